"""Resources: of which there is so much, and tasks hold parts (ARM §3 names the need, and leaves it out).

A renewable resource comes back when its holder leaves; a consumable one is
used up. Who asks for more than is left waits in line: the more important
before the less, and otherwise first come, first served; nobody overtakes.
Holders that are less important than whoever waits first are interrupted, if
that is of use: they fail where they stand, and give back when they have left.
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import TYPE_CHECKING, Callable
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.runtime import failures
from eslang.runtime.events import Event, Wait
from eslang.runtime.tasks import Extent, Interrupt, Task

if TYPE_CHECKING:
    from eslang.runtime.scheduler import Scheduler

EXHAUSTED, PREEMPTED = Keyword("RESOURCE-EXHAUSTED"), Keyword("RESOURCE-PREEMPTED")


class Holding:
    """What one task has of a resource, or waits for."""

    __slots__ = ("amount", "came", "extent", "is_granted", "is_preempted", "priority", "task")

    def __init__(self, task: Task, amount: Value, priority: Value) -> None:
        self.task = task
        self.amount = amount
        self.priority = priority
        self.extent = Extent(task.dynamic)
        self.came = Event(None)  # it is granted
        self.is_granted = False
        self.is_preempted = False  # its task was told to leave


class Resource:
    """One resource: how much there is, who holds of it, who waits."""

    __slots__ = ("capacity", "holdings", "is_consumable", "left", "line", "name")

    def __init__(self, name: Symbol, capacity: Value, is_consumable: bool) -> None:
        self.name = name
        self.capacity = capacity
        self.is_consumable = is_consumable
        self.left = capacity
        self.holdings: list[Holding] = []  # in the order in which they were granted
        self.line: list[Holding] = []  # who waits, the first in front

    def print_lisp(self, settings: object) -> str:
        """How the printer shows it."""
        return f"#<RESOURCE {self.name} {self.left} of {self.capacity}>"

    # --- holding -------------------------------------------------------------------

    def hold(
        self, scheduler: Scheduler, amount: Value, priority: Value, waits: bool, body: Callable[[], Value]
    ) -> Value:
        """What BODY gives while the current task holds AMOUNT; that is waited for, if it WAITS.

        Fails with :resource-exhausted if there cannot be so much, or is not and it does not wait.
        """
        holding = Holding(scheduler.at_work(), amount, priority)
        if amount > self.capacity or (self.is_consumable and amount > self.left):
            return self._refuse(scheduler, holding)
        self._stand_in_line(holding)
        if not waits and (self.line[0] is not holding or amount > self.left):
            self.line.remove(holding)
            return self._refuse(scheduler, holding)
        try:
            self.grant(scheduler)
            if not holding.is_granted:
                scheduler.wait(Wait(holding.task, "resource", (self.name, amount), (holding.came,)))
            return failures.guarded(body)
        finally:
            self._let_go(scheduler, holding)

    def _refuse(self, scheduler: Scheduler, holding: Holding) -> Value:
        self._tell(scheduler, "refused", holding)
        return failures.signal(Failure(EXHAUSTED, self.name, holding.amount, self.left), continuable=True)

    def _tell(self, scheduler: Scheduler, change: str, holding: Holding) -> None:
        """Tell what becomes of HOLDING."""
        amount, of = holding.amount, holding.task
        scheduler.lives.tell(
            "resource", change=change, resource=self.name, amount=amount, of=of, left=self.left
        )

    def _stand_in_line(self, holding: Holding) -> None:
        """Let HOLDING wait behind all that are as important, and before the others."""
        place = len(self.line)
        while place and self.line[place - 1].priority < holding.priority:
            place -= 1
        self.line.insert(place, holding)

    def _let_go(self, scheduler: Scheduler, holding: Holding) -> None:
        """HOLDING is over, granted or not."""
        holding.extent.live = False
        if holding.is_granted:
            self.holdings.remove(holding)
            if not self.is_consumable:
                self.left += holding.amount
            self._tell(scheduler, "released", holding)
        elif holding in self.line:
            self.line.remove(holding)
        self.grant(scheduler)

    def grant(self, scheduler: Scheduler) -> None:
        """Give to those in front of the line what they wait for, as far as it goes; then make room."""
        while self.line and self.line[0].amount <= self.left:
            first = self.line.pop(0)
            self.left -= first.amount
            self.holdings.append(first)
            first.is_granted = True
            self._tell(scheduler, "granted", first)
            scheduler.signal(first.came, ())
        if self.line:
            self._make_room(scheduler, self.line[0])

    def _make_room(self, scheduler: Scheduler, first: Holding) -> None:
        """Interrupt who is less important than FIRST, the least and the latest first, if that is enough."""
        if self.is_consumable:
            return
        leaving = sum([each.amount for each in self.holdings if each.is_preempted])
        missing = first.amount - self.left - leaving
        spared = set(first.task.ancestors())  # who would end FIRST with itself
        less = [
            each
            for each in self.holdings
            if each.priority < first.priority and not each.is_preempted and each.task not in spared
        ]
        less.reverse()  # of equals the latest first
        chosen: list[Holding] = []
        for each in sorted(less, key=lambda holding: holding.priority):
            if missing <= 0:
                break
            chosen.append(each)
            missing -= each.amount
        if missing > 0:
            return
        for each in chosen:
            self._preempt(scheduler, each, first)

    def _preempt(self, scheduler: Scheduler, holding: Holding, first: Holding) -> None:
        """Let the task of HOLDING fail where it stands, since FIRST needs what it has."""
        holding.is_preempted = True
        self._tell(scheduler, "preempted", holding)

        def fail() -> None:
            if first in self.line:  # it has not given up meanwhile
                failures.signal(Failure(PREEMPTED, self.name, first.task), continuable=True)
            else:
                holding.is_preempted = False

        interrupt = Interrupt("resource", fail, holding.extent, by=first.task)
        scheduler.interrupt(holding.task, interrupt)

    # --- consuming -----------------------------------------------------------------

    def use_up(self, amount: Value) -> Value:
        """Take AMOUNT for good. Fails with :resource-exhausted if there is not so much."""
        if amount > self.left:
            return failures.signal(Failure(EXHAUSTED, self.name, amount, self.left), continuable=True)
        self.left -= amount
        return self.left

    def fill_up(self, scheduler: Scheduler, amount: Value) -> Value:
        """Let there be AMOUNT more, up to the capacity; how much there is then."""
        self.left = min(self.capacity, self.left + amount)
        self.grant(scheduler)
        return self.left
