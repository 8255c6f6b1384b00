"""Tasks, and the tree that owns them (ESL §4).

A task runs one body to its end and is itself an event, so others may wait for
it. Checkpoints are remembered; plain events are not (ESL §4.2). A body is any
callable: nothing here knows what a form is, nor whose turn it is.
"""

from __future__ import annotations

from itertools import islice

from eslang.base.control import EndTask, Stop
from eslang.base.failure import Failure
from eslang.base.hints import TYPE_CHECKING, Any, Callable, Iterable, Iterator
from eslang.base.many import primary, values_list
from eslang.base.symbols import Keyword, Value
from eslang.runtime.events import Event
from eslang.runtime.failures import Dynamic, Form

if TYPE_CHECKING:
    from eslang.runtime.events import Wait

READY, RUNNING, WAITING, SUCCEEDED, FAILED, ABORTED = map(
    Keyword, ("READY", "RUNNING", "WAITING", "SUCCEEDED", "FAILED", "ABORTED")
)
ANYWHERE = 10**9  # the level of an interrupt that cleanups do not hold off


class Extent:
    """What an interrupt belongs to, a form that a task is in; it comes only while the task is inside.

    A recovery procedure of a form farther out, which answers a failure inside,
    is not inside, although the form is not left yet: the interrupt waits until
    that is over (ESL §2.1: the scope of procedures).
    """

    __slots__ = ("answers", "forms", "level", "live")

    def __init__(self, dynamic: Dynamic) -> None:
        self.live = True
        self.level = dynamic.held  # a cleanup that runs around the form does not hold the interrupt off
        self.forms = dynamic.forms
        self.answers = len(dynamic.answering)

    def is_suspended(self, dynamic: Dynamic) -> bool:
        """True while a procedure of a form around it answers a failure."""
        return any(self.is_within(form) for _, form in dynamic.answering[self.answers :])

    def is_within(self, form: Form) -> bool:
        """True if it was entered inside FORM."""
        around = self.forms
        while around is not None and around is not form:
            around = around.outer
        return around is not None


class StandStill:
    """What the interrupt of a deadlock belongs to: the wait that a task is in. Nothing holds it off."""

    __slots__ = ("level", "task", "wait")

    def __init__(self, task: Task) -> None:
        self.level = ANYWHERE
        self.task = task
        self.wait = task.wait

    @property
    def live(self) -> bool:
        """True while the task is in that wait."""
        return self.wait is not None and self.task.wait is self.wait and not self.wait.done


class Interrupt:
    """Something that a task is to do where it stands, at its next step."""

    __slots__ = ("action", "at_waits", "by", "extent", "kind", "level", "urgent")

    def __init__(
        self,
        kind: str,
        action: Callable[[], object],
        extent: Extent | StandStill | None = None,
        *,
        level: int = 0,
        urgent: bool = False,
        at_waits: bool = False,
        by: Task | None = None,
    ) -> None:
        self.kind = kind  # "abort", "guardian", "deadline", …
        self.action = action
        self.extent = extent
        self.level = extent.level if extent is not None else level
        self.urgent = urgent  # WITHOUT-INTERRUPTS does not hold it off
        self.at_waits = at_waits  # it comes only when the task waits
        self.by = by  # the task it comes from, if any


