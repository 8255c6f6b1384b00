"""Jumps that cross frames.

Retry, Abort, NextBindings, Throw and their like are one family: each names
its target, only the target catches it, and no `except Exception` sees it.
A jump made in answer to a failure is `failed` from the point of failure
outward: that is when cleanup procedures run (language reference §2).
"""

from __future__ import annotations

from eslang.base.symbols import Value


class Unwind(BaseException):
    """A jump out to TARGET, a place that is still on the stack."""

    failed = False

    def __init__(self, target: object, value: Value = None) -> None:
        self.target = target
        self.value = value


class ReturnFrom(Unwind):
    """RETURN-FROM out of a closure, to the block's token."""


class Go(Unwind):
    """GO out of a closure; the value is the number of the tag."""


class Throw(Unwind):
    """THROW to a catch."""


class Retry(Unwind):
    """Back to the start of the body that the recovery procedure belongs to.

    It is made often, so its target is what Python's own exceptions hold.
    """

    __init__ = BaseException.__init__
    value = None

    @property
    def target(self) -> object:  # type: ignore[override]
        """The form."""
        return self.args[0]


class Abort(Unwind):
    """Return from the form that the recovery procedure belongs to."""


class NextBindings(Unwind):
    """Back to the start of the body of a WITH-QUERY-BINDINGS form; the value is the next solution."""


class Deactivated(Unwind):
    """A construct of SCS is left, since what it rests on does not hold any more. The target is its level."""

    failed = True  # what is inside is cleaned up


class RetryNow(Retry):
    """What a recovery procedure returns whose last form is (retry): the jump, made in answer to a failure."""

    failed = True


class AbortNow(Abort):
    """The same for (abort)."""

    failed = True


class Failed(Unwind):
    """A failure that nothing answered, on its way out of its task."""

    def __init__(self, failure: Exception) -> None:
        super().__init__(None, failure)
        self.failed = True


class EndTask(Unwind):
    """A task was aborted: it leaves everything, with its cleanups. The target is the task."""

    failed = True


class Stop(Unwind):
    """The run is to end: Ctrl-C, the time limit, (quit)."""

    def __init__(self, reason: str, code: int) -> None:
        super().__init__(None)
        self.reason = reason
        self.code = code
        self.failed = True


class Exit:
    """What a block, tagbody or catch leaves on the stack to be jumped to."""

    __slots__ = ("live",)

    def __init__(self) -> None:
        self.live = True
