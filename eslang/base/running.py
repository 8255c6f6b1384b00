"""Which interpreter is at work on this thread.

A Lisp function such as PRINT is one Python function for all interpreters; what
it needs of the one that called it, it finds here. The interpreter sets it at
every entrance and sets it back at the exit, so two of them never meet, not
even when one's primitive calls the other. (Decision 0002.)
"""

from __future__ import annotations

from _thread import _local as ThreadLocal  # what threading.local is, without the rest of threading
from types import FunctionType

from eslang.base.failure import type_error, undefined_function
from eslang.base.hints import Any
from eslang.base.symbols import Symbol, Value


class _Running(ThreadLocal):
    session: Any = None  # an eslang.interpreter.Session while one is at work


running = _Running()


def to_function(designator: Value) -> Any:
    """The function that DESIGNATOR (a function, or a symbol that names one) designates."""
    if designator.__class__ is FunctionType:
        return designator
    if isinstance(designator, Symbol) or designator is None:  # NIL, too, is a symbol
        try:
            return running.session.image.cell(designator).function
        except AttributeError:
            raise undefined_function(designator) from None
    if callable(designator):
        return designator
    raise type_error(designator, "FUNCTION")
