"""What all constructs of SCS have in common: their shape, and the running of a step (SCS Appendix C).

A step succeeds by returning, fails by FAIL, or is deactivated, which is
neither: then it gives :DEACTIVATED. Between two actions the energizing
conditions around them are asked (runtime/circuits.py).
"""

from __future__ import annotations

from eslang.base.hints import Any, Callable, NamedTuple
from eslang.base.lists import Cons, from_items, items, lisp_list
from eslang.base.many import many_of
from eslang.base.running import running
from eslang.base.shown import shown
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.compile.registry import CL, SCS
from eslang.constructs.conditions import computed_once, test_form, with_variables
from eslang.constructs.scs.asking import DEACTIVATED
from eslang.constructs.shapes import refuse
from eslang.runtime.attempts import Unsuccessful, outcome
from eslang.runtime.circuits import Stage, begin_action, end_of_action

LAMBDA, LIST, QUOTE = (Symbol.intern(name, CL) for name in ("LAMBDA", "LIST", "QUOTE"))
MODIFIERS = ("WHILE", "UNTIL", "WHEN", "UNLESS")
CONSTRUCTS = frozenset(  # whose last action has asked all conditions when they end
    Symbol.intern(name, SCS)
    for each in ("DO", "DO-ALL", "DO-ANY", "DO-FIRST", "DO-BEST", "REPEAT")
    for name in (each, each.replace("DO", "DO*") if each != "REPEAT" else "REPEAT*")
) | {Symbol.intern("ATOMIC", SCS)}
AT_ONCE = 10  # tries that may fail at one moment
IS_ACTION = "ends_with_an_action"  # an attribute of such functions


class Step(NamedTuple):
    """One step of a construct: what it does, its form (of other constructs only the name), its operator."""

    body: Callable[[], Value]
    form: Value
    operator: Value

    def run(self) -> Value:
        """Do it; then the conditions around are asked, unless an action at its end has done so."""
        asks = asks_itself(self.operator)
        if not asks:
            begin_action(self.form)
        value = self.body()
        if value is DEACTIVATED or not asks:
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
        if options is not None and keyword.name in options:
            refuse(environment, "malformed-step", f"`{shown(keyword)}` has no value", rest, within=within)
        if keyword.name not in MODIFIERS:
            if rest.cdr is None:
                break  # a step that gives a keyword
            wrong = f"`{shown(keyword)}` is no modifier of a step"
            hint = "write `:while`, `:until`, `:when` or `:unless`, and a condition"
            hint += f"; or `'{shown(keyword)}` for a value"
            refuse(environment, "malformed-step", wrong, rest, hint=hint, within=within)
        if rest.cdr is None or is_modifier(rest.cdr.car):
            refuse(environment, "malformed-step", f"`{shown(keyword)}` has no condition", rest, within=within)
        condition = rest.cdr.car
        test = asking_form(condition, environment)
        modifiers.append(lisp_list(LIST, keyword, lisp_list(QUOTE, condition), test))
        rest = rest.cdr.cdr
    return Cons(LIST, from_items(modifiers)) if modifiers else None, rest


def asking_form(condition: Value, environment: Any) -> Value:
    """The form that gives the function that asks CONDITION.

    Where something in it stands under a backquote, which is to be computed
    once, it gives the list of a function that does so and gives that function.
    """
    computed, bindings = computed_once(condition)
    test = lisp_list(LAMBDA, None, test_form(computed, environment))
    if bindings is None:
        return test
    return lisp_list(LIST, lisp_list(LAMBDA, None, with_variables(bindings, test)))


def steps_form(forms: Value, environment: Any, within: str) -> Value:
    """The form that gives the steps that FORMS, a list in WITHIN, are."""
    refuse_modifiers(forms, environment, within)
    parts = []
    for form in items(forms):
        operator = form.car if form.__class__ is Cons and isinstance(form.car, Symbol) else None
        if environment is not None and environment.find_function(operator) is not None:
            operator = None  # a local function, whatever its name
        shown_form = Cons(operator, None) if operator in CONSTRUCTS else form
        parts += [lisp_list(LAMBDA, None, form), lisp_list(QUOTE, shown_form), lisp_list(QUOTE, operator)]
    return Cons(LIST, from_items(parts))


def expand(function_name: Symbol, form: Cons, environment: Any, *more: Value) -> Value:
    """The call of FUNCTION-NAME for a construct of modifiers and steps."""
    within = spelled(form.car)
    modifiers, steps = parts_of(form, environment, within)
    return call_of(function_name, form, modifiers, steps_form(steps, environment, within), *more)


def is_modifier(form: Value) -> bool:
    """Whether FORM says that a condition follows."""
    return isinstance(form, Keyword) and form.name in MODIFIERS


def refuse_modifiers(forms: Value, environment: Any, within: str) -> None:
    """Refuse modifiers among FORMS, where steps are to be."""
    while forms.__class__ is Cons:
        form = forms.car
        if is_modifier(form):
            wrong = f"`{shown(form)}` stands where a step is to be"
            hint = "modifiers stand before the first step of a construct: `(scs:do :while condition step...)`"
            refuse(environment, "malformed-step", wrong, forms, hint=hint, within=within)
        forms = forms.cdr


def spelled(operator: Symbol) -> str:
    """OPERATOR as it is written where plain DO and DO* are Common Lisp's."""
    name = shown(operator)
    return f"scs:{name}" if name in ("do", "do*") else name


def call_of(function_name: Symbol, form: Cons, *parts: Value) -> Value:
    """The call of FUNCTION-NAME for FORM, of which it knows the operator."""
    return lisp_list(function_name, lisp_list(QUOTE, form.car), *parts)


def read_steps(steps: Value) -> list[Step]:
    """Steps as Python has them."""
    parts = items(steps)
    return [Step(many_of(parts[at]), parts[at + 1], parts[at + 2]) for at in range(0, len(parts), 3)]


# --- outcomes ------------------------------------------------------------------------


class Tries:
    """What is tried until something does not fail."""

    __slots__ = ("at", "at_once")

    def __init__(self) -> None:
        self.at = -1.0  # when the last try has failed
        self.at_once = 0  # how many have failed in a row at that moment

    def again(self) -> None:
        """A try has failed: ask the conditions, and let others have their turns.

        On the virtual clock time passes, if tries take none: a world that is
        in a bad way for three seconds has to come out of it.
        """
        end_of_action()
        session = running.session
        next(session.ticks.source)
        now = session.clock.now()
        self.at_once = self.at_once + 1 if now == self.at else 0
        self.at = now
        if self.at_once == AT_ONCE:
            session.clock.use_slice()


def persist(body: Callable[[], Value]) -> Value:
    """What BODY gives when it does not fail; until then it is tried again."""
    tries, task = Tries(), running.session.scheduler.at_work()
    while True:
        value = outcome(task, body)
        if value.__class__ is not Unsuccessful:
            return value
        tries.again()


def in_order(steps: list[Step], starred: bool, stage: Stage | None = None) -> Value:
    """Run STEPS, which STAGE counts; the values of the last one, NIL if that was deactivated."""
    value: Value = None
    stage = stage or Stage(None, None)
    for number, step in enumerate(steps, 1):
        stage.number = number
        value = persist(step.run) if starred else step.run()
    if not steps:
        end_of_action()
    return None if value is DEACTIVATED else value
