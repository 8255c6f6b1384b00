"""Time: real, or virtual.

A virtual clock moves only when it is told to; a plan that sleeps for hours on
it is done at once, and the same way every time. Seconds, from the start of
the interpreter.
"""

from __future__ import annotations

import time


class VirtualClock:
    """Time that passes when somebody sleeps."""

    def __init__(self) -> None:
        self._now = 0.0

    def now(self) -> float:
        return self._now

    def sleep(self, seconds: float) -> None:
        """Let SECONDS pass."""
        self._now += max(0.0, seconds)


class RealClock:
    """The time on the wall."""

    def __init__(self) -> None:
        self._start = time.monotonic()

    def now(self) -> float:
        return time.monotonic() - self._start

    def sleep(self, seconds: float) -> None:
        """Wait until SECONDS have passed."""
        time.sleep(max(0.0, seconds))


def make_clock(kind: str) -> VirtualClock | RealClock:
    """The clock called KIND, `virtual` or `real`."""
    if kind not in ("virtual", "real"):
        raise ValueError(f"a clock is `virtual` or `real`, not `{kind}`")
    return VirtualClock() if kind == "virtual" else RealClock()
