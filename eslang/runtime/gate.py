"""The gate of an interpreter: closed while anything of it is on a stack, from outside in.

It also knows at home in which of Python's threads the interpreter is: that in
which its tasks have their stacks. The numbers of threads are used again; the
mark that each has here is not, and goes when the thread goes. While the gate
is open, a visitor may come in for a moment (visits.py); who wants to close it
meanwhile waits until the visitor has gone.
"""

from __future__ import annotations

import sys
from _thread import _local as ThreadLocal
from _thread import allocate_lock
from _weakref import ref

from eslang.base.hints import Any


class Mark:
    """What one thread is known by."""

    __slots__ = ("__weakref__",)


class Here(ThreadLocal):
    """The mark of the thread at hand."""

    def __init__(self) -> None:
        self.mark = Mark()


HERE = Here()


class Gate:
    """Whether an interpreter is at work, and where it is at home."""

    __slots__ = ("_closed_by", "_entrance", "_home", "_lock", "_visitor")

    def __init__(self) -> None:
        self._lock = allocate_lock()
        self._entrance = allocate_lock()  # whoever is in it closes the gate, or is a visitor
        self._closed_by: Mark | None = None
        self._visitor: Mark | None = None
        self.move_here()

    def is_closed(self) -> bool:
        """True if it is closed."""
        return self._lock.locked()

    def close(self) -> bool:
        """Close it, as soon as a visitor of another thread has gone; false if it was closed already."""
        if self._visitor is HERE.mark:
            return False
        with self._entrance:
            if not self._lock.acquire(False):
                return False
            self._closed_by = HERE.mark
            return True

    def open(self) -> None:
        """Open it again."""
        self._closed_by = None
        self._lock.release()

    def is_ours(self) -> bool:
        """True if the thread at hand has closed it, or is visiting."""
        return self._closed_by is HERE.mark or self._visitor is HERE.mark

    def let_in(self, patient: bool = False) -> bool:
        """Let the thread at hand be a visitor; false if the gate is closed or, unless PATIENT, in use."""
        if not self._entrance.acquire(patient):
            return False
        if self._lock.locked():
            self._entrance.release()
            return False
        self._visitor = HERE.mark
        return True

    def let_out(self) -> None:
        """The visitor goes."""
        self._visitor = None
        self._entrance.release()

    def move_here(self) -> None:
        """Be at home in the thread at hand."""
        self._home = ref(HERE.mark)

    def is_here(self) -> bool:
        """True if it is at home in the thread at hand."""
        return self._home() is HERE.mark

    def is_homeless(self) -> bool:
        """True if the thread in which it was at home is gone."""
        return self._home() is None


def stack_here() -> Any:
    """The stack at hand, a greenlet; None if it is the thread's own."""
    greenlet = sys.modules.get("greenlet")
    here = None if greenlet is None else greenlet.getcurrent()
    return None if here is None or here.parent is None else here
