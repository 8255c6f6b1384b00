"""Waiting for a condition, and what wakes who waits.

While a condition is asked, an inquiry notes which facts it rests on. If that
is all it reads, its task sleeps until one of them changes; if it asks Lisp,
too, it is looked at again after each step (language reference §5).
"""

from __future__ import annotations

from eslang.base.hints import TYPE_CHECKING, Any, Callable
from eslang.base.lists import from_items
from eslang.base.running import running
from eslang.base.symbols import Symbol, T, Value
from eslang.constructs.queries import as_bound, in_force
from eslang.runtime.events import Wait
from eslang.runtime.polls import CONDITION

if TYPE_CHECKING:
    from eslang.facts.watching import Reads, Watch


class Inquiry:
    """What one asking of a condition read: facts, which are watched from then on, or Lisp, too."""

    __slots__ = ("asked_lisp", "bindings", "is_overtaken", "is_stale", "relations", "stir", "watches")

    def __init__(self, stir: Callable[[Any], object]) -> None:
        self.asked_lisp = False
        self.is_stale = False  # what it read has changed meanwhile
        self.is_overtaken = False  # facts have changed while it was answered
        self.bindings: dict[Symbol, Value] = {}  # under which the condition held
        self.relations: dict[Symbol, None] = {}
        self.watches: list[Watch] = []
        self.stir = stir

    @property
    def is_of_one_moment(self) -> bool:
        """Whether all facts that count were asked for at once; where Lisp is asked, too, there is no more."""
        return self.asked_lisp or len(self.watches) < 2

    def note(self, solution: dict[Symbol, Value] | None, reads: Reads) -> None:
        """A query had this SOLUTION, for which it read that."""
        from eslang.facts.watching import watch

        self.bindings.update(solution or {})
        self.relations.update(dict.fromkeys(name for name, _ in reads.relations()))
        self.is_overtaken = self.is_overtaken or reads.overtaken
        self.watches.append(watch(reads, self.stir))

    def call_within(self, body: Callable[[], Value]) -> Value:
        """What BODY gives under the bindings under which the condition held."""
        dynamic = running.session.dynamic
        outer = dynamic.logical
        dynamic.logical = outer.within(self.bindings)
        try:
            return body()
        finally:
            dynamic.logical = outer

    def end(self) -> None:
        """Watch no more."""
        if self.watches:
            from eslang.facts.watching import unwatch

            for each in self.watches:
                unwatch(each)
            self.watches.clear()


class Look:
    """One wait for a condition."""

    def __init__(self, condition: Value, test: Callable[[], Value]) -> None:
        self.test = test
        self.scheduler = running.session.scheduler
        self.waiting = Wait(self.scheduler.at_work(), CONDITION, as_bound(condition), (), self.holds)
        self.inquiry = Inquiry(self.stir)
        self.told: Any = None  # what was told of what it reads

    def wait(self, seconds: float | None) -> bool:
        """Wait until it holds, for so many SECONDS if that is told; false if it does not by then."""
        scheduler, timer = self.scheduler, None
        if seconds is not None:
            timer = scheduler.set_timer(seconds, lambda: scheduler.end_wait(self.waiting, False))
        try:
            return bool(scheduler.wait(self.waiting))
        finally:
            self.inquiry.end()
            scheduler.polls.forget(self.waiting)
            if timer is not None:
                scheduler.timers.call_off(timer)

    def holds(self) -> Value:
        """Ask the condition; again, if what it read has changed before it was answered."""
        dynamic = running.session.dynamic
        outer = dynamic.logical
        try:
            while True:
                self.inquiry.end()
                self.inquiry = Inquiry(self.stir)
                dynamic.logical = outer._replace(inquiry=self.inquiry)
                step = self.scheduler.steps
                value = self.test()
                inquiry = self.inquiry
                is_late = inquiry.is_overtaken and self.scheduler.steps != step  # it has waited
                if not (inquiry.is_stale or is_late) or (value is not None and inquiry.is_of_one_moment):
                    break
        finally:
            dynamic.logical = outer
        self.waiting.polls, self.waiting.reads = self.inquiry.asked_lisp, self.inquiry.relations
        if value is None and running.session.hooks.listeners:
            self.tell()
        return value

    def stir(self, change: object) -> None:
        """What the condition rests on has changed."""
        self.inquiry.is_stale = True
        self.scheduler.wake([self.waiting])

    def tell(self) -> None:
        """Tell what is waited for to change, unless that was told."""
        inquiry = self.inquiry
        reads = list(inquiry.relations), inquiry.asked_lisp
        if self.told != reads:
            self.told = reads
            relations, polls = from_items(list(inquiry.relations)), inquiry.asked_lisp
            self.scheduler.lives.tell("watch", of=self.waiting.of, relations=relations, polls=polls)


class Serving:
    """The solutions of a query that were served, and are solutions still."""

    def __init__(self) -> None:
        self.served: set[Any] = set()
        self.next: Any = None  # what the one is known by that is to be served now

    def look(self, query: Value) -> Value:
        """T if QUERY has a solution that was not served: the first is the next one. A Look asks it."""
        from eslang.facts.terms import code_of

        solutions, reads = running.session.database.ask_all(in_force(query))
        found = {tuple([(name, code_of(each[name])) for name in each]): each for each in solutions}
        self.served &= found.keys()
        self.next = next((key for key in found if key not in self.served), None)
        running.session.dynamic.logical.inquiry.note(found.get(self.next), reads)
        return None if self.next is None else T

    def serve(self, condition: Value, test: Callable[[], Value], body: Callable[[], Value]) -> Value:
        """Wait until there is a solution that was not served, which TEST asks; what BODY gives for it."""
        look = Look(condition, test)
        look.wait(None)
        self.served.add(self.next)
        return look.inquiry.call_within(body)
