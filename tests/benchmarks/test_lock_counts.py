"""What property locks cost, counted and not timed: steps of tasks."""

from __future__ import annotations

import io
from collections.abc import Iterator

import pytest

from eslang import Interpreter
from tests.benchmarks.locks import PROGRAM


@pytest.fixture
def crew() -> Iterator[Interpreter]:
    """An interpreter that knows the plans."""
    with Interpreter(output=io.StringIO(), clock="virtual") as made:
        made.load(PROGRAM)
        yield made


def steps_of(crew: Interpreter, text: str) -> int:
    """How many steps TEXT takes."""
    before = crew.scheduler.steps
    crew.eval(text)
    return crew.scheduler.steps - before


def test_a_true_property_is_taken_and_left_without_a_step(crew: Interpreter) -> None:
    assert steps_of(crew, "(takes 0 100)") == 0


def test_the_daemon_takes_no_step_while_a_thousand_properties_are_held(crew: Interpreter) -> None:
    crew.eval("(defun wait () (dotimes (i 50) (sleep 1) (assert `(other ,i))))")
    alone = steps_of(crew, "(wait)")
    assert alone > 0
    assert steps_of(crew, "(hold-all 1000 #'wait)") == alone


def test_a_task_on_a_lock_takes_so_many_steps(crew: Interpreter) -> None:
    few, many = steps_of(crew, "(crowd 1000 200)"), steps_of(crew, "(crowd 2000 200)")
    assert (many - few) / 1000 == pytest.approx(2, abs=0.1)  # it begins, and goes on


def test_a_violation_and_its_recovery_take_so_many_steps(crew: Interpreter) -> None:
    few, many = steps_of(crew, "(breaks 100)"), steps_of(crew, "(breaks 200)")
    assert (many - few) / 100 == pytest.approx(8, abs=0.5)
