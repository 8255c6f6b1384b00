"""FORMAT's directives for floats: ~F ~E ~G ~$ (CLHS 22.3.3).

Digits that are left out are rounded by the exact value of the float, halves
away from zero; digits that are not there are zeros.
"""

from __future__ import annotations

import math

from eslang.base.number_kinds import is_number
from eslang.base.number_text import decimal_digits
from eslang.base.symbols import Value
from eslang.lisp.format_control import Directive, directive
from eslang.lisp.format_run import GO_ON, Run
from eslang.lisp.format_text import BLANK, padded
from eslang.lisp.numbers_reals import as_float
from eslang.lisp.output import princ_text


def _scaled(size: float, power: int) -> int:
    """SIZE times ten to the POWER, rounded to an integer, halves up."""
    above, below = size.as_integer_ratio()
    if power >= 0:
        above *= 10**power
    else:
        below *= 10**-power
    return (2 * above + below) // (2 * below)


def fixed_digits(size: float, places: int | None, scale: int = 0) -> tuple[str, str]:
    """The digits before and after the point of SIZE times ten to the SCALE, PLACES of them after it.

    No PLACES: as many as there are, at least one. Zero before the point gives no digit.
    """
    digits, point = decimal_digits(size)
    point += scale
    if places is not None and len(digits) - point > places:
        digits = str(_scaled(size, places + scale)).rjust(places, "0")
        point = len(digits) - places
    elif size == 0:
        digits, point = "", 0
    whole = digits[:point].ljust(point, "0") if point > 0 else ""
    fraction = digits[point:] if point >= 0 else "0" * -point + digits
    return whole.lstrip("0"), fraction.ljust(1 if places is None else places, "0")


def exponent_digits(size: float, count: int | None) -> tuple[str, int]:
    """COUNT digits of SIZE (no COUNT: all) and the exponent of 0.DIGITS."""
    digits, point = decimal_digits(size)
    if size == 0 or count is None or count >= len(digits):
        return digits.ljust(count or 1, "0"), point
    if count <= 0:
        return "", point
    rounded = str(_scaled(size, count - point))
    if len(rounded) > count:  # 9.99 became 10.0
        return rounded[:-1], point + 1
    return rounded, point


def _float_argument(run: Run, directive: Directive, width: int | None) -> float | None:
    """The next argument as a float; written already, and None, if it is no finite number."""
    value: Value = run.next(directive)
    if is_number(value):
        number = as_float(value, "format")
        if math.isfinite(number):
            return number
        value = number
    run.out.write(padded(princ_text(value), [width or 0, 1, 0, BLANK], False))
    return None


def _sign(number: float, always: bool) -> str:
    return "-" if math.copysign(1.0, number) < 0 else "+" if always else ""


def _laid_out(text: str, width: int | None, overflow: Value, pad: str) -> str:
    if width is None:
        return text
    if len(text) > width and overflow is not None:
        return str(overflow.char * width)
    return text.rjust(width, pad)


@directive("F", parameters=5)
def write_fixed(run: Run, directive: Directive) -> int:
    """~w,d,k,overflowchar,padcharF: a float with a fixed point."""
    width, places, scale, overflow, pad = _float_parameters(run, directive, None, None, 0)
    number = _float_argument(run, directive, width)
    if number is not None:
        text = fixed_text(number, width, places, scale, directive.at)
        run.out.write(_laid_out(text, width, overflow, pad.char))
    return GO_ON


def _float_parameters(run: Run, directive: Directive, *numbers: Value) -> list[Value]:
    """The parameters of ~F, ~E or ~G: NUMBERS are the defaults before overflowchar and padchar."""
    values = run.parameters(directive, *numbers, _NO_CHARACTER, BLANK, *_MARKER[: len(numbers) == 4])
    if values[len(numbers)] is _NO_CHARACTER:
        values[len(numbers)] = None
    return values


_NO_CHARACTER = type(BLANK)("")
_MARKER = (type(BLANK)("e"),)


