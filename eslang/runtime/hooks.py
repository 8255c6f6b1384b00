"""What the kernel tells whoever asks.

The kernel prints nothing. A listener is a callable that gets Event objects;
where nobody listens, nothing is made and nothing is paid. What is told, and
with which parts, stands in kinds.py.
"""

from __future__ import annotations

from eslang.base.hints import Any, Callable, NamedTuple


class Event(NamedTuple):
    """Something that happened: its kind, when, in which task, at which form, and more."""

    kind: str
    time: float
    task: Any
    form: Any  # where in the source: a Place, or None
    data: dict[str, Any]


Listener = Callable[[Event], object]
SPOKEN = ("recovery", "failure", "aborted", "goal")  # the kinds of which the papers print a line


class Hooks:
    """The listeners of one interpreter.

    The `speakers` hear only of what the papers print, so that a run which
    prints that does not pay for all the rest.
    """

    __slots__ = ("current", "listeners", "now", "speakers")

    def __init__(self, now: Callable[[], float], current: Callable[[], Any]) -> None:
        self.listeners: list[Listener] = []
        self.speakers: list[Listener] = []
        self.now = now
        self.current = current  # the task whose turn it is

    def tell(self, kind: str, form: Any = None, **data: Any) -> None:
        """Tell every listener. Callers ask `if hooks.listeners` first where it must cost nothing."""
        event = Event(kind, self.now(), self.current(), form, data)
        if self.speakers and kind in SPOKEN:
            for speaker in list(self.speakers):
                speaker(event)
        for listener in list(self.listeners):
            listener(event)
