"""Ctrl-C in a program that embeds us and leaves Ctrl-C to Python.

Python would raise KeyboardInterrupt wherever our code happens to stand. While
a plan is at work the wish is noted instead, and obeyed between two steps, with
all cleanups; then KeyboardInterrupt is raised where Python called us. Only
Python code that a primitive runs is interrupted at once, as everywhere else.
Whoever asks twice is not kept waiting.
"""

from __future__ import annotations

import _signal as signal  # type: ignore[import-not-found]  # without the enumerations that signal brings
from types import FrameType

from eslang.base.hints import Any, Callable


class CtrlC:
    """While entered, Ctrl-C calls ASK; KeyboardInterrupt is raised at the exit."""

    __slots__ = ("_before", "ask", "asked")

    def __init__(self, ask: Callable[[], None]) -> None:
        self.ask = ask
        self.asked = False
        self._before: Any = None

    def __enter__(self) -> CtrlC:
        before = signal.getsignal(signal.SIGINT)
        if before is signal.default_int_handler or isinstance(getattr(before, "__self__", None), CtrlC):
            try:
                signal.signal(signal.SIGINT, self._on_interrupt)
                self._before = before
            except ValueError:
                pass  # signals are the affair of another thread
        return self

    def __exit__(self, *error: object) -> None:
        if self._before is not None:
            signal.signal(signal.SIGINT, self._before)
        if self.asked:
            raise KeyboardInterrupt from None

    def _on_interrupt(self, number: int, frame: FrameType | None) -> None:
        if self.asked or is_in_primitive(frame):
            raise KeyboardInterrupt
        self.asked = True
        self.ask()


def is_in_primitive(frame: FrameType | None) -> bool:
    """True if FRAME runs Python code that a primitive called, and that is not ours."""
    foreign = False
    while frame is not None:
        name = str(frame.f_globals.get("__name__", ""))
        if name.startswith("eslang.") or "%many" in frame.f_globals:
            return foreign and name == "eslang.base.calls"
        foreign, frame = True, frame.f_back
    return False
