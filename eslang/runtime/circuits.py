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
from eslang.base.hints import TYPE_CHECKING, Any, Callable, Sequence
from eslang.base.lists import from_items, lisp_list
from eslang.base.running import running
from eslang.base.symbols import Keyword, Value
from eslang.runtime import failures
from eslang.runtime.arenas import Arena, take_turns
from eslang.runtime.attempts import outcome
from eslang.runtime.events import Wait
from eslang.runtime.tasks import Extent, Interrupt, Task

if TYPE_CHECKING:
    from eslang.runtime.logical import Logical


NEAREST = 50  # constructs of an active path that are told one by one
OUTER = Keyword("OUTER")
NEVER = -1
LEFT_BY = "deactivated"  # the kind of a wait for what leaves all that the task is in


class Level:
    """One entrance of a construct that is active while something holds."""

    __slots__ = (
        "arena",
        "call",
        "cleans",
        "closed",
        "extent",
        "holds",
        "is_stale",
        "leaving",
        "live",
        "logical",
        "outer",
        "polled",
        "polls",
        "settled",
        "task",
        "turns",
    )

    def __init__(self, task: Task, logical: Logical, holds: Callable[[], bool]) -> None:
        outer: Level | None = logical.circuit
        self.outer = outer
        self.task = task
        self.logical = logical  # what was in force around it
        self.holds = holds
        self.polls = False  # it is asked after every action
        self.is_stale = False  # what it rests on has changed
        self.settled = NEVER  # the number of changes at which it and all around it were looked at
        self.polled: Sequence[Level] = ()  # those of them that were polled then
        self.arena: Arena | None = None if outer is None else outer.arena  # where it acts beside others
        self.turns: Callable[[Any], bool] = take_turns if outer is None else outer.turns  # and how
        self.cleans: bool = outer is not None and outer.cleans  # it belongs to a cleanup
        self.live = True
        self.closed = False  # it is being left: nothing inside begins another action
        self.leaving: Callable[[], None] | None = None  # what its task does to leave it, or to fail
        self.extent = Extent(task.dynamic)
        self.call: Interrupt | None = None  # what lets its task ask, should it wait

    def open(self, turns: Callable[[Any], bool] | None = None) -> None:
        """What begins in it are branches, which take turns; those of an action only among themselves."""
        self.turns = turns or self.turns
        if self.arena is None or self.task.dynamic.masked:
            self.arena = Arena()

    def shield(self, bare: Logical) -> Level | None:
        """What stands around a cleanup in it: it holds always, and acts beside the same others."""
        if self.arena is None:
            return None
        level = Level(running.session.scheduler.at_work(), bare, lambda: True)
        level.arena, level.turns, level.cleans = self.arena, self.turns, True
        return level

    def stir(self, change: object = None) -> None:
        """What it rests on has changed: it is to be asked, at once if its task waits."""
        if self.is_stale or not self.live:
            return
        self.is_stale = True
        running.session.scheduler.stirs += 1
        self.call = Interrupt("circuit", ask_stale, self.extent, at_waits=True)
        scheduler, task = running.session.scheduler, self.task
        if scheduler.current is task:  # it may wait before the action has ended
            task.interrupts = [*task.interrupts, self.call]
        else:
            scheduler.interrupt(task, self.call)

    def settle(self) -> None:
        """It is asked now: nothing else has to have it asked."""
        self.is_stale = False
        call, self.call = self.call, None
        if call is not None and call in self.task.interrupts:
            self.task.interrupts = [each for each in self.task.interrupts if each is not call]

    def ask(self) -> None:
        """Leave all inside if it does not hold any more. A failure of the asking is the construct's."""
        session = running.session
        dynamic, task = session.dynamic, session.scheduler.at_work()
        is_mine = self.task is task
        if self.closed:
            if not is_mine:
                self.await_leaving()
            elif self.leaving is not None:
                self.leaving()
            return
        logical, forms = dynamic.logical, dynamic.forms
        self.settle()
        dynamic.logical = self.logical
        if is_mine:
            dynamic.forms = self.extent.forms
        try:
            holds = failures.guarded(self.holds) if is_mine else outcome(task, self.holds)
        finally:
            dynamic.logical, dynamic.forms = logical, forms
        if holds is not True:
            if is_mine:
                self.close()
                raise Deactivated(self)
            self.leave_from_inside(holds)

    def leave_from_inside(self, holds: Value) -> None:
        """Let its task leave it, or fail in it if HOLDS is no answer; that ends the one that is at work."""
        session = running.session

        def leave() -> None:
            if holds is False:
                raise Deactivated(self)
            session.dynamic.forms = self.extent.forms
            failures.signal(holds.failure, continuable=False)

        self.leaving = leave
        self.close()
        session.scheduler.interrupt(self.task, Interrupt("circuit", leave, self.extent))
        self.await_leaving()

    def close(self) -> None:
        """It is to be left: nothing inside goes on but cleanups, and this task."""
        self.closed = self.is_stale = True
        scheduler = running.session.scheduler
        scheduler.stirs += 1
        pending = list(self.task.children or ())
        while pending:
            task = pending.pop()
            pending += task.children or ()
            if task is not scheduler.current and self.is_around(task):
                scheduler.interrupt(task, Interrupt("circuit", self.await_leaving))

    def is_around(self, task: Task) -> bool:
        """True if TASK stands inside."""
        level: Level | None = task.dynamic.logical.circuit
        while level is not None and level is not self:
            level = level.outer
        return level is self

    def await_leaving(self) -> None:
        """Wait for its task, which is to leave it, and ends this one."""
        scheduler = running.session.scheduler
        scheduler.wait(Wait(scheduler.at_work(), LEFT_BY, self.task))

    def poll(self, polls: bool) -> None:
        """Whether it is to be asked after every action, from now on."""
        if polls and not self.polls:
            running.session.scheduler.stirs += 1
        self.polls = polls

    def end(self) -> None:
        """It is left."""
        self.live = self.extent.live = False


