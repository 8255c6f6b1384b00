"""Top-level goals (SCS §2): what an agent is to achieve or to maintain.

Here is what a goal says, and how it comes on the agenda of the agent, and off
it. The agenda itself (runtime/agenda.py) is loaded when there is a goal.
"""

from __future__ import annotations

from eslang.base.failure import type_error
from eslang.base.hints import TYPE_CHECKING, Any, Callable
from eslang.base.lists import Cons, from_items, items, lisp_list
from eslang.base.number_kinds import is_number
from eslang.base.running import running, to_function
from eslang.base.shown import shown
from eslang.base.symbols import Keyword, Symbol, T, Value, truth
from eslang.compile.registry import CL, ESL, SCS, function, macro
from eslang.constructs.conditions import (
    CONNECTIVES,
    QUASIQUOTE,
    computed_once,
    has_variables,
    holds_p,
    if_called,
    instance_form,
    is_compound,
    is_operator,
    is_written,
    may_call,
    term_form,
    test_form,
    with_variables,
)
from eslang.constructs.queries import LOGICAL_BINDING, in_force
from eslang.constructs.scs.asking import Asker
from eslang.constructs.scs.stepping import read_steps, steps_form
from eslang.constructs.shapes import refuse
from eslang.facts.unify import is_variable
from eslang.runtime.events import Wait

if TYPE_CHECKING:
    from eslang.runtime.agenda import Agenda, Goal

LAMBDA, LIST, QUOTE = (Symbol.intern(name, CL) for name in ("LAMBDA", "LIST", "QUOTE"))
ACHIEVE, ACHIEVE_FUNCTION = (Symbol.intern(name, ESL) for name in ("ACHIEVE", "%ACHIEVE"))
MAINTAIN, GOAL, ADD_GOAL, ADD, DROP_GOAL, DROP = (
    Symbol.intern(name, SCS)
    for name in ("MAINTAIN", "GOAL", "ADD-GOAL", "%ADD-GOAL", "DROP-GOAL", "%DROP-GOAL")
)
INFINITE = Keyword("INFINITE")
OPTIONS = ("UTILITY", "BY", "RETRIES")
SHAPES = "`(achieve condition)` or `(maintain condition)`"


# --- giving and dropping -------------------------------------------------------------


@macro("(add-goal goal &key utility by retries)", SCS)
def add_goal(form: Cons, environment: Any) -> Value:
    """Give the agent GOAL: (achieve CONDITION) or (maintain CONDITION).

    PURSUE-GOALS sees to it. A goal to achieve is there until CONDITION has
    been brought about; one to maintain stays, and is active whenever CONDITION
    is false. What is tried is ACHIEVE, or the step BY. An attempt that fails is
    followed by another; by so many only as RETRIES says, if it is a number. Of
    goals with a UTILITY those go on that are worth most: it is a form,
    evaluated whenever that is to be known.

    CONDITION is not evaluated, as in ACHIEVE. It is tested where the goal is
    pursued, with the local variables and the #?variables of this place. GOAL
    may also be a variable, or under a backquote: then it is a list like that,
    whose condition is a query. A goal that is there already is not added
    again, but takes the new UTILITY.

    Returns: the goal, an event that its end signals: with :achieved, and the
             variables of CONDITION, as an association list; with :dropped; or
             with :impossible, and the cause and arguments of the last failure.
    Fails:   :type-error if GOAL is neither.

    Example:
        ? (to-achieve (lamp ?where ?state) (t (assert '(lamp #?where #?state))))
        (LAMP ?WHERE ?STATE)
        ? (defvar *light* (add-goal (achieve (lamp hall :on))))
        *LIGHT*
        ? (pursue-goals)
        Attempting to achieve (LAMP HALL :ON)
        (LAMP HALL :ON) achieved.
        T
        ? (wait-for-events *light*)
        :ACHIEVED
        NIL

    Source: SCS §2, "Goals"; when a goal is impossible: decision 37.
    """
    options = _options(form.cdr.cdr, environment)
    utility = None if options["UTILITY"] is None else lisp_list(LAMBDA, None, options["UTILITY"])
    by = None if options["BY"] is None else steps_form(lisp_list(options["BY"]), environment, "add-goal")
    return _with_spec(
        form.cdr,
        environment,
        "add-goal",
        lambda *spec: lisp_list(ADD, *spec, utility, by, options["RETRIES"]),
    )


@macro("(drop-goal goal)", SCS)
def drop_goal(form: Cons, environment: Any) -> Value:
    """Drop GOAL: what ADD-GOAL has given, or a goal as it is written.

    An attempt that is under way is left, with its cleanup procedures.

    Returns: T; NIL if there is no such goal any more.
    Fails:   :type-error if GOAL is no goal.

    Example:
        ? (add-goal (maintain (door :shut)))
        #<GOAL (MAINTAIN (DOOR :SHUT))>
        ? (drop-goal (maintain (door :shut)))
        T
        ? (goals)
        NIL

    Source: SCS §2, "Goals"; the name: language reference §7.
    """
    goal = form.cdr.car
    if goal.__class__ is Cons and goal.car in (ACHIEVE, MAINTAIN):
        return _with_spec(form.cdr, environment, "drop-goal", lambda *spec: lisp_list(DROP, spec[0]))
    return lisp_list(DROP, goal)


