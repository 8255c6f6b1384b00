"""What is known of property locks (ARM §4): who wants what, and how that stands.

A property that plans maintain has one lock. Its subscribers, in their order,
claim a value: nearly always the same, so a lock has one claim; values that are
not the same but can both hold, since one has variables, are claims of their
own. What a claim goes through is told in locks.py and maintenance.py.
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import Any, Callable, NamedTuple
from eslang.base.symbols import Value
from eslang.runtime.events import Wait
from eslang.runtime.tasks import Extent, Interrupt, Task

# --- how a claim stands
WANTED = "wanted"  # it was not achieved yet: the first of its subscribers is to do that
ACHIEVED = "achieved"
VIOLATED = "violated"  # it was achieved, and does not hold any more
RECOVERING = "recovering"  # the same, and a task is there to restore it


class Property(NamedTuple):
    """A property and the value that it is to have."""

    key: Any  # which property: what is the same for all its values; hashable
    value: Any  # hashable, too
    form: Value  # both, as a plan has them
    text: str  # as people see them; several are taken in the order of this


class Sight(NamedTuple):
    """What a look at a property has found."""

    holds: bool
    forget: Callable[[], None]  # ends the watch over what it rests on
    is_unsteady: bool = False  # it may change without a word: it rests on what cannot be watched


def nothing() -> None:
    """Do nothing."""


class Lock:
    """A property that somebody wants to have a value."""

    __slots__ = ("busy", "claims", "key", "subscriptions")

    def __init__(self, key: Any) -> None:
        self.key = key
        self.claims: list[Claim] = []
        self.subscriptions: dict[Subscription, None] = {}
        self.busy: Task | None = None  # who achieves, or restores, one of its claims

    @property
    def owner(self) -> Task | None:
        """The first of its subscribers."""
        first = next(iter(self.subscriptions), None)
        return None if first is None else first.task


class Claim:
    """A value that some subscribers of a lock want its property to have."""

    __slots__ = (
        "forget",
        "is_moot",
        "lock",
        "property",
        "recovery",
        "standing",
        "subscriptions",
        "violation",
    )

    def __init__(self, lock: Lock, wanted: Property) -> None:
        self.lock = lock
        self.property = wanted
        self.standing = WANTED
        self.subscriptions: dict[Subscription, None] = {}
        self.violation: Violation | None = None  # the last
        self.recovery: Task | None = None  # the task that restores it
        self.is_moot = False  # nobody was left who wanted that
        self.forget: Callable[[], None] = nothing  # ends the watch over it

    @property
    def first(self) -> Subscription | None:
        """The first of its subscriptions."""
        return next(iter(self.subscriptions), None)

    def persists(self) -> bool:
        """True if it has subscribers that are not on their way out of everything, or wait for it even so."""
        awaited = {} if self.violation is None else {wait.task: None for wait in self.violation.waits}
        return any(
            each.task.status is None
            and (each.task.ending is None or each.wait is not None or each.task in awaited)
            for each in self.subscriptions
        )


class Subscription:
    """That a task is inside a form that claims a property."""

    __slots__ = ("claim", "extent", "is_met", "is_over", "since", "task", "violation", "wait")

    def __init__(self, task: Task, claim: Claim, extent: Extent, since: float) -> None:
        self.task = task
        self.claim = claim
        self.extent = extent  # the form
        self.since = since
        self.is_met = False  # the property was achieved for it
        self.is_over = False  # it was released, or has failed
        self.wait: Wait | None = None  # until that is so
        self.violation: Violation | None = None  # the last one that concerns it


class Violation:
    """That a property which was achieved did not hold any more."""

    __slots__ = ("failure", "is_over", "sent", "told", "waits")

    def __init__(self) -> None:
        self.is_over = False
        self.failure: Callable[[], Failure] | None = (
            None  # makes what they fail with for whom it was not restored
        )
        self.sent: list[tuple[Task, Interrupt]] = []  # to the subscribers, until they had a turn to answer
        self.told: dict[Task, None] = {}  # who has failed because of it
        self.waits: dict[Wait, None] = {}  # for its end

    def unheard(self) -> bool:
        """True while a subscriber has not had a turn to hear of it, though it is ready for that."""
        self.sent = [
            (task, interrupt)
            for task, interrupt in self.sent
            if task.queued and interrupt in task.interrupts and task.may_take(interrupt)
        ]
        return bool(self.sent)


class Holding(NamedTuple):
    """One subscription, for people: what `:locks` shows."""

    lock: Value  # the property with the value that is claimed
    task: Task
    is_owner: bool
    waits: bool  # for the property to be achieved, or restored
    standing: str
    since: float  # when the task subscribed
