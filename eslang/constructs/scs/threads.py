"""Threads of execution (SCS §3): explicit wait and resume, at designated points; and the cycle.

A thread is a task. It gives up its turn where its text says so, and goes on
when another resumes it.
"""

from __future__ import annotations

from eslang.base.failure import type_error
from eslang.base.hints import Any
from eslang.base.lists import Cons
from eslang.base.many import pack, primary
from eslang.base.number_kinds import is_number
from eslang.base.running import running
from eslang.base.shown import shown
from eslang.base.symbols import Symbol, Value, truth
from eslang.compile.registry import SCS, function, macro
from eslang.constructs.scs.asking import run_under
from eslang.constructs.scs.stepping import expand, in_order, read_steps
from eslang.constructs.shapes import refuse
from eslang.runtime.circuits import end_of_action, stage_here
from eslang.runtime.events import Event, Wait
from eslang.runtime.periods import Periods
from eslang.runtime.tasks import Task

CYCLE = Symbol.intern("%DO-IN-CYCLES", SCS)
SUSPENDED = "suspended"  # the kind of a wait that RESUME ends


def suspend_values() -> Value:
    """All that RESUME gives."""
    scheduler = running.session.scheduler
    task = scheduler.at_work()
    event = Event(None)
    return pack(scheduler.wait(Wait(task, SUSPENDED, task, (event,))))


@function("(suspend)", SCS, many=suspend_values)
def suspend() -> Value:
    """Let this task wait here until another one resumes it.

    Returns: the values that RESUME gives.
    Waits:   until (resume task) is called for this task.

    Example:
        ? (let ((arm (spawn (list :got (suspend)))))
            (yield)
            (resume arm :cup)
            (car (wait-for-events arm)))
        :GOT

    Source: SCS §3, "Multiple Threads of Execution".
    """
    return primary(suspend_values())


@function("(resume task &rest values)", SCS)
def resume(task: Value, *values: Value) -> Value:
    """Let TASK, which waits in SUSPEND, go on, with VALUES.

    Returns: T, or NIL if TASK does not wait in SUSPEND: then nothing happens.
    Fails:   :type-error if TASK is no task.

    Source: SCS §3, "Multiple Threads of Execution".
    """
    if not isinstance(task, Task):
        raise type_error(task, "TASK", Symbol.intern("RESUME", SCS))
    wait = task.wait
    is_suspended = wait is not None and wait.kind == SUSPENDED and not wait.done
    if wait is not None and is_suspended:
        running.session.scheduler.end_wait(wait, values)
    return truth(is_suspended)


@macro("(with-cycle frequency &rest steps)", SCS)
def with_cycle(form: Cons, environment: Any) -> Value:
    """Do STEPS in order, over and over, HZ times a second.

    FREQUENCY is (HZ). Cycles begin when they are due on the clock. One that would begin while the
    one before still runs is skipped, and that is told (`period-missed`).
    Modifiers may stand before STEPS, as in DO.

    Returns: :deactivated, when a modifier ends it.
    Fails:   as STEPS do; :type-error, if HZ is not above 0.
    Waits:   between two cycles.

    Example:
        ? (let ((looks 0))
            (with-cycle (10) :while (< looks 3) (incf looks))
            looks)
        3

    Source: SCS §3, "Continuous Action".
    """
    frequency = form.cdr.car
    if frequency.__class__ is not Cons or frequency.cdr is not None:
        wrong, hint = f"`{shown(frequency)}` is no frequency", "write `(hz)`, the number of cycles a second"
        refuse(environment, "malformed-step", wrong, form.cdr, hint=hint, within="with-cycle")
    return expand(CYCLE, Cons(form.car, form.cdr.cdr), environment, frequency.car)


@function("(%do-in-cycles operator modifiers steps frequency)", SCS)
def do_in_cycles(operator: Value, modifiers: Value, steps: Value, frequency: Value) -> Value:
    """Do STEPS FREQUENCY times a second."""
    listed = read_steps(steps)
    if not is_number(frequency) or not frequency > 0:
        raise type_error(frequency, "POSITIVE-REAL", Symbol.intern("WITH-CYCLE", SCS))

    def body() -> Value:
        periods = Periods(running.session.scheduler, 1 / float(frequency))
        stage = stage_here()
        while True:
            in_order(listed, False, stage)
            periods.wait()
            end_of_action()

    return run_under(operator, modifiers, body)
