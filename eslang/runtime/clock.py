"""Time: real, or virtual.

A virtual clock moves only when it is told to: to the next timer when all
tasks wait, and by a little for each time slice that a loop uses up. So a plan
that sleeps for hours on it is done at once, and the same way every time.
Seconds, from the start of the interpreter.
"""

from __future__ import annotations

import time

SLICE = 0.001  # virtual seconds that one time slice lasts


class VirtualClock:
    """Time that passes when nothing else can happen."""

    is_virtual = True

    def __init__(self) -> None:
        self._now = 0.0

    def now(self) -> float:
        return self._now

    def advance(self, moment: float) -> None:
        """Let it be MOMENT, unless it is later already."""
        self._now = max(self._now, moment)

    def use_slice(self) -> None:
        """A loop has used up one time slice."""
        self._now += SLICE


class RealClock:
    """The time on the wall."""

    is_virtual = False

    def __init__(self) -> None:
        self._start = time.monotonic()

    def now(self) -> float:
        return time.monotonic() - self._start

    def advance(self, moment: float) -> None:
        """Nobody can advance the time on the wall."""

    def use_slice(self) -> None:
        """It passes by itself."""


def wall_time() -> float:
    """Seconds since the beginning of 1970, in Greenwich."""
    return time.time()


Clock = VirtualClock | RealClock


def make_clock(kind: str) -> Clock:
    """The clock called KIND, `virtual` or `real`."""
    if kind not in ("virtual", "real"):
        raise ValueError(f"a clock is `virtual` or `real`, not `{kind}`")
    return VirtualClock() if kind == "virtual" else RealClock()
