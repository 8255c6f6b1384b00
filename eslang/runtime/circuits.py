"""Circuits: the energizing conditions under which a task acts (SCS Appendix B and C).

Each construct that goes on only while a condition holds is a level. Whenever
an atomic action has ended, the levels are asked from the outermost in; at the
first that no longer holds, everything inside is left, with its cleanups, and
new choices are made there. A level that rests on facts alone is asked only if
they have changed; then its task is roused, too, should it wait. What a level
asks is handed in: this file knows no condition.
"""

from __future__ import annotations

from eslang.base.control import Deactivated
from eslang.base.hints import TYPE_CHECKING, Any, Callable
from eslang.base.lists import from_items
from eslang.base.running import running
from eslang.base.symbols import Value
from eslang.runtime.events import Wait
from eslang.runtime.tasks import Extent, Interrupt, Task

if TYPE_CHECKING:
    from eslang.runtime.logical import Logical


class Level:
    """One entrance of a construct that is active while something holds."""

    __slots__ = ("chain", "extent", "holds", "is_branch", "is_stale", "live", "logical", "polls", "task")

    def __init__(self, task: Task, logical: Logical, holds: Callable[[], bool]) -> None:
        outer: Level | None = logical.circuit
        self.task = task
        self.logical = logical  # what was in force around it
        self.holds = holds
        self.polls = False  # it is asked after every action
        self.is_stale = False  # what it rests on has changed
        self.is_branch: bool = outer is not None and outer.is_branch  # others take turns with it
        self.live = True
        self.extent = Extent(task.dynamic)
        self.chain: tuple[Level, ...] = (*outer.chain, self) if outer is not None else (self,)

    def stir(self, change: object = None) -> None:
        """What it rests on has changed: it is to be asked, at once if its task waits."""
        if self.is_stale or not self.live:
            return
        self.is_stale = True
        scheduler = running.session.scheduler
        if scheduler.current is not self.task:
            scheduler.interrupt(self.task, Interrupt("circuit", self.ask_again, self.extent))

    def ask_again(self) -> None:
        """Leave it, if it does not hold any more. Raises Deactivated."""
        if self.live and self.is_stale and not self.ask():
            raise Deactivated(self)

    def ask(self) -> bool:
        """Whether it still holds."""
        self.is_stale = False
        dynamic = running.session.dynamic
        here, dynamic.logical = dynamic.logical, self.logical
        try:
            return self.holds()
        finally:
            dynamic.logical = here

    def end(self) -> None:
        """It is left."""
        self.live = self.extent.live = False


class Stage:
    """One construct that is under way: how far it is, and why it does that, for those who look on."""

    __slots__ = ("around", "condition", "number", "operator")

    def __init__(self, operator: Value, around: Stage | None, number: int = 1) -> None:
        self.operator = operator
        self.around = around
        self.number = number  # of the step that is under way
        self.condition: list[Value] = []  # the one for which it was chosen

    def path(self) -> list[Value]:
        """It and all around it, outermost first, each (OPERATOR NUMBER [CONDITION])."""
        found = []
        stage: Stage | None = self
        while stage is not None:
            found.append(from_items([stage.operator, stage.number, *stage.condition]))
            stage = stage.around
        return found[::-1]


def stage_here() -> Stage:
    """The innermost construct that is under way."""
    stage: Stage = running.session.dynamic.logical.stage
    return stage


def begin_action(action: Value) -> None:
    """ACTION is about to begin: nothing may have changed since the levels were asked."""
    session = running.session
    dynamic = session.dynamic
    if dynamic.masked:
        return
    level: Level | None = dynamic.logical.circuit
    if level is not None:
        for each in level.chain:
            if each.is_stale and not each.ask():
                leave(session, each)
    if session.hooks.listeners:
        stage: Stage | None = dynamic.logical.stage
        path = [] if stage is None else stage.path()
        session.scheduler.lives.tell("action", action=action, path=path)


def tell_deactivated(why: str, condition: Value = None) -> None:
    """The innermost construct leaves what it does, or all of it."""
    session = running.session
    stage: Stage | None = session.dynamic.logical.stage
    if session.hooks.listeners and stage is not None:
        session.scheduler.lives.tell("deactivated", why=why, condition=condition, path=stage.path())


def end_of_action() -> None:
    """An atomic action has ended: let another branch have its turn, and ask the levels."""
    session = running.session
    dynamic = session.dynamic
    level: Level | None = dynamic.logical.circuit
    if level is None or dynamic.masked:
        return
    if level.is_branch:
        take_turns(session)
    for each in level.chain:
        if (each.is_stale or each.polls) and not each.ask():
            leave(session, each)


def leave(session: Any, level: Level) -> None:
    """Leave everything inside LEVEL; if that belongs to another task, wait for what it makes of this one."""
    task = session.scheduler.at_work()
    if level.task is task:
        raise Deactivated(level)
    level.is_stale = True

    def deactivate() -> None:
        raise Deactivated(level)

    session.scheduler.interrupt(level.task, Interrupt("circuit", deactivate, level.extent))
    session.scheduler.wait(Wait(task, "deactivated", level.task))


def take_turns(session: Any) -> None:
    """Let any of the branches that are ready go on, as chance has it, the current one among them.

    Other tasks keep their places in the queue.
    """
    scheduler = session.scheduler
    task, ready = scheduler.at_work(), scheduler.ready
    places = [index for index, other in enumerate(ready) if other.dynamic.logical.circuit is not None]
    if not places:
        return
    places.append(len(ready))
    ready.append(task)
    task.queued = True
    chosen, first = places[session.chance.randrange(len(places))], places[0]
    ready[first], ready[chosen] = ready[chosen], ready[first]
    scheduler.pause(task)
    if task.interrupts or task.ending is not None:
        scheduler.attend(task)
