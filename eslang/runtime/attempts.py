"""Attempts: work whose own failure is somebody else's news.

Who achieves a property for others (ARM §4) has to tell them when that fails;
a construct of SCS, which of its steps have failed.
The failure counts as that of the work if nothing inside answers it. What an
interrupt brings that belongs to something farther out, such as a deadline, is
no failure of the work: it goes outward, as if the work were not there.
"""

from __future__ import annotations

from eslang.base.control import Abort
from eslang.base.failure import GENERAL_FAILURE, Failure
from eslang.base.hints import Callable
from eslang.base.symbols import Value
from eslang.runtime import failures
from eslang.runtime.failures import Clause, Form
from eslang.runtime.tasks import Extent, Interrupt, Task


def attempt(task: Task, work: Callable[[], object]) -> Failure | None:
    """Let TASK, the current one, do WORK; the failure that it ends with, if it does."""

    def done() -> Value:
        work()
        return None

    failure: Failure | None = outcome(task, done)
    return failure


def outcome(task: Task, work: Callable[[], Value]) -> Value:
    """Let TASK, the current one, do WORK; what that gives, or the failure that it ends with."""
    form, before = Form(), len(task.obeying)

    def is_own(failure: Failure) -> bool:
        return not any(comes_from_outside(each, form) for each in task.obeying[before:])

    def take(failure: Value) -> Value:
        raise Abort(form, failure)

    clause = Clause(GENERAL_FAILURE, None, None, is_own)
    return failures.run_form(form, (clause,), (take,), work)


def comes_from_outside(interrupt: Interrupt, form: Form) -> bool:
    """True if INTERRUPT belongs to nothing that was entered inside FORM."""
    extent = interrupt.extent
    return not extent.is_within(form) if isinstance(extent, Extent) else extent is None
