"""FORMAT: text made of a control string and arguments (CLHS 22.3).

The control string is parsed by format_control.py; what the directives do stands
in format_text.py, format_numbers.py, format_floats.py and format_blocks.py,
which register themselves when imported here. The text arrives in one piece.
"""

from __future__ import annotations

from eslang.base.failure import simple_error, type_error
from eslang.base.symbols import T, Value
from eslang.base.text import String
from eslang.compile.registry import function
from eslang.lisp import format_blocks, format_floats, format_numbers, format_text
from eslang.lisp.format_control import parse_control
from eslang.lisp.format_run import Run
from eslang.lisp.streams import FillStream, OutputStream, StringOutputStream, output_stream

DIRECTIVE_FILES = (format_text, format_numbers, format_floats, format_blocks)


def format_text_at(column: int, control: Value, arguments: tuple[Value, ...]) -> str:
    """What CONTROL makes of ARGUMENTS where writing begins in COLUMN."""
    if control.__class__ is not String:
        raise type_error(control, "STRING", "format")
    out = StringOutputStream()
    out.column = column
    Run(out, list(arguments)).perform(parse_control(control.text))
    return out.take()


def formatted(control: Value, arguments: tuple[Value, ...]) -> str:
    """What CONTROL makes of ARGUMENTS."""
    return format_text_at(0, control, arguments)


def _destination(designator: Value) -> OutputStream:
    if designator.__class__ is not String:
        return output_stream(designator, "format")
    if not designator.fill:
        raise simple_error("FORMAT: the string has no fill pointer", designator)
    return FillStream(designator)


@function("(format destination control &rest arguments)")
def format_(destination: Value, control: Value, *arguments: Value) -> Value:
    """Write ARGUMENTS as CONTROL says.

    DESTINATION is T for *STANDARD-OUTPUT*, a stream, a string with a fill
    pointer, or NIL to return the text as a string.
    Returns: the string if DESTINATION is NIL, else NIL.
    Fails:   :error for a wrong directive, naming it and its position, and for
             arguments that are missing.
    """
    if destination is None:
        return String(format_text_at(0, control, arguments))
    stream = _destination(T if destination is T else destination)
    stream.write(format_text_at(stream.column, control, arguments))
    return None
