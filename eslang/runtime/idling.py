"""Idling: nobody is ready, so time passes until somebody is.

On a virtual clock that is a jump to the next timer; on a real one it is a
rest, which ends with the next timer or with what is posted. Where neither can
come, the tasks are in a deadlock.
"""

from __future__ import annotations

from _queue import Empty

from eslang.base.hints import TYPE_CHECKING

if TYPE_CHECKING:
    from eslang.runtime.scheduler import Scheduler

POLL = 0.02  # seconds between two looks at a condition that reads what no task changes


def idle(scheduler: Scheduler) -> None:
    """Let time pass until a timer is due, or something comes from outside."""
    moment = scheduler.timers.next_moment()
    clock = scheduler.session.clock
    if clock.is_virtual and moment is not None and not scheduler.outside:
        clock.advance(moment)
        return
    pause = None if moment is None else max(0.0, moment - clock.now())
    if not clock.is_virtual and any(wait.outside and not wait.done for wait in scheduler.polls.waits):
        scheduler.rest(POLL if pause is None else min(POLL, pause))
        scheduler.polls.look_at_once()
    elif scheduler.outside or scheduler.is_open or pause is not None:
        scheduler.rest(pause)
    else:
        scheduler.end_deadlock()


def rest(scheduler: Scheduler, seconds: float | None) -> None:
    """Sleep until something is posted, which is done then, or for SECONDS."""
    try:
        action = scheduler.posted.get(timeout=seconds) if seconds is not None else scheduler.posted.get()
    except Empty:
        return
    action()
