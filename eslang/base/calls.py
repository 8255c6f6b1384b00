"""Calls with arguments that are counted only when the program runs.

Python 3.11 makes `function(*arguments)` a call through C, which uses the C
stack: of such calls only so many may stand inside one another.
"""

from __future__ import annotations

import sys

from eslang.base.hints import Any, Sequence
from eslang.base.symbols import Value

NONE: dict[str, Any] = {}


def spread(function: Any, arguments: Sequence[Value]) -> Value:
    """Call FUNCTION with ARGUMENTS; directly where they are few, to spare the C stack."""
    match len(arguments):
        case 0:
            return function()
        case 1:
            return function(arguments[0])
        case 2:
            return function(arguments[0], arguments[1])
        case 3:
            return function(arguments[0], arguments[1], arguments[2])
        case 4:
            return function(arguments[0], arguments[1], arguments[2], arguments[3])
    return reenter(function, arguments)


depth = [0]  # how many calls through C the running task has inside one another

if sys.version_info >= (3, 12):

    def reenter(function: Any, arguments: Sequence[Value], keywords: dict[str, Any] = NONE) -> Value:
        """Call FUNCTION with any number of arguments."""
        return function(*arguments, **keywords)

else:
    DEEPEST = 1500

    def reenter(function: Any, arguments: Sequence[Value], keywords: dict[str, Any] = NONE) -> Value:
        """Call FUNCTION with any number of arguments; such calls use the C stack on Python 3.11."""
        if depth[0] > DEEPEST:
            raise RecursionError("too many calls with many arguments inside one another")
        depth[0] += 1
        try:
            return function(*arguments, **keywords)
        finally:
            depth[0] -= 1