class Task(Event):
    """One thread of execution: its place in the tree, its life so far, and what it has on its stack."""

    __slots__ = (
        "body",
        "checkpoints",
        "children",
        "daemon",
        "dynamic",
        "ending",
        "failure",
        "interrupts",
        "is_root",
        "kept",
        "obeying",
        "on_end",
        "over",
        "parent",
        "promises",
        "queued",
        "reached",
        "seen",
        "source",
        "spare",
        "stack",
        "status",
        "surroundings",
        "switch",
        "unseen",
        "values",
        "wait",
    )

    def __init__(self, name: str, body: Callable[[], Value], parent: Task | None) -> None:
        self.name: str = name
        self.waits = None
        self.body: Callable[[], Value] | None = body
        self.parent = parent
        self.children: dict[Task, None] | None = None  # those that it has spawned, while they live
        self.dynamic = Dynamic()
        self.stack: Any = None  # the greenlet, once it runs
        self.switch: Any = None  # goes on with that; None if only the driver can let it go on
        self.surroundings: Any = None  # the variables that Python code finds, once it has begun: a Context
        self.status: Keyword | None = None  # how it ended
        self.values: Value = None  # what it gave, all values
        self.failure: Failure | None = None  # what ended it
        self.seen = False  # somebody has looked at how it ended
        self.unseen: tuple[Task, ...] = ()  # those that it has spawned which failed while nobody looked
        self.queued = False  # among the ready
        self.wait: Wait | None = None  # the innermost
        self.spare: Wait | None = None  # one that is over, for an event: the next may use it again
        self.interrupts: list[Interrupt] | tuple[()] = ()
        self.obeying: tuple[Interrupt, ...] = ()  # those that are under way
        self.ending: EndTask | Stop | None = None  # it was aborted, or the run is to end
        self.daemon = False
        self.is_root = False  # entered from outside: what it spawns belongs to the run
        self.kept: tuple[Any, int] | None = None  # while others run: its bindings, its calls through C
        self.source: Any = None  # of the ticks of its loops
        self.checkpoints: dict[Any, Event] | None = None  # that somebody waits for
        self.reached: dict[Any, None] | None = None  # checkpoints that it has passed
        self.on_end: Callable[[Task], None] | None = None
        self.over: Event | None = None  # its last checkpoint, which no name has (ESL §4.2): its end
        self.promises: tuple[tuple[str, Value], ...] = ()  # what the text of its body signals

    def print_lisp(self, settings: Any) -> str:
        """How the printer shows it."""
        return f"#<TASK {self.name}>"

    @property
    def has_ended(self) -> bool:
        """True if nothing more will come of it."""
        return self.status is not None

    @property
    def value(self) -> Value:
        """Its first value; NIL if it did not succeed."""
        return primary(self.values)

    def given(self) -> tuple[Value, ...]:
        """All that it gave; nothing if it did not succeed."""
        return tuple(values_list(self.values)) if self.status is SUCCEEDED else ()

    def outcome(self) -> tuple[Value, ...] | None:
        """The same once it has ended; None before. Who asks has seen how it ended."""
        self.seen = True
        return self.given() if self.status is not None else None

    def ancestors(self) -> Iterator[Task]:
        """Those that it belongs to, itself first."""
        task: Task | None = self
        while task is not None:
            yield task
            task = task.parent

    def is_deep(self, depth: int) -> bool:
        """True if DEPTH others, or more, own one another down to it."""
        return next(islice(self.ancestors(), depth, None), None) is not None

    # --- interrupts ----------------------------------------------------------------

    def may_take(self, interrupt: Interrupt) -> bool:
        """True if INTERRUPT can reach it where it stands: nothing there holds it off."""
        dynamic, extent = self.dynamic, interrupt.extent
        if extent.__class__ is Extent and dynamic.answering and extent.is_suspended(dynamic):
            return False
        if interrupt.at_waits and self.wait is None:
            return False
        return dynamic.held <= interrupt.level and (not dynamic.masked or interrupt.urgent)

    def next_interrupt(self) -> Interrupt | None:
        """Take the first interrupt that can reach it now; those whose forms were left are dropped."""
        found: Interrupt | None = None
        left: list[Interrupt] = []
        for interrupt in self.interrupts:
            if interrupt.extent is not None and not interrupt.extent.live:
                continue
            if found is None and self.may_take(interrupt):
                found = interrupt
            else:
                left.append(interrupt)
        self.interrupts = left
        return found

    def may_end(self) -> bool:
        """True if it is to end, and nothing holds that off."""
        dynamic = self.dynamic
        return (
            self.ending is not None
            and not dynamic.held
            and (not dynamic.masked or self.ending.__class__ is not EndTask)
        )

    # --- checkpoints ---------------------------------------------------------------

    def has_reached(self, key: Any) -> bool:
        """True if it has passed the checkpoint KEY."""
        return self.reached is not None and key in self.reached

    def checkpoint_event(self, key: Any, name: Value) -> Event:
        """The event of the checkpoint KEY, for those who wait for it."""
        if self.checkpoints is None:
            self.checkpoints = {}
        event = self.checkpoints.get(key)
        if event is None:
            event = self.checkpoints[key] = Event(name)
        return event

    def reach(self, key: Any) -> Iterable[Wait]:
        """Record that it passes the checkpoint KEY; the waits that this ends."""
        if self.reached is None:
            self.reached = {}
        self.reached[key] = None
        event = self.checkpoints.pop(key, None) if self.checkpoints is not None else None
        return event.signal(()) if event is not None else []
