"""Programs of SCS by chance, run by the interpreter: what they note, and how they end."""

from __future__ import annotations

import sys
from collections.abc import Callable
from io import StringIO
from typing import Any

from circuits.writer import PREAMBLE, Writer, effect
from eslang import Interpreter
from naive.circuit_runs import TICK, Effects, Run
from naive.steps import Steps, World
from trees.telling import line_of

PLAN = """
(with-recovery-procedures ((:general-failure
                            (abort (list* :failed (failure-cause) (failure-arguments)))))
  (list :came {form}))
"""
LIMIT = 24  # actions
END: Effects = (("assert", "over"),)


def limited(term: Any) -> Any:
    """TERM, until it is over."""
    return Steps("do", False, (("until", ("fact", "over")),), (term,))


class Stage:
    """One interpreter on which programs are run, one after the other."""

    def __init__(self) -> None:
        limit = sys.getrecursionlimit()
        self.interp = Interpreter(clock="virtual", output=StringIO())
        sys.setrecursionlimit(limit)
        self.notes: list[str] = []
        self.told: list[str] = []  # what listeners hear
        self.entered: Any = None  # the world that is defined
        self.interp.primitive(name="note", signature="(note &rest words)", outside=False)(self.note)
        self.interp.eval(PREAMBLE)
        self.interp.hooks.listeners.append(lambda event: self.told.append(line_of(event)))

    def note(self, *words: Any) -> None:
        """Leave a trace."""
        self.notes.append("".join(str(word).lower() for word in words))

    def prepare(self, program: Any) -> str:
        """Define PROGRAM as a plan, and what it needs; how it is written."""
        writer = Writer(program)
        text = "\n".join([*writer.definitions, f"(defun plan () {PLAN.format(form=writer.form)})"])
        self.interp.eval(text)
        return text

    def run(self, world: World, changes: tuple[Effects, ...], seed: int | None = None) -> Run:
        """Run the plan that is defined, in WORLD, which CHANGES."""
        self.enter(world, changes)
        if seed is not None:
            self.interp.chance.seed(seed)
        self.interp.call("set-up")
        self.notes, self.told = [], []
        came = self.interp.call("run-plan")
        self.interp.finish()
        return ending(tuple(self.notes), came)

    def enter(self, world: World, changes: tuple[Effects, ...]) -> None:
        """Define WORLD, and how it CHANGES, if that is not yet so."""
        if self.entered == (world, changes):
            return
        self.entered = world, changes
        script = (f'(sleep 1) (note "{TICK}") {" ".join(map(effect, effects))}' for effects in changes)
        facts = [effect(("assert", *fact)) for fact in sorted(world.facts)]
        self.interp.eval(
            f"""(defun set-up ()
                  (retract '(p)) (retract '(q)) (retract '(lit)) (retract '(over)) (retract '(at ?place))
                  (setq *x* {world.x} *left* {world.left}) {" ".join(facts)})
                (defun run-plan () (spawn (progn {" ".join(script)}) :daemon t) (plan))"""
        )


def ending(notes: tuple[str, ...], came: list[Any]) -> Run:
    """How a run ended, as the reference says it."""
    word, what = str(came[0]), came[1]
    if word == ":FAILED":
        return Run(notes, "failed", failure(came[1:]))
    if str(what) == ":DEACTIVATED":
        return Run(notes, "off")
    return Run(notes, "ok", what if what is None or isinstance(what, str) else "t")


def failure(parts: list[Any]) -> Any:
    """A failure, as the reference says it."""
    cause, *arguments = parts
    if str(cause) == ":ALL-SUBTASKS-FAILED":
        return ("all", *map(failure, arguments[0]))
    return (str(cause).lower().strip(":"), *arguments)


class Script:
    """Stands in for chance: makes the choices that it is told, and then always the first."""

    def __init__(self, choices: list[int]) -> None:
        self.choices = choices
        self.counts: list[int] = []  # among how many each was made

    def randrange(self, count: int) -> int:
        """The next choice."""
        if len(self.counts) == len(self.choices):
            self.choices.append(0)
        self.counts.append(count)
        return self.choices[len(self.counts) - 1]

    def shuffle(self, listed: list[Any]) -> None:
        """Put LISTED into an order that is chosen."""
        for last in range(len(listed) - 1, 0, -1):
            other = self.randrange(last + 1)
            listed[last], listed[other] = listed[other], listed[last]

    def next(self) -> list[int] | None:
        """The choices of the next run; nothing, if all were made."""
        choices = list(self.choices)
        while choices and choices[-1] == self.counts[len(choices) - 1] - 1:
            choices.pop()
        return [*choices[:-1], choices[-1] + 1] if choices else None


def every_choice(run: Callable[[], Run], chance: Any, most: int) -> set[Run] | None:
    """All that RUN comes to, whatever chance does; nothing, if that takes more than MOST runs."""
    found: set[Run] = set()
    choices: list[int] | None = []
    for _ in range(most):
        assert choices is not None
        script = Script(choices)
        chance.randrange, chance.shuffle = script.randrange, script.shuffle
        try:
            found.add(run())
        finally:
            del chance.randrange, chance.shuffle
        choices = script.next()
        if choices is None:
            return found
    return None
