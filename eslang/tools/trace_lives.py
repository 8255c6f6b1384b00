"""The tasks of a trace: their tree, what each was doing when, and who acted on whom."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from eslang.tools.trace_reading import Record, Trace
from eslang.tools.trace_words import sentence

RUN, WAIT, SLEEP, RECOVER, CLEANUP, INTERRUPT = "run", "wait", "sleep", "recover", "cleanup", "interrupt"
BEGINS = {"recovery": RECOVER, "cleanup-started": CLEANUP, "interrupt": INTERRUPT}
ENDS = {"recovery-ended": RECOVER, "cleanup-ended": CLEANUP, "interrupt-ended": INTERRUPT}
SLEEPS = ("sleep", "period")


class Span(NamedTuple):
    """What a task was doing from one event to another."""

    state: str
    first: int  # numbers of records
    last: int
    cause: int  # the record that says what it is about; -1 for none


class Arrow(NamedTuple):
    """One task acted on another."""

    kind: str  # start, signal, abort, interrupt, failure, join
    source: str
    first: int
    target: str
    last: int


@dataclass
class Life:
    """What is known of one task."""

    name: str
    parent: str | None = None
    role: str = "main"
    daemon: bool = False
    started: int = 0
    ended: int | None = None
    status: str | None = None
    failure: dict[str, Any] | None = None
    place: str | None = None  # where it failed
    aborted: int | None = None  # the record that says by whom
    children: list[Life] = field(default_factory=list)
    spans: list[Span] = field(default_factory=list)
    layers: list[tuple[str, int]] = field(default_factory=list)  # what it is doing within what
    since: int = 0  # when the innermost of them began, or was come back to


class Lives:
    """All tasks of a trace, and the arrows between them."""

    def __init__(self, trace: Trace) -> None:
        self.trace = trace
        self.lives: dict[str, Life] = {}
        self.arrows: list[Arrow] = []
        self._woken: dict[str, tuple[str, str, int]] = {}  # who is to go on: (kind, by whom, since when)
        self._reads: dict[
            str, list[str]
        ] = {}  # the relations that the condition rests on for which who waits
        self._changed: dict[str, tuple[str | None, int]] = {}  # the last change of each: by whom, when
        for record in trace.records:
            self._note(record)
        for life in self.lives.values():
            if life.ended is None:
                self._turn(life, len(trace.records))

    @property
    def roots(self) -> list[Life]:
        """The tasks that belong to no other."""
        return [life for life in self.lives.values() if life.parent is None]

    def in_tree_order(self) -> Iterator[tuple[Life, int]]:
        """All tasks, each behind its parent, with its depth."""
        pending = [(life, 0) for life in reversed(self.roots)]
        while pending:
            life, depth = pending.pop()
            yield life, depth
            pending += [(child, depth + 1) for child in reversed(life.children)]

    def life(self, name: str, number: int) -> Life:
        """The task NAME; one that is new begins at record NUMBER."""
        found = self.lives.get(name)
        if found is None:
            found = self.lives[name] = Life(name, started=number, since=number)
        return found

    def _note(self, record: Record) -> None:
        kind, told, number = record.kind, record.told, record.number
        if kind == "task-started":
            self._start(record)
        elif kind == "task-ended":
            self._end(self.life(told["about"], number), record)
        elif kind == "abort":
            self.life(told["of"], number).aborted = number
            self._arrow("abort", told["by"], number, told["of"], number)
        elif kind == "interrupt-sent":
            self._woken[told["to"] + " interrupt"] = ("interrupt", told["by"], number)
        elif kind == "fact":
            self._changed[words_of(told["fact"])[0]] = record.task, number
        if record.task is not None:
            self._note_of(self.life(record.task, number), record)

    def _note_of(self, life: Life, record: Record) -> None:
        """Note what RECORD says of the task whose turn it was."""
        kind, told, number = record.kind, record.told, record.number
        if kind == "wait":
            self._begin(life, SLEEP if told["on"] in SLEEPS else WAIT, number)
        elif kind == "resume":
            self._wake_up(life, record)
            self._leave(life, (WAIT, SLEEP), number)
        elif kind in BEGINS:
            if kind == "interrupt":
                self._arrive(life.name + " interrupt", life, number)
            self._begin(life, BEGINS[kind], number)
        elif kind in ENDS:
            self._leave(life, (ENDS[kind],), number)
        elif kind == "watch":
            self._reads[life.name] = [] if told["polls"] else words_of(told["relations"])
        elif kind in ("signal", "checkpoint"):
            for name in told["wakes"]:
                self._woken[name] = ("signal", life.name, number)
        elif kind == "failure-passed":
            self._arrow("failure", told["of"], number, life.name, number)
        elif kind == "failure":
            life.place = record.form

    def _start(self, record: Record) -> None:
        told, number = record.told, record.number
        life = self.life(told["about"], number)
        life.role, life.daemon, life.started = told["role"], told["daemon"], number
        if told["parent"] is not None and told["parent"] != life.name:
            life.parent = told["parent"]
            self.life(told["parent"], number).children.append(life)
        source = told["parent"] or record.task
        if source != life.name:
            self._arrow("start", source, number, life.name, number)

    def _end(self, life: Life, record: Record) -> None:
        self._turn(life, record.number)
        life.layers.clear()
        life.ended = record.number
        life.status = record.told["status"]
        life.failure = record.told["failure"]

    def _wake_up(self, life: Life, record: Record) -> None:
        """LIFE goes on, because of what woke it or because of who has ended."""
        self._arrive(life.name, life, record.number)
        if record.told["on"] == "condition" and record.told["how"] == "came":
            changes = [
                self._changed[name] for name in self._reads.get(life.name, ()) if name in self._changed
            ]
            by, number = max(changes, key=lambda change: change[1], default=(None, -1))
            if number >= life.since:
                self._arrow("signal", by, number, life.name, record.number)
        if record.told["on"] in ("end", "tasks", "leaving") and record.told["how"] == "came":
            of = record.told["of"]
            names = of if isinstance(of, list) else [of]
            known = [self.lives[name] for name in names if name in self.lives]
            ended = [child for child in known if child.ended is not None]
            if ended:
                last = max(ended, key=lambda child: child.ended or 0)
                self._arrow("join", last.name, last.ended or 0, life.name, record.number)

    def _arrive(self, key: str, life: Life, number: int) -> None:
        """Draw the arrow that was on its way to LIFE, if one was."""
        sent = self._woken.pop(key, None)
        if sent is not None:
            self._arrow(sent[0], sent[1], sent[2], life.name, number)

    def _arrow(self, kind: str, source: str | None, first: int, target: str, last: int) -> None:
        if source is not None and source != target:
            ended = self.life(source, first).ended
            first = first if ended is None else min(first, ended)
            self.arrows.append(Arrow(kind, source, first, target, last))

    def _turn(self, life: Life, number: int) -> None:
        """Close what LIFE was doing until record NUMBER."""
        state, cause = life.layers[-1] if life.layers else (RUN, -1)
        if life.ended is None and number > life.since:
            life.spans.append(Span(state, life.since, number, cause))
        life.since = number

    def _begin(self, life: Life, state: str, number: int) -> None:
        self._turn(life, number)
        life.layers.append((state, number))

    def _leave(self, life: Life, states: tuple[str, ...], number: int) -> None:
        self._turn(life, number)
        for index in range(len(life.layers) - 1, -1, -1):
            if life.layers[index][0] in states:
                del life.layers[index:]
                return


def words_of(text: str | None) -> list[str]:
    """The symbols of a list, as a trace has it."""
    return (text or "?").strip("()").split() or ["?"]


def counts(lives: Lives) -> dict[str, int]:
    """How many tasks ended how."""
    found: dict[str, int] = {}
    for life in lives.lives.values():
        status = word(life.status)
        found[status] = found.get(status, 0) + 1
    return found


def word(status: str | None) -> str:
    """A status as a word."""
    return "unfinished" if status is None else status.lstrip(":").lower()


def now_doing(lives: Lives, life: Life) -> str:
    """What a task that has not ended was doing last."""
    if not life.layers or life.layers[-1][1] < 0:
        return "running"
    return sentence(lives.trace.records[life.layers[-1][1]])
