"""Arenas: where the steps of a circuit that run in parallel act, one action at a time (SCS Appendix C).

The task of each such step is a branch. Chance says which of those that are
ready goes on; none begins an action while another is at one, or behind a
failure that nobody has taken yet.
"""

from __future__ import annotations

from eslang.base.hints import Any
from eslang.runtime.events import Wait
from eslang.runtime.tasks import Task

TURN = "turn"  # the kind of a wait of a branch that is not to act yet


class Arena:
    """Where the branches act of a construct and of all that stand inside."""

    __slots__ = ("acting", "failing", "last", "waits")

    def __init__(self) -> None:
        self.acting: Task | None = None  # who is at an atomic action
        self.failing = 0  # constructs that are being left because one of their branches has failed
        self.last: Task | None = None  # who has acted last
        self.waits: dict[Wait, None] = {}

    def admit(self, session: Any, cleans: bool) -> bool:
        """Let the current task wait until it may act; who CLEANS may behind a failure, too.

        True if others have acted since it did.
        """
        task = session.scheduler.at_work()
        while (self.failing and not cleans) or self.is_taken(task):
            wait = Wait(task, TURN, "its turn")
            self.waits[wait] = None
            try:
                session.scheduler.wait(wait)
            finally:
                del self.waits[wait]
        return self.last is not None and self.last is not task

    def is_taken(self, task: Task) -> bool:
        """Whether somebody is at an action, to which TASK does not belong."""
        return self.acting is not None and self.acting not in task.ancestors()

    def leave(self, session: Any, outer: Task | None) -> None:
        """The action has ended; OUTER is at one around it."""
        self.acting = outer
        self.wake(session)

    def fail(self) -> None:
        """A branch has failed, and nothing in it takes that."""
        self.failing += 1

    def settle(self, session: Any) -> None:
        """The failure has come to the construct around the branches."""
        self.failing -= 1
        self.wake(session)

    def wake(self, session: Any) -> None:
        """Let those that wait look again, in any order."""
        if self.waits:
            waits = list(self.waits)
            session.chance.shuffle(waits)
            for wait in waits:
                session.scheduler.end_wait(wait, None)


def take_turns(session: Any) -> bool:
    """Let any of the branches that are ready go on, as chance has it, the current one among them.

    Other tasks keep their places in the queue, and so do those that have to
    wait for an action around this one. True if others went on.
    """
    scheduler = session.scheduler
    task, ready = scheduler.at_work(), scheduler.ready
    arena = task.dynamic.logical.circuit.arena
    places = [
        index
        for index, other in enumerate(ready)
        if other.dynamic.logical.circuit is not None and not arena.is_taken(other)
    ]
    if not places:
        return False
    places.append(len(ready))
    ready.append(task)
    task.queued = True
    chosen, first = places[session.chance.randrange(len(places))], places[0]
    ready[first], ready[chosen] = ready[chosen], ready[first]
    steps = scheduler.steps
    scheduler.pause(task)
    if task.interrupts or task.ending is not None:
        scheduler.attend(task)
    return bool(scheduler.steps != steps + 1)
