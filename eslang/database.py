"""The logical database of an interpreter: facts that know the session's functions and listeners."""

from __future__ import annotations

from eslang.base.calls import spread
from eslang.base.hints import TYPE_CHECKING, Iterable
from eslang.base.lists import Cons, items
from eslang.base.running import running, to_function
from eslang.base.symbols import Symbol, Value
from eslang.facts.nested import Written, filled
from eslang.facts.query import Facts
from eslang.facts.unify import is_variable
from eslang.runtime.failures import guarded
from eslang.runtime.story import place_here

if TYPE_CHECKING:
    from eslang.facts.watching import Change
    from eslang.interpreter import Interpreter

FUNCTION, QUOTE = (Symbol.intern(name, "COMMON-LISP") for name in ("FUNCTION", "QUOTE"))


def make_database(session: Interpreter) -> Facts:
    """An empty database for SESSION, whose listeners hear of each change."""
    cell, hooks = session.image.cell, session.hooks

    def is_call(symbol: Symbol) -> bool:
        return hasattr(cell(symbol), "function")

    def tell(change: Change) -> None:
        place = place_here() if hooks.current() is not None else None
        hooks.tell("fact", place, added=change.added, fact=change.fact)

    def look() -> None:
        if session.ticks.pending is not None:
            session.scheduler.safepoint()

    made = Facts(is_call, call_test)
    made.audience, made.tell = hooks.listeners, tell
    made.pauses.give_way, made.pauses.look = session.scheduler.safepoint, look
    return made


def call_test(symbol: Symbol, arguments: list[Value]) -> bool:
    """Whether the function SYMBOL says something else than NIL of ARGUMENTS."""
    return guarded(lambda: _apply(symbol, arguments)) is not None


def _apply(symbol: Symbol, arguments: Iterable[Value]) -> Value:
    function = to_function(symbol)
    return spread(function, [_computed(each) if each.__class__ is Written else each for each in arguments])


def _computed(written: Written) -> Value:
    """The value of an argument.

    A variable has its value, a call of a function is made, what is quoted is
    as it stands, a global variable has its value; all else stands for itself.
    """
    form, bindings = written
    if is_variable(form):
        return bindings[form]
    if form.__class__ is not Cons:
        return _global(form) if form.__class__ is Symbol else form
    if form.car is QUOTE or form.car is FUNCTION:
        datum = filled(form.cdr.car, bindings)
        return datum if form.car is QUOTE else to_function(datum)
    if isinstance(form.car, Symbol) and hasattr(running.session.image.cell(form.car), "function"):
        return _apply(form.car, [Written(each, bindings) for each in items(form.cdr)])
    return filled(form, bindings)


def _global(symbol: Symbol) -> Value:
    """The value of the global variable SYMBOL; SYMBOL, if it is none."""
    cell = running.session.image.cell(symbol)
    return getattr(cell, "value", symbol) if cell.special or cell.constant else symbol
