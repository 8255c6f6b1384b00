"""What some plans cost, counted and not timed: calls of Python functions, and events.

A count is exact, so it tells of a step too many on any machine. Where one
changes on purpose, the number here changes with it, and the change note says so.
"""

from __future__ import annotations

import gc
import io
import sys
from collections.abc import Iterator
from types import FrameType
from typing import Any

import pytest

from eslang import Interpreter
from eslang.compile.emit_functions import UNCHECKED

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
