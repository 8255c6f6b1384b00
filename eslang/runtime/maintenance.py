"""Maintenance: properties that were achieved are kept so (ARM §4, Automatic Recoveries).

What a property rests on is watched; a change that may concern it makes it
suspect. A daemon looks at what is suspect: there is one only while there is
something to do. When a property turns out to be violated, its subscribers fail
where they stand, and the daemon gives way to them. If any of them is still
there then, and is not leaving, a task tries to restore the property; so one
slow recovery holds up no other. While a lock is being recovered nobody else
achieves or recovers anything of it, and nobody gets it for another value.
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import Callable, Iterable
from eslang.base.symbols import Keyword, Value, truth
from eslang.runtime import failures
from eslang.runtime.attempts import attempt
from eslang.runtime.claims import (
    ACHIEVED,
    RECOVERING,
    VIOLATED,
    Claim,
    Property,
    Sight,
    Subscription,
    Violation,
    nothing,
)
from eslang.runtime.events import Wait
from eslang.runtime.lives import SPAWNED
from eslang.runtime.locks import PropertyLocks
from eslang.runtime.logical import NOTHING_BOUND
from eslang.runtime.polls import CONDITION
from eslang.runtime.scheduler import Scheduler
from eslang.runtime.tasks import Task

VIOLATION, UNRECOVERABLE = map(Keyword, ("MAINTAINED-PROPERTY-VIOLATION", "UNRECOVERABLE-PROPERTY-VIOLATION"))
Observe = Callable[[Property, Callable[[], None]], Sight]


class Maintenance:
    """Who sees to the properties that were achieved.

    `observe(property, changed)` looks at PROPERTY, and begins to watch it: CHANGED
    is called when it may be no longer so, at once if it may have changed while it
    was looked at. What is unsteady is looked at again after each step.
    """

    def __init__(self, locks: PropertyLocks, observe: Observe, recover: Callable[[Property], object]) -> None:
        self.locks = locks
        self.scheduler = locks.scheduler
        self.observe = observe
        self.recover = recover
        self.suspects: dict[Claim, None] = {}  # what may not be as it was when it was looked at
        self.unsteady: dict[Claim, None] = {}  # what may change without a word
        self.daemon: Task | None = None
        self.waiting: dict[Task, Claim] = {}  # who waits for which recovery

    # --- watching ----------------------------------------------------------------

    def begin(self, claim: Claim) -> None:
        """CLAIM was achieved: from now on it is maintained."""
        if not self.look(claim):
            self.suspect(claim)

    def end(self, claim: Claim) -> None:
        """CLAIM is not maintained any more."""
        self.suspects.pop(claim, None)
        self._forget(claim)
        if self.daemon is not None:
            self.scheduler.make_ready(self.daemon)  # there may be nothing left for it
        self._end_violation(claim.violation, None)

    def look(self, claim: Claim) -> bool:
        """True if the property of CLAIM holds now; it is watched from then on. A failure counts as no."""
        task = self.scheduler.at_work()
        self._forget(claim)
        seen: list[Sight] = []
        task.dynamic.masked += 1
        try:
            attempt(task, lambda: seen.append(self.observe(claim.property, lambda: self.suspect(claim))))
        finally:
            task.dynamic.masked -= 1
        if not seen:
            return False
        if not claim.subscriptions:
            seen[0].forget()
            return seen[0].holds
        self._forget(claim)
        claim.forget = seen[0].forget
        if seen[0].is_unsteady:
            self.unsteady[claim] = None
            self._rouse()
        return seen[0].holds

    def _forget(self, claim: Claim) -> None:
        """Watch over CLAIM no more."""
        self.unsteady.pop(claim, None)
        forget, claim.forget = claim.forget, nothing
        forget()

    def suspect(self, claim: Claim) -> None:
        """CLAIM may not be as it was: the daemon is to look."""
        self.suspects[claim] = None
        self._rouse()

    def _rouse(self) -> None:
        """There is something for the daemon to do."""
        if self.daemon is None or self.daemon.status is not None:
            self.daemon = self._start("maintain-properties", self._keep, self._daemon_ended)
        else:
            self.scheduler.make_ready(self.daemon)

    def _start(self, name: str, body: Callable[[], Value], on_end: Callable[[Task], None]) -> Task:
        """Start a task of the run that nobody waits for, and on which no task's bindings have a bearing."""
        lives = self.scheduler.lives
        task = lives.create(name, body, None, on_end)
        task.daemon = task.seen = True
        lives.start(task, SPAWNED)
        task.kept, task.dynamic.logical = None, NOTHING_BOUND
        return task

    # --- the daemon --------------------------------------------------------------

    def _keep(self) -> Value:
        """Look at what is suspect, until nothing is."""
        while self.suspects or self.unsteady:
            if not self.suspects:
                self._wait_for_suspects()
            suspects, self.suspects = self.suspects, {}
            try:
                self._see_to(suspects)
            except BaseException:
                left = [claim for claim in (*suspects, *self.suspects) if claim.subscriptions]
                self.suspects = dict.fromkeys(left)
                raise
        return None

    def _wait_for_suspects(self) -> None:
        """Look at what is unsteady after each step, until something is suspect."""
        wait = Wait(
            self.scheduler.at_work(), CONDITION, Keyword("MAINTAINED-PROPERTIES"), (), self._look_around
        )
        try:
            self.scheduler.wait(wait)
        finally:
            self.scheduler.polls.forget(wait)

    def _look_around(self) -> Value:
        """True if something is suspect, what is unsteady looked at; or if nothing is left to be looked at."""
        for claim in list(self.unsteady):
            if claim in self.unsteady and self.look(claim) is (claim.standing is VIOLATED):
                self.suspects[claim] = None
        return truth(bool(self.suspects) or not self.unsteady)

    def _see_to(self, suspects: Iterable[Claim]) -> None:
        """Look at each of SUSPECTS, once; have those restored that are violated and still wanted."""
        for claim in suspects:
            self._check(claim)
        violated = [claim for claim in suspects if claim.standing is VIOLATED and claim.subscriptions]
        self._give_way([claim.violation for claim in violated if claim.violation is not None])
        for claim in violated:
            if claim.standing is VIOLATED and claim not in self.suspects:
                self._start_recovery(claim)

    def _check(self, claim: Claim) -> None:
        """Look at CLAIM, if that is how it is to be found out what it has come to."""
        if not claim.subscriptions or claim.standing not in (ACHIEVED, VIOLATED):
            return
        holds = self.look(claim)
        if claim.standing is ACHIEVED and holds:
            self.locks.meet(claim)
        elif claim.standing is ACHIEVED:
            self.violate(claim)
        elif claim.standing is VIOLATED and holds:
            self.restore(claim)

    def _give_way(self, violations: list[Violation]) -> None:
        """Let all who fail because of VIOLATIONS have a turn first, to leave or to wait."""
        task = self.scheduler.at_work()
        while any(violation.unheard() for violation in violations):
            self.scheduler.yield_turn(task)

    def _daemon_ended(self, task: Task) -> None:
        """The daemon has ended; another begins if there is something left for it."""
        self.daemon = None
        if any(claim.persists() for claim in (*self.suspects, *self.unsteady)):
            self._rouse()

    # --- violations --------------------------------------------------------------

    def violate(self, claim: Claim) -> None:
        """CLAIM, which was achieved, does not hold any more: all for whom it did fail, where they stand."""
        claim.standing = VIOLATED
        violation = claim.violation = Violation()
        self.locks.announce("violated", claim, None)
        by_task: dict[Task, list[Subscription]] = {}
        for each in claim.subscriptions:
            if each.is_met:
                by_task.setdefault(each.task, []).insert(0, each)  # of one task, the innermost form first
        for subscriptions in by_task.values():
            for each in subscriptions:
                each.violation = violation
                interrupt = self.locks.interrupt(each, "violation", failing(each, violation))
                violation.sent.append((each.task, interrupt))

    def restore(self, claim: Claim) -> None:
        """CLAIM, which was violated, holds again: who waited for that goes on."""
        claim.standing = ACHIEVED
        self.locks.announce("recovered", claim, claim.recovery)
        self._end_violation(claim.violation, None)
        self.locks.meet(claim)

    def give_up(self, claim: Claim, failure: Failure | None) -> None:
        """CLAIM cannot be restored: all its subscribers fail, and are no subscribers any more."""
        make = self.locks.maker(UNRECOVERABLE, claim, failure, claim.recovery)
        violation, failed = claim.violation, list(claim.subscriptions)
        claim.standing = VIOLATED
        waiting = {wait.task for wait in violation.waits} if violation is not None else set()
        self.locks.announce("unrecoverable", claim, claim.recovery)
        for each in failed:
            self.locks.drop(each)
        self._end_violation(violation, make)
        for each in failed:
            if each.task not in waiting or each.violation is not violation:
                self.locks.fail(each, make())

    def _end_violation(self, violation: Violation | None, failure: Callable[[], Failure] | None) -> None:
        """VIOLATION is over: the property holds again, unless there is a FAILURE."""
        if violation is not None:
            violation.is_over, violation.failure = True, failure or violation.failure
            for wait in list(violation.waits):
                if wait.task.status is None:  # else it has gone with its thread
                    self.scheduler.end_wait(wait, None)

    # --- recovering --------------------------------------------------------------

    def _start_recovery(self, claim: Claim) -> None:
        """Let a task restore CLAIM, if anybody persists, and nobody is at work for its lock."""
        if claim.lock.busy is not None or not claim.persists():
            return
        self._forget(claim)
        claim.standing = RECOVERING
        claim.is_moot = False
        task = self._start("recovery", lambda: self._recover(claim), lambda task: self._recovery_ended(claim))
        claim.recovery = claim.lock.busy = task
        self.locks.announce("recovering", claim, task)

    def _recover(self, claim: Claim) -> Value:
        """Restore CLAIM, whose recovery the current task is."""
        failure = attempt(self.scheduler.at_work(), lambda: self.recover(claim.property))
        holds = self.look(claim)
        if claim.subscriptions:
            if holds:
                self.restore(claim)
            else:
                self.give_up(claim, failure)
        self._settle(claim)
        return None

    def _settle(self, claim: Claim) -> None:
        """Nobody is at work for the lock of CLAIM any more."""
        claim.lock.busy = claim.recovery = None
        if not claim.subscriptions:
            self.locks.remove(claim)
        self.locks.go_on(claim.lock)

    def _recovery_ended(self, claim: Claim) -> None:
        """The task that was to restore CLAIM has ended: whole, or it was aborted."""
        if claim.recovery is None:
            return
        if claim.is_moot:
            claim.standing = VIOLATED  # whoever came meanwhile has it tried again
        elif claim.subscriptions:
            self.give_up(claim, None)
        self._settle(claim)

    def call_off(self, claim: Claim) -> None:
        """Nobody is left who wants CLAIM to be restored."""
        claim.is_moot = True
        if claim.recovery is not None and claim.recovery.status is None:
            self.scheduler.lives.abort(claim.recovery, "recovery")
        else:  # it has gone with the thread that it lived in
            claim.recovery = None
            self.locks.remove(claim)

    # --- waiting for a recovery ----------------------------------------------------

    def wait_for_recovery(self, wanted: Property) -> None:
        """Wait until the violation of what is WANTED, which the current task was told of, is over.

        Not if those who are to restore it need the task itself, as where it achieves
        another value of the same property. Fails with :unrecoverable-property-violation
        if it was not restored.
        """
        task = self.scheduler.at_work()
        claim, violation = self._violation_of(task, wanted)
        if claim is None or violation is None:
            return
        if not violation.is_over and not self.holds_again(claim):
            self._wait(task, claim, violation)
        if violation.failure is not None:
            failures.signal(violation.failure(), continuable=True)

    def _wait(self, task: Task, claim: Claim, violation: Violation) -> None:
        """Let TASK wait until VIOLATION, one of CLAIM, is over."""
        busy = claim.lock.busy
        if busy is not None and self.locks.path(busy, task) is not None:
            return
        wait = Wait(task, "recovery", claim.property.form)
        if claim.standing is VIOLATED:
            self.suspect(claim)
        outer = self.waiting.get(task)
        violation.waits[wait], self.waiting[task] = None, claim
        try:
            self.scheduler.wait(wait)
        finally:
            del violation.waits[wait], self.waiting[task]
            if outer is not None:
                self.waiting[task] = outer

    def _violation_of(self, task: Task, wanted: Property) -> tuple[Claim | None, Violation | None]:
        """The last violation of what is WANTED: the one that concerns TASK, if any does."""
        for each in reversed(self.locks.subscriptions.get(task, ())):
            if each.violation is not None and is_same(each.claim.property, wanted):
                return each.claim, each.violation
        lock = self.locks.locks.get(wanted.key)
        for claim in lock.claims if lock is not None else ():
            if is_same(claim.property, wanted):
                return claim, claim.violation
        return None, None

    def holds_again(self, claim: Claim) -> bool:
        """True if CLAIM, which was achieved once, turns out to hold; it is restored, if it was violated."""
        if claim.standing is RECOVERING or not self.look(claim):
            return False
        if claim.standing is VIOLATED:
            self.restore(claim)
        return claim.standing is ACHIEVED


def failing(subscription: Subscription, violation: Violation) -> Callable[[], Value]:
    """What the task of SUBSCRIPTION does because of VIOLATION: it fails. Once, if it is over by then."""

    def fail() -> Value:
        if violation.is_over and subscription.task in violation.told:
            return None
        violation.told[subscription.task] = None
        failure = Failure(VIOLATION, subscription.claim.property.form)
        return failures.signal(failure, continuable=True)

    return fail


def is_same(one: Property, other: Property) -> bool:
    """True if both are the same property with the same value."""
    return bool(one.key == other.key and one.value == other.value)


def make_locks(
    scheduler: Scheduler,
    *,
    achieve: Callable[[Property], object],
    compatible: Callable[[Property, Property], bool],
    observe: Observe,
    recover: Callable[[Property], object],
) -> PropertyLocks:
    """Property locks whose properties are maintained."""
    locks = PropertyLocks(scheduler, achieve, compatible)
    locks.keeper = Maintenance(locks, observe, recover)
    return locks
