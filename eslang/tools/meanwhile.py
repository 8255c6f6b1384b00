"""What goes on while the prompt waits: the tasks that forms have spawned.

After each form, those that are ready go on for a moment, so that an answer
shows what it has set going. While input is awaited, all of them go on, timers
too. That nothing can wake a task is then no deadlock: what is said next may.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

MOMENT = 0.05  # seconds that tasks have after a form, on the clock of the interpreter

Rest = Callable[[float | None], None]  # sleeps so long, or until something comes


class Meanwhile:
    """The tasks of one interpreter, between two forms."""

    def __init__(self, interp: Any) -> None:
        self.interp = interp

    def settle(self) -> None:
        """Let tasks go on until none is ready, but no longer than a moment. Raises Stop."""
        clock = self.interp.clock
        end = clock.now() + MOMENT
        self.go_on(lambda: self.is_quiet() or clock.now() >= end, lambda seconds: None)

    def is_quiet(self) -> bool:
        """True if no task has anything to do before a timer is due, or something comes from outside."""
        scheduler = self.interp.scheduler
        scheduler.polls.look_again()
        return not scheduler.ready and bool(scheduler.posted.empty())

    def burst(self, is_over: Callable[[], bool]) -> float | None:
        """Let tasks go on until IS_OVER, or all wait; the seconds until one goes on. Raises Stop."""
        pauses: list[float | None] = []
        self.go_on(lambda: bool(pauses) or is_over(), pauses.append)
        return pauses[-1] if pauses else 0.0

    def go_on(self, done: Callable[[], bool], rest: Rest) -> None:
        """Let tasks go on until DONE; where all wait, REST. Raises Stop."""
        scheduler = self.interp.scheduler
        before = scheduler.rest, scheduler.is_open, scheduler.between
        scheduler.rest, scheduler.is_open = rest, True
        scheduler.between = scheduler.between or (lambda: None)  # a loop hands over, so that DONE is asked
        try:
            with self.interp.at_work():
                self.interp.runs.drive_until(done)
        finally:
            scheduler.rest, scheduler.is_open, scheduler.between = before
