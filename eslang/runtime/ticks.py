"""Ticks: how a loop that waits for nothing stays within reach.

Every round of every loop draws one tick. They come in slices, counted in C;
between two slices the task passes a safepoint, where others may have their
turn and a pending stop is obeyed. Each task has ticks of its own. A program
that calls functions without ever looping is stopped at its next call instead,
by a profiler hook that is in place only while a stop is pending.
"""

from __future__ import annotations

import sys
from itertools import chain, repeat
from types import FrameType

from eslang.base.control import Stop
from eslang.base.hints import Any, Callable, Iterable, Iterator

SLICE = 1000  # rounds between two safepoints


class Ticks:
    """The safepoints of one interpreter."""

    def __init__(self, safepoint: Callable[[], None]) -> None:
        self.pending: Stop | None = None  # what the run is to end with
        self.safepoint = safepoint
        self.watch_calls = True  # a pending stop is to be found at calls, too
        self._slices = self._slice
        self.source = self.make()  # what compiled loops iterate over

    def make(self) -> Iterator[None]:
        """The ticks of one task.

        A jump that leaves a safepoint must not use them up, since loops farther
        out draw from them: so it is raised by a part of the slice, not by the
        giver of slices. The inner chain gives the parts, so that a tick comes
        through the outer one alone.
        """
        return chain.from_iterable(chain.from_iterable(iter(self._slices, None)))

    def _slice(self) -> Iterable[Iterator[None]]:
        return repeat(None, SLICE), iter(self._pass, None)

    def _pass(self) -> None:
        self.source = self.make()  # these ticks are being drawn from, and may not be from elsewhere
        self.safepoint()

    def stop(self, stop: Stop) -> None:
        """Let the run end, soon; safe to call from a signal handler."""
        self.pending = stop
        if self.watch_calls:
            sys.setprofile(self._at_call)

    def take(self) -> Stop | None:
        """The pending stop, which the caller is to see to."""
        stop, self.pending = self.pending, None
        if stop is not None and self.watch_calls:
            sys.setprofile(None)
        return stop

    def _at_call(self, frame: FrameType, event: str, argument: Any) -> None:
        if event == "call" and self.pending is not None and "%many" in frame.f_globals:
            self.safepoint()
