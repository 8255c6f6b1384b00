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
from eslang.base.running import running
from eslang.base.symbols import Value
from eslang.runtime import failures
from eslang.runtime.failures import Clause, Form
from eslang.runtime.tasks import Extent, Interrupt, Task


class Unsuccessful:
    """That some work has failed, which is no value of Lisp, as a failure may be."""

    __slots__ = ("failure",)

    def __init__(self, failure: Failure) -> None:
        self.failure = failure


def attempt(task: Task, work: Callable[[], object]) -> Failure | None:
    """Let TASK, the current one, do WORK; the failure that it ends with, if it does."""
    found = outcome(task, work)
    return found.failure if found.__class__ is Unsuccessful else None


def outcome(task: Task, work: Callable[[], Value]) -> Value:
    """Let TASK, the current one, do WORK; what that gives, or Unsuccessful if it fails."""
    form, before = Form(), len(task.obeying)

    def is_own(failure: Failure) -> bool:
        return not any(comes_from_outside(each, form) for each in task.obeying[before:])

    def take(failure: Failure) -> None:
        if is_answering(task, form):
            raise Abort(form, Unsuccessful(failure))

    clause = Clause(GENERAL_FAILURE, None, None, is_own)
    return failures.run_form(form, (clause,), (take,), work)


def noticed(work: Callable[[], Value], note: Callable[[], None]) -> Value:
    """Do WORK, the whole of a task; NOTE that it fails before anything is unwound."""
    form, task = Form(), running.session.scheduler.at_work()

    def hear(failure: Failure) -> None:
        if is_answering(task, form):
            note()

    clause = Clause(GENERAL_FAILURE, None, None, lambda failure: True)
    return failures.run_form(form, (clause,), (hear,), work)


def is_answering(task: Task, form: Form) -> bool:
    """True if a failure has come to FORM; others hear of what is no failure, too, such as a warning."""
    answering = task.dynamic.answering
    return bool(answering) and answering[-1][1] is form


def comes_from_outside(interrupt: Interrupt, form: Form) -> bool:
    """True if INTERRUPT belongs to nothing that was entered inside FORM."""
    extent = interrupt.extent
    return not extent.is_within(form) if isinstance(extent, Extent) else extent is None
