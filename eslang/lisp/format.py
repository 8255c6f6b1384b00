"""FORMAT: text made of a control string and arguments (CLHS 22.3).

Here is where the text goes. The control string is parsed by format_control.py;
what the directives do stands in format_text.py, format_numbers.py,
format_floats.py and format_blocks.py, which are loaded when first wanted. The
text arrives in one piece.
"""

from __future__ import annotations

from eslang.base.failure import simple_error, type_error
from eslang.base.symbols import Value
from eslang.base.text import String
from eslang.compile.registry import function
from eslang.lisp.streams import FillStream, OutputStream, output_stream


def formatted(control: Value, arguments: tuple[Value, ...], column: int = 0) -> str:
    """What CONTROL makes of ARGUMENTS where writing begins in COLUMN."""
    from eslang.lisp.format_machine import run_control

    if control.__class__ is not String:
        raise type_error(control, "STRING", "format")
    return run_control(control.text, arguments, column)


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
        return String(formatted(control, arguments))
    stream = _destination(destination)
    stream.write(formatted(control, arguments, stream.column))
    return None
