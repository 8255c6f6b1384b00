"""Forms and what they come to, as text: for tests of Lisp functions that need an interpreter."""

from __future__ import annotations

from functools import cache
from io import StringIO
from typing import Any

from eslang.base.failure import Failure
from eslang.base.printer import prin1


@cache
def _interpreter() -> Any:
    from eslang.interpreter import Interpreter

    return Interpreter(seed=0, clock="virtual", output=StringIO())


def value_of(text: str) -> str:
    """The value of the last form of TEXT as PRIN1 writes it, or `failure :CAUSE`.

    One interpreter serves all tests, so names that are given a meaning should be the test's own.
    """
    from eslang.base.spans import Source

    interp, values = _interpreter(), [None]
    try:
        for reading in interp.readings(Source("<test>", text)):
            values = interp.evaluate(reading)
    except Failure as failure:
        return f"failure {prin1(failure.cause)}"
    return prin1(values[0] if values else None)
