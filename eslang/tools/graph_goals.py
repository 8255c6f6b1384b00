"""Which methods a goal may have, as far as its text tells."""

from __future__ import annotations

from collections.abc import Iterator

from eslang.base.lists import Cons
from eslang.base.symbols import Symbol, Value
from eslang.base.text import String
from eslang.compile.registry import CL, ESL
from eslang.facts.goals import CONNECTIVES
from eslang.facts.unify import is_variable

QUOTES = tuple(Symbol.intern(name, CL) for name in ("QUOTE", "QUASIQUOTE"))
OPEN = (Symbol.intern("UNQUOTE", CL), Symbol.intern("LOGICAL-BINDING", ESL))


def goals_in(condition: Value) -> Iterator[Cons]:
    """The goals that CONDITION is made of."""
    pending = [condition]
    while pending:
        goal = pending.pop()
        if goal.__class__ is not Cons:
            continue
        if goal.car in QUOTES and goal.cdr.__class__ is Cons:
            pending.append(goal.cdr.car)
        elif isinstance(goal.car, Symbol) and goal.car in CONNECTIVES:
            rest, parts = goal.cdr, []
            while rest.__class__ is Cons:
                parts.append(rest.car)
                rest = rest.cdr
            pending += reversed(parts)
        elif goal.car in OPEN:
            pass  # it shows only when the plan runs
        else:
            yield goal


def may_match(pattern: Value, goal: Value) -> bool:
    """Whether PATTERN and GOAL may be the same, when the plan runs."""
    pending = [(pattern, goal)]
    while pending:
        one, other = pending.pop()
        if is_open(one) or is_open(other):
            continue
        if one.__class__ is Cons and other.__class__ is Cons:
            pending += [(one.cdr, other.cdr), (one.car, other.car)]
        elif one.__class__ is String and other.__class__ is String:
            if one.text != other.text:
                return False
        elif one.__class__ is not other.__class__ or one != other:
            return False
    return True


def is_open(term: Value) -> bool:
    """Whether TERM may stand for anything: a variable, or what is computed."""
    return is_variable(term) or (term.__class__ is Cons and isinstance(term.car, Symbol) and term.car in OPEN)
