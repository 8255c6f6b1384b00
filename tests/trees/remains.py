"""What may not remain when a run has ended: the invariants of the kernel."""

from __future__ import annotations

import sys
from collections import Counter
from typing import Any

from eslang.base import calls
from eslang.base.stack import STACK
from trees.running import Run
from trees.words import EVENTS


def remains(run: Run) -> list[str]:
    """All that is left over of RUN; empty if all is well."""
    found = ["it did not end"] if run.too_long else []
    found += [f"{name} is {value!r}" for name, value in of_the_run(run.interp).items() if value]
    found += of_events(run)
    for task in run.tasks:
        found += [f"{name} of {task.name} is {value!r}" for name, value in of_task(task).items() if value]
    found += of_dynamic("the calm", run.interp.dynamic)
    found += of_cleanups(run.notes)
    return found


def of_the_run(interp: Any) -> dict[str, Any]:
    """What each is to be empty, of an interpreter at rest."""
    scheduler, lives = interp.scheduler, interp.scheduler.lives
    return {
        "lives.count": lives.count,
        "lives.tops": lives.tops,
        "lives.unseen": lives.unseen,
        "lives.crash": lives.crash,
        "the root": interp.runs.root,
        "the pending stop of the run": interp.runs.stopped,
        "the current task": scheduler.current,
        "the driver": scheduler.driver,
        "scheduler.ready": list(scheduler.ready),
        "scheduler.polls": scheduler.polls.waits,
        "the number of timers": len(scheduler.timers),
        "the number of posts": scheduler.posted.qsize(),
        "the pending stop": scheduler.ticks.pending,
        "the hook of the ticks": sys.getprofile(),
        "the place of the bindings": interp.bindings.hidden,
        "the depth of calls": calls.depth[0],
        "the room of the stack": STACK.raised,
        "a foreign state": interp.dynamic is not scheduler.calm,
    }


def of_events(run: Run) -> list[str]:
    """The waits that events still know."""
    events = [(name, run.interp.value(name)) for name in EVENTS]
    events += [(f"the signals of {task.name}", task) for task in run.tasks]
    for task in run.tasks:
        events += [
            (f"checkpoint {key} of {task.name}", event) for key, event in (task.checkpoints or {}).items()
        ]
    return [f"{name} is waited for" for name, event in events if event.waits]


def of_task(task: Any) -> dict[str, Any]:
    """What each is to be empty, of a task that has ended."""
    found = {
        "a life": task.status is None,
        "a stack": task.stack,
        "a wait": task.wait,
        "an end to come": task.ending,
        "the interrupts": task.interrupts,
        "the interrupts under way": task.obeying,
        "the children": task.children,
        "a turn to come": task.queued,
        "the body": task.body,
        "the ticks": task.source,
        "a watcher": task.on_end,
    }
    return found | dict.fromkeys(of_dynamic(task.name, task.dynamic), True)


def of_dynamic(name: str, dynamic: Any) -> list[str]:
    """What DYNAMIC, of which everything was left, still has."""
    state = {
        "forms": dynamic.forms,
        "answers": dynamic.answering,
        "catches": dynamic.catches,
        "jumps": dynamic.jumps,
        "cleanups": dynamic.held,
        "masks": dynamic.masked,
        "silence": dynamic.quiet,
    }
    return [f"{part} of {name} is {value!r}" for part, value in state.items() if value]


def of_cleanups(notes: list[tuple[Any, ...]]) -> list[str]:
    """The forms whose cleanups did not run just once: those in NOTES, as the preamble leaves them."""
    counts = Counter((words[0], words[1]) for words in notes if len(words) > 1)
    found = []
    for kind, number in counts:
        if kind == ":ENTER-PROTECTED" and counts[":CLEAN-PROTECTED", number] != 1:
            found.append(f"the cleanup {number} ran {counts[':CLEAN-PROTECTED', number]} times")
        if kind == ":ENTER" and counts[":CLEAN", number] + counts[":LEAVE", number] > 1:
            found.append(f"the cleanup procedure {number} ran although its body was left, or twice")
        if kind == ":WRONG-BINDING":
            found.append(f"the binding {number} was another one's")
    return found


def forgotten(notes: list[tuple[Any, ...]]) -> list[str]:
    """The cleanup procedures that did not run, though their bodies did not end; for plans without jumps."""
    counts = Counter((words[0], words[1]) for words in notes if len(words) > 1)
    return [
        f"the cleanup procedure {number} did not run"
        for kind, number in counts
        if kind == ":ENTER" and counts[":CLEAN", number] + counts[":LEAVE", number] == 0
    ]
