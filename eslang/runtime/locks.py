"""Property locks (ARM §4): tasks say which properties they need, and do not fight over them.

A task that wants a property to have a value subscribes to its lock; that fails
if another wants a value that cannot hold together with this one. The first
subscriber is the owner, and achieves the property, for all; the others wait.
When it leaves before that, the next one does it. From then on the property is
maintained (maintenance.py): when it is violated, all subscribers fail, where
they stand. Which tasks there are, and what they do, is known here; what a
property is, and how it is achieved, is not.
"""

from __future__ import annotations

from eslang.base.failure import Failure, control_error
from eslang.base.hints import TYPE_CHECKING, Any, Callable, Iterable, Sequence
from eslang.base.lists import lisp_list
from eslang.base.shown import shown
from eslang.base.stack import require_room
from eslang.base.symbols import Keyword, Value
from eslang.base.text import String
from eslang.runtime import failures
from eslang.runtime.attempts import attempt
from eslang.runtime.claims import (
    ACHIEVED,
    RECOVERING,
    VIOLATED,
    WANTED,
    Claim,
    Holding,
    Lock,
    Property,
    Subscription,
)
from eslang.runtime.deadlock import DEADLOCK, awaited
from eslang.runtime.events import Wait
from eslang.runtime.tasks import Extent, Interrupt, Task

if TYPE_CHECKING:
    from eslang.runtime.maintenance import Maintenance
    from eslang.runtime.scheduler import Scheduler

UNAVAILABLE, NOT_ACHIEVED = map(Keyword, ("PROPERTY-LOCK-UNAVAILABLE", "CONDITION-NOT-ACHIEVED"))
ENDS = ("end", "tasks", "leaving")  # the kinds of waits for the ends of tasks


