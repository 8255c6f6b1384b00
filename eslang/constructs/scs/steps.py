"""Steps (SCS Appendix C): atomic actions, sequences, and what is said of all constructs.

A step succeeds by returning, fails by FAIL, or is deactivated, which is
neither: then it gives :DEACTIVATED. Between two actions the energizing
conditions around them are asked (runtime/circuits.py).
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import Any, Callable, Iterator, NamedTuple
from eslang.base.lists import Cons, from_items, items, lisp_list
from eslang.base.many import many_of
from eslang.base.running import running
from eslang.base.shown import shown
from eslang.base.symbols import Keyword, Symbol, T, Value
from eslang.base.text import String
from eslang.compile.registry import CL, SCS, function, macro
from eslang.constructs.conditions import test_form
from eslang.constructs.scs.asking import DEACTIVATED, run_under
from eslang.constructs.shapes import refuse
from eslang.runtime import failures
from eslang.runtime.circuits import begin_action, end_of_action
from eslang.runtime.failures import Clause, Form
from eslang.runtime.guarding import run_masked

DEFUN, LAMBDA, LIST, PROGN, QUOTE = (
    Symbol.intern(name, CL) for name in ("DEFUN", "LAMBDA", "LIST", "PROGN", "QUOTE")
)
MODIFIERS = ("WHILE", "UNTIL", "WHEN", "UNLESS")
ATOMIC, NOTE_ACTION, IN_ORDER, REPEAT = (
    Symbol.intern(name, SCS) for name in ("%CALL-ATOMIC", "%NOTE-ACTION", "%DO-IN-ORDER", "%DO-REPEATEDLY")
)
CONSTRUCTS = frozenset(  # whose last action has asked all conditions when they end
    Symbol.intern(name, SCS)
    for each in ("DO", "DO-ALL", "DO-ANY", "DO-FIRST", "DO-BEST", "REPEAT")
    for name in (each, each.replace("DO", "DO*") if each != "REPEAT" else "REPEAT*")
) | {Symbol.intern("ATOMIC", SCS)}
IS_ACTION = "ends_with_an_action"  # an attribute of such functions
ATOMIC_FORM, DO = (Symbol.intern(name, SCS) for name in ("ATOMIC", "DO"))


class Step(NamedTuple):
    """One step of a construct: what it does, and the operator of its form."""

    body: Callable[[], Value]
    operator: Value

    def run(self) -> Value:
        """Do it; then the conditions around are asked, unless an action at its end has done so."""
        value = self.body()
        if value is DEACTIVATED or not asks_itself(self.operator):
            end_of_action()
        return value


def asks_itself(operator: Value) -> bool:
    """Whether a call of OPERATOR ends with an action that asks the conditions."""
    if operator in CONSTRUCTS:
        return True
    called = operator and getattr(running.session.image.cell(operator), "function", None)
    return hasattr(called, IS_ACTION)


# --- the shape of constructs ---------------------------------------------------------


def parts_of(
    form: Cons, environment: Any, within: str, options: dict[str, Value] | None = None
) -> tuple[Value, Value]:
    """The form that gives the modifiers of FORM, and the rest of its body; OPTIONS get their values."""
    modifiers: list[Value] = []
    rest = form.cdr
    while rest.__class__ is Cons and isinstance(rest.car, Keyword):
        keyword = rest.car
        if options is not None and keyword.name in options and rest.cdr is not None:
            options[keyword.name] = rest.cdr.car
            rest = rest.cdr.cdr
            continue
        if keyword.name not in MODIFIERS:
            wrong = f"`{shown(keyword)}` is no modifier of a step"
            hint = "write `:while`, `:until`, `:when` or `:unless`, and a condition"
            refuse(environment, "malformed-step", wrong, rest, hint=hint, within=within)
        if rest.cdr is None:
            refuse(environment, "malformed-step", f"`{shown(keyword)}` has no condition", rest, within=within)
        condition = rest.cdr.car
        test = lisp_list(LAMBDA, None, test_form(condition, environment))
        modifiers.append(lisp_list(LIST, String(keyword.name), lisp_list(QUOTE, condition), test))
        rest = rest.cdr.cdr
    return Cons(LIST, from_items(modifiers)) if modifiers else None, rest


def steps_form(forms: Value, environment: Any) -> Value:
    """The form that gives the steps that FORMS are."""
    parts = []
    for form in items(forms):
        operator = form.car if form.__class__ is Cons and isinstance(form.car, Symbol) else None
        if environment is not None and environment.find_function(operator) is not None:
            operator = None  # a local function, whatever its name
        parts += [lisp_list(LAMBDA, None, form), lisp_list(QUOTE, operator)]
    return Cons(LIST, from_items(parts))


def expand(function_name: Symbol, form: Cons, environment: Any, *more: Value) -> Value:
    """The call of FUNCTION-NAME for a construct of modifiers and steps."""
    modifiers, steps = parts_of(form, environment, str(form.car).lower())
    return lisp_list(function_name, modifiers, steps_form(steps, environment), *more)


def read_modifiers(modifiers: Value) -> list[tuple[str, Value, Any]]:
    """Modifiers as Python has them."""
    return [(kind.text, condition, test) for kind, condition, test in map(items, items(modifiers))]


def read_steps(steps: Value) -> list[Step]:
    """Steps as Python has them."""
    parts = items(steps)
    return [Step(parts[index], parts[index + 1]) for index in range(0, len(parts), 2)]


# --- outcomes ------------------------------------------------------------------------


EVERY_FAILURE = (Clause(None, None, None, takes=lambda failure: True),)


def attempt(body: Callable[[], Value]) -> Value:
    """What BODY gives; its failure, a Failure, if it fails and nothing inside answers that."""
    form = Form()

    def take(failure: Failure) -> None:
        failures.abort(form, failure)

    return failures.run_form(form, EVERY_FAILURE, (take,), body)


def persist(body: Callable[[], Value]) -> Value:
    """What BODY gives when it does not fail; until then it is tried again."""
    rounds: Iterator[None] = running.session.ticks.source
    while True:
        value = attempt(body)
        if value.__class__ is not Failure:
            return value
        end_of_action()
        next(rounds)
        rounds = running.session.ticks.source


def in_order(steps: list[Step], starred: bool) -> Value:
    """Run STEPS; the value of the last one, NIL if that was deactivated."""
    value: Value = None
    for step in steps:
        value = persist(step.run) if starred else step.run()
    if not steps:
        end_of_action()
    return None if value is DEACTIVATED else value


# --- actions -------------------------------------------------------------------------


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
    return lisp_list(ATOMIC, from_items([LAMBDA, None], form.cdr))


def _atomic_values(body: Any) -> Value:
    return run_atomic(many_of(body))


@function("(%call-atomic body)", SCS, many=_atomic_values)
def run_atomic(body: Any) -> Value:
    """Call BODY as one action."""
    begin_action()
    values = run_masked(running.session.scheduler, body)
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
    definition = lisp_list(DEFUN, name, arguments, *head, Cons(ATOMIC_FORM, body))
    return lisp_list(PROGN, definition, lisp_list(NOTE_ACTION, lisp_list(QUOTE, name)))


@function("(%note-action name)", SCS)
def note_action(name: Symbol) -> Symbol:
    """Remember that the function NAME ends with an action."""
    setattr(running.session.image.cell(name).function, IS_ACTION, True)
    return name


@macro("(defstep name arguments &body steps)", SCS)
def defstep(form: Cons, environment: Any) -> Value:
    """Define NAME as a step with ARGUMENTS: STEPS, in order.

    They are done as in (scs:do . STEPS). It is expanded where it is called. Modifiers may stand before STEPS.

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
    definition = lisp_list(DEFUN, name, arguments, *head, Cons(DO, body))
    return lisp_list(PROGN, definition, lisp_list(NOTE_ACTION, lisp_list(QUOTE, name)))


