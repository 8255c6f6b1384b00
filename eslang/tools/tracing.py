"""The listener behind `--trace FILE`: the events of a run as JSON lines.

One object a line: kind, time, task, form, and the parts of that kind of event
(runtime/kinds.py). The same run gives the same bytes: tasks and events stand
by their labels, other Lisp values as their printed text.
"""

from __future__ import annotations

import json
import re
import sys
from math import isfinite
from typing import Any, TextIO

from eslang.base.control import Failed
from eslang.base.failure import Failure
from eslang.base.lists import Cons
from eslang.base.printer import WriteSettings, prin1
from eslang.base.running import running
from eslang.base.symbols import Symbol, Value
from eslang.base.text import String
from eslang.runtime.deadlock import Waiting
from eslang.runtime.events import Event
from eslang.runtime.story import Place
from eslang.runtime.tasks import Task

FORMAT = 1
BRIEFLY = WriteSettings(length=24, level=6)
LONGEST = 400  # characters of a value's text
LARGEST = 2**63  # of numbers that stand as such
ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")
encode = json.JSONEncoder(ensure_ascii=False).encode


class Tracer:
    """Writes each event that it is told to a text stream."""

    def __init__(self, stream: TextIO, told: dict[str, Any]) -> None:
        self.stream = stream
        self.trouble: OSError | None = None  # why nothing more is written
        self._labels: dict[Event, str] = {}
        self._counts: dict[str, int] = {}
        self.write({"kind": "trace-begun", "format": FORMAT, **told})

    def __call__(self, event: Any) -> None:
        """Write EVENT as one line."""
        record = {
            "kind": event.kind,
            "time": round(event.time, 9),
            "task": None if event.task is None else event.task.name,
            "form": None if event.form is None else str(event.form),
        }
        for name, value in event.data.items():
            record[name] = self.plain(value)
        self.write(record)

    def close(self, time: float) -> None:
        """Write the line that says that the trace is whole; say so if it is not."""
        self.write({"kind": "trace-ended", "time": round(time, 9)})
        try:
            if self.stream is not sys.stdout:
                self.stream.close()
        except OSError as trouble:
            self.trouble = self.trouble or trouble
        if self.trouble is not None and not isinstance(self.trouble, BrokenPipeError):
            reason = (self.trouble.strerror or str(self.trouble)).lower()
            sys.stderr.write(f"esl: the trace could not be written: {reason}\n")

    def write(self, record: dict[str, Any]) -> None:
        """Write RECORD, unless the stream takes no more."""
        if self.trouble is None:
            try:
                self.stream.write(encode(record) + "\n")
            except OSError as trouble:
                self.trouble = trouble

    def plain(self, value: Any) -> Any:
        """VALUE as JSON has it: numbers and strings as themselves, failures as parts, the rest printed."""
        if value is None or (isinstance(value, int) and abs(value) < LARGEST):
            return value
        if isinstance(value, (str, String)):
            return shortened(value if isinstance(value, str) else value.text)
        if isinstance(value, float):
            return round(value, 9) if isfinite(value) else prin1(value)
        if isinstance(value, Event):
            return self.label(value)
        if isinstance(value, Failure):
            return self.failure(value)
        if isinstance(value, Place):
            return str(value)
        if isinstance(value, Waiting):
            return {name: self.plain(getattr(value, name)) for name in value._fields}
        if isinstance(value, (list, tuple)):
            return [self.plain(part) for part in value]
        return shown(value)

    def failure(self, failure: Failure) -> dict[str, Any]:
        """The parts of FAILURE: its cause, its arguments, and the task that it was passed on from."""
        parts = {
            "cause": shown(failure.cause),
            "arguments": [self.plain(argument) for argument in failure.values],
        }
        if failure.origin is not None:
            parts["from"] = failure.origin.name
        return parts

    def label(self, event: Event) -> str:
        """A name that only EVENT has."""
        if isinstance(event, Task):
            return event.name
        label = self._labels.get(event)
        if label is None:
            name = "event" if event.name is None else shown(event.name)
            count = self._counts[name] = self._counts.get(name, 0) + 1
            label = self._labels[event] = name if count == 1 else f"{name}.{count}"
        return label


def shown(value: Value) -> str:
    """The text of VALUE, not too long, and the same in every run."""
    if isinstance(value, Symbol) or running.session is None:
        return prin1(value)
    text = printed_apart(value, running.session.dynamic)
    return shortened(ADDRESS.sub("", text) if " at 0x" in text else text)


def printed_apart(value: Value, dynamic: Any) -> str:
    """The text of VALUE; a printer of the plan's own that fails does not disturb the plan."""
    forms, quiet = dynamic.forms, dynamic.quiet
    dynamic.forms, dynamic.quiet = None, True
    try:
        return prin1(value, BRIEFLY) if value.__class__ is Cons else prin1(value)
    except (Exception, Failed):
        return "#<unprintable>"
    finally:
        dynamic.forms, dynamic.quiet = forms, quiet


def shortened(text: str) -> str:
    """TEXT, or its beginning."""
    return text if len(text) <= LONGEST else text[:LONGEST] + "…"
