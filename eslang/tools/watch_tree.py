"""The tasks of a run that goes on, as a tree in lines: how each is, and what it waits for.

A listener that only takes notes; what ended stays to be seen, as long as there
is room. Nothing here knows a terminal.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from eslang.base.shown import shown
from eslang.runtime.deadlock import phrase
from eslang.runtime.story import Place
from eslang.runtime.tasks import Task
from eslang.tools.report import failure_text

FAILED_SHARE = 4  # one line in so many is for tasks that failed, if there are so many
KEPT = 400  # tasks that have ended, and as many that failed
SLEEPS = ("sleep", "period")
ALIVE = "●"
MARKS = {"SUCCEEDED": "✓", "FAILED": "✗", "ABORTED": "⊘"}
HUES = {"✓": "32", "✗": "31", "⊘": "2", "○": "33", "↻": "33", ALIVE: "36"}


class Awaited(NamedTuple):
    """What a wait is for, as an event tells it."""

    kind: str
    of: Any


class Seen:
    """What is known of one task."""

    __slots__ = ("ended", "failed", "layers", "name", "order", "parent", "place", "status", "why")

    def __init__(self, name: str, parent: str | None, order: int) -> None:
        self.name = name
        self.parent = parent
        self.order = order
        self.status: str | None = None
        self.ended = 0.0
        self.layers: list[tuple[str, str, float]] = []  # (what for, in words, until when), innermost last
        self.place = ""
        self.failed = ""  # what it failed with
        self.why = ""  # who aborted it


class WatchTree:
    """All tasks of a run."""

    def __init__(self) -> None:
        self.tasks: dict[str, Seen] = {}
        self.ended: dict[str, None] = {}  # in the order in which they did
        self.failed: dict[str, None] = {}  # likewise, those that failed
        self.counts: dict[str, int] = {}  # how many ended how
        self.last_failure = ""
        self.facts = {True: 0, False: 0}  # how many came, and went
        self.last_fact = ""
        self._order = 0

    def __call__(self, event: Any) -> None:
        """Note EVENT."""
        note = NOTES.get(event.kind)
        if note is not None:
            note(self, event, event.data)

    def of(self, task: Task) -> Seen:
        """What is known of TASK."""
        found = self.tasks.get(task.name)
        if found is None:
            self._order += 1
            parent = task.parent.name if task.parent is not None else None
            found = self.tasks[task.name] = Seen(task.name, parent, self._order)
        return found

    # --- notes -------------------------------------------------------------------

    def start(self, event: Any, told: dict[str, Any]) -> None:
        """A task begins."""
        self.of(told["about"])

    def end(self, event: Any, told: dict[str, Any]) -> None:
        """A task has ended; of those that have, the oldest is forgotten."""
        seen = self.of(told["about"])
        seen.status, seen.ended = told["status"].name, event.time
        seen.layers.clear()
        if told["failure"] is not None:
            seen.failed = failure_text(told["failure"])
        self.counts[seen.status] = self.counts.get(seen.status, 0) + 1
        for group, fits in ((self.failed, seen.failed), (self.ended, not seen.failed)):
            if fits:
                group[seen.name] = None
            if len(group) > KEPT:
                oldest = next(iter(group))
                del group[oldest], self.tasks[oldest]

    def wait(self, event: Any, told: dict[str, Any]) -> None:
        """The task whose turn it is begins to wait."""
        seen = self.of(event.task)
        sleeps = told["on"] in SLEEPS
        awaited: Any = Awaited(told["on"], told["of"])
        words = "sleeps" if sleeps else f"waits for {phrase(awaited)}"
        seen.layers.append((told["on"], words, event.time + told["of"] if sleeps else 0.0))
        seen.place = short(event.form)

    def resume(self, event: Any, told: dict[str, Any]) -> None:
        """Its wait is over."""
        self.leave(event)

    def recover(self, event: Any, told: dict[str, Any]) -> None:
        """It runs a recovery procedure."""
        seen = self.of(event.task)
        words = failure_text(told["failure"])
        seen.layers.append(("recovery", f"recovers from {words}", 0.0))
        seen.place = short(event.form)
        self.last_failure = f"{words} in {seen.name}, recovery at {short(event.form)}"

    def clean(self, event: Any, told: dict[str, Any]) -> None:
        """It runs a cleanup."""
        if event.task is not None:
            self.of(event.task).layers.append(("cleanup", "cleans up", 0.0))

    def leave(self, event: Any, told: Any = None) -> None:
        """What it was doing within the rest is over."""
        if event.task is not None and event.task.name in self.tasks:
            layers = self.of(event.task).layers
            if layers:
                layers.pop()

    def fail(self, event: Any, told: dict[str, Any]) -> None:
        """It fails, and nothing recovers."""
        name = event.task.name if event.task is not None else "the run"
        place = f" at {short(event.form)}" if event.form is not None else ""
        if event.task is not None:
            self.of(event.task).place = short(event.form)
        self.last_failure = f"{failure_text(told['failure'])} in {name}{place}, no recovery"

    def abort(self, event: Any, told: dict[str, Any]) -> None:
        """A task is aborted."""
        by = f" by {told['by'].name}" if told["by"] is not None else ""
        self.of(told["of"]).why = f"aborted{by}"

    def change(self, event: Any, told: dict[str, Any]) -> None:
        """A fact came, or went."""
        self.facts[told["added"]] += 1
        sign = "+" if told["added"] else "−"
        where = f" in {event.task.name}" if event.task is not None else ""
        place = f" at {short(event.form)}" if event.form is not None else ""
        self.last_fact = f"{sign} {shown(told['fact'])}{where}{place}"

    # --- lines -------------------------------------------------------------------

    def lines(self, now: float, room: int) -> list[tuple[str, str, str]]:
        """At most ROOM lines: (mark, branches and name, words), and one for those that are left out."""
        chosen = self._chosen(room)
        children: dict[str | None, list[Seen]] = {}
        for seen in sorted(chosen.values(), key=lambda seen: seen.order):
            parent = seen.parent if seen.parent in chosen else None
            children.setdefault(parent, []).append(seen)
        found = [(mark(seen), stem + seen.name, words(seen, now)) for stem, seen in branches(children)]
        left = len(self.tasks) - len(chosen)
        gone = sum(self.counts.values()) - len(self.ended) - len(self.failed)
        if left or gone:
            waiting = sum(
                1 for seen in self.tasks.values() if seen.status is None and seen.name not in chosen
            )
            more = [f"{left + gone - waiting} that ended"] if left + gone > waiting else []
            found.append((" ", "…", ", ".join([*([f"{waiting} more that live"] if waiting else []), *more])))
        return found

    def fact_line(self) -> str:
        """How many facts came and went, and the last of them; nothing if there were none."""
        came, went = self.facts[True], self.facts[False]
        return f"facts: {came:,} came, {went:,} went, last {self.last_fact}" if self.last_fact else ""

    def _chosen(self, room: int) -> dict[str, Seen]:
        """The tasks that are shown: those alive before those that ended, each with what it belongs to."""
        if len(self.tasks) <= room:
            return dict(self.tasks)
        chosen: dict[str, Seen] = {}
        ranked = sorted(self.tasks.values(), key=rank)
        failed = [seen for seen in ranked if seen.status == "FAILED"][: room // FAILED_SHARE]
        for seen in (*failed, *ranked[: 4 * room]):
            line, above = {}, seen
            while above.name not in chosen:
                line[above.name] = above
                if above.parent is None or above.parent not in self.tasks:
                    break
                above = self.tasks[above.parent]
            if len(chosen) + len(line) <= room - 1:
                chosen.update(line)
        return chosen

    def summary(self) -> str:
        """How many tasks there are, and how they are."""
        alive = [seen for seen in self.tasks.values() if seen.status is None]
        waiting = sum(1 for seen in alive if mark(seen) == "○")
        parts = [f"{len(alive) - waiting} running", f"{waiting} waiting"]
        parts += [
            f"{number} {status.lower()}" for status, number in sorted(self.counts.items(), reverse=True)
        ]
        return ", ".join(parts)


def rank(seen: Seen) -> tuple[bool, bool, float, int]:
    """What is shown first: who lives, then who failed, then who ended last."""
    return seen.status is not None, seen.status != "FAILED", -seen.ended, seen.order


def branches(children: dict[str | None, list[Seen]]) -> Iterator[tuple[str, Seen]]:
    """Each task behind the branches of the tree that lead to it."""
    pending = [("", "", seen) for seen in reversed(children.get(None, []))]
    while pending:
        stem, below, seen = pending.pop()
        yield stem, seen
        group = children.get(seen.name, [])
        for index in range(len(group) - 1, -1, -1):
            last = index == len(group) - 1
            pending.append((below + ("└ " if last else "├ "), below + ("  " if last else "│ "), group[index]))


def mark(seen: Seen) -> str:
    """One character for how a task is."""
    if seen.status is not None:
        return MARKS[seen.status]
    if not seen.layers:
        return ALIVE
    return {"recovery": "↻", "cleanup": "↻"}.get(seen.layers[-1][0], "○")


def words(seen: Seen, now: float) -> str:
    """What a task does, or how it ended."""
    if seen.status is not None:
        told = {"FAILED": f"failed: {seen.failed}", "ABORTED": seen.why or "aborted"}
        place = f"  {seen.place}" if seen.status == "FAILED" and seen.place else ""
        return told.get(seen.status, "succeeded") + place
    if not seen.layers:
        return "running"
    kind, what, until = seen.layers[-1]
    if kind in SLEEPS:
        what = f"sleeps, {max(0.0, until - now):.1f} s left"
    return f"{what}  {seen.place}"


def short(place: Place | None) -> str:
    """PLACE without the folders of its file."""
    return "" if place is None else str(place).rpartition("/")[2]


NOTES = {
    "task-started": WatchTree.start,
    "task-ended": WatchTree.end,
    "wait": WatchTree.wait,
    "resume": WatchTree.resume,
    "recovery": WatchTree.recover,
    "recovery-ended": WatchTree.leave,
    "cleanup-started": WatchTree.clean,
    "cleanup-ended": WatchTree.leave,
    "failure": WatchTree.fail,
    "abort": WatchTree.abort,
    "fact": WatchTree.change,
}
