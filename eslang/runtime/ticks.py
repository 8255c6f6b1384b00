"""Ticks: how a loop that waits for nothing stays within reach.

Every round of every loop draws one tick. They come in slices, counted in C;
between two slices the task passes a safepoint, where a pending stop is obeyed.
A program that calls functions without ever looping is stopped at its next
call instead, by a profiler hook that is in place only while a stop is pending.
"""

from __future__ import annotations

import sys
from itertools import chain, repeat
from types import FrameType

from eslang.base.control import Stop
from eslang.base.hints import Any, Iterable, Iterator

SLICE = 1000  # rounds between two safepoints


class Ticks:
    """The safepoints of one interpreter."""

    def __init__(self) -> None:
        self.pending: Stop | None = None
        self.held = 0  # cleanups that are under way: a stop waits for them
        self.source: Iterator[None] = self._make()  # what compiled loops iterate over

    def _make(self) -> Iterator[None]:
        return chain.from_iterable(iter(self._slice, None))

    def _slice(self) -> Iterable[None]:
        self.safepoint()
        return repeat(None, SLICE)

    def safepoint(self) -> None:
        """Obey a pending stop."""
        if self.pending is not None and not self.held:
            stop, self.pending = self.pending, None
            sys.setprofile(None)
            self.source = self._make()
            raise stop

    def stop(self, stop: Stop) -> None:
        """Stop what runs, soon; safe to call from a signal handler."""
        self.pending = stop
        self.source = self._make()
        sys.setprofile(self._at_call)

    def forget(self) -> None:
        """Forget a stop that nothing has obeyed: what was to be stopped has ended."""
        if self.pending is not None:
            self.pending = None
            sys.setprofile(None)

    def _at_call(self, frame: FrameType, event: str, argument: Any) -> None:
        if event == "call" and "%many" in frame.f_globals:
            self.safepoint()
