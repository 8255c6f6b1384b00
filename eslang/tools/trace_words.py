"""The events of a trace in words, for people."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from typing import Any

from eslang.tools.narrator import retries
from eslang.tools.trace_reading import Record

SUBJECTS = {
    "task-started": "about",
    "task-ended": "about",
    "abort": "of",
    "interrupt-sent": "to",
    "deadlock": "to",
    "resource": "of",
}
ROLES = {"member": "", "main": "", "guardian": ", a guardian", "goal": ", for a goal", "spawned": ", spawned"}
WHY_ABORTED = {
    "net": "the net is decided",
    "guardian": "what it guarded is over",
    "owner": "its owner ends",
    "run": "the run ends",
    "caller": "who awaits it was cancelled",
    "recovery": "nobody wants it any more",
    "goal": "its goal is over",
}
MANY = 4  # names that are listed


def subject(record: Record) -> str | None:
    """The task that RECORD is about."""
    name: str | None = record.told.get(SUBJECTS.get(record.kind, ""), record.task)
    return name


def concerns(record: Record, name: str) -> bool:
    """True if RECORD has to do with the task NAME."""
    told = record.told
    parts = (record.task, told.get("about"), told.get("of"), told.get("to"), told.get("by"))
    return name in parts or name in told.get("wakes", ()) or name in list_of(told.get("of"))


def list_of(value: Any) -> list[Any]:
    """VALUE, if it is a list."""
    return value if isinstance(value, list) else []


def sentence(record: Record) -> str:
    """What RECORD says of its subject."""
    make = SENTENCES.get(record.kind)
    if make is None:
        rest = ", ".join(f"{name} {value_text(value)}" for name, value in record.told.items())
        return f"{record.kind}: {rest}" if rest else record.kind
    return make(record.told)


def listed(names: list[Any]) -> str:
    """NAMES in a row; of many only the first."""
    shown = [str(name) for name in names[:MANY]]
    left = len(names) - MANY
    return ", ".join(shown) + (f" and {left} more" if left > 0 else "")


def failure_words(failure: dict[str, Any]) -> str:
    """The cause of FAILURE, and its arguments; of a deadlock only who is in it."""
    if failure["cause"] == ":DEADLOCK":
        found = [re.match(r'\("([^"]*)"', value_text(argument)) for argument in failure["arguments"]]
        return f":DEADLOCK of {listed([match[1] for match in found if match])}"
    return " ".join([failure["cause"], *map(value_text, failure["arguments"])])


def value_text(value: Any) -> str:
    """VALUE, one of a trace, as text."""
    if value is None:
        return "NIL"
    return value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def seconds(value: Any) -> str:
    """A number of seconds."""
    return f"{value:g} s" if isinstance(value, (int, float)) else str(value)


def waited_for(told: dict[str, Any]) -> str:
    """What a wait is for."""
    on, of = told["on"], told["of"]
    if on == "events" and isinstance(of, list):
        return " or ".join(f"event {name}" for name in of[:MANY]) + (" …" if len(of) > MANY else "")
    if on == "checkpoint" and isinstance(of, list) and len(of) == 2:
        return f"checkpoint {value_text(of[1])} of {of[0]}"
    if on in ("end", "tasks", "leaving"):
        names = of if isinstance(of, list) else [of]
        return f"the end{'s' if len(names) > 1 else ''} of {listed(names)}"
    if on == "condition":
        return f"the condition {value_text(of)}"
    if on == "resource" and isinstance(of, list) and len(of) == 2:
        return f"{value_text(of[1])} of {value_text(of[0])}"
    if on == "period":
        return f"the next period, {seconds(of)}"
    if on == "suspended":
        return "another task to resume it"
    if on == "deactivated":
        return f"{of} to leave the construct"
    if on == "sleep":
        return f"{seconds(of)} to pass"
    if on == "outside":
        return f"{value_text(of)}, outside"
    if on in ("goals", "turn"):
        return str(of)
    if on == "retry":
        return f"news, to {value_text(of)[1:-1]}"
    if on in ("achievement", "recovery"):
        return f"the {on} of {value_text(of)}"
    return on if of is None else f"{on} {value_text(of)}"


def _wait(told: dict[str, Any]) -> str:
    return f"sleeps {seconds(told['of'])}" if told["on"] == "sleep" else f"waits for {waited_for(told)}"


def _watch(told: dict[str, Any]) -> str:
    if told["polls"]:
        return "is to look again after each step of another task"
    names = value_text(told["relations"]).strip("()").split()
    return f"is to wake when facts of {listed(names)} change"


def _resume(told: dict[str, Any]) -> str:
    words = {"came": "goes on", "timeout": "goes on: the time is over", "left": "leaves its wait"}
    return words.get(told["how"], f"goes on: {told['how']}")


def _started(told: dict[str, Any]) -> str:
    return "begins" + ROLES.get(told["role"], f", {told['role']}") + (", daemon" if told["daemon"] else "")


def _ended(told: dict[str, Any]) -> str:
    if told["status"] == ":FAILED" and told["failure"] is not None:
        return f"has failed: {failure_words(told['failure'])}"
    return {":SUCCEEDED": "has succeeded", ":ABORTED": "has ended, aborted"}.get(told["status"], "has ended")


def _woken(told: dict[str, Any]) -> str:
    return f", wakes {listed(told['wakes'])}" if told["wakes"] else ""


def _signal(told: dict[str, Any]) -> str:
    given = f" {told['arguments']}" if told["arguments"] is not None else ""
    return f"signals {told['event']}{given}" + (_woken(told) or ", nobody waits")


def _abort(told: dict[str, Any]) -> str:
    by = f" by {told['by']}" if told["by"] is not None else ""
    why = WHY_ABORTED.get(told["why"])
    return f"is aborted{by}" + (f": {why}" if why else "")


def _cause_of_interrupt(told: dict[str, Any]) -> str:
    return str(told["why"]) + (f" {told['by']}" if told["by"] is not None else "")


def _recovery(told: dict[str, Any]) -> str:
    return f"recovers from {failure_words(told['failure'])} ({retries(told['left']).lower()})"


def _recovery_end(told: dict[str, Any]) -> str:
    words = {
        "retry": "tries again",
        "abort": "gives up the form, with a value",
        "continued": "goes on behind the FAIL",
        "declined": "did not recover",
    }
    return words.get(told["how"], "leaves the recovery by a jump")


def _goal(told: dict[str, Any]) -> str:
    states = {"no-action": "is true already", "attempting": "is attempted", "achieved": "is achieved"}
    return f"goal {value_text(told['condition'])} {states.get(told['state'], told['state'])}"


def _goal_changed(told: dict[str, Any]) -> str:
    goal = value_text(told["goal"])
    sentences = {
        "added": f"is to pursue {goal}",
        "pursued": f"attempts to {goal[1:-1]}",
        "inactive": f"has nothing to do for {goal}",
        "failed": f"has failed to {goal[1:-1]}, and tries again",
        "blocked": f"finds no method for {goal}",
        "achieved": f"is done with {goal}",
        "dropped": f"drops {goal}",
        "impossible": f"gives up {goal}",
    }
    return sentences[told["change"]]


def _lock(told: dict[str, Any]) -> str:
    locked, of, owner = value_text(told["property"]), told["of"], told["owner"]
    sentences = {
        "subscribed": f"subscribes to {locked}, which {'it' if of == owner else owner} owns",
        "released": f"releases {locked}",
        "owned": f"leaves {locked} to {of}",
        "achieving": f"is to achieve {locked}",
        "achieved": f"has achieved {locked}",
        "not-achieved": f"could not achieve {locked}",
        "violated": f"finds {locked} violated",
        "recovering": f"lets {of} restore {locked}",
        "recovered": f"finds {locked} restored",
        "unrecoverable": f"gives up {locked}",
    }
    return sentences.get(told["change"], f"{told['change']} {locked}")


def _resource(told: dict[str, Any]) -> str:
    claim, left = f"{told['amount']} of {told['resource']}", f"{told['left']} left"
    sentences = {
        "granted": f"has {claim} now, {left}",
        "released": f"gives {claim} back, {left}",
        "refused": f"cannot have {claim}, {left}",
        "preempted": f"is to give {claim} back",
    }
    return sentences.get(told["change"], f"{told['change']} {claim}")


def _path(told: dict[str, Any]) -> str:
    """The constructs that are under way, outermost first."""
    return " › ".join(str(stage)[1:-1] for stage in list_of(told["path"]))


def _action(told: dict[str, Any]) -> str:
    path = _path(told)
    return f"does {value_text(told['action'])}" + (f", in {path}" if path else "")


def _deactivated(told: dict[str, Any]) -> str:
    condition = value_text(told["condition"])
    reasons = {
        "condition": f"{condition} does not hold any more",
        "earlier": f"{condition} holds",
        "alternatives": "no alternative is left",
        "while": f"{condition} does not hold",
        "when": f"{condition} does not hold",
        "until": f"{condition} holds",
        "unless": f"{condition} holds",
    }
    return f"leaves {_path(told)}: {reasons.get(told['why'], told['why'])}"


def _deadlock(told: dict[str, Any]) -> str:
    return f"deadlock of {listed([each.get('task') for each in told['waiting']])}: nothing can wake them"


SENTENCES: dict[str, Callable[[dict[str, Any]], str]] = {
    "task-started": _started,
    "task-ended": _ended,
    "abort": _abort,
    "wait": _wait,
    "watch": _watch,
    "resume": _resume,
    "signal": _signal,
    "checkpoint": lambda told: f"passes checkpoint {value_text(told['id'])}" + _woken(told),
    "period-missed": lambda told: f"has missed {told['missed']} periods of {seconds(told['seconds'])}",
    "interrupt-sent": lambda told: f"is to be interrupted: {_cause_of_interrupt(told)}",
    "interrupt": lambda told: f"is interrupted: {_cause_of_interrupt(told)}",
    "interrupt-ended": lambda told: "leaves where it stood" if told["left"] else "goes on where it stood",
    "recovery": _recovery,
    "recovery-ended": _recovery_end,
    "failure-taken": lambda told: f"takes the failure {failure_words(told['failure'])}",
    "failure": lambda told: f"fails: {failure_words(told['failure'])}, no recovery",
    "failure-passed": lambda told: f"fails as {told['of']} did: {failure_words(told['failure'])}",
    "aborted": lambda told: "the run of this form is aborted",
    "cleanup-started": lambda told: "cleans up",
    "cleanup-ended": lambda told: "leaves its cleanup" if told["left"] else "has cleaned up",
    "deadlock": _deadlock,
    "action": _action,
    "deactivated": _deactivated,
    "goal": _goal,
    "fact": lambda told: f"{'asserts' if told['added'] else 'retracts'} {value_text(told['fact'])}",
    "goal-changed": _goal_changed,
    "lock": _lock,
    "resource": _resource,
    "run-stopped": lambda told: f"the run is stopped: {told['reason']} (exit {told['code']})",
}
