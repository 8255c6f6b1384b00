"""Deadlock: nothing runs, and nothing can wake anything.

The report names every task, what it waits for, where, and who could have
ended that wait. Its parts are the arguments of the failure :deadlock, a list
for each task, and for people it is laid out by the tools.
"""

from __future__ import annotations

import sys
from types import FrameType

from eslang.base.failure import Failure
from eslang.base.hints import Any, Iterable, NamedTuple
from eslang.base.lists import lisp_list
from eslang.base.shown import shown
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.base.text import String
from eslang.runtime.agenda import Goal
from eslang.runtime.events import Event, Wait
from eslang.runtime.lives import LEAVING
from eslang.runtime.story import Place, nearest_place
from eslang.runtime.tasks import FAILED, SUCCEEDED, Task

DEADLOCK = Keyword("DEADLOCK")
FEW = 3  # relations that a reason names


class Waiting(NamedTuple):
    """One task of a deadlock: what it waits for, where, why that does not come, and what would help."""

    task: str
    what: str
    place: Place | None
    why: str
    kind: str  # of the wait
    advice: str


class Deadlock(NamedTuple):
    """All tasks of a deadlock, in the order in which they began."""

    waiting: tuple[Waiting, ...]


def deadlock(tasks: Iterable[Task]) -> Failure:
    """The failure of TASKS, all of which wait for ever."""
    alive = list(tasks)
    report = Deadlock(tuple([waiting(task, alive) for task in alive if task.wait is not None]))
    failure = Failure(DEADLOCK, *[as_list(each) for each in report.waiting])
    failure.report = report
    return failure


def as_list(waiting: Waiting) -> Value:
    """WAITING as plans have it: the task, what it waits for, and why that does not come, if that is known."""
    texts = [waiting.task, waiting.what, *([waiting.why] if waiting.why else [])]
    return lisp_list(*map(String, texts))


def family(roots: Iterable[Task]) -> list[Task]:
    """ROOTS and all that belongs to them, in the order in which they began."""
    found: list[Task] = []
    pending = list(roots)
    while pending:
        task = pending.pop(0)
        found.append(task)
        pending[0:0] = members(task)
    return found


def members(task: Task) -> list[Task]:
    """The tasks alive that belong to TASK."""
    return [child for child in task.children or () if child.status is None]


def whom_to_tell(task: Task) -> Task:
    """The task in which a deadlock is raised: TASK, or where it cannot leave, the one that it waits for."""
    while task.wait is not None and task.wait.kind == LEAVING:
        task = awaited(task.wait)[0]
    return task


def awaited(wait: Wait) -> list[Task]:
    """The tasks for whose ends WAIT is, those that are still to come."""
    tasks = [wait.of] if isinstance(wait.of, Task) else wait.of
    return [task for task in tasks if task.status is None]


def waiting(task: Task, alive: list[Task]) -> Waiting:
    """What is known of the wait of TASK."""
    wait = task.wait
    assert wait is not None
    reason, advice = why(wait, alive)
    return Waiting(task.name, phrase(wait), place_of_task(task), reason, wait.kind, advice)


def place_of_task(task: Task) -> Place | None:
    """Where in the source TASK stands."""
    frame: FrameType | None = task.stack.gr_frame if task.stack is not None else None
    return nearest_place(frame if frame is not None else sys._getframe(1))


def phrase(wait: Wait) -> str:
    """What WAIT is for, in words."""
    of: Any = wait.of
    match wait.kind:
        case "events":
            return " or ".join(f"{name_of(event)}" for event in of) or "an event of an empty list"
        case "checkpoint":
            return f"checkpoint {shown(of[1])} of {of[0].name}"
        case "end" | "tasks" | "leaving":
            return "the end of " + ", ".join([task.name for task in awaited(wait)])
        case "sleep":
            return f"{float(of):g} seconds to pass"
        case "period":
            return "the next period"
        case "suspended":
            return "another task to resume it"
        case "condition":
            return f"the condition {shown(of)}"
        case "resource":
            return f"{of[1]} of the resource {shown(of[0])}"
        case "retry":
            return f"facts that change what can be done to {shown(of)[1:-1]}"
        case "achievement" | "recovery":
            return f"the {wait.kind} of {shown(of)}"
    return f"{of}" if of is not None else wait.kind


