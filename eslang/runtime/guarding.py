"""Guardians and deadlines: what interrupts the task that is inside a form.

An extent is the form's; the interrupt comes only while the task is inside,
and is forgotten when it has left.
"""

from __future__ import annotations

from eslang.base.hints import TYPE_CHECKING, Callable
from eslang.base.stack import require_room
from eslang.base.symbols import Value
from eslang.runtime import failures
from eslang.runtime.failures import Dynamic
from eslang.runtime.tasks import ABORTED, Extent, Interrupt, Task

if TYPE_CHECKING:
    from eslang.runtime.scheduler import Scheduler


def _under_these_bindings(dynamic: Dynamic, action: Callable[[], Value]) -> Callable[[], Value]:
    """What does ACTION with logic variables bound as they are here, as a recovery procedure would."""
    here = dynamic.logical

    def act() -> Value:
        there, dynamic.logical = dynamic.logical, here
        try:
            return action()
        finally:
            dynamic.logical = there

    return act


def run_guarded(
    scheduler: Scheduler, guard: Task, action: Callable[[], Value], body: Callable[[], Value]
) -> Value:
    """Run BODY; if GUARD ends before, the task does ACTION where it stands. GUARD has ended afterwards."""
    task = scheduler.at_work()
    extent = Extent(task.dynamic)
    action = _under_these_bindings(task.dynamic, action)

    def alarm(ended: Task) -> None:
        if ended.status is not ABORTED and extent.live:
            scheduler.interrupt(task, Interrupt("guardian", action, extent, by=ended))

    require_room()
    guard.on_end = alarm
    guard.seen = True
    scheduler.lives.start(guard, "guardian")
    try:
        return failures.guarded(body)
    finally:
        extent.live = False
        scheduler.lives.abort_all(task, [guard], "guardian")


def run_until(
    scheduler: Scheduler, seconds: float, action: Callable[[], Value], body: Callable[[], Value]
) -> Value:
    """Run BODY; if SECONDS have passed before, the task does ACTION where it stands."""
    task = scheduler.at_work()
    extent = Extent(task.dynamic)
    action = _under_these_bindings(task.dynamic, action)
    timer = scheduler.set_timer(
        seconds, lambda: scheduler.interrupt(task, Interrupt("deadline", action, extent))
    )
    try:
        return failures.guarded(body)
    finally:
        extent.live = False
        scheduler.timers.call_off(timer)


def run_masked(scheduler: Scheduler, body: Callable[[], Value]) -> Value:
    """Run BODY, which no interrupt reaches; those that came meanwhile reach it at its end."""
    task = scheduler.at_work()
    dynamic = task.dynamic
    dynamic.masked += 1
    try:
        result = failures.guarded(body)
    finally:
        dynamic.masked -= 1
    if not dynamic.masked:
        scheduler.attend(task)
    return result
