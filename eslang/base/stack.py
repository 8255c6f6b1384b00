"""The end of the stack, and room beyond it for what answers a failure that came of reaching it.

Recovery procedures, and the cleanups that a jump then passes, run where the
stack is full. So the limit is raised when a task has reached it, and lowered
again once the stack has unwound so far that nothing needs the room.
"""

from __future__ import annotations

import sys

HEADROOM = 20_000  # frames
SHARE = 20  # the part of the limit that must be free before it is lowered again
ROOM = 200  # frames: more than what is done whole has inside one another
MOST = 3  # how often the limit is raised before it is lowered again


class Stack:
    """The limit of this process's stack, and how often it was raised."""

    __slots__ = ("limit", "raised")

    def __init__(self) -> None:
        self.raised = 0
        self.limit = 0  # as it was before

    def make_room(self) -> None:
        """Raise the limit."""
        if not self.raised:
            self.limit = sys.getrecursionlimit()
        if self.raised < MOST:
            sys.setrecursionlimit(sys.getrecursionlimit() + HEADROOM)
            self.raised += 1

    def give_back(self) -> None:
        """Lower the limit to where it was, unless the stack is still near it."""
        if is_below(self.limit - self.limit // SHARE):
            sys.setrecursionlimit(self.limit)
            self.raised = 0


STACK = Stack()


def require_room() -> None:
    """Raise RecursionError now, not amid what must be done whole, if the stack has little room left."""
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(limit - ROOM)  # Python refuses what is below the depth at hand
    sys.setrecursionlimit(limit)


def is_nearly_full() -> bool:
    """True if most of the stack is used."""
    return not is_below(sys.getrecursionlimit() * 7 // 8)


def is_below(depth: int) -> bool:
    """True if the stack is less than DEPTH frames deep."""
    limit = sys.getrecursionlimit()
    try:
        sys.setrecursionlimit(depth)  # Python refuses what is below the depth at hand
    except RecursionError:
        return False
    sys.setrecursionlimit(limit)
    return True
