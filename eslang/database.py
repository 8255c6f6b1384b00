"""The logical database of an interpreter: facts that know the session's functions and listeners."""

from __future__ import annotations

from eslang.base.calls import spread
from eslang.base.failure import undefined_function
from eslang.base.hints import TYPE_CHECKING
from eslang.base.running import running
from eslang.base.symbols import Symbol, Value
from eslang.facts.query import Facts
from eslang.runtime.failures import guarded

if TYPE_CHECKING:
    from eslang.facts.watching import Change
    from eslang.interpreter import Interpreter


def make_database(session: Interpreter) -> Facts:
    """An empty database for SESSION, whose listeners hear of each change."""
    cell, hooks = session.image.cell, session.hooks

    def is_call(symbol: Symbol) -> bool:
        return hasattr(cell(symbol), "function")

    def tell(change: Change) -> None:
        hooks.tell("fact", None, added=change.added, fact=change.fact)

    made = Facts(is_call, call_test)
    made.audience, made.tell = hooks.listeners, tell
    return made


def call_test(symbol: Symbol, arguments: list[Value]) -> bool:
    """Whether the function SYMBOL says something else than NIL of ARGUMENTS."""
    try:
        function = running.session.image.cell(symbol).function
    except AttributeError:
        raise undefined_function(symbol) from None
    return guarded(lambda: spread(function, arguments)) is not None
