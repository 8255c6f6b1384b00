"""Steps (SCS Appendix C): atomic actions, sequences, and what is said of all constructs.

A step succeeds by returning, fails by FAIL, or is deactivated, which is
neither: then it gives :DEACTIVATED. Between two actions the energizing
conditions around them are asked (runtime/circuits.py).
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import Any, Callable, Iterator, NamedTuple
from eslang.base.lists import Cons, from_items, items, lisp_list
from eslang.base.running import running
from eslang.base.shown import shown
from eslang.base.symbols import Keyword, Symbol, Value
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
ATOMIC, NOTE_ACTION, DO, IN_ORDER = (
    Symbol.intern(name, SCS) for name in ("%CALL-ATOMIC", "%NOTE-ACTION", "DO", "%DO-IN-ORDER")
)
CONSTRUCTS: set[Symbol] = set()  # whose last action has asked all conditions when they end


class Step(NamedTuple):
    """One step of a construct: what it does, and the operator of its form."""

    body: Callable[[], Value]
    operator: Value

    def run(self) -> Value:
        """Do it; then the conditions around are asked, unless an action at its end has done so."""
        value = self.body()
        if not asks_itself(self.operator):
            end_of_action()
        return value


def asks_itself(operator: Value) -> bool:
    """Whether a call of OPERATOR ends with an action that asks the conditions."""
    return operator in CONSTRUCTS or operator in running.session.actions


def construct(name: str) -> Symbol:
    """The symbol of a construct of SCS, as an operator that asks the conditions itself."""
    symbol = Symbol.intern(name, SCS)
    CONSTRUCTS.add(symbol)
    return symbol


# --- the shape of constructs ---------------------------------------------------------


def parts_of(form: Cons, environment: Any, within: str) -> tuple[Value, Value]:
    """The form that gives the modifiers of FORM, and the rest of its body."""
    modifiers: list[Value] = []
    rest = form.cdr
    while rest.__class__ is Cons and isinstance(rest.car, Keyword):
        keyword = rest.car
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


def steps_form(forms: Value) -> Value:
    """The form that gives the steps that FORMS are."""
    parts = []
    for form in items(forms):
        operator = form.car if form.__class__ is Cons and isinstance(form.car, Symbol) else None
        parts += [lisp_list(LAMBDA, None, form), lisp_list(QUOTE, operator)]
    return Cons(LIST, from_items(parts))


def expand(function_name: Symbol, form: Cons, environment: Any, *more: Value) -> Value:
    """The call of FUNCTION-NAME for a construct of modifiers and steps."""
    modifiers, steps = parts_of(form, environment, str(form.car).lower())
    return lisp_list(function_name, modifiers, steps_form(steps), *more)


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
    """Run STEPS; the value of the last one."""
    value: Value = None
    for step in steps:
        value = persist(step.run) if starred else step.run()
    return value
