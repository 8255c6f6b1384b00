"""Goals (ESL §3): TO-ACHIEVE says how a condition is brought about, ACHIEVE does it."""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items, lisp_list
from eslang.base.running import running
from eslang.base.symbols import Keyword, Symbol, T, Value
from eslang.compile.registry import CL, ESL, function, macro
from eslang.constructs.conditions import (
    computed_once,
    instance_form,
    term_form,
    test_form,
    with_variables,
)
from eslang.runtime import failures
from eslang.runtime.story import place_here

NO_APPLICABLE_METHOD = Keyword("NO-APPLICABLE-METHOD")
CONDITION_NOT_ACHIEVED = Keyword("CONDITION-NOT-ACHIEVED")
LAMBDA, QUOTE, COND = (Symbol.intern(name, CL) for name in ("LAMBDA", "QUOTE", "COND"))
DEFINE_GOAL, ACHIEVE = (Symbol.intern(name, ESL) for name in ("%DEFINE-GOAL", "%ACHIEVE"))


@macro("(to-achieve condition &rest methods)", ESL)
def to_achieve(form: Cons, environment: Any) -> Value:
    """Say how CONDITION is achieved: METHODS are COND clauses, tried in order.

    CONDITION is not evaluated. Variables in it, such as ?DEVICE, match
    anything; #?DEVICE is what it matched, in the methods. A later TO-ACHIEVE
    for the same condition takes the place of the earlier, and what the library
    knows is asked last.

    Returns: CONDITION.

    Example:
        ? (progn (defvar *lamp* :off) (defun lamp-on? () (eq *lamp* :on)))
        LAMP-ON?
        ? (to-achieve (lamp-on?)
            ((eq *lamp* :off) (setf *lamp* :on)))
        (LAMP-ON?)
        ? (achieve (lamp-on?))
        Attempting to achieve (LAMP-ON?)
        (LAMP-ON?) achieved.
        T

    Source: ESL §3.
    """
    pattern = form.cdr.car
    clauses = []
    rest = form.cdr.cdr
    while rest is not None:
        clause = rest.car
        if clause.__class__ is not Cons:
            environment.analyser.fail(
                "malformed-method",
                "a method is a COND clause",
                environment.analyser.spans.element(rest),
                hint="write `(test form...)`",
            )
        clauses.append(Cons(clause.car, _then_true(clause.cdr)))
        rest = rest.cdr
    methods = lisp_list(LAMBDA, None, Cons(COND, from_items(clauses)))
    return lisp_list(DEFINE_GOAL, lisp_list(QUOTE, pattern), methods)


def _then_true(forms: Value) -> Value:
    """FORMS, and T behind them, which says that a method was run."""
    elements = []
    while forms is not None:
        elements.append(forms.car)
        forms = forms.cdr
    return from_items([*elements, T])


@macro("(achieve condition)", ESL)
def achieve(form: Cons, environment: Any) -> Value:
    """Make CONDITION true, unless it is, by the first method that applies.

    CONDITION is not evaluated; what has to be computed stands under a
    backquote, as in (achieve `(at robot ,place)) or (achieve `,goal).

    Returns: NIL if CONDITION was true already, T if it was made true.
    Fails:   :no-applicable-method if there is no method, or no test is true;
             :condition-not-achieved if CONDITION is still false afterwards;
             both with the condition. And with whatever the method fails with.

    Example:
        ? (defun dark? () nil)
        DARK?
        ? (achieve (not (dark?)))
        (NOT (DARK?)) achieved. (No action needed.)
        NIL

    Source: ESL §3; causes: language reference §3.
    """
    condition, bindings = computed_once(form.cdr.car)
    test = lisp_list(LAMBDA, None, test_form(condition, environment))
    instance = lisp_list(LAMBDA, None, instance_form(condition, environment))
    return with_variables(bindings, lisp_list(ACHIEVE, term_form(condition), instance, test))


@function("(%define-goal pattern methods)", ESL)
def define_goal(pattern: Value, methods: Value) -> Value:
    """Remember the methods of a condition."""
    session = running.session
    session.methods.define(pattern, methods, is_library=not session.image.sealed)
    return pattern


@function("(%achieve condition instance test &optional work)", ESL)
def achieve_function(condition: Value, instance: Value, test: Value, work: Value = None) -> Value:
    """Achieve CONDITION, which TEST tells, by WORK if there is that.

    INSTANCE gives CONDITION with its arguments computed, for which methods are looked for.
    """
    if test() is not None:
        _tell("no-action", condition)
        return None
    _tell("attempting", condition)
    bindings, methods = ({}, work) if work is not None else _methods(condition, instance)
    if methods is None or not _ran(bindings, methods):
        return failures.signal(Failure(NO_APPLICABLE_METHOD, condition), continuable=True)
    if test() is None:
        return failures.signal(Failure(CONDITION_NOT_ACHIEVED, condition), continuable=True)
    _tell("achieved", condition)
    return T


def _tell(state: str, condition: Value) -> None:
    """Tell how the goal CONDITION stands."""
    hooks = running.session.hooks
    if hooks.listeners or hooks.speakers:
        place = place_here() if hooks.listeners else None
        hooks.tell("goal", place, state=state, condition=condition)


def _methods(condition: Value, instance: Value) -> tuple[dict[Symbol, Value], Value]:
    """The methods of CONDITION as it is written; else those whose pattern its instance matches."""
    goals = running.session.methods
    methods = goals.exact(condition)
    return ({}, methods) if methods is not None else goals.find(instance())


def _ran(bindings: dict[Symbol, Value], methods: Any) -> bool:
    """Run METHODS under BINDINGS; true if one of them applied."""
    dynamic = running.session.dynamic
    saved, dynamic.logical = dynamic.logical, dynamic.logical.within(bindings)
    try:
        return methods() is not None
    except Exception as error:
        failures.signal_error(error)
        return False
    finally:
        dynamic.logical = saved
