"""The listener behind `--trace FILE`: the events of a run as JSON lines.

One object a line: kind, time, task, form, and what the kind of event tells.
Lisp values stand as their printed text, numbers and strings as themselves.
"""

from __future__ import annotations

import json
from math import isfinite
from typing import Any, TextIO

from eslang.base.failure import Failure
from eslang.base.printer import prin1
from eslang.base.text import String
from eslang.runtime.story import Place


class Tracer:
    """Writes each event it is told to a text stream."""

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream

    def __call__(self, event: Any) -> None:
        """Write EVENT as one line."""
        record = {
            "kind": event.kind,
            "time": event.time,
            "task": plain(event.task),
            "form": plain(event.form),
        }
        for name, value in (event.data or {}).items():
            record[name] = plain(value)
        self.stream.write(json.dumps(record, ensure_ascii=False) + "\n")


def plain(value: Any) -> Any:
    """VALUE as JSON has it: numbers and strings as themselves, a failure as its parts, the rest printed."""
    if value is None or isinstance(value, (int, str)):
        return value
    if isinstance(value, Place):
        return str(value)
    if isinstance(value, float):
        return value if isfinite(value) else prin1(value)
    if isinstance(value, String):
        return value.text
    if isinstance(value, Failure):
        return {"cause": prin1(value.cause), "arguments": [plain(argument) for argument in value.arguments]}
    return prin1(value)
