"""What may help after a failure that the logical database found: one line for people.

It knows what the arguments of such failures are, and asks the image which
names are functions; where a hint is shown is the reports' matter.
"""

from __future__ import annotations

from typing import Any

from eslang.base.failure import Failure
from eslang.base.lists import Cons
from eslang.base.printer import prin1
from eslang.base.symbols import Symbol, Value
from eslang.facts.goals import UNBOUND
from eslang.facts.unify import is_variable


def fact_hint(failure: Failure, interp: Any) -> str | None:
    """What to do about FAILURE, if it is one of the database."""
    cause, values = failure.cause, failure.values
    if cause is UNBOUND and len(values) == 2 and values[1].__class__ is Cons:
        return _unbound(values[0], values[1], interp)
    if cause.name == "UNSTRATIFIED-RULES":
        return "let one of these relations be asserted rather than derived"
    if cause.name == "UNBOUNDED-RULES":
        return "ask with more arguments known, or let the rules take lists apart rather than build them"
    if cause.name == "TYPE-ERROR" and len(values) == 2 and isinstance(values[1], Symbol):
        if values[1].name == "RELATION":
            return _no_relation(values[0])
        if values[1].name == "FACT":
            return "one pattern is meant here; queries of several parts are for DB-QUERY and its like"
    return None


def _unbound(variable: Value, form: Cons, interp: Any) -> str | None:
    operator, name = form.car, prin1(variable).lower()
    if not isinstance(operator, Symbol):
        return None
    written = prin1(operator).lower()
    if operator.name == "NOT":
        return f"a pattern beside the NOT has to say what `{name}` may be; under NOT, `?_` is anything"
    if interp is None or interp.is_relation(operator):
        return None
    if not hasattr(interp.image.cell(operator), "function"):
        return None
    if operator in interp.database.reserved:
        return f"a pattern has to say what `{name}` may be"
    return f"`{written}` is a function, so this is a call; `(defrelation {written})` makes it a relation"


def _no_relation(name: Value) -> str:
    if isinstance(name, Symbol) and not is_variable(name):
        return f"`{prin1(name).lower()}` has a meaning of its own in queries: give the relation another name"
    return "a fact or a pattern begins with the name of a relation, which is a symbol and no variable"
