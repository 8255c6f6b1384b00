"""A trace for Chrome's and Perfetto's viewers: tasks as tracks, waits as slices, signals as flows.

Their time is in microseconds, and two events of one moment would lie on each
other: so each event is at least one microsecond later than the one before.
"""

from __future__ import annotations

import json
from typing import Any

from eslang.tools.trace_lives import RUN, Arrow, Life, Lives, word
from eslang.tools.trace_reading import Record, Trace
from eslang.tools.trace_words import failure_words, sentence, subject

RUN_NUMBER = 1
BEFORE_END = 0.5  # microseconds: a flow binds to a slice only inside it
INSTANTS = {
    "failure",
    "failure-passed",
    "failure-taken",
    "abort",
    "deadlock",
    "goal",
    "goal-changed",
    "action",
    "deactivated",
    "fact",
    "lock",
    "resource",
    "period-missed",
    "run-stopped",
    "signal",
    "checkpoint",
}
STATES = {
    "wait": "waiting",
    "sleep": "sleeping",
    "recover": "recovery",
    "cleanup": "cleanup",
    "interrupt": "interrupt",
}


def chrome_text(trace: Trace) -> str:
    """TRACE as a JSON text in the trace event format."""
    lives = Lives(trace)
    moments = microseconds(trace)
    order = [life for life, _ in lives.in_tree_order()]
    tracks = {life.name: number for number, life in enumerate(order, start=1)}
    events = [*names(trace, order)]
    for life in order:
        events += slices(lives, life, tracks[life.name], moments)
    events += [instant(record, tracks, moments) for record in trace.records if record.kind in INSTANTS]
    for number, arrow in enumerate(lives.arrows, start=1):
        events += flow(arrow, number, lives, tracks, moments)
    events.sort(key=lambda event: (event["ph"] != "M", event["ts"], -event.get("dur", 0)))
    about = {"clock": trace.header.get("clock"), "seed": trace.header.get("seed"), "remarks": trace.remarks}
    whole = {"displayTimeUnit": "ms", "otherData": about, "traceEvents": events}
    return json.dumps(whole, ensure_ascii=False, separators=(",", ":")) + "\n"


def microseconds(trace: Trace) -> list[float]:
    """The time of each record, and of the end, no two of them the same."""
    found: list[float] = []
    before = -1.0
    for time in [*[record.time for record in trace.records], trace.last]:
        before = max(round(time * 1e6, 3), before + 1)
        found.append(before)
    return found


def event(phase: str, name: str, track: int, moment: float, **more: Any) -> dict[str, Any]:
    """One event of the format."""
    return {"ph": phase, "name": name, "pid": RUN_NUMBER, "tid": track, "ts": moment, **more}


def names(trace: Trace, order: list[Life]) -> list[dict[str, Any]]:
    """What the viewer is to call the tracks, and in which order they stand."""
    plans = ", ".join(map(str, trace.header.get("plans") or [])) or trace.name
    found = [event("M", "process_name", 0, 0, args={"name": plans})]
    for number, life in enumerate(order, start=1):
        found.append(event("M", "thread_name", number, 0, args={"name": life.name}))
        found.append(event("M", "thread_sort_index", number, 0, args={"sort_index": number}))
    return found


def slices(lives: Lives, life: Life, track: int, moments: list[float]) -> list[dict[str, Any]]:
    """The life of one task, and in it what it waited for and what it answered."""
    until = len(moments) - 1 if life.ended is None else life.ended
    told: dict[str, Any] = {"status": word(life.status), "role": life.role, "parent": life.parent}
    if life.failure is not None:
        told["failure"] = failure_words(life.failure)
    whole = event("X", life.name, track, moments[life.started], cat="task", args=told)
    whole["dur"] = moments[until] - moments[life.started]
    found = [whole]
    for span in life.spans:
        if span.state != RUN:
            record = lives.trace.records[span.cause]
            told = {"what": sentence(record), "place": record.form}
            part = event("X", STATES[span.state], track, moments[span.first], cat=span.state, args=told)
            part["dur"] = moments[span.last] - moments[span.first]
            found.append(part)
    return found


def instant(record: Record, tracks: dict[str, int], moments: list[float]) -> dict[str, Any]:
    """A moment at which something happened to a task, or to the run."""
    track = tracks.get(subject(record) or "", 0)
    told = {"what": sentence(record), "place": record.form}
    scope = "t" if track else "p"
    return event("i", record.kind, track, moments[record.number], cat=record.kind, s=scope, args=told)


def flow(
    arrow: Arrow, number: int, lives: Lives, tracks: dict[str, int], moments: list[float]
) -> list[dict[str, Any]]:
    """Both ends of ARROW."""
    first = inside(lives.lives[arrow.source], arrow.first, moments)
    last = max(inside(lives.lives[arrow.target], arrow.last, moments), first)
    more: dict[str, Any] = {"cat": arrow.kind, "id": number}
    return [
        event("s", arrow.kind, tracks[arrow.source], first, **more),
        event("f", arrow.kind, tracks[arrow.target], last, bp="e", **more),
    ]


def inside(life: Life, number: int, moments: list[float]) -> float:
    """The time of record NUMBER, or the last moment of LIFE before its end."""
    if life.ended is not None and number >= life.ended:
        return max(moments[life.ended] - BEFORE_END, moments[life.started])
    return max(moments[number], moments[life.started])
