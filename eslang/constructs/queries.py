"""Going through the solutions of a query, one after another (ESL §5).

WITH-QUERY-BINDINGS is entered with the solutions of that moment. NEXT-BINDINGS
jumps back to it, from wherever its task is, as far as it is inside.
"""

from __future__ import annotations

from eslang.base.control import NextBindings
from eslang.base.failure import Failure, control_error, unbound_variable
from eslang.base.hints import TYPE_CHECKING, Any, Callable, Iterator
from eslang.base.lists import Cons, from_items, lisp_list
from eslang.base.many import many_of
from eslang.base.running import running
from eslang.base.shown import shown
from eslang.base.stack import STACK
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.compile.registry import CL, ESL, function, macro
from eslang.constructs.shapes import refuse
from eslang.facts.unify import is_variable
from eslang.runtime import failures

if TYPE_CHECKING:
    from eslang.facts.plans import Solutions
    from eslang.runtime.logical import Logical
    from eslang.runtime.tasks import Task

LAMBDA, QUOTE = (Symbol.intern(name, CL) for name in ("LAMBDA", "QUOTE"))
BINDING, LOGICAL_BINDING, WITH_BINDINGS = (
    Symbol.intern(n, ESL) for n in ("%LOGICAL-BINDING", "LOGICAL-BINDING", "%CALL-WITH-QUERY-BINDINGS")
)
INHERIT = Keyword("INHERIT-BINDINGS")
NO_BINDINGS, NO_MORE_BINDINGS = Keyword("NO-BINDINGS"), Keyword("NO-MORE-BINDINGS")
MANY = 10_000  # pairs of a term that are looked through for #?x


class Query:
    """One entrance of a WITH-QUERY-BINDINGS form."""

    __slots__ = ("asked", "outer", "solutions", "task")

    def __init__(self, asked: Value, solutions: Solutions, task: Task | None, outer: Logical) -> None:
        self.asked = asked
        self.solutions = solutions
        self.task = task
        self.outer = outer  # what is in force around the form, and for the tests of the query


@macro("(with-query-bindings query &body body)", ESL)
def with_query_bindings(form: Cons, environment: Any) -> Value:
    """Run BODY under the first bindings for which QUERY holds.

    In BODY, #?X is what ?X is bound to, and (next-bindings) jumps to its start
    with the next bindings. They come in the order of assertion, and are those
    of the moment in which the form was entered, whatever BODY changes. With
    the word :INHERIT-BINDINGS before BODY, bindings of the forms around
    constrain QUERY.

    Returns: the values of BODY.
    Fails:   :no-bindings, with QUERY, if there are none;
             :unbound-logic-variable if a variable has no value where NOT or
             a test needs one.

    Example:
        ? (progn (assert '(is-a arm tool)) (assert '(is-a drill tool)))
        (IS-A DRILL TOOL)
        ? (with-query-bindings '(is-a ?x tool)
            (if (eq #?x 'arm) (next-bindings) #?x))
        DRILL

    Source: ESL §5. What the bindings are: language reference §5.
    """
    query, body = form.cdr.car, form.cdr.cdr
    inherit = None
    if body is not None and body.car is INHERIT:
        inherit, body = INHERIT, body.cdr
    elif body is not None and isinstance(body.car, Keyword) and body.cdr is not None:
        wrong = f"with-query-bindings has no option `{shown(body.car)}`"
        hint = "write `:inherit-bindings`, or nothing"
        refuse(environment, "malformed-form", wrong, body, hint=hint, within="with-query-bindings")
    return lisp_list(WITH_BINDINGS, query, inherit, from_items([LAMBDA, None], body))


def _with_query_bindings_values(query: Value, inherit: Value, body: Any) -> Value:
    return run_with_query_bindings(query, inherit, many_of(body))


@function("(%call-with-query-bindings query inherit body)", ESL, many=_with_query_bindings_values)
def run_with_query_bindings(query: Value, inherit: Value, body: Any) -> Value:
    """Call BODY under the bindings of QUERY, from its start again after each NEXT-BINDINGS."""
    session = running.session
    dynamic = session.dynamic
    outer = dynamic.logical
    asked = in_force(query)
    solutions = session.database.solutions(asked, outer.bindings if inherit is not None else {})
    this = Query(asked, solutions, session.scheduler.current, outer)
    rounds: Iterator[None] | None = None
    try:
        found = next(solutions, None)
        if found is None:
            return failures.signal(Failure(NO_BINDINGS, asked), continuable=True)
        while True:
            dynamic.logical = outer.within(found, this)
            try:
                if rounds is not None:
                    next(rounds)  # as the round of a loop; an interrupt may come here
                return failures.guarded(body)
            except NextBindings as jump:
                if jump.target is not this:
                    raise
                found = jump.value
            if STACK.raised:
                STACK.give_back()
            rounds = session.ticks.source
    finally:
        dynamic.logical = outer
        solutions.close()


