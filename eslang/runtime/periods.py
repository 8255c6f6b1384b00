"""Periods: moments that lie a fixed time apart, counted from the first, so that they never drift."""

from __future__ import annotations

from math import ceil

from eslang.base.hints import TYPE_CHECKING

if TYPE_CHECKING:
    from eslang.runtime.scheduler import Scheduler

SLACK = 1e-9  # of a period: what two sums of floats may differ by


class Periods:
    """Periods of so many seconds, the first of which has begun."""

    def __init__(self, scheduler: Scheduler, seconds: float) -> None:
        self.scheduler = scheduler
        self.seconds = seconds
        self.begun = scheduler.session.clock.now()
        self.count = 0  # of the one at hand

    def wait(self) -> None:
        """Wait until the next period begins; those that are over already are skipped, and told."""
        now = self.scheduler.session.clock.now()
        following = max(self.count + 1, ceil((now - self.begun) / self.seconds - SLACK))
        missed = following - self.count - 1
        self.count = following
        if missed:
            self.scheduler.lives.tell("period-missed", missed=missed, seconds=self.seconds)
        self.scheduler.sleep(max(0.0, self.begun + following * self.seconds - now), "period")
