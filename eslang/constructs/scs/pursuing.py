"""Pursuing goals (SCS §2): those of the agent, and that of a step that maintains something.

Which goal is tried when, and what comes of that, is told in runtime/pursuit.py,
which is loaded when it is wanted.
"""

from __future__ import annotations

from eslang.base.failure import Failure, control_error
from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items, lisp_list
from eslang.base.running import running, to_function
from eslang.base.symbols import Keyword, Symbol, T, Value
from eslang.compile.registry import SCS, function, macro
from eslang.constructs.conditions import computed_once, with_variables
from eslang.constructs.scs.asking import run_under
from eslang.constructs.scs.goals import ACHIEVE_FUNCTION, agenda_of, await_need, parts_of_condition
from eslang.constructs.scs.stepping import call_of, parts_of
from eslang.constructs.shapes import refuse
from eslang.runtime import failures
from eslang.runtime.circuits import end_of_action, stage_here

PURSUE, MAINTAIN_STEP = (Symbol.intern(name, SCS) for name in ("%PURSUE-GOALS", "%MAINTAIN"))
IMPOSSIBLE_GOALS, IF_OPEN = map(Keyword, ("IMPOSSIBLE-GOALS", "IF-OPEN"))


@macro("(pursue-goals &key while until when unless wait)", SCS)
def pursue_goals(form: Cons, environment: Any) -> Value:
    """Pursue the goals of the agent, one action at a time, in any order.

    Each goal has a task. After every action, chance says whose turn it is;
    if goals have utilities, those go on that are worth most then. Goals that
    are added meanwhile are taken up before the next action.

    A goal is impossible, and dropped, when an attempt fails with :impossible,
    :deadlock, :unbound-logic-variable or a cause below :error, or the last of
    its :retries does. If no
    method applies it waits until facts have changed; when nothing else is
    left that could change them, it is impossible, too.

    It ends when no goal is left to be done: goals to maintain hold then, and
    stay. With WAIT it does not end: goals and facts may come from others. That
    is so without the word in an interpreter that waits for the outside.
    Modifiers may be among the words, as in DO.

    Returns: T; :deactivated, if a modifier ends it.
    Fails:   :impossible-goals at its end, with a list of the goals that were
             impossible, each (GOAL CAUSE . ARGUMENTS); :control-error if the
             goals are being pursued already; as the utilities of goals fail.
    Waits:   until no goal is left to be done.

    Example:
        ? (defproperty battery (percent))
        BATTERY
        ? (to-achieve (battery ?level) (t (assert '(battery #?level))))
        (BATTERY ?LEVEL)
        ? (progn (add-goal (maintain (battery 100))) (add-goal (achieve (battery 50))))
        #<GOAL (ACHIEVE (BATTERY 50))>
        ? (pursue-goals)
        Attempting to achieve (BATTERY 100)
        (BATTERY 100) achieved.
        Attempting to achieve (BATTERY 50)
        (BATTERY 50) achieved.
        Attempting to achieve (BATTERY 100)
        (BATTERY 100) achieved.
        T

    Source: SCS §2, "Goals", "The Interpreter"; when it ends: decision 37.
    """
    options: dict[str, Value] = {"WAIT": IF_OPEN}
    modifiers, rest = parts_of(form, environment, "pursue-goals", options)
    if rest is not None:
        wrong, hint = "pursue-goals has no steps", "give goals with `add-goal`"
        refuse(environment, "malformed-step", wrong, rest, hint=hint, within="pursue-goals")
    return call_of(PURSUE, form, modifiers, options["WAIT"])


@function("(%pursue-goals operator modifiers wait)", SCS)
def pursue_goals_of(operator: Value, modifiers: Value, wait: Value) -> Value:
    """PURSUE-GOALS under MODIFIERS."""
    return run_under(operator, modifiers, lambda: _pursue(wait))


def _pursue(wait: Value) -> Value:
    from eslang.runtime.pursuit import Pursuit

    session = running.session
    agenda = agenda_of(session)
    if agenda.pursuit is not None:
        raise control_error(f"the goals are being pursued already, by the task {agenda.pursuit.task}")
    waits = session.scheduler.is_open if wait is IF_OPEN else wait is not None
    given_up = Pursuit(agenda, lambda hear: session.database.subscribe(hear), waits, stage_here()).run()
    if not given_up:
        return T
    told = [
        Cons(goal.spec, Cons(failure.cause, from_items(list(failure.arguments))))
        for goal, failure in given_up
    ]
    return failures.signal(Failure(IMPOSSIBLE_GOALS, from_items(told)), continuable=True)


@macro("(maintain condition)", SCS)
def maintain(form: Cons, environment: Any) -> Value:
    """Achieve CONDITION whenever it is false, as long as this step lasts.

    It does not end by itself: a modifier of a construct around it ends it.
    CONDITION is written as in ACHIEVE.

    Fails:   as ACHIEVE does.
    Waits:   while CONDITION holds.

    Example:
        ? (defproperty lamp (state))
        LAMP
        ? (to-achieve (lamp ?state) (t (assert '(lamp #?state))))
        (LAMP ?STATE)
        ? (scs:do :until (evening over) (do-all (maintain (lamp :on)) (assert '(evening over))))
        Attempting to achieve (LAMP :ON)
        (LAMP :ON) achieved.
        :DEACTIVATED

    Source: SCS §2, "Goals", "SCS Plans".
    """
    condition, bindings = computed_once(form.cdr.car)
    parts = parts_of_condition(condition, environment)
    return with_variables(bindings, lisp_list(MAINTAIN_STEP, *parts))


@function("(%maintain condition instance test)", SCS)
def maintain_step(condition: Value, instance: Value, test: Any) -> Value:
    """Achieve CONDITION whenever TEST says that it is false."""
    rounds = running.session.ticks.source
    while True:
        await_need(condition, test)
        to_function(ACHIEVE_FUNCTION)(condition, instance, test)
        end_of_action()
        next(rounds)
        rounds = running.session.ticks.source