def fixed_text(number: float, width: int | None, places: int | None, scale: int, plus: bool) -> str:
    """NUMBER with a fixed point, in WIDTH if that can be."""
    sign, size = _sign(number, plus), abs(number)
    whole, fraction = fixed_digits(size, places, scale)
    if width is None:
        return f"{sign}{whole or '0'}.{fraction}"
    if places is None:
        room = max(width - len(sign) - len(whole) - 1, 0)
        if len(fraction) > room:
            whole, fraction = fixed_digits(size, room, scale)
    if not whole and (width > len(sign) + 1 + len(fraction) or not fraction):
        whole = "0"
    return f"{sign}{whole}.{fraction}"


@directive("E", parameters=7)
def write_exponential(run: Run, directive: Directive) -> int:
    """~w,d,e,k,overflowchar,padchar,exptcharE: a float with an exponent."""
    width, places, size, scale, overflow, pad, marker = _float_parameters(run, directive, None, None, None, 1)
    number = _float_argument(run, directive, width)
    if number is None:
        return GO_ON
    text, fits = exponential_text(number, width, places, size, scale, marker.char, directive.at)
    if not fits and width is not None and overflow is not None:
        text = overflow.char * width
    run.out.write(_laid_out(text, width, overflow, pad.char))
    return GO_ON


def exponential_text(
    number: float,
    width: int | None,
    places: int | None,
    exponent_size: int | None,
    scale: int,
    marker: str,
    plus: bool,
) -> tuple[str, bool]:
    """NUMBER with an exponent, SCALE digits before the point; and whether the exponent fits its size."""
    sign, size = _sign(number, plus), abs(number)

    def tail(point: int) -> str:
        exponent = point - scale if size else 0
        digits = str(abs(exponent)).rjust(exponent_size or 1, "0")
        return f"{marker}{'-' if exponent < 0 else '+'}{digits}"

    count = None
    if places is not None:
        count = places + 1 if scale > 0 else places + scale
    digits, point = exponent_digits(size, count)
    if count is None and width is not None:
        room = width - len(sign) - 1 - len(tail(point)) - max(-scale, 0)
        if room < len(digits):
            digits, point = exponent_digits(size, max(room, scale, 1))
    if scale > 0:
        digits = digits.ljust(scale, "0")
        whole, fraction = digits[:scale], digits[scale:]
    else:
        whole, fraction = "", "0" * -scale + digits
    if places is not None:
        fraction = fraction.ljust(places - max(scale - 1, 0), "0")
    end = tail(point)
    if not fraction and places is None:
        fraction = "0"
    if not whole and (width is None or width > len(sign) + 1 + len(fraction) + len(end)):
        whole = "0"
    fits = exponent_size is None or len(end) <= exponent_size + 2
    return f"{sign}{whole}.{fraction}{end}", fits


@directive("G", parameters=7)
def write_general(run: Run, directive: Directive) -> int:
    """~G: as ~F where that shows the number well, else as ~E."""
    width, places, size, _, overflow, pad, _ = _float_parameters(run, directive, None, None, None, None)
    number = _float_argument(run, directive, width)
    if number is None:
        return GO_ON
    digits, point = decimal_digits(number)
    if number == 0:
        digits, point = "", 0
    wanted = max(len(digits), min(point, 7)) if places is None else places
    if not 0 <= wanted - point <= wanted:
        run.place -= 1
        return write_exponential(run, directive)
    blanks = 4 if size is None else size + 2
    inner = None if width is None else width - blanks
    text = fixed_text(number, inner, wanted - point, 0, directive.at)
    run.out.write(_laid_out(text, inner, overflow, pad.char) + " " * blanks)
    return GO_ON


@directive("$", parameters=4)
def write_money(run: Run, directive: Directive) -> int:
    """~d,n,w,padchar$: a float with D digits after the point and at least N before it."""
    places, least, width, pad = run.parameters(directive, 2, 1, 0, BLANK)
    number = _float_argument(run, directive, width)
    if number is None:
        return GO_ON
    sign = _sign(number, directive.at)
    whole, fraction = fixed_digits(abs(number), places)
    text = f"{whole.rjust(least, '0')}.{fraction}"
    if directive.colon:
        run.out.write(sign + text.rjust(width - len(sign), pad.char))
    else:
        run.out.write((sign + text).rjust(width, pad.char))
    return GO_ON
