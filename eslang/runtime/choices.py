"""Choices: which of the tasks that are ready has its turn, where there is more than one.

A list of choices holds a name of a task for each such step. It may be given,
so that a run takes just this course; when it is at its end, the ready take
turns first in, first out. What was chosen is noted in the same form, however
it was chosen, so that any run can be had again.
"""

from __future__ import annotations

from eslang.base.control import Stop
from eslang.base.hints import TYPE_CHECKING, Any, Callable, Iterable, Sequence

if TYPE_CHECKING:
    from eslang.runtime.tasks import Task

WRONG = 65  # the exit code of a run that was told what it cannot do
Choose = Callable[[Sequence[Any]], int]  # the index of the one that is chosen among the ready


def first(ready: Sequence[Any]) -> int:
    """Nobody chooses: the first is the next."""
    return 0


class Choices:
    """Who chooses, and what was chosen so far."""

    def __init__(self, choose: Choose, stop: Callable[[Stop], None]) -> None:
        self.made: list[str] = []
        self._choose = choose
        self._stop = stop  # ends the run

    def __call__(self, ready: Sequence[Task]) -> int:
        """The index of the task of READY that is to have its turn; the step is noted."""
        index = self._choose(ready)
        if not 0 <= index < len(ready):
            self._stop(Stop(misfit(len(self.made) + 1, f"number {index}", ready), WRONG))
            self._choose, index = first, 0  # until all has ended
        self.made.append(ready[index].name)
        return index


class Course:
    """A list of choices that a run is to follow."""

    def __init__(self, names: Iterable[str], stop: Callable[[Stop], None]) -> None:
        self.names: list[str] = list(names)
        self._stop = stop
        self._count = 0

    def __call__(self, ready: Sequence[Task]) -> int:
        """The index of the one that the list names next; the first, at its end, or if it does not fit."""
        if self._count >= len(self.names):
            return 0
        name = self.names[self._count]
        self._count += 1
        for index, task in enumerate(ready):
            if task.name == name:
                return index
        self._stop(Stop(misfit(self._count, f"`{name}`", ready), WRONG))
        self._count = len(self.names)
        return 0


def misfit(step: int, chosen: str, ready: Sequence[Task]) -> str:
    """What is wrong where the choice of STEP is none of READY."""
    names = ", ".join(f"`{task.name}`" for task in ready)
    return f"choice {step} is {chosen}, which is not ready; ready are {names}"


def make_choices(session: Any, shuffled: bool, given: Choose | Iterable[str] | None) -> Choices | None:
    """Who chooses in SESSION: a function or a list, if GIVEN; chance, if SHUFFLED; else nobody does."""

    def stop(why: Stop) -> None:
        session.scheduler.ticks.stop(why)

    def by_chance(ready: Sequence[Task]) -> int:
        return int(session.chance.randrange(len(ready)))

    if callable(given):
        return Choices(given, stop)
    if given is not None:
        return Choices(Course(given, stop), stop)
    return Choices(by_chance, stop) if shuffled else None


def read_choices(text: str) -> list[str]:
    """The list of choices that TEXT holds: a name a line; blank lines, and those after a ;, are none."""
    lines = [line.strip() for line in text.split("\n")]
    return [line for line in lines if line and not line.startswith(";")]


def choices_text(names: Iterable[str]) -> str:
    """The list of choices NAMES as a file holds it."""
    return "".join(f"{name}\n" for name in names)
