"""Timers: what is to happen when a moment has come.

A heap of moments; of two at the same moment, the one that was set first is
first. A timer that is called off stays in the heap until it is due, or until
most of the heap is of that kind. What a timer does is its owner's matter.
"""

from __future__ import annotations

from _heapq import heapify, heappop, heappush

from eslang.base.hints import Callable

FEW = 64  # timers called off that are never worth a clearing


class Timer:
    """Something that is due at a moment, unless it is called off before."""

    __slots__ = ("action", "moment")

    def __init__(self, moment: float, action: Callable[[], None]) -> None:
        self.moment = moment
        self.action: Callable[[], None] | None = action


class Timers:
    """All timers of one scheduler."""

    __slots__ = ("_count", "_off", "heap")

    def __init__(self) -> None:
        self.heap: list[tuple[float, int, Timer]] = []
        self._count = 0
        self._off = 0  # how many in the heap were called off

    def __len__(self) -> int:
        return len(self.heap) - self._off

    def set(self, moment: float, action: Callable[[], None]) -> Timer:
        """Let ACTION happen at MOMENT."""
        timer = Timer(moment, action)
        self._count += 1
        heappush(self.heap, (moment, self._count, timer))
        return timer

    def call_off(self, timer: Timer) -> None:
        """Let TIMER not happen, if it has not happened yet."""
        if timer.action is None:
            return
        timer.action = None
        self._off += 1
        if self._off > FEW and self._off * 2 > len(self.heap):
            self.heap = [entry for entry in self.heap if entry[2].action is not None]
            heapify(self.heap)
            self._off = 0

    def next_moment(self) -> float | None:
        """When the next timer is due; None if there is none."""
        heap = self.heap
        while heap and heap[0][2].action is None:
            heappop(heap)
            self._off -= 1
        return heap[0][0] if heap else None

    def fire(self, now: float) -> bool:
        """Do what is due at NOW, in order; true if anything was."""
        fired = False
        while True:
            moment = self.next_moment()
            if moment is None or moment > now:
                return fired
            action, timer = None, heappop(self.heap)[2]
            action, timer.action = timer.action, None
            if action is not None:
                action()
            fired = True
