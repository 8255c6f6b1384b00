"""How a plan of tasks is run: on virtual time, with all that is told of it kept, and what comes between."""

from __future__ import annotations

from collections.abc import Callable
from io import StringIO
from typing import Any

from eslang import Failure, Interpreter
from eslang.base.control import Stop
from trees.telling import line_of
from trees.words import PREAMBLE

MOST = 60_000  # events of one run; a plan that tells more goes on for ever
Injection = Callable[["Run"], None]


class Run:
    """One interpreter, the plans that it runs, and what came of the last one."""

    def __init__(self, *, shuffle: bool = False, seed: int = 0) -> None:
        self.output = StringIO()
        self.interp = Interpreter(clock="virtual", output=self.output, shuffle=shuffle, seed=seed)
        for signature, function in (
            ("(note &rest words)", self.note),
            ("(through function)", self.through),
            ("(python-error)", self.python_error),
        ):
            name = signature.strip("()").split()[0]
            self.interp.primitive(name=name, signature=signature, outside=False)(function)
        self.interp.eval(PREAMBLE)
        self.interp.hooks.listeners.append(self.hear)
        self.begin()

    def begin(self) -> None:
        """Forget what came of the plan before."""
        self.notes: list[tuple[Any, ...]] = []
        self.lines: list[str] = []  # the notes, each with its time
        self.told: list[str] = []
        self.tasks: list[Any] = []
        self.heard = 0
        self.outcome = ""
        self.too_long = False
        self.at: dict[int, Injection] = {}  # what is to happen between two steps, behind which event
        self.at_note: dict[int, Injection] = {}  # what the running task is to do itself, before which note

    # --- what plans call -----------------------------------------------------------

    def note(self, *words: Any) -> None:
        """Leave a trace."""
        injection = self.at_note.get(len(self.notes) + 1)
        if injection is not None:
            injection(self)
        self.notes.append(tuple(str(word) for word in words))
        self.lines.append(" ".join([f"{self.interp.clock.now():g}", *self.notes[-1]]))

    def through(self, function: Any) -> Any:
        """Call back."""
        return self.interp.call(function)

    def python_error(self) -> None:
        """Fail as Python does."""
        raise ValueError("ours")

    # --- what is told ----------------------------------------------------------------

    def hear(self, event: Any) -> None:
        """Keep EVENT as a line."""
        self.heard += 1
        if event.kind == "task-started":
            self.tasks.append(event.data["about"])
        self.told.append(line_of(event))
        injection = self.at.get(self.heard)
        if injection is not None:
            self.interp.scheduler.post(lambda: injection(self))
        if self.heard == MOST:
            self.too_long = True
            self.interp.interrupt("this plan does not end")

    # --- running -------------------------------------------------------------------

    def evaluate(self, text: str) -> Run:
        """Run TEXT, and let the run end."""
        return self._ended(lambda: self.interp.eval(text))

    def call(self, name: str) -> Run:
        """Run the plan that is called NAME, and let the run end."""
        return self._ended(lambda: self.interp.call(name))

    def _ended(self, work: Callable[[], Any]) -> Run:
        self._ended_by(work)
        self._ended_by(self._finish)
        while not self.interp.scheduler.posted.empty():  # an injection behind the last event
            self._ended_by(self._finish)
        return self

    def _finish(self) -> None:
        with self.interp.door():
            self.interp.scheduler.take_posts()
            self.interp.runs.finish()

    def _ended_by(self, work: Callable[[], Any]) -> None:
        try:
            self.outcome += f" {work()}"
        except Failure as failure:
            self.outcome += f" {failure}"
        except Stop as stop:
            self.outcome += f" stopped: {stop.reason}"


def trace_of(plan: str, **given: Any) -> list[str]:
    """What PLAN notes, each with its time, and what came of it. Nothing may be left of it."""
    from trees.remains import remains

    run = Run(**given).evaluate(plan)
    left = remains(run)
    assert not left, left
    return [*run.lines, run.outcome.removesuffix(" None").strip()]


def abort(number: int) -> Injection:
    """Abort the task that began as NUMBER."""

    def do(run: Run) -> None:
        if number < len(run.tasks):
            task, scheduler = run.tasks[number], run.interp.scheduler
            scheduler.lives.abort(task, "abort-task")
            if task is scheduler.current:
                scheduler.attend(task)

    return do


def interrupt(number: int, action: Callable[[Run], object]) -> Injection:
    """Let the task that began as NUMBER do ACTION where it stands."""

    def do(run: Run) -> None:
        from eslang.runtime.tasks import Interrupt

        if number < len(run.tasks):
            task, scheduler = run.tasks[number], run.interp.scheduler
            scheduler.interrupt(task, Interrupt("interrupt-task", lambda: action(run)))
            if task is scheduler.current:
                scheduler.attend(task)

    return do


def stop(run: Run) -> None:
    """End the whole run."""
    run.interp.runs.stop(Stop("stopped", 3))


def nothing(run: Run) -> None:
    """Do nothing."""


def fail(run: Run) -> None:
    """Fail."""
    run.interp.call("fail", ":injected")