@function("(goals)", SCS)
def goals() -> Value:
    """List the goals of the agent, in the order in which they were given.

    Source: SCS §2, "Goals"; the name: language reference §7.
    """
    return from_items(list(agenda_of(running.session).goals()))


@function("(goal-status goal)", SCS)
def goal_status(goal: Value) -> Keyword:
    """Tell how GOAL is.

    Returns: :pending, if it is not pursued; :active; :inactive, if it is to
             be maintained and holds; :blocked, if no method applies; once it
             is over, :achieved, :dropped or :impossible.
    Fails:   :type-error if GOAL is no goal.

    Example:
        ? (goal-status (add-goal (achieve (at robot dock))))
        :PENDING

    Source: SCS §2, "Goals"; the name: language reference §7.
    """
    status: Keyword = as_goal(goal, Symbol.intern("GOAL-STATUS", SCS)).status
    return status


# --- what a goal says ----------------------------------------------------------------


def _options(rest: Value, environment: Any) -> dict[str, Value]:
    """The forms of ADD-GOAL's options."""
    found = dict.fromkeys(OPTIONS)
    while rest is not None:
        known = isinstance(rest.car, Keyword) and rest.car.name in OPTIONS
        if not known or rest.cdr is None:
            wrong = (
                f"`{shown(rest.car)}` has no value"
                if known
                else f"add-goal has no option `{shown(rest.car)}`"
            )
            hint = "write `:utility form`, `:by step` or `:retries number`"
            refuse(environment, "malformed-goal", wrong, rest, hint=hint, within="add-goal")
        found[rest.car.name] = rest.cdr.car
        rest = rest.cdr.cdr
    return found


def _with_spec(holder: Cons, environment: Any, within: str, call: Callable[..., Value]) -> Value:
    """The CALL of a function for the goal in HOLDER: a form that gives it, its instance, and its test."""
    goal = holder.car
    if isinstance(goal, Symbol) or (
        goal.__class__ is Cons and goal.car in (QUOTE, QUASIQUOTE, LOGICAL_BINDING)
    ):
        return call(goal, None, None)
    if goal.__class__ is not Cons or goal.car not in (ACHIEVE, MAINTAIN):
        wrong, hint = f"`{shown(goal)}` is no goal", f"write {SHAPES}"
        refuse(environment, "malformed-goal", wrong, holder, hint=hint, within=within)
    if goal.cdr.__class__ is not Cons or goal.cdr.cdr is not None:
        count = len(items(goal.cdr)) if goal.cdr.__class__ is Cons else 0
        wrong = f"a goal has one condition, found {count or 'none'}"
        hint = "join them by `and`" if count else f"write {SHAPES}"
        refuse(environment, "malformed-goal", wrong, holder, hint=hint, within=within)
    condition, bindings = computed_once(goal.cdr.car)
    data, instance, test = parts_of_condition(condition, environment)
    return with_variables(bindings, call(lisp_list(LIST, lisp_list(QUOTE, goal.car), data), instance, test))


def parts_of_condition(condition: Value, environment: Any) -> tuple[Value, Value, Value]:
    """Forms that give CONDITION as data, its instance for methods, and its test, these two as functions."""
    instance = lisp_list(LAMBDA, None, instance_form(condition, environment))
    return (
        _fixed_form(condition, environment),
        instance,
        lisp_list(LAMBDA, None, test_form(condition, environment)),
    )


def _fixed_form(form: Value, environment: Any) -> Value:
    """A form that gives a condition as data, with the values of local variables that it is called with."""
    if not is_compound(form) or is_written(form):
        return instance_form(form, environment)
    operator = form.car
    if operator in CONNECTIVES:
        parts = [_fixed_form(part, environment) for part in items(form.cdr)]
        return Cons(LIST, Cons(lisp_list(QUOTE, operator), from_items(parts)))
    data = term_form(form)
    is_call = (
        not has_variables(form) and not is_operator(operator, environment) and may_call(form, environment)
    )
    if not is_call or environment is None:
        return data
    known = [
        part if isinstance(part, Symbol) and environment.find_variable(part) is not None else term_form(part)
        for part in items(form.cdr)
    ]
    return if_called(operator, Cons(LIST, Cons(lisp_list(QUOTE, operator), from_items(known))), data)


