"""Nets: tasks that one task starts, and waits for (ESL §4.3).

All must succeed, or one, or none. However the parent leaves, its children
have ended by then, their cleanups included.
"""

from __future__ import annotations

from eslang.base.hints import TYPE_CHECKING, Callable
from eslang.base.stack import require_room
from eslang.runtime.events import Wait
from eslang.runtime.lives import LEAVING
from eslang.runtime.tasks import FAILED, SUCCEEDED, Task

if TYPE_CHECKING:
    from eslang.runtime.scheduler import Scheduler

Rule = Callable[["Net", Task], bool]  # given one that has ended: is the net decided?


class Net:
    """The children of one form, and what has become of them."""

    def __init__(self, scheduler: Scheduler, rule: Rule) -> None:
        self.scheduler = scheduler
        self.rule = rule
        self.members: list[Task] = []
        self.left = 0
        self.deciding: Task | None = None  # the child that decided how the net ends
        self.wait: Wait | None = None

    def run(self) -> None:
        """Start the members, and wait until all have ended."""
        lives = self.scheduler.lives
        task = self.scheduler.at_work()
        require_room()
        self.left = len(self.members)
        for member in self.members:
            member.on_end = self.note_end
            member.seen = True
            lives.start(member, "member")
        try:
            if self.left:
                self.wait = Wait(task, "tasks", self.members)
                self.scheduler.wait(self.wait)
        finally:
            if self.left:
                lives.abort_all(task, self.members, "net")

    def note_end(self, member: Task) -> None:
        """MEMBER has ended; the others are aborted if that decides it."""
        self.left -= 1
        if self.deciding is None and self.rule(self, member):
            self.deciding = member
            if self.wait is not None:
                self.wait.kind = LEAVING
            for other in self.members:
                self.scheduler.lives.abort(other, "net", member)
        if not self.left and self.wait is not None:
            self.scheduler.end_wait(self.wait, None)


def all_must_succeed(net: Net, member: Task) -> bool:
    """The first failure decides."""
    return member.status is FAILED


def any_may_fail(net: Net, member: Task) -> bool:
    """Nothing decides before all have ended."""
    return False


def one_must_succeed(net: Net, member: Task) -> bool:
    """The first success decides."""
    return member.status is SUCCEEDED
