"""Doors: what is set while Python code calls an interpreter, and set back afterwards."""

from __future__ import annotations

import sys

from eslang.base.border import leave
from eslang.base.failure import Failure
from eslang.base.hints import TYPE_CHECKING, Any
from eslang.base.running import running
from eslang.ctrl_c import CtrlC

if TYPE_CHECKING:
    from eslang.interpreter import Interpreter


class AtWork:
    """Sets the interpreter at work, and sets back the one that was."""

    __slots__ = ("before", "interpreter")

    def __init__(self, interpreter: Interpreter) -> None:
        self.interpreter = interpreter
        self.before: Any = None

    def __enter__(self) -> None:
        self.before, running.session = running.session, self.interpreter

    def __exit__(self, *error: object) -> None:
        running.session = self.before


class Door(AtWork):
    """The same for Python code: a failure leaves with arguments as Python has them.

    Ctrl-C ends what it calls, with its cleanups; and what a call inside a
    running asyncio loop leaves alive goes on in that loop.
    """

    __slots__ = ("keys",)

    def __enter__(self) -> None:
        AtWork.__enter__(self)
        self.keys: CtrlC | None = None
        if not self.interpreter.runs.gate.is_closed():
            self.keys = CtrlC(self.interpreter.interrupt).__enter__()

    def __exit__(self, *error: object) -> None:
        running.session = self.before
        if isinstance(error[1], Failure):
            leave(error[1])
        if self.keys is not None:
            runs = self.interpreter.runs
            if "asyncio" in sys.modules and runs.lives.tops and runs.gate.is_here():
                self.interpreter.outside.offer_turns()
            if self.keys.asked:
                self.interpreter.ticks.take()  # it may have come too late for what ran
            self.keys.__exit__(*error)