@function("(%add-goal spec instance test utility by retries)", SCS)
def add_goal_of(
    spec: Value, instance: Value, test: Any, utility: Any = None, by: Value = None, retries: Value = None
) -> Goal:
    """Add the goal SPEC; INSTANCE and TEST are told unless its condition is a query."""
    known = retries is None or retries is INFINITE or (retries.__class__ is int and retries >= 0)
    if not known:
        raise type_error(retries, "UNSIGNED-BYTE", ADD_GOAL)
    operator, condition = read_spec(spec, ADD_GOAL)
    goal = make_goal(operator, condition, instance, test, by, None if retries is INFINITE else retries)
    if utility is not None:
        bindings = running.session.dynamic.logical.bindings
        goal.utility = lambda: as_real(_under(bindings, utility))
    return agenda_of(running.session).add(goal)


def make_goal(
    operator: Symbol,
    condition: Value,
    instance: Any = None,
    test: Any = None,
    by: Value = None,
    retries: int | None = None,
) -> Goal:
    """A goal; its condition is a query unless INSTANCE and TEST are told."""
    from eslang.runtime.agenda import Goal, Means

    bindings = running.session.dynamic.logical.bindings
    told = test or (lambda: holds_p(condition))
    step = None if by is None else read_steps(by)[0]

    def ask() -> Value:
        return _under(bindings, told)

    def work() -> Value:
        step.run()  # type: ignore[union-attr]
        return T

    def attempt() -> Value:
        way = (instance or (lambda: condition), ask, *([] if step is None else [work]))
        return _under(bindings, lambda: to_function(ACHIEVE_FUNCTION)(condition, *way))

    means = Means(
        lambda: ask() is not None,
        lambda: solution_of(condition, ask),
        lambda: await_need(condition, ask),
        attempt,
    )
    return Goal(operator, condition, operator is MAINTAIN, means, retries)


def _under(bindings: dict[Symbol, Value], body: Callable[[], Value]) -> Value:
    """What BODY gives where these BINDINGS of logic variables are in force."""
    if not bindings:
        return body()
    dynamic = running.session.dynamic
    outer, dynamic.logical = dynamic.logical, dynamic.logical.within(bindings)
    try:
        return body()
    finally:
        dynamic.logical = outer


class Keeping(Wait):
    """A wait until there is something to be restored."""

    __slots__ = ()
    advice = "end what maintains it by a modifier around it, or abort its task"


def await_need(condition: Value, test: Callable[[], Value]) -> None:
    """Wait until TEST says that CONDITION does not hold."""
    asker = Asker()
    try:
        asker.idle(lisp_list(CONNECTIVES[2], condition), [asker.ask(condition, test, negated=True)], Keeping)
    finally:
        asker.end()


def solution_of(condition: Value, test: Callable[[], Value]) -> Value:
    """The variables of CONDITION under which it holds, as an association list."""
    if not has_variables(condition):
        return None
    asker = Asker()
    try:
        asked = asker.ask(condition, test)
        found = asked.bindings if asked.holds() else {}
        return from_items([Cons(variable, value) for variable, value in found.items()])
    finally:
        asker.end()


def read_spec(spec: Value, operator: Symbol) -> tuple[Symbol, Value]:
    """What SPEC says is to be done, and the condition. Fails with :type-error if it is no goal."""
    is_goal = spec.__class__ is Cons and spec.car in (ACHIEVE, MAINTAIN) and spec.cdr.__class__ is Cons
    if not is_goal or spec.cdr.cdr is not None or spec.cdr.car is None:
        raise type_error(spec, GOAL, operator)
    return spec.car, in_force(spec.cdr.car)


def as_goal(value: Value, operator: Symbol) -> Goal:
    """VALUE, which is to be a goal."""
    from eslang.runtime.agenda import Goal

    if not isinstance(value, Goal):
        raise type_error(value, GOAL, operator)
    return value


def as_real(value: Value) -> Value:
    """VALUE, which is to be a real number."""
    if is_number(value):
        return value
    raise type_error(value, "REAL")


def sketch_of(condition: Value) -> tuple[Value, ...]:
    """The names and numbers in CONDITION, without what is inside lists, and without variables."""
    found = []
    while condition.__class__ is Cons:
        part, condition = condition.car, condition.cdr
        if part.__class__ is int or (isinstance(part, Symbol) and not is_variable(part)):
            found.append(part)
    return tuple(found)


def agenda_of(session: Any) -> Agenda:
    """The agenda of SESSION, made when first wanted."""
    if session.agenda is None:
        from eslang.facts.unify import is_same_pattern
        from eslang.runtime.agenda import Agenda

        session.agenda = Agenda(session, is_same_pattern, sketch_of)
    agenda: Agenda = session.agenda
    return agenda


@function("(%drop-goal goal)", SCS)
def drop_goal_of(goal: Value) -> Value:
    """Drop GOAL, or the one that is written so."""
    session = running.session
    agenda = agenda_of(session)
    if goal.__class__ is Cons:
        operator, condition = read_spec(goal, DROP_GOAL)
        found = agenda.find(operator is MAINTAIN, condition)
    else:
        found = as_goal(goal, DROP_GOAL)
    done = found is not None and agenda.drop(found)
    task = session.scheduler.current
    if task is not None and (task.interrupts or task.ending is not None):
        session.scheduler.attend(task)  # it may be at work for that very goal
    return truth(done)
