"""FORMAT's directives for integers: ~D ~B ~O ~X ~R (CLHS 22.3.2)."""

from __future__ import annotations

from eslang.base.number_text import integer_text
from eslang.base.printer import write_text
from eslang.base.symbols import Value
from eslang.base.text import character
from eslang.lisp.characters import check_radix
from eslang.lisp.format_control import Directive, Perform, directive
from eslang.lisp.format_run import GO_ON, Run
from eslang.lisp.format_text import BLANK
from eslang.lisp.format_words import LARGEST_IN_WORDS, cardinal, ordinal, roman
from eslang.lisp.numbers import check_integer
from eslang.lisp.output import current_settings

_COMMA = character(",")


def _write_integer(run: Run, directive: Directive, base: int, layout: list[Value]) -> int:
    """An integer in BASE, laid out by mincol, padchar, commachar and comma-interval."""
    value = run.next(directive)
    if value.__class__ is not int:
        settings = current_settings(False)._replace(base=base, radix=False)
        run.out.write(write_text(value, settings))
        return GO_ON
    width, pad, comma, interval = layout
    digits = integer_text(abs(value), base)
    if directive.colon and interval > 0:
        digits = _grouped(digits, comma.char, interval)
    sign = "-" if value < 0 else "+" if directive.at else ""
    run.out.write((sign + digits).rjust(width, pad.char) if width > 0 else sign + digits)
    return GO_ON


def _grouped(digits: str, comma: str, interval: int) -> str:
    first = len(digits) % interval or interval
    groups = [digits[:first]]
    groups.extend(digits[place : place + interval] for place in range(first, len(digits), interval))
    return comma.join(groups)


def _register(char: str, base: int) -> None:
    def write(run: Run, directive: Directive) -> int:
        return _write_integer(run, directive, base, run.parameters(directive, 0, BLANK, _COMMA, 3))

    perform: Perform = write
    directive(char, parameters=4)(perform)


_register("D", 10)
_register("B", 2)
_register("O", 8)
_register("X", 16)


@directive("R", parameters=5)
def write_radix(run: Run, directive: Directive) -> int:
    """~nR: an integer in base N; ~R in words, ~:R as an ordinal, ~@R in Roman figures."""
    radix, *layout = run.parameters(directive, None, 0, BLANK, _COMMA, 3)
    if radix is not None:
        return _write_integer(run, directive, check_radix(radix, "format"), layout)
    number = check_integer(run.next(directive), "format")
    if directive.at:
        if not 0 < number < (5000 if directive.colon else 4000):
            raise directive.wrong("no Roman figures for such a number", number)
        run.out.write(roman(number, directive.colon))
        return GO_ON
    if abs(number) > LARGEST_IN_WORDS:
        raise directive.wrong("no words for so large a number", number)
    run.out.write(ordinal(number) if directive.colon else cardinal(number))
    return GO_ON
