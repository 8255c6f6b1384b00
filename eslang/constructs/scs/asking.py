"""Asking conditions again and again, and running steps while they hold (SCS Appendix C).

A condition over facts is asked anew only when what it rests on has changed;
one that asks Lisp, once after each action.
"""

from __future__ import annotations

from eslang.base.control import Deactivated
from eslang.base.hints import TYPE_CHECKING, Callable, Iterable
from eslang.base.lists import Cons, items
from eslang.base.running import running
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.constructs.watching import Inquiry
from eslang.runtime import failures
from eslang.runtime.circuits import Level, Stage, ask_all, is_polled, tell_deactivated
from eslang.runtime.events import Wait
from eslang.runtime.polls import CONDITION

if TYPE_CHECKING:
    from eslang.runtime.logical import Logical

DEACTIVATED = Keyword("DEACTIVATED")  # what a step gives that neither succeeded nor failed
LEFT: Value = object()  # what a level gives whose conditions do not hold any more
Bindings = dict[Symbol, Value]


class Asked:
    """A condition, and the answer that it had."""

    __slots__ = ("condition", "inquiry", "is_stale", "negated", "owner", "test", "value")

    def __init__(self, condition: Value, test: Value, owner: Asker, negated: bool = False) -> None:
        self.condition = condition
        self.test = test
        self.owner = owner
        self.negated = negated
        self.inquiry = Inquiry(self.stir)
        self.is_stale = True
        self.value = False

    @property
    def polls(self) -> bool:
        """Whether its answer may change with any action."""
        return self.inquiry.asked_lisp

    @property
    def bindings(self) -> Bindings:
        """The variables under which it holds."""
        return {} if self.negated else self.inquiry.bindings

    def stir(self, change: object) -> None:
        """What it rests on has changed."""
        self.inquiry.is_stale = self.is_stale = True
        self.owner.stir()

    def holds(self) -> bool:
        """Whether it holds now; it is asked only if that can have changed."""
        if self.is_stale or self.inquiry.asked_lisp:
            self._ask()
        return self.value

    def _ask(self) -> None:
        dynamic = running.session.dynamic
        outer = dynamic.logical
        if self.test.__class__ is Cons:  # what stands under backquotes in it is computed once
            self.test = self.test.car()
        try:
            while self.is_stale or self.inquiry.asked_lisp:
                self.inquiry.end()
                self.inquiry = Inquiry(self.stir)
                dynamic.logical = outer._replace(inquiry=self.inquiry)
                self.is_stale = False
                self.value = (failures.guarded(self.test) is None) is self.negated
                if not self.is_stale:
                    break
        finally:
            dynamic.logical = outer


class Idling(Wait):
    """A wait until a choice has a condition that holds."""

    __slots__ = ()
    advice = "let another task make the condition true, or give the choice a clause `(t …)`"


class Asker:
    """One entrance of a construct that has conditions."""

    __slots__ = ("conditions", "level", "task", "wait")

    def __init__(self) -> None:
        self.conditions: list[Asked] = []
        self.level: Level | None = None
        self.wait: Wait | None = None
        self.task = running.session.scheduler.at_work()

    def ask(self, condition: Value, test: Value, negated: bool = False) -> Asked:
        """Take a condition, which is not asked yet; TEST is a function, or the list of what gives one."""
        asked = Asked(condition, test, self, negated)
        self.conditions.append(asked)
        return asked

    def stir(self) -> None:
        """What one of the conditions rests on has changed."""
        if self.level is not None:
            self.level.stir()
        if self.wait is not None:
            running.session.scheduler.wake([self.wait])

    def run(
        self, on: list[Asked], holds: Callable[[], bool], bindings: Bindings, body: Callable[[], Value]
    ) -> Value:
        """What BODY gives as long as HOLDS, which asks ON, is true; LEFT if that ends."""
        dynamic = running.session.dynamic
        outer = dynamic.logical

        def still() -> bool:
            answer = holds()
            level.poll(any(each.polls for each in on))
            return answer

        level = self.level = Level(self.task, outer, still)
        level.polls = any(each.polls for each in on)
        dynamic.logical = outer.within(bindings)._replace(circuit=level)
        try:
            return failures.guarded(body)
        except Deactivated as jump:
            if jump.target is not level:
                raise
            return LEFT
        finally:
            level.end()
            self.level = None
            back_to(outer)

    def idle(self, of: Value, among: Iterable[Asked], kind: type[Wait] = Idling) -> None:
        """Wait until one of the conditions AMONG holds; the wait is of a KIND with its own advice."""
        listed = list(among)

        def any_holds() -> Value:
            around = running.session.dynamic.logical.circuit
            ask_all(around, polled=True)
            found = [each for each in listed if each.holds()]
            wait.polls = is_polled(around) or any(each.polls for each in listed)
            wait.reads = dict.fromkeys(name for each in listed for name in each.inquiry.relations)
            return found or None

        wait = self.wait = kind(self.task, CONDITION, of, (), any_holds)
        scheduler = running.session.scheduler
        try:
            scheduler.wait(wait)
        finally:
            scheduler.polls.forget(wait)
            self.wait = None

    def end(self) -> None:
        """Watch no more."""
        for each in self.conditions:
            each.inquiry.end()


def run_under(operator: Value, modifiers: Value, body: Callable[[], Value]) -> Value:
    """What BODY of the construct OPERATOR gives under MODIFIERS; DEACTIVATED if one does not hold."""
    dynamic = running.session.dynamic
    outer = dynamic.logical
    dynamic.logical = outer.entered(Stage(operator, outer.stage))
    try:
        return body() if modifiers is None else _run_modified(modifiers, body)
    finally:
        back_to(outer)


def back_to(outer: Logical) -> None:
    """What was in force before is so again; but the last choice that could be reinforced stays known."""
    dynamic = running.session.dynamic
    learned = dynamic.logical.learned
    dynamic.logical = outer if learned is outer.learned else outer._replace(learned=learned)


def _run_modified(modifiers: Value, body: Callable[[], Value]) -> Value:
    asker = Asker()
    dynamic = running.session.dynamic
    outer = dynamic.logical
    lasting: list[tuple[str, Asked]] = []
    try:
        bindings: Bindings = {}
        for kind, condition, test in map(items, items(modifiers)):
            asked = asker.ask(condition, test, kind.name in ("UNTIL", "UNLESS"))
            dynamic.logical = outer.within(bindings)
            if not asked.holds():
                tell_deactivated(kind.name.lower(), condition)
                return DEACTIVATED
            bindings.update(asked.bindings)
            if kind.name in ("WHILE", "UNTIL"):
                lasting.append((kind.name, asked))
            else:
                asked.inquiry.end()
        dynamic.logical = outer.within(bindings)
        if not lasting:
            return body()
        on = [asked for _, asked in lasting]
        value = asker.run(on, lambda: all(each.holds() for each in on), bindings, body)
        if value is not LEFT:
            return value
        back_to(outer)
        kind, ended = next(each for each in lasting if not each[1].value)
        tell_deactivated(kind.lower(), ended.condition)
        return DEACTIVATED
    finally:
        asker.end()
