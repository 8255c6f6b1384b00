"""Conditions: one rule for what a condition means, wherever it stands.

In this order: AND, OR, NOT of conditions; a query, if the operator names a
relation; a call, if it names a function; else a query (language reference
§3). Parts of an AND that speak of logic variables are one query: a call
among them is a test, in which the variables have their values. A condition
under a quote or a backquote is the one that is written there; #?x is the one
that it is bound to. What cannot be a call, as (at robot (3 4)), is a query.
"""

from __future__ import annotations

from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items, items, lisp_list
from eslang.base.running import running
from eslang.base.symbols import Keyword, Symbol, Value, truth
from eslang.compile.registry import CL, ESL, function
from eslang.constructs.queries import LOGICAL_BINDING, in_force, mentions_binding
from eslang.facts.unify import is_variable

AND, OR, NOT, IF, QUOTE, LIST, PROGN, LAMBDA, FUNCTION, FUNCALL, QUASIQUOTE, UNQUOTE, LET = (
    Symbol.intern(name, CL)
    for name in (
        *("AND", "OR", "NOT", "IF", "QUOTE", "LIST", "PROGN", "LAMBDA", "FUNCTION", "FUNCALL"),
        *("QUASIQUOTE", "UNQUOTE", "LET"),
    )
)
WHERE_FUNCTION = Symbol.intern("%WHERE-FUNCTION", CL)
CALLS, HOLDS, ASKS_LISP, IN_FORCE, COMPUTED = (
    Symbol.intern(name, ESL)
    for name in ("%CALLS-P", "%HOLDS-P", "%ASKS-LISP", "%IN-FORCE", "%COMPUTED-CONDITION")
)
CONNECTIVES = (AND, OR, NOT)


def test_form(condition: Value, environment: Any) -> Value:
    """A form that tells whether CONDITION holds."""
    if not is_compound(condition):
        return lisp_list(PROGN, lisp_list(ASKS_LISP), condition)
    if is_written(condition):
        return lisp_list(HOLDS, condition)
    operator, parts = condition.car, items(condition.cdr) if condition.car in CONNECTIVES else []
    if operator is AND:
        joined = [part for part in parts if has_variables(part)]
        tests = [test_form(part, environment) for part in parts if not has_variables(part)]
        if len(joined) == 1:
            tests.append(test_form(joined[0], environment))
        elif joined:
            tests.append(lisp_list(HOLDS, query_form(Cons(AND, from_items(joined)), environment)))
        return Cons(AND, from_items(tests))
    if operator in CONNECTIVES:
        return Cons(operator, from_items([test_form(part, environment) for part in parts]))
    if has_variables(condition):
        return lisp_list(HOLDS, query_form(condition, environment))
    call = lisp_list(PROGN, lisp_list(ASKS_LISP), condition)
    if is_operator(operator, environment):
        return call
    query = lisp_list(HOLDS, term_form(condition))
    return if_called(operator, call, query) if may_call(condition, environment) else query


def query_form(condition: Value, environment: Any) -> Value:
    """A form that gives CONDITION as a query: calls are tests that know the variables around them."""
    if not is_compound(condition):
        return test_query_form(condition)
    if is_written(condition):
        return condition
    operator = condition.car
    if operator in CONNECTIVES:
        parts = [query_form(part, environment) for part in items(condition.cdr)]
        if all(part.__class__ is Cons and part.car is QUOTE for part in parts):
            return lisp_list(QUOTE, Cons(operator, from_items([part.cdr.car for part in parts])))
        return Cons(LIST, Cons(lisp_list(QUOTE, operator), from_items(parts)))
    if is_operator(operator, environment):
        return test_query_form(condition)
    if all(map(is_constant, items(condition.cdr))):
        return lisp_list(QUOTE, condition)
    query = term_form(condition)
    if not may_call(condition, environment):
        return query
    return if_called(operator, test_query_form(condition), query)


def test_query_form(form: Value) -> Value:
    """A form that gives a query for the value of FORM, under the bindings of the variables in it."""
    variables = list(variables_of(form))
    closure = lisp_list(LAMBDA, from_items(variables), form)
    quoted = [lisp_list(QUOTE, variable) for variable in variables]
    return lisp_list(LIST, lisp_list(QUOTE, FUNCALL), closure, *quoted)


def instance_form(condition: Value, environment: Any) -> Value:
    """A form that gives CONDITION as data: with its arguments computed where it is a call."""
    if not is_compound(condition):
        return lisp_list(QUOTE, condition)
    if is_written(condition):
        return lisp_list(IN_FORCE, condition)
    operator = lisp_list(QUOTE, condition.car)
    if condition.car in CONNECTIVES:
        parts = [instance_form(part, environment) for part in items(condition.cdr)]
        return Cons(LIST, Cons(operator, from_items(parts)))
    is_call = not is_operator(condition.car, environment) and may_call(condition, environment)
    if not is_call or has_variables(condition):
        return term_form(condition)
    computed = Cons(LIST, Cons(operator, condition.cdr))
    return if_called(condition.car, computed, term_form(condition))


