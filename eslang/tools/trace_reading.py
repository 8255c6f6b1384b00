"""A trace file, read back: the records of a run, checked line by line.

A run that was killed leaves a file whose last line is cut, or that lacks its
end; what is there can still be looked at. Anything else that is wrong is
refused with the line where it stands.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from eslang.runtime.kinds import KINDS, Kind
from eslang.tools.tracing import FORMAT

CUT = "the last line is cut: the run was killed while it wrote it"
ENDLESS = "the run had not ended: it was killed, or goes on"


class BadTrace(Exception):
    """A file that is no trace, or a wrong line of one."""


@dataclass(slots=True)
class Record:
    """One event of a run: its number, and what was told."""

    number: int
    kind: str
    time: float
    task: str | None
    form: str | None
    told: dict[str, Any]


@dataclass(slots=True)
class Trace:
    """A run as it was written down."""

    name: str
    header: dict[str, Any] = field(default_factory=dict)
    records: list[Record] = field(default_factory=list)
    end: float | None = None  # when the run ended, if it did
    remarks: list[str] = field(default_factory=list)

    @property
    def last(self) -> float:
        """The last moment that is known of."""
        times = [self.records[-1].time] if self.records else [0.0]
        return max([*times, *([self.end] if self.end is not None else [])])


def read_trace(path: str) -> Trace:
    """The trace in the file PATH, `-` for standard input. Raises BadTrace, OSError."""
    if path == "-":
        return read_lines("<stdin>", sys.stdin.buffer.read())
    with open(path, "rb") as stream:
        return read_lines(path, stream.read())


def read_lines(name: str, written: bytes) -> Trace:
    """The trace that was WRITTEN; NAME is what messages call it."""
    lines = written.decode("utf-8", "replace").split("\n")
    rest = lines.pop()  # what stands behind the last newline
    trace = Trace(name)
    for number, line in enumerate(lines, start=1):
        read_line(trace, number, parsed(name, number, line))
    if rest:
        trace.remarks.append(CUT)
    if not trace.header:
        raise BadTrace(f"{name} is no trace: `esl run --trace FILE` writes one")
    if trace.end is None and not rest:
        trace.remarks.append(ENDLESS)
    return trace


def parsed(name: str, number: int, line: str) -> dict[str, Any]:
    """LINE as the object that it is to be."""
    try:
        found = json.loads(line)
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, dict) or not isinstance(found.get("kind"), str):
        if number == 1:
            raise BadTrace(f"{name} is no trace: `esl run --trace FILE` writes one")
        raise BadTrace(f"{name}:{number}: this line is no event: {line[:40]!r}")
    return found


def read_line(trace: Trace, number: int, found: dict[str, Any]) -> None:
    """Add what was FOUND on line NUMBER to TRACE."""
    kind = found.pop("kind")
    if number == 1:
        if kind != "trace-begun":
            raise BadTrace(f"{trace.name}:1: the beginning of this trace is missing")
        if found.get("format") != FORMAT:
            raise BadTrace(
                f"{trace.name}:1: another version of eslang wrote this trace; let that one read it"
            )
        trace.header = found
        return
    time = found.pop("time", None)
    if not isinstance(time, (int, float)) or isinstance(time, bool) or not 0 <= time < 1e15:
        raise BadTrace(f"{trace.name}:{number}: this event has no time")
    if kind == "trace-ended":
        trace.end = float(time)
        return
    task, form = found.pop("task", None), found.pop("form", None)
    known = KINDS.get(kind)
    wrong = None if known is None else missing_part(known, found)
    if wrong is not None or not is_name(task) or not is_name(form):
        raise BadTrace(f"{trace.name}:{number}: this `{kind}` is wrong: {wrong or 'task or form'}")
    trace.records.append(Record(len(trace.records), kind, float(time), task, form, found))


def is_name(value: Any) -> bool:
    """True if VALUE is a name, or none."""
    return value is None or isinstance(value, str)


def missing_part(kind: Kind, told: dict[str, Any]) -> str | None:
    """The first part of KIND that is not TOLD, or not as its type says."""
    for part in kind.parts:
        if part.name not in told:
            return part.name
        value = told[part.name]
        if value is None and part.type.endswith("| None"):
            continue
        check = CHECKS.get(part.type.partition(" ")[0])
        if check is not None and not check(value):
            return part.name
    return None


def is_failure(value: Any) -> bool:
    """True if VALUE is a failure as the tracer writes it."""
    return (
        isinstance(value, dict)
        and isinstance(value.get("cause"), str)
        and isinstance(value.get("arguments"), list)
    )


def are_names(value: Any) -> bool:
    """True if VALUE is a list of names."""
    return isinstance(value, list) and all(isinstance(each, str) for each in value)


CHECKS: dict[str, Callable[[Any], bool]] = {
    "Task": lambda value: isinstance(value, str),
    "Event": lambda value: isinstance(value, str),
    "Keyword": lambda value: isinstance(value, str),
    "Place": lambda value: isinstance(value, str),
    "str": lambda value: isinstance(value, str),
    "bool": lambda value: isinstance(value, bool),
    "int": lambda value: isinstance(value, int),
    "float": lambda value: isinstance(value, (int, float)),
    "list[Task]": are_names,
    "Failure": is_failure,
    "tuple[Waiting,": lambda value: isinstance(value, list) and all(isinstance(each, dict) for each in value),
}