# --- sequences -----------------------------------------------------------------------


@macro("(do &rest steps)", SCS)
def do(form: Cons, environment: Any) -> Value:
    """Do STEPS in order; fail as soon as one of them fails.

    Modifiers stand before STEPS, each with a condition: :when or :unless,
    which is asked before they begin; :while or :until, which is asked after
    every action, and ends the construct wherever it is.

    Returns: the value of the last of STEPS; :deactivated, if a modifier ends it.
    Fails:   as the first of STEPS that fails.

    Example:
        ? (scs:do (princ "approach ") (princ "grip ") :done)
        approach grip
        :DONE
        ? (scs:do :when (evenp 3) (princ "never"))
        :DEACTIVATED

    Source: SCS Appendix C.
    """
    return expand(IN_ORDER, form, environment, None)


@macro("(do* &rest steps)", SCS)
def do_star(form: Cons, environment: Any) -> Value:
    """Do STEPS in order; one that fails is tried again until it succeeds.

    Returns: the value of the last of STEPS; :deactivated, if a modifier ends it.

    Example:
        ? (let ((tries 0))
            (scs:do* (if (< (incf tries) 3) (fail :slipped) tries)))
        3

    Source: SCS Appendix C.
    """
    return expand(IN_ORDER, form, environment, T)


@function("(%do-in-order modifiers steps starred)", SCS)
def do_in_order(modifiers: Value, steps: Value, starred: Value) -> Value:
    """DO, or DO* if STARRED."""
    listed = read_steps(steps)
    return run_under(read_modifiers(modifiers), lambda: in_order(listed, starred is not None))


@macro("(repeat &rest steps)", SCS)
def repeat(form: Cons, environment: Any) -> Value:
    """Do STEPS in order, over and over, as DO does.

    Returns: :deactivated, when a modifier ends it.
    Fails:   as the first of STEPS that fails.

    Example:
        ? (let ((level 0))
            (repeat :while (< level 3) (princ (incf level))))
        123
        :DEACTIVATED

    Source: SCS Appendix C.
    """
    return expand(REPEAT, form, environment, None)


@macro("(repeat* &rest steps)", SCS)
def repeat_star(form: Cons, environment: Any) -> Value:
    """Do STEPS in order, over and over, as DO* does.

    Returns: :deactivated, when a modifier ends it.

    Example:
        ? (let ((turns 0))
            (repeat* :until (= turns 3) (if (oddp (incf turns)) (fail :odd))))
        :DEACTIVATED

    Source: SCS Appendix C.
    """
    return expand(REPEAT, form, environment, T)


@function("(%do-repeatedly modifiers steps starred)", SCS)
def do_repeatedly(modifiers: Value, steps: Value, starred: Value) -> Value:
    """REPEAT, or REPEAT* if STARRED."""
    listed = read_steps(steps)

    def body() -> Value:
        rounds = running.session.ticks.source
        while True:
            in_order(listed, starred is not None)
            next(rounds)
            rounds = running.session.ticks.source

    return run_under(read_modifiers(modifiers), body)