class PropertyLocks:
    """The property locks of one interpreter."""

    def __init__(
        self,
        scheduler: Scheduler,
        achieve: Callable[[Property], object],
        compatible: Callable[[Property, Property], bool],
    ) -> None:
        self.scheduler = scheduler
        self.achieve = achieve
        self.compatible = compatible  # can two values of one property hold together?
        self.locks: dict[Any, Lock] = {}
        self.subscriptions: dict[Task, list[Subscription]] = {}
        self.keeper: Maintenance  # who sees to what was achieved

    def maintain(self, properties: Sequence[Property], body: Callable[[], Value]) -> Value:
        """Run BODY while the current task is subscribed to the locks of PROPERTIES, which were achieved."""
        require_room()
        task = self.scheduler.at_work()
        taken: list[Subscription] = []
        try:
            self._subscribe(task, properties, taken)
            for subscription in taken:
                self._await_achievement(subscription)
            return failures.guarded(body)
        finally:
            self.release(taken)

    # --- subscribing -------------------------------------------------------------

    def _subscribe(self, task: Task, properties: Sequence[Property], taken: list[Subscription]) -> None:
        """Let TASK snarf the locks of PROPERTIES, all at once; they are TAKEN then.

        Fails with :property-lock-unavailable while it holds none of them; if a recovery
        procedure for that runs off its end, the others are taken.
        """
        wanted = list(properties)
        while (found := self._obstacle(task, wanted)) is not None:
            index, obstacle, holder = found
            failure = Failure(UNAVAILABLE, wanted.pop(index).form, obstacle.form, holder)
            failures.signal(failure, continuable=True)
        extent = Extent(task.dynamic)
        snarfed = {
            index: self._snarf(task, wanted[index], extent)
            for index in sorted(range(len(wanted)), key=lambda index: wanted[index].text)
        }
        taken += [snarfed[index] for index in range(len(wanted))]
        for subscription in snarfed.values():
            self.announce("subscribed", subscription.claim, task)

    def _obstacle(self, task: Task, wanted: list[Property]) -> tuple[int, Property, Task | None] | None:
        """The index of one of those WANTED by TASK that cannot be had, why, and who has that."""
        for index, one in enumerate(wanted):
            for claim in self._claims_now(one.key):
                if not self.compatible(one, claim.property):
                    return index, claim.property, claim.first.task if claim.first else claim.recovery
            for other in wanted[:index]:
                if other.key == one.key and not self.compatible(one, other):
                    return index, other, task
        return None

    def _claims_now(self, key: Any) -> list[Claim]:
        """The claims of the lock KEY, without those of tasks that have gone with the thread they lived in."""
        lock = self.locks.get(key)
        if lock is None:
            return []
        if lock.busy is not None and lock.busy.status is not None:
            lock.busy = None
        self.release([each for each in lock.subscriptions if each.task.status is not None])
        return lock.claims

    def _snarf(self, task: Task, wanted: Property, extent: Extent) -> Subscription:
        """A subscription of TASK, inside EXTENT, to the lock of what is WANTED."""
        now = self.now()
        lock = self.locks.get(wanted.key)
        if lock is None:
            lock = self.locks[wanted.key] = Lock(wanted.key)
        claim = next((each for each in lock.claims if each.property.value == wanted.value), None)
        if claim is None:
            claim = Claim(lock, wanted)
            lock.claims.append(claim)
        subscription = Subscription(task, claim, extent, now)
        subscription.is_met = claim.standing is ACHIEVED and claim not in self.keeper.suspects
        lock.subscriptions[subscription] = claim.subscriptions[subscription] = None
        self.subscriptions.setdefault(task, []).append(subscription)
        return subscription

    # --- achieving ---------------------------------------------------------------

    def _await_achievement(self, subscription: Subscription) -> None:
        """Let the property be achieved by its turn, or restored; a failure of that is signalled."""
        claim, task = subscription.claim, subscription.task
        lock = claim.lock
        while not (subscription.is_met or subscription.is_over):
            if lock.busy is task:
                raise control_error(f"what achieves {claim.property.text} needs it")
            if claim.standing is WANTED:
                if lock.busy is None and self._is_to_achieve(subscription):
                    self._bring_about(subscription)
                    continue
            elif self.keeper.holds_again(claim):
                subscription.is_met = claim.standing is ACHIEVED
                continue
            failure = self._wait(subscription)
            if failure is not None:
                failures.signal(failure, continuable=True)

    def _wait(self, subscription: Subscription) -> Failure | None:
        """Wait until something has become of the claim; the failure, if that is what came."""
        claim = subscription.claim
        if claim.standing is VIOLATED:
            self.keeper.suspect(claim)
        subscription.wait = wait = Wait(subscription.task, "achievement", claim.property.form)
        try:
            self._open_circle(subscription)
            failure: Failure | None = self.scheduler.wait(wait)
            return failure
        finally:
            subscription.wait = None

    def _bring_about(self, subscription: Subscription) -> None:
        """Let the task of SUBSCRIPTION achieve the property; all that wait for it hear how that went."""
        claim, task = subscription.claim, subscription.task
        claim.lock.busy = task
        self.announce("achieving", claim, task)
        try:
            failure = attempt(task, lambda: self.achieve(claim.property))
        finally:
            claim.lock.busy = None
        if failure is None:
            claim.standing = ACHIEVED
            self.announce("achieved", claim, task)
            self.meet(claim)
            self.keeper.begin(claim)
            self.go_on(claim.lock)
        else:
            self._give_in(subscription, failure)

    def meet(self, claim: Claim) -> None:
        """The property holds: its subscribers go on."""
        for each in claim.subscriptions:
            each.is_met = True
            if each.wait is not None:
                self.scheduler.end_wait(each.wait, None)

    def _give_in(self, subscription: Subscription, failure: Failure) -> None:
        """The property of SUBSCRIPTION cannot be achieved: all that wait for its lock fail."""
        claim = subscription.claim
        lock, make = claim.lock, self.maker(NOT_ACHIEVED, claim, failure, subscription.task)
        failing = [each for each in lock.subscriptions if each.claim.standing is WANTED]
        for each in failing:
            self.drop(each)
        self.announce("not-achieved", claim, subscription.task)
        for each in failing:
            if each is not subscription:
                self.fail(each, make())
        self.go_on(lock)
        own = make()
        own.origin = None  # it comes from this very task
        failures.signal(own, continuable=True)

    def maker(
        self, cause: Keyword, claim: Claim, failure: Failure | None, origin: Task | None
    ) -> Callable[[], Failure]:
        """What makes a failure for each subscriber of CLAIM, which FAILURE, one of ORIGIN, has led to."""
        form = claim.property.form
        arguments: list[Value] = [form]
        if failure is not None and not (
            failure.cause is cause and [shown(each) for each in failure.arguments] == [shown(form)]
        ):
            arguments += [failure.cause, *failure.arguments]

        def make() -> Failure:
            made = Failure(cause, *arguments)
            made.origin, made.__cause__ = origin, failure
            return made

        return make

    def fail(self, subscription: Subscription, failure: Failure) -> None:
        """Let the task of SUBSCRIPTION fail where it stands."""
        if subscription.wait is not None:
            self.scheduler.end_wait(subscription.wait, failure)
        else:
            self.interrupt(subscription, "lock", lambda: failures.signal(failure, continuable=True))

    def interrupt(self, subscription: Subscription, why: str, action: Callable[[], Value]) -> Interrupt:
        """Let the task of SUBSCRIPTION do ACTION where it stands, while it is inside."""
        interrupt = Interrupt(why, action, subscription.extent)
        self.scheduler.interrupt(subscription.task, interrupt)
        return interrupt

    # --- releasing ---------------------------------------------------------------

    def release(self, taken: Iterable[Subscription]) -> None:
        """End the subscriptions that were TAKEN; who comes next goes on. Nothing waits here."""
        released = []
        locks: dict[Lock, Task | None] = {}
        for each in taken:
            each.extent.live = False
            mine = self.subscriptions[each.task]
            mine.remove(each)
            if not mine:
                del self.subscriptions[each.task]
            if not each.is_over:
                released.append(each)
                locks.setdefault(each.claim.lock, each.claim.lock.owner)
                self.drop(each)
        for lock in locks:
            self.go_on(lock)
        for each in released:
            self.announce("released", each.claim, each.task)
        for lock, owner in locks.items():
            if lock.owner is not owner and lock.owner is not None:
                self.announce("owned", next(iter(lock.subscriptions)).claim, lock.owner)

    def drop(self, subscription: Subscription) -> None:
        """SUBSCRIPTION counts no more."""
        claim = subscription.claim
        subscription.is_over = True
        del claim.subscriptions[subscription], claim.lock.subscriptions[subscription]
        if claim.subscriptions:
            return
        if claim.standing is RECOVERING:
            self.keeper.call_off(claim)
        else:
            self.remove(claim)

    def remove(self, claim: Claim) -> None:
        """Nobody wants CLAIM any more."""
        lock = claim.lock
        if claim in lock.claims:
            lock.claims.remove(claim)
            self.keeper.end(claim)
            if not lock.claims:
                del self.locks[lock.key]

    def go_on(self, lock: Lock) -> None:
        """If nobody is at work for LOCK, let who is to achieve or restore something begin."""
        if lock.busy is not None:
            return
        for claim in lock.claims:
            if claim.standing is VIOLATED:
                self.keeper.suspect(claim)
            elif claim.standing is WANTED:
                for each in claim.subscriptions:
                    if each.wait is not None and self._is_to_achieve(each):
                        self.scheduler.end_wait(each.wait, None)
                        return

    # --- circles -----------------------------------------------------------------

    def _is_to_achieve(self, subscription: Subscription) -> bool:
        """True if it is for SUBSCRIPTION to achieve its claim: it is the first, or the first waits for it."""
        first = subscription.claim.first
        return first is not None and self.path(first.task, subscription.task) is not None

    def _open_circle(self, subscription: Subscription) -> None:
        """If those for whom SUBSCRIPTION is to wait wait for it, let one of them achieve what it waits for.

        Fails with :deadlock if none can, since others are at work for all that: methods need one another.
        """
        claim = subscription.claim
        task = claim.lock.busy
        path = None if task is None else self.path(task, subscription.task)
        if path is None:
            return
        for each in path:
            if each.claim.lock.busy is None and each.claim.standing is WANTED and each.wait is not None:
                self.scheduler.end_wait(each.wait, None)
                return
        raise Failure(DEADLOCK, *[waiting(each) for each in (subscription, *path)])

    def path(self, task: Task, goal: Task, seen: dict[Task, None] | None = None) -> list[Subscription] | None:
        """The subscriptions by way of which TASK waits for GOAL; None if it does not."""
        seen = {} if seen is None else seen
        if task is goal:
            return []
        wait = task.wait
        if task in seen or wait is None or wait.done:
            return None
        seen[task] = None
        own = next((each for each in self.subscriptions.get(task, ()) if each.wait is wait), None)
        claim = self.keeper.waiting.get(task) if own is None else own.claim
        for other in ends(wait) if claim is None else awaited_for(claim):
            path = self.path(other, goal, seen)
            if path is not None:
                return path if own is None else [own, *path]
        return None

    # --- for those who look ------------------------------------------------------

    def holdings(self) -> list[Holding]:
        """All subscriptions: by lock, in their order."""
        return [
            Holding(
                each.claim.property.form,
                each.task,
                each.task is lock.owner,
                not each.is_met,
                each.claim.standing,
                each.since,
            )
            for lock in self.locks.values()
            for each in lock.subscriptions
            if each.task.status is None  # else it has gone with its thread
        ]

    def now(self) -> float:
        """The time on the clock."""
        now: float = self.scheduler.session.clock.now()
        return now

    def announce(self, change: str, claim: Claim, task: Task | None) -> None:
        """Tell that CLAIM is changed, by a subscription of TASK, or what TASK does for it."""
        self.scheduler.lives.tell(
            "lock", change=change, property=claim.property.form, of=task, owner=claim.lock.owner
        )


def awaited_for(claim: Claim) -> list[Task]:
    """Who is to act before anybody else can go on with CLAIM."""
    if claim.lock.busy is not None:
        return [claim.lock.busy]
    return [claim.first.task] if claim.first is not None and claim.standing is WANTED else []


def ends(wait: Wait) -> list[Task]:
    """The tasks for whose ends WAIT is, those that are still to come."""
    return awaited(wait) if wait.kind in ENDS else []


def waiting(subscription: Subscription) -> Value:
    """A task and what it waits for, as the arguments of :deadlock have them."""
    what = f"{subscription.claim.property.text} to be achieved"
    return lisp_list(String(subscription.task.name), String(what))
