"""What the kernel tells whoever asks.

The kernel prints nothing. A listener is a callable that gets Event objects;
where nobody listens, nothing is made and nothing is paid.
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


class Hooks:
    """The listeners of one interpreter."""

    __slots__ = ("current", "listeners", "now")

    def __init__(self, now: Callable[[], float], current: Callable[[], Any]) -> None:
        self.listeners: list[Listener] = []
        self.now = now
        self.current = current  # the task whose turn it is

    def tell(self, kind: str, form: Any = None, **data: Any) -> None:
        """Tell every listener. Callers ask `if hooks.listeners` first where it must cost nothing."""
        event = Event(kind, self.now(), self.current(), form, data)
        for listener in list(self.listeners):
            listener(event)
