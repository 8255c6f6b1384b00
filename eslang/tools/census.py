"""What tasks there are, for people at the prompt: all of them, or all that is known of one.

Those that have ended lately stay to be seen. What the kernel knows of a task
is in runtime/tasks.py; only its last failure is noted here, where it may have
been answered since.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from typing import Any

from eslang.base.failure import Failure
from eslang.base.printer import prin1
from eslang.base.shown import shown
from eslang.base.suggest import nearest
from eslang.runtime.deadlock import family, phrase, place_of_task
from eslang.runtime.tasks import ABORTED, FAILED, Task
from eslang.tools.report import failure_text, place_of

REMEMBERED = 50  # tasks that have ended and can still be asked about
LISTED = 10  # of them, those that are listed


class Census:
    """The tasks of one interpreter."""

    def __init__(self, interp: Any) -> None:
        self.interp = interp
        self.ended: deque[Task] = deque(maxlen=REMEMBERED)
        self.failures: dict[Task, Failure] = {}  # the last of each
        interp.scheduler.lives.recent = self
        self.fallen: list[Task] = []  # top-level tasks that have failed since somebody asked
        interp.hooks.speakers.append(self.hear)

    def append(self, task: Task) -> None:
        """TASK has ended."""
        if len(self.ended) == REMEMBERED:
            self.failures.pop(self.ended[0], None)
        self.ended.append(task)
        if task.status is FAILED and task.parent is None:
            self.fallen.append(task)

    def hear(self, event: Any) -> None:
        """The listener that notes the last failure of each task."""
        failure = event.data.get("failure")
        if failure is not None and event.task is not None and not event.task.is_root:
            self.failures[event.task] = failure

    def take_fallen(self) -> list[Task]:
        """The tasks of the run that have failed since the last time."""
        fallen, self.fallen = self.fallen, []
        return fallen

    # --- all of them -------------------------------------------------------------

    def alive(self) -> list[Task]:
        """The tasks that have not ended, owners before what belongs to them."""
        return family(self.interp.scheduler.lives.tops)

    def listing(self) -> str:
        """All tasks, as a tree, those that have ended lately among them."""
        rows = list(self.rows())
        if not rows:
            return "No tasks.\n"
        widths = [max([len(row[column]) for row in rows]) for column in range(3)]
        lines = [
            "  ".join([f"{cell:<{w}}" for cell, w in zip(row, (*widths, 0), strict=True)]) for row in rows
        ]
        return "".join([line.rstrip() + "\n" for line in lines])

    def rows(self) -> Iterator[tuple[str, str, str, str]]:
        """For each task its name, indented below its owner's, its status, why, and where."""
        shown_ones = [*list(self.ended)[-LISTED:], *self.alive()]
        known = set(shown_ones)
        pending = [(task, 0) for task in shown_ones if task.parent not in known]
        while pending:
            task, depth = pending.pop(0)
            yield ("  " * depth + task.name, self.status(task), self.reason(task), self.place(task))
            pending[0:0] = [(child, depth + 1) for child in shown_ones if child.parent is task]

    def status(self, task: Task) -> str:
        """How TASK is, in a word."""
        if task.status is not None:
            return shown(task.status)[1:]
        if task.ending is not None:
            return "leaving"
        return "ready" if task.queued or task.wait is None else "waiting"

    def reason(self, task: Task) -> str:
        """What TASK waits for, gave, or failed with."""
        if task.failure is not None:
            return failure_text(task.failure)
        if task.status is not None:
            return "" if task.status is ABORTED else prin1(task.value)
        return f"for {phrase(task.wait)}" if task.wait is not None and not task.queued else ""

    def place(self, task: Task) -> str:
        """Where TASK stands, or failed."""
        if task.status is not None:
            return place_of(task.failure) if task.failure is not None else ""
        return str(place_of_task(task) or "")

    # --- one of them -------------------------------------------------------------

    def names(self) -> list[str]:
        """The names of all tasks that can be asked about."""
        return [task.name for task in [*self.alive(), *self.ended]]

    def find(self, name: str) -> Task | str:
        """The task called NAME; a sentence if there is none."""
        tasks = {task.name: task for task in [*self.ended, *self.alive()]}
        wanted = name.strip('"').lower()
        if wanted in tasks:
            return tasks[wanted]
        near = nearest(wanted, tasks)
        return f"There is no task `{wanted}`" + (f"; the nearest name is `{near}`.\n" if near else ".\n")

    def about(self, task: Task) -> str:
        """All that is known of TASK."""
        status, reason, place = self.status(task), self.reason(task), self.place(task)
        known = [f"{status} {reason}".rstrip(), *([f"at {place}"] if place else [])]
        lines = [f"{task.name}: {', '.join(known)}"]
        lines += [f"  {title:<12}  {text}" for title, text in self.particulars(task) if text]
        return "\n".join(lines) + "\n"

    def particulars(self, task: Task) -> Iterator[tuple[str, str]]:
        """What else is known of TASK: titles, and texts, which may be empty."""
        daemon = ", which does not wait for it" if task.daemon else ""
        yield "belongs to", (task.parent.name if task.parent is not None else "the run") + daemon
        yield "owns", ", ".join([child.name for child in task.children or ()])
        yield "checkpoints", " ".join(reached(task))
        yield "interrupts", ", ".join([interrupt.kind for interrupt in task.interrupts])
        yield "cleanups", "under way" if task.status is None and task.dynamic.held else ""
        failure = self.failures.get(task)
        if failure is not None and failure is not task.failure:
            where = place_of(failure)
            yield "last failure", failure_text(failure) + (f", raised at {where}" if where else "")


def reached(task: Task) -> list[str]:
    """The checkpoints that TASK has passed."""
    return [checkpoint(key) for key in task.reached or ()]


def checkpoint(key: Any) -> str:
    """The checkpoint with the key KEY, as it is written; one that is a list is not kept as such."""
    return f'"{key}"' if isinstance(key, str) else "(…)" if isinstance(key, tuple) else prin1(key)
