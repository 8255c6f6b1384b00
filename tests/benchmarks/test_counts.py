"""What some plans cost, counted and not timed: calls of Python functions, events, steps of tasks.

A count is exact, so it tells of a step too many on any machine. Where one
changes on purpose, the number here changes with it, and the change note says so.
"""

from __future__ import annotations

import gc
import io
import sys
from collections.abc import Iterator
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

from eslang import Interpreter
from eslang.compile.emit_functions import UNCHECKED

PROGRAM = Path(__file__).with_name("programs") / "tasks.esl"
RECOVERY = """
(defun stumble (rounds)
  (dotimes (round rounds)
    (let ((tries 0))
      (with-recovery-procedures ((:slipped :retries 3 (retry)))
        (incf tries)
        (if (< tries 4) (fail :slipped))))))
(defun answered (rounds)
  (with-recovery-procedures ((:slipped :retries :infinite 1))
    (dotimes (round rounds) (fail :slipped))))
(defun safe (rounds)
  (dotimes (round rounds)
    (with-recovery-procedures ((:slipped (retry))) round)))
(defun clean (rounds)
  (dotimes (round rounds)
    (with-cleanup-procedure (print :never) round)))
"""


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter that knows the plans."""
    with Interpreter(output=io.StringIO()) as made:
        made.eval(RECOVERY)
        yield made


def calls_of(agent: Interpreter, name: str, *arguments: Any) -> int:
    """How many Python functions are called to run a Lisp function."""
    count = 0

    def note(frame: FrameType, event: str, argument: Any) -> None:
        nonlocal count
        count += event == "call"

    agent.call(name, *arguments)  # what is made when first wanted is made now
    gc.disable()  # some libraries have the collector call functions of theirs
    sys.setprofile(note)
    try:
        agent.call(name, *arguments)
    finally:
        sys.setprofile(None)
        gc.enable()
    return count


def calls_a_round(agent: Interpreter, name: str) -> int:
    """How many Python functions one round of a plan calls, beside what entering and leaving takes."""
    few, many = calls_of(agent, name, 100), calls_of(agent, name, 200)
    assert (many - few) % 100 == 0
    return (many - few) // 100


def test_a_call_of_a_function_is_one_call(agent: Interpreter) -> None:
    agent.eval("(defun fib (n) (if (< n 2) n (+ (fib (- n 1)) (fib (- n 2)))))")
    assert calls_of(agent, "fib", 11) - calls_of(agent, "fib", 10) == 110  # 287 calls, and 177


@pytest.mark.parametrize(
    ("plan", "calls", "answers"),
    [
        ("safe", 6, 0),  # the form, its clauses, its body, and the runtime around it
        ("clean", 4, 0),
        ("answered", 3, 1),  # FAIL, the search, the procedure
        ("stumble", 20, 3),  # three failures, three retries, success
    ],
)
def test_a_round_costs_so_many_calls(agent: Interpreter, plan: str, calls: int, answers: int) -> None:
    looks = answers if UNCHECKED else 0  # a procedure looks for the end of the stack where Python does not
    assert calls_a_round(agent, plan) == calls + looks


def test_where_nobody_listens_no_event_is_made(agent: Interpreter, monkeypatch: pytest.MonkeyPatch) -> None:
    from eslang.runtime.hooks import Hooks

    told: list[str] = []
    monkeypatch.setattr(Hooks, "tell", lambda self, kind, *rest, **data: told.append(kind))
    agent.call("stumble", 3)
    assert told == []


@pytest.fixture
def crew() -> Iterator[Interpreter]:
    """An interpreter that knows the plans of tasks."""
    with Interpreter(output=io.StringIO(), clock="virtual") as made:
        made.load(PROGRAM)
        yield made


def steps_of(crew: Interpreter, name: str, *arguments: Any) -> int:
    """How many steps a plan takes: each turn of a task is one."""
    before = crew.scheduler.steps
    crew.call(name, *arguments)
    return crew.scheduler.steps - before


@pytest.mark.parametrize(
    ("plan", "steps"),
    [
        ("signals", 2),  # the waiter's turn, and the signaller's
        ("ping-pong", 2),
        ("nudges", 2),  # the interrupted task's turn, and the other's
        ("stops", 4),  # it begins, the other goes on, it is interrupted and ends, the other goes on
        ("lives", 2),
        ("crowd", 2),  # of each member: to begin, and to end
    ],
)
def test_a_round_takes_so_many_steps(crew: Interpreter, plan: str, steps: int) -> None:
    few, many = steps_of(crew, plan, 50), steps_of(crew, plan, 150)
    assert many - few == 100 * steps


def test_tasks_that_wait_take_no_steps(crew: Interpreter) -> None:
    before = steps_of(crew, "signals", 100)
    crew.call("wait-in-vain", 100)
    assert steps_of(crew, "signals", 100) == before


def test_a_signal_wakes_only_those_that_wait_for_it(crew: Interpreter) -> None:
    assert steps_of(crew, "waves", 100, 5) - steps_of(crew, "waves", 100, 4) == 101  # and the signaller


@pytest.mark.parametrize(
    ("plan", "calls"),
    [
        ("signals", 10),  # SIGNAL, YIELD, WAIT-FOR-EVENTS, and what the scheduler does for each
        ("ping-pong", 14),
    ],
)
def test_a_round_of_two_tasks_costs_so_many_calls(crew: Interpreter, plan: str, calls: int) -> None:
    few, many = calls_of(crew, plan, 100), calls_of(crew, plan, 200)
    assert (many - few) // 100 == calls  # and what the driver does, now and then


def test_the_attributes_of_a_session_are_found_the_short_way() -> None:
    assert not hasattr(
        Interpreter, "__getattr__"
    )  # Python looks for every attribute the long way where it is