@function("(next-bindings)", ESL)
def next_bindings() -> Value:
    """Jump to the start of WITH-QUERY-BINDINGS' body, with its next bindings.

    It is the innermost such form that counts; in a recovery procedure, the
    form that the procedure stands in. The bindings belong to the task that
    entered it.

    Fails:   :no-more-bindings, with the query, when there are no more;
             :control-error outside such a form, or in another task.

    Example:
        ? (progn (assert '(is-a w1 widget)) (assert '(is-a w2 widget)))
        (IS-A W2 WIDGET)
        ? (with-query-bindings '(is-a ?w widget)
            (with-recovery-procedures (:no-more-bindings (abort :all-tried))
              (princ #?w)
              (next-bindings)))
        W1W2
        Failure :NO-MORE-BINDINGS, recovery available. (No retries)
        :ALL-TRIED

    Source: ESL §5. Other tasks: decision 27.
    """
    session = running.session
    query: Query | None = session.dynamic.logical.query
    if query is None:
        raise control_error("NEXT-BINDINGS is called outside WITH-QUERY-BINDINGS")
    if query.task is not session.scheduler.current:
        raise control_error(
            "NEXT-BINDINGS is called in a task that did not enter WITH-QUERY-BINDINGS: "
            f"its bindings belong to the task {query.task}"
        )
    dynamic, inner = session.dynamic, session.dynamic.logical
    dynamic.logical = query.outer
    try:
        found = next(query.solutions, None)
    finally:
        dynamic.logical = inner
    if found is None:
        return failures.signal(Failure(NO_MORE_BINDINGS, query.asked), continuable=True)
    raise NextBindings(query, found)


@macro("(logical-binding variable)", ESL)
def logical_binding(form: Cons, environment: Any) -> Value:
    """Give what the logic variable VARIABLE is bound to.

    #?X is read as (logical-binding ?X). In the facts, patterns and queries
    that are given to the database, it stands for its value under a quote, too.

    Fails:   :unbound-variable if it is bound to nothing here.

    Source: ESL §5.
    """
    return lisp_list(BINDING, lisp_list(QUOTE, form.cdr.car))


@function("(%logical-binding variable)", ESL)
def value_of_binding(variable: Symbol) -> Value:
    """Give what VARIABLE is bound to."""
    bindings = running.session.dynamic.logical.bindings
    if variable not in bindings:
        raise unbound_variable(variable)
    return bindings[variable]


def in_force(term: Value) -> Value:
    """TERM with the values of the #?x in it; TERM itself, if there are none."""
    rest = term
    for _ in range(MANY):
        if rest.__class__ is not Cons:
            return term
        if rest.car.__class__ is Cons and mentions_binding(rest.car):
            return _in_force(term)
        rest = rest.cdr
    return term


def mentions_binding(term: Value) -> bool:
    """Whether #?x stands in TERM."""
    pending = [term]
    for _ in range(MANY):
        if not pending:
            break
        part = pending.pop()
        if part.__class__ is Cons:
            if part.car is LOGICAL_BINDING:
                return True
            pending += [part.cdr, part.car]
    return False


def as_bound(term: Value) -> Value:
    """TERM for people: with the values of those #?x in it that are bound."""
    bindings = running.session.dynamic.logical.bindings
    if not bindings or not mentions_binding(term):
        return term
    return _in_force(term, lambda name: bindings.get(name, lisp_list(LOGICAL_BINDING, name)))


def _in_force(term: Value, value_of: Callable[[Symbol], Value] = value_of_binding) -> Value:
    if term.__class__ is not Cons:
        return term
    if term.car is LOGICAL_BINDING and term.cdr.__class__ is Cons and is_variable(term.cdr.car):
        return value_of(term.cdr.car)
    return Cons(_in_force(term.car, value_of), _in_force(term.cdr, value_of))