def computed_once(condition: Value) -> tuple[Value, Value]:
    """CONDITION, with variables in place of what stands under backquotes in it; and how LET binds these."""
    bindings: list[Value] = []

    def computed(part: Value) -> Value:
        if not is_compound(part):
            return part
        if part.car is QUASIQUOTE:
            name = Symbol.uninterned("CONDITION")
            bindings.append(lisp_list(name, lisp_list(COMPUTED, part)))
            return lisp_list(QUASIQUOTE, lisp_list(UNQUOTE, name))
        if part.car in CONNECTIVES:
            return Cons(part.car, from_items([computed(each) for each in items(part.cdr)]))
        return part

    return computed(condition), from_items(bindings)


def with_variables(bindings: Value, form: Value) -> Value:
    """FORM, inside a LET with these BINDINGS if there are any."""
    return form if bindings is None else lisp_list(LET, bindings, form)


def is_compound(condition: Value) -> bool:
    """Whether CONDITION has an operator."""
    return condition.__class__ is Cons and isinstance(condition.car, Symbol)


def is_written(condition: Cons) -> bool:
    """Whether CONDITION is a form for a condition: one under a quote or a backquote, or #?x."""
    return condition.car is QUOTE or condition.car is QUASIQUOTE or condition.car is LOGICAL_BINDING


def is_one_query(condition: Value) -> bool:
    """Whether CONDITION is asked as one query, all solutions of which count."""
    if not is_compound(condition):
        return False
    return is_written(condition) or (condition.car not in (OR, NOT) and has_variables(condition))


def may_call(condition: Cons, environment: Any) -> bool:
    """Whether CONDITION may be a call: its operator is a function, or all lists in it look like calls."""
    if calls_p(condition.car) is not None:
        return True
    pending = [condition]
    while pending:
        form = pending.pop()
        if not isinstance(form.car, Symbol) or isinstance(form.car, Keyword) or is_variable(form.car):
            return False
        if form.car is FUNCTION or is_written(form) or is_operator(form.car, environment):
            continue
        rest = form.cdr
        while rest.__class__ is Cons:
            if rest.car.__class__ is Cons:
                pending.append(rest.car)
            rest = rest.cdr
        if rest is not None:
            return False
    return True


def is_operator(symbol: Symbol, environment: Any) -> bool:
    """True if SYMBOL names a macro, a special form or a local function here, and no relation."""
    session = running.session
    if environment is not None and environment.find_function(symbol) is not None:
        return True
    if session.image.cell(symbol).macro is None and symbol not in session.image.special_forms:
        return False
    return not session.is_relation(symbol)


def is_constant(term: Value) -> bool:
    """Whether TERM means the same in a query and in a call."""
    if term.__class__ is Cons:
        return term.car is QUOTE and not has_variables(term.cdr)
    return term.__class__ is not Symbol or is_variable(term)


def if_called(operator: Symbol, call: Value, query: Value) -> Value:
    """A form that is CALL if a condition with OPERATOR is one, and else QUERY."""
    test = lisp_list(CALLS, lisp_list(QUOTE, operator))
    return lisp_list(IF, test, lisp_list(WHERE_FUNCTION, operator, call), query)


def term_form(term: Value) -> Value:
    """A form that gives TERM as data, with the values of its #?variables."""
    if term.__class__ is not Cons:
        return lisp_list(QUOTE, term)
    if term.car is LOGICAL_BINDING or is_written(term):
        return term
    if not mentions_binding(term):
        return lisp_list(QUOTE, term)
    return Cons(LIST, from_items([term_form(part) for part in items(term)]))


def has_variables(term: Value) -> bool:
    """Whether TERM speaks of logic variables."""
    return bool(variables_of(term))


def variables_of(term: Value) -> dict[Symbol, None]:
    """The logic variables in TERM, each once; those of #?x are no such."""
    found: dict[Symbol, None] = {}
    pending = [term]
    while pending:
        part = pending.pop()
        if part.__class__ is Cons:
            if part.car is not LOGICAL_BINDING and not is_written(part):
                pending += [part.cdr, part.car]
        elif is_variable(part):
            found[part] = None
    return found


# --- what the forms call -------------------------------------------------------------


@function("(%calls-p operator)", ESL)
def calls_p(operator: Symbol) -> Value:
    """Tell whether a condition with OPERATOR is a call."""
    session = running.session
    return truth(hasattr(session.image.cell(operator), "function") and not session.is_relation(operator))


@function("(%asks-lisp)", ESL)
def asks_lisp() -> Value:
    """Note that the condition asks Lisp, whose answer may change at any step."""
    inquiry = running.session.dynamic.logical.inquiry
    if inquiry is not None:
        inquiry.asked_lisp = True
    return None


@function("(%in-force condition)", ESL)
def condition_in_force(condition: Value) -> Value:
    """Give CONDITION with the values of the #?x in it."""
    return in_force(condition)


@function("(%computed-condition condition)", ESL)
def computed_condition(condition: Value) -> Value:
    """Give CONDITION, which stands under a backquote: `esl check` reads it here."""
    return condition


@function("(%holds-p query)", ESL)
def holds_p(query: Value) -> Value:
    """Tell whether QUERY holds in the database; whoever watches hears what that rests on."""
    session, query = running.session, in_force(query)
    inquiry = session.dynamic.logical.inquiry
    if inquiry is None:
        return truth(session.database.first(query) is not None)
    solution, reads = session.database.ask(query)
    inquiry.note(solution, reads)
    return truth(solution is not None)
