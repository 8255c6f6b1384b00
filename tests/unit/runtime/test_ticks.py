"""Ticks: a loop, or a program that only calls, is stopped from outside."""

from __future__ import annotations

import sys
from io import StringIO
from typing import Any

import pytest

from eslang import Interpreter
from eslang.base.control import Stop
from eslang.runtime.ticks import SLICE, Ticks


@pytest.fixture
def written() -> StringIO:
    return StringIO()


@pytest.fixture
def interp(written: StringIO) -> Any:
    """An interpreter in which (enough) asks for the end of the run."""
    with Interpreter(clock="virtual", output=written) as made:
        made.primitive(lambda: made.interrupt("enough", 7), name="enough", signature="(enough)")
        yield made
    assert sys.getprofile() is None


def test_ticks_never_end_and_pass_a_safepoint_after_every_slice() -> None:
    passed: list[int] = []
    ticks = Ticks(lambda: passed.append(1))
    source = ticks.source
    for _ in range(2 * SLICE + 1):
        next(source)
    assert len(passed) == 2


def test_a_jump_out_of_a_safepoint_leaves_the_ticks_usable() -> None:
    def jump() -> None:
        raise Stop("enough", 7)

    ticks = Ticks(jump)
    source = ticks.source
    for _ in range(SLICE):
        next(source)
    with pytest.raises(Stop):
        next(source)
    ticks.safepoint = lambda: None
    for _ in range(2 * SLICE):
        next(source)


def test_a_pending_stop_is_taken_once() -> None:
    ticks = Ticks(lambda: None)
    stop = Stop("enough", 7)
    ticks.stop(stop)
    assert ticks.take() is stop
    assert ticks.take() is None


LOOPS = {
    "loop": "(loop)",
    "dotimes": "(dotimes (i 1000000000000))",
    "do": "(do () (nil))",
    "go": "(tagbody again (go again))",
    "while": "(loop while t do (list 1))",
    "a circular list": "(let ((l (list 1))) (setf (cdr l) l) (dolist (x l) x))",
    "retries without end": "(with-recovery-procedures ((:a :retries :infinite (retry))) (fail :a))",
    "calls without a loop": """(labels ((fib (n) (if (< n 2) n (+ (fib (- n 1)) (fib (- n 2))))))
                                 (fib 100))""",
    "a loop that ignores errors": "(ignore-errors (loop))",
    "a loop that handles conditions": "(handler-case (loop) (condition () :no))",
    "a loop that answers every failure": "(with-recovery-procedures ((:general-failure (abort))) (loop))",
}


@pytest.mark.parametrize("loop", LOOPS)
def test_what_does_not_end_is_stopped(interp: Any, loop: str) -> None:
    with pytest.raises(Stop) as caught:
        interp.eval(f"(progn (enough) {LOOPS[loop]})")
    assert caught.value.code == 7
    assert interp.eval("(loop repeat 3 collect 1)") == [1, 1, 1]


def test_cleanups_run_when_a_run_is_stopped(interp: Any, written: StringIO) -> None:
    with pytest.raises(Stop):
        interp.eval("""(with-cleanup-procedure (princ 2)
                         (unwind-protect (with-cleanup-procedure (princ 1) (enough) (loop)) (princ :u)))""")
    assert written.getvalue() == "1U2"
