"""Visits: what Python code does to an interpreter without running a task.

The thread in which it is at work does that at once. Another one leaves an
errand, which is done between two steps. Where nothing is at work, whoever
comes is a visitor for a moment: who wants to run waits for its end, and is not
refused. So no two threads ever meet, and nobody who only leaves an errand waits.
"""

from __future__ import annotations

from eslang.base.hints import TYPE_CHECKING, Any, Callable

if TYPE_CHECKING:
    from eslang.runtime.runs import Runs

NOT_NOW = object()  # what a visit gives that cannot be made


class Errand:
    """What another thread wants to have done; whoever takes it from the errands of the run does it."""

    __slots__ = ("answer", "error", "on_end", "work")

    def __init__(self, work: Callable[[], Any], on_end: Callable[[Errand], object]) -> None:
        self.work = work
        self.on_end = on_end
        self.answer: Any = None
        self.error: BaseException | None = None

    def do(self) -> None:
        """Do it; only what Python raises to leave everything is raised here, too."""
        try:
            self.answer = self.work()
        except Exception as error:
            self.error = error
        except BaseException as error:
            self.error = error
            raise
        finally:
            self.on_end(self)


def visit(runs: Runs, work: Callable[[], Any]) -> Any:
    """What WORK gives, done at once; NOT_NOW if the interpreter is at work in another thread."""
    gate, scheduler = runs.gate, runs.scheduler
    if gate.is_ours():
        try:
            return work()
        finally:
            stir(runs)
    if not gate.let_in():
        return NOT_NOW
    try:
        if not scheduler.posted.empty():
            with runs.session.at_work():
                scheduler.take_posts()
        return work()
    finally:
        stir(runs)
        gate.let_out()
        runs.do_errands()


def stir(runs: Runs) -> None:
    """What was done outside of any task is to be noticed by those that it has woken, or may wake."""
    scheduler = runs.scheduler
    if scheduler.current is None and (scheduler.ready or scheduler.polls.waits) and scheduler.posted.empty():
        scheduler.post(lambda: None)


def leave_errand(runs: Runs, work: Callable[[], Any], on_end: Callable[[Errand], object]) -> Errand:
    """Let WORK be done between two steps; ON_END is called when that is over."""
    errand = Errand(work, on_end)

    def do() -> None:
        if runs.errands.pop(errand, False):
            errand.do()
            stir(runs)

    runs.errands[errand] = True
    runs.scheduler.post(do)
    runs.do_errands()
    return errand


def serve(runs: Runs) -> None:
    """Do the errands that nobody has done yet, if nothing is at work: who is will do them."""
    while runs.errands and runs.gate.let_in():
        try:
            with runs.session.at_work():
                runs.scheduler.take_posts()
                for errand in list(runs.errands):
                    if runs.errands.pop(errand, False):
                        errand.do()
            stir(runs)
        finally:
            runs.gate.let_out()


def send(runs: Runs, work: Callable[[], Any]) -> Any:
    """What WORK gives, done between two steps; the thread at hand waits for that."""
    from threading import Event

    over = Event()
    errand = leave_errand(runs, work, lambda errand: over.set())
    try:
        over.wait()
    finally:
        runs.errands.pop(errand, None)  # nobody waits for it any more
    error, errand.error = errand.error, None
    if error is None:
        return errand.answer
    try:
        raise error
    finally:
        del error  # which knows this frame
