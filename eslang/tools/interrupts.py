"""Ctrl-C, the time limit, and turns for all: what reaches a plan from the clock and the keys.

A request to end only sets the interpreter's flag; it ends the evaluation with
its cleanups. Whoever loses patience and asks again, and a time limit that the
cleanups outlast, ends the whole command at once. A task that calls functions
without ever looping passes no safepoint: now and then the processor's clock
makes it pass one at its next call.
"""

from __future__ import annotations

import _signal as signal  # type: ignore[import-not-found]  # without the enumerations that signal brings
import os
import sys
from types import FrameType

from eslang.base.control import Stop
from eslang.base.hints import Any

INTERRUPTED, TIME_LIMIT = 130, 124
GRACE = 5.0  # seconds that cleanups have after the time limit
PATIENCE = 3  # at a prompt, Ctrl-C may be pressed so often before it ends the session
STRETCH = 0.01  # seconds of processor time after which a task that only calls lets others have their turn
ENTRY = (lambda: None).__code__.co_code[0]  # the instruction at which every function begins


class Interrupts:
    """While entered, Ctrl-C and the time limit ask the interpreter to stop; `code` is who asked.

    At a prompt they are gentle: between two forms the first Ctrl-C is not
    meant for the tasks that go on; it only wakes who is RESTING.
    """

    def __init__(
        self, interp: Any, limit: float | None = None, patience: int = 1, *, gentle: bool = False
    ) -> None:
        self.interp = interp
        self.limit = limit
        self.patience = patience  # requests after which the next one ends the command at once
        self.gentle = gentle
        self.resting = False
        self.asked = 0
        self.code: int | None = None
        self._before: Any = None

    def __enter__(self) -> Interrupts:
        self._before = signal.signal(signal.SIGINT, self._on_interrupt)
        if self.limit is not None:
            signal.signal(signal.SIGALRM, self._on_limit)
            signal.setitimer(signal.ITIMER_REAL, self.limit, GRACE)
        return self

    def __exit__(self, *_: object) -> None:
        if self.limit is not None:
            signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGINT, self._before)
        self.interp.ticks.take()  # a request that came too late for what ran

    def _on_interrupt(self, number: int, frame: FrameType | None) -> None:
        self._ask("interrupted", INTERRUPTED)

    def _on_limit(self, number: int, frame: FrameType | None) -> None:
        self._ask(f"the time limit of {self.limit:g} s is over", TIME_LIMIT)

    def _ask(self, reason: str, code: int) -> None:
        if self.asked >= self.patience:
            leave_at_once(reason, self.code or code)
        self.asked += 1
        self.code = code
        if not self.gentle or self.asked > 1 or self.interp.runs.root is not None:
            self.interp.ticks.stop(Stop(reason, code))  # also what is still being read, before any task
            self.interp.scheduler.post(lambda: None)  # whoever rests is to look
        elif self.resting:
            raise KeyboardInterrupt


class Turns:
    """While entered, no task keeps the others from their turns, or a stop from being obeyed, by calls alone.

    Only at the entry of a function of the plan, which might as well wait
    there, is the task made to pass a safepoint; anywhere else the next stretch
    is awaited. On virtual time the order of tasks is not the processor's
    affair, and only a pending stop counts.
    """

    def __init__(self, interp: Any) -> None:
        self.interp = interp
        self._before: Any = None

    def __enter__(self) -> Turns:
        if hasattr(signal, "setitimer"):
            self._before = signal.signal(signal.SIGVTALRM, self._on_stretch)
            signal.setitimer(signal.ITIMER_VIRTUAL, STRETCH, STRETCH)
            self.interp.ticks.watch_calls = False  # no profiler hook is needed
        return self

    def __exit__(self, *_: object) -> None:
        if self._before is not None:
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)
            signal.signal(signal.SIGVTALRM, self._before)
            self.interp.ticks.watch_calls = True

    def _on_stretch(self, number: int, frame: FrameType | None) -> None:
        interp = self.interp
        if frame is None or (interp.clock.is_virtual and interp.ticks.pending is None):
            return
        interp.scheduler.hand_back()  # the driver is to look soon
        if frame.f_globals.get("%ticks") is interp.ticks and frame.f_code.co_code[frame.f_lasti] == ENTRY:
            interp.scheduler.safepoint()


def leave_at_once(reason: str, code: int) -> None:
    """End the command without any cleanup, because it was asked twice."""
    for stream, text in ((sys.stdout, ""), (sys.stderr, f"esl: {reason}\n")):
        try:
            stream.write(text)
            stream.flush()
        except Exception:
            code = code  # what could not be written is lost
    os._exit(code)
