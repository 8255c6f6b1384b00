"""Steps in parallel (SCS Appendix C): do all.

Each step is a task. After every action any of those that are ready goes on,
as chance has it.
"""

from __future__ import annotations

from eslang.base.hints import Any, Callable
from eslang.base.lists import Cons
from eslang.base.running import running
from eslang.base.symbols import Symbol, T, Value
from eslang.compile.registry import SCS, function, macro
from eslang.constructs.scs.asking import run_under
from eslang.constructs.scs.stepping import Step, expand, persist, read_steps
from eslang.runtime import failures
from eslang.runtime.attempts import noticed
from eslang.runtime.circuits import Level, Stage, ask_around, stage_here
from eslang.runtime.lives import passed_on
from eslang.runtime.nets import Net, all_must_succeed

ALL = Symbol.intern("%DO-ALL", SCS)


@macro("(do-all &rest steps)", SCS)
def do_all(form: Cons, environment: Any) -> Value:
    """Do STEPS in parallel, one action at a time, in any order.

    After every action, chance says whose turn it is. It ends when all have
    ended; a step that is deactivated has ended. As soon as one fails, the
    others are aborted. While an action waits, no other begins; a step that is
    no action and waits lets the others act. Modifiers may stand before STEPS,
    as in DO.

    Returns: T; :deactivated, if a modifier ends it.
    Fails:   as the first of STEPS that fails.
    Waits:   until all STEPS have ended.

    Example:
        ? (let ((count 0))
            (do-all (scs:do (incf count) (incf count)) (incf count))
            count)
        3

    Source: SCS Appendix C.
    """
    return expand(ALL, form, environment, None)


@macro("(do*-all &rest steps)", SCS)
def do_star_all(form: Cons, environment: Any) -> Value:
    """Do STEPS in parallel, as DO-ALL does; try those that fail again.

    Returns: T; :deactivated, if a modifier ends it.
    Waits:   until all STEPS have ended.

    Example:
        ? (let ((tries 0))
            (do*-all (if (< (incf tries) 3) (fail :busy)) (princ "other"))
            tries)
        other
        3

    Source: SCS Appendix C.
    """
    return expand(ALL, form, environment, T)


@function("(%do-all operator modifiers steps starred)", SCS)
def do_all_of(operator: Value, modifiers: Value, steps: Value, starred: Value) -> Value:
    """DO-ALL, or DO*-ALL if STARRED."""
    listed = read_steps(steps)
    return run_under(operator, modifiers, lambda: run_all(listed, starred is not None))


def run_all(steps: list[Step], starred: bool) -> Value:
    """Run STEPS as branches, until all have ended; fail as soon as one does."""
    session = running.session
    scheduler = session.scheduler
    net = Net(scheduler, all_must_succeed)
    parent = scheduler.at_work()
    dynamic = parent.dynamic
    outer = dynamic.logical
    level = Level(parent, outer, lambda: True)
    level.open()
    for number, step in enumerate(steps, 1):
        name = str(step.operator or "step").lower()
        net.members.append(scheduler.lives.create(name, branch(number, step, starred, level), parent))
    session.chance.shuffle(net.members)
    dynamic.logical = outer._replace(circuit=level)
    try:
        net.run()
    finally:
        level.end()
        dynamic.logical = outer
        if level.closed and level.arena is not None:
            level.arena.settle(session)
    if net.deciding is not None:
        ask_around()
        return failures.signal(passed_on(net.deciding), continuable=True)
    return T


def branch(number: int, step: Step, starred: bool, level: Level) -> Callable[[], Value]:
    """What the task of one of the steps does. As soon as it fails, LEVEL is to be left."""

    def fails() -> None:
        if not level.closed and level.arena is not None:
            level.close()
            level.arena.fail()

    def body() -> Value:
        dynamic = running.session.dynamic
        whole = stage_here()
        dynamic.logical = dynamic.logical.entered(Stage(whole.operator, whole.around, number))
        return persist(step.run) if starred else noticed(step.run, fails)

    return body
