"""Conditions that may change at any step, and are looked at again after each."""

from __future__ import annotations

from eslang.base.hints import TYPE_CHECKING
from eslang.runtime.events import Wait

if TYPE_CHECKING:
    from eslang.runtime.scheduler import Scheduler

CONDITION = "condition"  # the kind of a wait that looks at its test again


class Polls:
    """The waits for such conditions."""

    __slots__ = ("looked", "scheduler", "waits")

    def __init__(self, scheduler: Scheduler) -> None:
        self.scheduler = scheduler
        self.waits: list[Wait] = []
        self.looked = -1  # the step that only looked again at a condition

    def look_again(self) -> None:
        """Let all that wait for a condition look at it again, unless nothing was done since."""
        if self.waits and self.looked != self.scheduler.steps:
            waits, self.waits = self.waits, []
            self.scheduler.wake(waits)

    def look_at_once(self) -> None:
        """The same, whatever was done."""
        self.looked = -1
        self.look_again()

    def add(self, wait: Wait, again: bool) -> None:
        """Let WAIT, whose condition does not hold, look at it again after the next step that does something.

        This step did nothing else if it only looked AGAIN.
        """
        self.waits.append(wait)
        self.scheduler.hand_back()
        self.looked = self.scheduler.granted if again else -1

    def forget(self, wait: Wait) -> None:
        """Look no more at the condition of WAIT."""
        if wait in self.waits:
            self.waits = [other for other in self.waits if other is not wait]
