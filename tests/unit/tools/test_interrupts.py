"""Turns: what makes a task that only calls pass a safepoint, and that nothing of it is left."""

from __future__ import annotations

import signal
import sys
from io import StringIO
from typing import Any

import pytest

from eslang.base.control import Stop
from eslang.interpreter import Interpreter
from eslang.tools.interrupts import Turns

FIB = "(defun fib (n) (if (< n 2) n (+ (fib (- n 1)) (fib (- n 2)))))"
RACE = "(progn (spawn (princ :other)) (yield) (spawn (princ :last)) (fib 24) (princ :fib))"


def order(interp: Any, written: StringIO, plan: str) -> str:
    """What PLAN writes while turns are seen to."""
    with Turns(interp):
        interp.eval(FIB)
        interp.eval(plan)
        with interp.at_work():
            interp.runs.finish()
    return written.getvalue()


@pytest.mark.slow
def test_on_the_real_clock_others_have_their_turn_between_two_calls() -> None:
    written = StringIO()
    with Interpreter(output=written) as interp:
        assert order(interp, written, RACE.replace("24", "30")) == "OTHERLASTFIB"


def test_on_the_virtual_clock_the_order_is_that_of_the_program() -> None:
    written = StringIO()
    with Interpreter(clock="virtual", output=written) as interp:
        assert order(interp, written, RACE) == "OTHERFIBLAST"


@pytest.mark.parametrize("clock", ["real", "virtual"])
def test_a_stop_reaches_calls_without_a_profiler_hook(clock: str) -> None:
    with Interpreter(clock=clock, output=StringIO()) as interp:
        hooks: list[Any] = []

        @interp.primitive
        def enough() -> None:
            interp.interrupt("enough", 7)
            hooks.append(sys.getprofile())

        interp.eval(FIB)
        with Turns(interp), pytest.raises(Stop):
            interp.eval("(progn (enough) (fib 90))")
        assert hooks == [None]
        interp.interrupt()
        assert interp.eval("(fib 5)") == 5
    assert sys.getprofile() is None
    assert signal.getitimer(signal.ITIMER_VIRTUAL) == (0, 0)
