"""Conditions: one rule for what a condition means, wherever it stands.

In this order: AND, OR, NOT of conditions; a query, if the operator names a
relation; a call, if it names a function; else a query (language reference
§3). Relations come with the database; until then a query is refused.
"""

from __future__ import annotations

from eslang.base.failure import undefined_function
from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items, items, lisp_list
from eslang.base.running import running
from eslang.base.symbols import Symbol, Value, truth
from eslang.compile.registry import CL, ESL, function

AND, OR, NOT, IF, QUOTE, LIST = (Symbol.intern(n, CL) for n in ("AND", "OR", "NOT", "IF", "QUOTE", "LIST"))
CALLS, QUERY = (Symbol.intern(name, ESL) for name in ("%CALLS-P", "%HOLDS-P"))
LOGICAL_BINDING = Symbol.intern("LOGICAL-BINDING", ESL)


def test_form(condition: Value, environment: Any) -> Value:
    """A form that tells whether CONDITION holds."""
    if condition.__class__ is not Cons or not isinstance(condition.car, Symbol):
        return condition
    if condition.car in (AND, OR, NOT):
        return Cons(
            condition.car, from_items([test_form(part, environment) for part in items(condition.cdr)])
        )
    if is_operator(condition.car, environment):
        return condition
    return lisp_list(
        IF,
        lisp_list(CALLS, lisp_list(QUOTE, condition.car)),
        condition,
        lisp_list(QUERY, term_form(condition)),
    )


def instance_form(condition: Value, environment: Any) -> Value:
    """A form that gives CONDITION as data: with its arguments computed where it is a call."""
    if condition.__class__ is not Cons or not isinstance(condition.car, Symbol):
        return lisp_list(QUOTE, condition)
    operator = lisp_list(QUOTE, condition.car)
    if condition.car in (AND, OR, NOT):
        parts = [instance_form(part, environment) for part in items(condition.cdr)]
        return Cons(LIST, Cons(operator, from_items(parts)))
    if is_operator(condition.car, environment):
        return term_form(condition)
    computed = Cons(LIST, Cons(operator, condition.cdr))
    return lisp_list(IF, lisp_list(CALLS, operator), computed, term_form(condition))


def is_operator(symbol: Symbol, environment: Any) -> bool:
    """True if SYMBOL names a macro, a special form or a local function here."""
    session = running.session
    if environment is not None and environment.find_function(symbol) is not None:
        return True
    return session.image.cell(symbol).macro is not None or symbol in session.image.special_forms


def term_form(term: Value) -> Value:
    """A form that gives TERM as data, with the values of its #?variables."""
    if term.__class__ is not Cons:
        return lisp_list(QUOTE, term)
    if term.car is LOGICAL_BINDING:
        return term
    if not _has_bindings(term):
        return lisp_list(QUOTE, term)
    return Cons(LIST, from_items([term_form(part) for part in items(term)]))


def _has_bindings(term: Value) -> bool:
    pending = [term]
    while pending:
        part = pending.pop()
        if part.__class__ is Cons:
            if part.car is LOGICAL_BINDING:
                return True
            pending += [part.car, part.cdr]
    return False


@function("(%calls-p operator)", ESL)
def calls_p(operator: Symbol) -> Value:
    """Tell whether a condition with OPERATOR is a call."""
    return truth(hasattr(running.session.image.cell(operator), "function"))


@function("(%holds-p query)", ESL)
def holds_p(query: Cons) -> Value:
    """Tell whether QUERY holds in the database.

    Fails: :undefined-function, as long as there is no database.
    """
    raise undefined_function(query.car)