class Stage:
    """One construct that is under way: how far it is, and why it does that, for those who look on."""

    __slots__ = ("around", "condition", "depth", "number", "operator")

    def __init__(self, operator: Value, around: Stage | None, number: int = 1) -> None:
        self.operator = operator
        self.around = around
        self.depth: int = 1 if around is None else around.depth + 1
        self.number = number  # of the step that is under way
        self.condition: list[Value] = []  # the one for which it was chosen

    def path(self) -> list[Value]:
        """It and those around it, outermost first, each (OPERATOR NUMBER [CONDITION]).

        Beyond the nearest ones only how many there are is told, as (:OUTER NUMBER).
        """
        found: list[Value] = []
        stage: Stage | None = self
        while stage is not None:
            if len(found) == NEAREST:
                found.append(lisp_list(OUTER, stage.depth))
                break
            found.append(from_items([stage.operator, stage.number, *stage.condition]))
            stage = stage.around
        return found[::-1]


def stage_here() -> Stage:
    """The innermost construct that is under way."""
    stage: Stage = running.session.dynamic.logical.stage
    return stage


def begin_action(action: Value) -> Arena | None:
    """ACTION is about to begin: nothing may have changed since the levels were asked. Where it is done."""
    session = running.session
    dynamic = session.dynamic
    if dynamic.masked:
        return None
    level: Level | None = dynamic.logical.circuit
    arena = None
    if level is not None:
        arena = level.arena
        ask_all(level, polled=arena is not None and arena.admit(session, level.cleans))
    if session.hooks.listeners:
        stage: Stage | None = dynamic.logical.stage
        path = [] if stage is None else stage.path()
        session.scheduler.lives.tell("action", action=action, path=path)
    return arena


def tell_deactivated(why: str, condition: Value = None) -> None:
    """The innermost construct leaves what it does, or all of it."""
    session = running.session
    stage: Stage | None = session.dynamic.logical.stage
    if session.hooks.listeners and stage is not None:
        session.scheduler.lives.tell("deactivated", why=why, condition=condition, path=stage.path())


def end_of_action() -> None:
    """An atomic action has ended: ask the levels, and let another branch have its turn."""
    session = running.session
    dynamic = session.dynamic
    level: Level | None = dynamic.logical.circuit
    if level is None or dynamic.masked:
        return
    if level.arena is not None:
        level.arena.last = session.scheduler.at_work()
    ask_all(level, polled=True)
    if level.arena is not None and level.turns(session):
        ask_all(level, polled=True)  # others have acted


def ask_around() -> None:
    """Something has ended that is no action, but may have changed as much: ask the levels."""
    dynamic = running.session.dynamic
    if not dynamic.masked:
        ask_all(dynamic.logical.circuit, polled=True)


def ask_stale() -> None:
    """The task waits, and what it is in rests on something that has changed: ask the levels."""
    ask_all(running.session.dynamic.logical.circuit, polled=False)


def ask_all(level: Level | None, *, polled: bool) -> None:
    """Ask LEVEL and those around it, outermost first, if they can have changed."""
    if level is None:
        return
    stirs = running.session.scheduler.stirs
    if level.settled != stirs:
        asked: Sequence[Level] = look_at_all(level, polled)
    else:
        asked = level.polled if polled else ()
    for each in asked:
        each.ask()
    level.settled = stirs


def look_at_all(level: Level, polled: bool) -> list[Level]:
    """LEVEL and those around it that are to be asked, outermost first."""
    found, polls = [], []
    each: Level | None = level
    while each is not None:
        if each.polls:
            polls.append(each)
        if each.is_stale or (polled and each.polls):
            found.append(each)
        each = each.outer
    level.polled = tuple(reversed(polls))
    found.reverse()
    return found


def is_polled(level: Level | None) -> bool:
    """Whether LEVEL or one around it may change with any action."""
    while level is not None and not level.polls:
        level = level.outer
    return level is not None