def name_of(event: Event) -> str:
    """EVENT in words."""
    if isinstance(event, Task):
        return f"a signal of {event.name}"
    if isinstance(event, Goal):
        return f"the end of the goal {event}"
    return f"event {event.name}".lower() if event.name is not None else "an event without a name"


def why(wait: Wait, alive: list[Task]) -> tuple[str, str]:
    """Who could have ended WAIT, and did not; and what would help."""
    match wait.kind:
        case "checkpoint":
            return why_no_checkpoint(*wait.of)
        case "events":
            return why_no_signal(wait.of, alive)
        case "condition":
            return why_no_change(wait, alive)
        case "suspended":
            return "", "let another task call `(resume task)` for it"
    return "", ""


def why_no_change(wait: Wait, alive: list[Task]) -> tuple[str, str]:
    """Why none of the facts changes that the condition of WAIT rests on; and what would help."""
    advice = wait.advice
    names = [] if wait.polls else list(wait.reads)
    if not names:
        return "", advice
    shown_names = " or ".join([shown(name) for name in names[:FEW]])
    for task in alive:
        if asserts(task, names):
            could = f"{task.name} could assert or retract facts of {shown_names}"
            return could, f"let {task.name} do that first"
    for task in ended(alive):
        if asserts(task, names) and task.status is not SUCCEEDED:
            return f"{task.name}, which asserts or retracts facts of {shown_names}, {fate(task)}", advice
    return f"no task that is left asserts or retracts facts of {shown_names} in its body", advice


def asserts(task: Task, names: Iterable[Symbol]) -> bool:
    """True if the text of TASK's body asserts or retracts facts of one of the relations NAMES."""
    return any(promises(task, "assert", name) for name in names)


def why_no_checkpoint(task: Task, key: Value) -> tuple[str, str]:
    """Why TASK does not pass its checkpoint KEY; and what would help."""
    form = f"(checkpoint {shown(key)})"
    if task.status is not None:
        return f"{task.name} has ended without it", f"let {task.name} pass `{form}` before it ends"
    if promises(task, "checkpoint", key):
        return f"{task.name} has not come to its {form}", f"let {task.name} pass `{form}` first"
    return f"{task.name} never signals it: no {form} stands in its body", f"let {task.name} pass `{form}`"


def why_no_signal(events: Iterable[Event], alive: list[Task]) -> tuple[str, str]:
    """Why none of EVENTS is signalled; and what would help."""
    if not events:
        return "nothing can end such a wait", "let the list hold an event"
    if any(isinstance(event, Goal) for event in events):
        return "no task that is left pursues goals", "let another task `(pursue-goals)`"
    names = [event.name for event in events if event.name is not None]
    could = [task.name for task in alive if any(promises(task, "signal", name) for name in names)]
    form = f"(signal {shown(names[0]) if names else 'event'})"
    if could:
        return f"{', '.join(could)} could signal it", f"let {could[0]} come to its `{form}`"
    for task in ended(alive):
        if any(promises(task, "signal", name) for name in names):
            return why_signal_is_lost(task, form)
    return "no task that is left signals it by name", f"let a task that does not wait `{form}`"


def ended(alive: list[Task]) -> list[Task]:
    """The tasks that have ended among those for whose ends others wait together."""
    found: list[Task] = []
    for task in alive:
        if task.wait is not None and task.wait.kind == "tasks":
            found += [other for other in task.wait.of if other.status is not None]
    return found


def why_signal_is_lost(task: Task, form: str) -> tuple[str, str]:
    """Why nobody heard TASK, which has ended and whose text has the signal FORM; and what would help."""
    if task.status is SUCCEEDED:
        advice = f"let the wait begin before `{form}`, or use a checkpoint, which is recorded"
        return f"{task.name} has ended; a signal that nobody waits for is lost", advice
    return f"{task.name}, which signals it, {fate(task)}", f"let {task.name} come to its `{form}`"


def fate(task: Task) -> str:
    """How TASK, which did not succeed, has ended."""
    return "has failed" if task.status is FAILED else "was aborted"


def promises(task: Task, kind: str, of: Value) -> bool:
    """True if the text of TASK's body has a signal of KIND for OF."""
    return any(known == kind and (named is of or named == of) for known, named in task.promises)
