"""Atomic actions, and steps with arguments (SCS Appendix C, §2).

Nothing interrupts an action. When it has ended, the conditions around it are
asked.
"""

from __future__ import annotations

from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items, lisp_list
from eslang.base.many import many_of
from eslang.base.running import running
from eslang.base.symbols import Symbol, Value
from eslang.base.text import String
from eslang.compile.registry import CL, SCS, function, macro
from eslang.constructs.scs.stepping import IS_ACTION, expand, refuse_modifiers
from eslang.constructs.scs.steps import IN_ORDER
from eslang.runtime.circuits import begin_action, end_of_action
from eslang.runtime.guarding import run_masked

DEFUN, LAMBDA, LIST, PROGN, QUOTE = (
    Symbol.intern(name, CL) for name in ("DEFUN", "LAMBDA", "LIST", "PROGN", "QUOTE")
)
ATOMIC, NOTE_ACTION, STEP = (
    Symbol.intern(name, SCS) for name in ("%CALL-ATOMIC", "%NOTE-ACTION", "%DO-STEP")
)


@macro("(atomic &body actions)", SCS)
def atomic(form: Cons, environment: Any) -> Value:
    """Do ACTIONS in order, as one action: nothing interrupts them.

    The conditions around are asked when the last has ended, and not between
    them. It fails as soon as one of ACTIONS does.

    Returns: the values of the last of ACTIONS.
    Fails:   as ACTIONS do.

    Example:
        ? (atomic (princ "grip ") (princ "lift ") :held)
        grip lift
        :HELD

    Source: SCS Appendix C, (a1;...;an).
    """
    refuse_modifiers(form.cdr, environment, "atomic")
    return lisp_list(ATOMIC, lisp_list(QUOTE, form), from_items([LAMBDA, None], form.cdr))


def _atomic_values(action: Value, body: Any) -> Value:
    return run_atomic(action, many_of(body))


@function("(%call-atomic action body)", SCS, many=_atomic_values)
def run_atomic(action: Value, body: Any) -> Value:
    """Call BODY as one ACTION."""
    session = running.session
    arena = begin_action(action)
    if arena is None:
        values = run_masked(session.scheduler, body)
    else:
        outer, arena.acting = arena.acting, session.scheduler.at_work()
        try:
            values = run_masked(session.scheduler, body)
        finally:
            arena.leave(session, outer)
    end_of_action()
    return values


@macro("(defaction name arguments &body body)", SCS)
def defaction(form: Cons, environment: Any) -> Value:
    """Define NAME as a function that is one atomic action: BODY.

    Returns: NAME.

    Example:
        ? (defaction turn (angle) "Turn the robot." (princ angle) :turned)
        TURN
        ? (scs:do (turn 30) (turn 60))
        3060
        :TURNED

    Source: SCS §3, Appendix C; the name: language reference §7.
    """
    name, arguments, body = form.cdr.car, form.cdr.cdr.car, form.cdr.cdr.cdr
    head: list[Value] = []
    while body is not None and body.cdr is not None and body.car.__class__ is String:
        head.append(body.car)
        body = body.cdr
    action = from_items([LIST, lisp_list(QUOTE, name), *variables_of(arguments)])
    refuse_modifiers(body, environment, "defaction")
    body = lisp_list(ATOMIC, action, from_items([LAMBDA, None], body))
    definition = lisp_list(DEFUN, name, arguments, *head, body)
    return definition_of_action(name, definition)


def definition_of_action(name: Value, definition: Value) -> Value:
    """DEFINITION, and the note that the function NAME ends with an action."""
    if not isinstance(name, Symbol):  # (SETF PLACE) is not called by that
        return definition
    return lisp_list(PROGN, definition, lisp_list(NOTE_ACTION, lisp_list(QUOTE, name)))


def variables_of(arguments: Value) -> list[Symbol]:
    """The variables that a lambda list binds to the arguments of a call."""
    found = []
    while arguments.__class__ is Cons:
        name, arguments = arguments.car, arguments.cdr
        if name.__class__ is Cons:
            name = name.car.cdr.car if name.car.__class__ is Cons else name.car
        if name.name == "&AUX":
            break
        if not name.name.startswith("&"):
            found.append(name)
    return found


@function("(%note-action name)", SCS)
def note_action(name: Symbol) -> Symbol:
    """Remember that the function NAME ends with an action."""
    setattr(running.session.image.cell(name).function, IS_ACTION, True)
    return name


@macro("(defstep name arguments &body steps)", SCS)
def defstep(form: Cons, environment: Any) -> Value:
    """Define NAME as a step with ARGUMENTS: STEPS, in order.

    They are done as in (scs:do . STEPS). It is expanded where it is called.
    Modifiers may stand before STEPS.

    Returns: NAME.

    Example:
        ? (defstep fetch (thing)
            (princ thing)
            (do-any (fail :left-empty) :found))
        FETCH
        ? (scs:do (fetch "cup "))
        cup
        :FOUND

    Source: SCS §2, "SCS Plans"; the name: language reference §7.
    """
    name, arguments, body = form.cdr.car, form.cdr.cdr.car, form.cdr.cdr.cdr
    head: list[Value] = []
    if body is not None and body.car.__class__ is String:
        head.append(body.car)
        body = body.cdr
    definition = lisp_list(DEFUN, name, arguments, *head, Cons(STEP, Cons(name, body)))
    return definition_of_action(name, definition)


@macro("(%do-step name &rest steps)", SCS)
def do_step(form: Cons, environment: Any) -> Value:
    """Do STEPS as DO does, as the step NAME."""
    return expand(IN_ORDER, form.cdr, environment, None)
