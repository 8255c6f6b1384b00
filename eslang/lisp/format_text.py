"""FORMAT's directives for objects, characters, layout and going to and fro in the arguments.

~A ~S ~W ~C, ~% ~& ~~ ~| ~T ~I ~_, ~* ~P ~/name/ (CLHS 22.3.1, 22.3.4, 22.3.5-7).
"""

from __future__ import annotations

from eslang.base.character_names import character_name
from eslang.base.hints import Callable
from eslang.base.printer import write_text
from eslang.base.running import running, to_function
from eslang.base.sameness import is_eql
from eslang.base.symbols import Value, truth
from eslang.base.text import character
from eslang.lisp.characters import check_character
from eslang.lisp.format_control import Directive, directive
from eslang.lisp.format_run import ANY, GO_ON, Run
from eslang.lisp.output import current_settings, prin1_text, princ_text

BLANK = character(" ")


def padded(text: str, parameters: list[Value], left: bool) -> str:
    """TEXT with the padding that ~mincol,colinc,minpad,padcharA asks for."""
    width, step, count, pad = parameters
    count = max(count, 0)
    missing = width - len(text) - count
    if missing > 0:
        step = max(step, 1)
        count += (missing + step - 1) // step * step
    padding: str = pad.char * count
    return padding + text if left else text + padding


@directive("A", parameters=4)
def write_for_people(run: Run, directive: Directive) -> int:
    """~A: an argument as PRINC writes it."""
    return _write(run, directive, princ_text)


@directive("S", parameters=4)
def write_for_reading(run: Run, directive: Directive) -> int:
    """~S: an argument as PRIN1 writes it."""
    return _write(run, directive, prin1_text)


def _write(run: Run, directive: Directive, text_of: Callable[[Value], str]) -> int:
    parameters = run.parameters(directive, 0, 1, 0, BLANK) if directive.parameters else None
    value = run.next(directive)
    text = "()" if directive.colon and value is None else text_of(value)
    run.out.write(padded(text, parameters, directive.at) if parameters else text)
    return GO_ON


@directive("W")
def write_as_set(run: Run, directive: Directive) -> int:
    """~W: an argument as WRITE writes it."""
    run.out.write(write_text(run.next(directive), current_settings()))
    return GO_ON


@directive("C")
def write_character(run: Run, directive: Directive) -> int:
    """~C: a character; ~:C by its name, ~@C as the reader wants it."""
    value = run.next(directive)
    char = check_character(value, "format")
    if directive.colon:
        run.out.write(character_name(char) or char)
    else:
        run.out.write(prin1_text(value) if directive.at else char)
    return GO_ON


def _repeat(run: Run, directive: Directive, text: str) -> int:
    (count,) = run.parameters(directive, 1)
    run.out.write(text * count)
    return GO_ON


@directive("%", parameters=1)
def write_newlines(run: Run, directive: Directive) -> int:
    """~%: a newline."""
    return _repeat(run, directive, "\n")


@directive("|", parameters=1)
def write_pages(run: Run, directive: Directive) -> int:
    """~|: a new page."""
    return _repeat(run, directive, "\f")


@directive("~", parameters=1)
def write_tildes(run: Run, directive: Directive) -> int:
    """~~: a tilde."""
    return _repeat(run, directive, "~")


@directive("&", parameters=1)
def write_fresh_line(run: Run, directive: Directive) -> int:
    """~&: a newline unless the line is empty; ~n& and n-1 newlines more."""
    (count,) = run.parameters(directive, 1)
    if count > 0:
        run.out.fresh_line()
        run.out.write("\n" * (count - 1))
    return GO_ON


@directive("T", parameters=2)
def tabulate(run: Run, directive: Directive) -> int:
    """~T: blanks up to a column; ~@T some blanks, then up to a multiple of a column."""
    number, step = run.parameters(directive, 1, 1)
    column = run.out.column
    if directive.colon:  # relative to a section of the pretty printer, which there is none of
        return GO_ON
    if directive.at:
        target = column + number
        if step > 0:
            target = -(-target // step) * step
    elif column < number:
        target = number
    else:
        target = number + ((column - number) // step + 1) * step if step > 0 else column
    run.out.write(" " * (target - column))
    return GO_ON


@directive("_I", parameters=1)
def break_line(run: Run, directive: Directive) -> int:
    """~_ and ~I: hints for a pretty printer; nothing is written."""
    return GO_ON


@directive("*", parameters=1)
def move(run: Run, directive: Directive) -> int:
    """~n*: skip N arguments; ~n:* go N back; ~n@* go to the Nth, from 0."""
    (count,) = run.parameters(directive, None)
    if directive.at:
        place = count or 0
    else:
        step = 1 if count is None else count
        place = run.place + (-step if directive.colon else step)
    if not 0 <= place <= len(run.arguments):
        raise directive.wrong(f"there is no argument {place}")
    run.place = place
    return GO_ON


@directive("P")
def pluralize(run: Run, directive: Directive) -> int:
    """~P: an s unless the argument is 1; ~@P y or ies; with `:` for the argument before."""
    if directive.colon:
        if run.place == 0:
            raise directive.wrong("there is no argument before")
        run.place -= 1
    one = is_eql(run.next(directive), 1)
    if directive.at:
        run.out.write("y" if one else "ies")
    else:
        run.out.write("" if one else "s")
    return GO_ON


@directive("/", parameters=10)
def call_function(run: Run, directive: Directive) -> int:
    """~/name/: call a function with the stream, an argument, the two marks and the parameters."""
    given = run.parameters(directive, *[ANY] * len(directive.parameters))
    parameters = [None if parameter is ANY else parameter for parameter in given]
    function = to_function(_symbol_called(directive))
    value = run.next(directive)
    function(run.out, value, truth(directive.colon), truth(directive.at), *parameters)
    return GO_ON


def _symbol_called(directive: Directive) -> Value:
    package_name, colon, name = directive.name.upper().rpartition(":")
    image = running.session.image
    package = image.packages.get(package_name.rstrip(":")) if colon else image.package
    if package is None:
        raise directive.wrong(f"there is no package {package_name.rstrip(':')}")
    return package.intern(name)
