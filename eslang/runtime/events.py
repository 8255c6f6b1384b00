"""Events, and the waits for them (ESL §4.1).

An event does not record its signals: who waits when it is signalled is woken,
all at once, and who comes later waits for the next time. A wait may be for
several events, and leaves all of them when one has woken it. A test is asked
in the waiting task, so that it may fail, or wait, where it was written.
"""

from __future__ import annotations

from eslang.base.calls import spread
from eslang.base.hints import TYPE_CHECKING, Any, Callable, Iterable, Sequence
from eslang.base.symbols import Datum, Symbol, Value

if TYPE_CHECKING:
    from eslang.runtime.tasks import Task

Arguments = tuple[Value, ...]


class Event(Datum):
    """Something that tasks wait for until it is signalled."""

    __slots__ = ("name", "waits")

    def __init__(self, name: Value = None) -> None:
        self.name = name
        self.waits: Wait | dict[Wait, None] | None = None  # one alone, as most are, without a dict

    def print_lisp(self, settings: Any) -> str:
        """How the printer shows it."""
        return f"#<EVENT {self.name}>" if self.name is not None else "#<EVENT>"

    def outcome(self) -> Arguments | None:
        """What it has signalled for good; None unless it has ended, as tasks and goals do."""
        return None

    def signal(self, arguments: Arguments) -> Iterable[Wait]:
        """End all waits for this, each once; their tasks are to be made ready by the caller."""
        waits, self.waits = self.waits, None
        if waits is None:
            return ()
        ended = (waits,) if isinstance(waits, Wait) else waits
        for wait in ended:
            if wait.test is not None:
                wait.offers.append(arguments)
                self.expect(wait)
            else:
                wait.done = True
                wait.result = arguments
                if wait.several:
                    wait.withdraw()
        return ended

    def expect(self, wait: Wait) -> None:
        """Let WAIT be woken by the next signal."""
        waits = self.waits
        if waits is None:
            self.waits = wait
        elif isinstance(waits, Wait):
            self.waits = {waits: None, wait: None}
        else:
            waits[wait] = None

    def forget(self, wait: Wait) -> None:
        """Let no signal wake WAIT any more."""
        waits = self.waits
        if waits is wait:
            self.waits = None
        elif waits is not None and not isinstance(waits, Wait):
            waits.pop(wait, None)


class Wait:
    """One task's wait: what for, and whether it is over."""

    __slots__ = (
        "done",
        "events",
        "kind",
        "of",
        "offers",
        "outside",
        "plain",
        "polls",
        "reads",
        "result",
        "several",
        "task",
        "test",
    )
    advice = "let another task make the condition true, or give the wait a `:timeout`"

    def __init__(
        self,
        task: Task,
        kind: str,
        of: Any = None,
        events: Sequence[Event] = (),
        test: Callable[..., Value] | None = None,
    ) -> None:
        self.task = task
        self.kind = kind  # "events", "checkpoint", "sleep", …: a word for people and for traces
        self.of = of  # what belongs to the kind: the events, the checkpoint, the moment …
        self.events = events
        self.test = test
        self.done = False
        self.result: Any = None
        self.several = len(events) > 1
        self.plain = not self.several and test is None  # any signal of its event ends it, and that is all
        if test is not None:
            self.offers: list[Arguments] = []
            self.polls = True  # its condition may change at any step
            self.reads: Iterable[Symbol] = ()  # the relations of the facts that its condition rests on
            self.outside = False  # and reads what may change by itself
        for event in events:
            event.expect(self)

    def again(self, event: Event) -> None:
        """Let this, which is over, be a wait for EVENT: that is cheaper than a new one."""
        self.done = False
        self.of = self.events = (event,)
        if event.waits is None:
            event.waits = self
        else:
            event.expect(self)

    def end(self, result: Any) -> None:
        """It is over, with RESULT."""
        self.done = True
        self.result = result
        self.withdraw()

    @property
    def how(self) -> str:
        """How it ended, in a word."""
        if not self.done:
            return "left"
        return "timeout" if self.result is False else "came"

    def withdraw(self) -> None:
        """Let no event wake it any more."""
        for event in self.events:
            event.forget(self)

    def consider(self) -> bool:
        """Ask the test about the signals that came, in their order; true if one ends the wait."""
        while self.offers and not self.done:
            arguments = self.offers.pop(0)
            if self.test is not None and spread(self.test, arguments) is not None:
                self.end(arguments)
        return self.done
