"""What is told of a run, as lines that are the same for two runs that are the same."""

from __future__ import annotations

from typing import Any

from eslang.base.failure import Failure
from eslang.base.lists import Cons, items
from eslang.base.printer import prin1
from eslang.base.text import String
from eslang.runtime.events import Event
from eslang.runtime.tasks import Task


def line_of(event: Any) -> str:
    """EVENT as a line."""
    told = " ".join(f"{name}={word(value)}" for name, value in event.data.items())
    return f"{event.time} {word(event.task)} {event.kind} {word(event.form)} {told}"


def word(value: Any) -> str:
    """VALUE in words that name no address."""
    if isinstance(value, Task):
        return value.name
    if isinstance(value, Event | Failure | str | int | float) or value is None:
        return str(value)
    if isinstance(value, list | tuple):
        return f"({' '.join(map(word, value))})"
    if value.__class__ is Cons:
        return f"({' '.join(map(word, items(value)))})"
    if isinstance(value, String):
        return value.text
    if callable(value):
        return "a function"
    return prin1(value)
