"""All of FORMAT's directives, together; loaded when a control string is first run."""

from __future__ import annotations

from eslang.base.symbols import Value
from eslang.lisp import format_blocks, format_floats, format_numbers, format_text
from eslang.lisp.format_control import parse_control
from eslang.lisp.format_run import Run
from eslang.lisp.streams import StringOutputStream

DIRECTIVE_FILES = (format_text, format_numbers, format_floats, format_blocks)  # they register themselves


def run_control(control: str, arguments: tuple[Value, ...], column: int) -> str:
    """What CONTROL makes of ARGUMENTS where writing begins in COLUMN."""
    out = StringOutputStream()
    out.column = column
    Run(out, list(arguments)).perform(parse_control(control))
    return out.take()
