"""What forms come to, as text: for tests of the compiler.

One interpreter serves all tests, so names that are given a meaning should be
the test's own.
"""

from __future__ import annotations

from functools import cache
from io import StringIO
from typing import Any

import pytest

from eslang.base.diagnostics import EslError
from eslang.base.failure import Failure
from eslang.base.printer import prin1
from eslang.base.spans import Source


@cache
def interpreter() -> Any:
    """The one that all tests share."""
    from eslang.interpreter import Interpreter

    return Interpreter(seed=0, clock="virtual", output=StringIO())


def values_of(text: str) -> str:
    """All the values of the last form of TEXT, with blanks between them."""
    interp, values = interpreter(), []
    for reading in interp.readings(Source("<test>", text)):
        values = interp.evaluate(reading)
    return " ".join(prin1(value) for value in values)


def failure_of(text: str, count: int = 9) -> str:
    """The cause of the failure that TEXT ends in, and the first COUNT of its arguments."""
    with pytest.raises(Failure) as raised:
        values_of(text)
    failure = raised.value
    return " ".join(prin1(part) for part in (failure.cause, *failure.arguments[:count]))


def mistake_of(text: str) -> str:
    """The name of the diagnostic that refuses TEXT."""
    with pytest.raises(EslError) as raised:
        values_of(text)
    return raised.value.diagnostic.name
