"""Periods: counted from the first, skipped when overrun."""

from __future__ import annotations

import pytest

from trees.running import Run, trace_of

PERIODS = {
    "they do not drift": (
        """(let ((n 0)) (periodically 1 (note (incf n)) (sleep 0.25) (if (= n 3) (return :end))))""",
        ["0 1", "1 2", "2 3", ":END"],
    ),
    "those that are overrun are skipped": (
        """(let ((n 0)) (periodically 1 (note (incf n)) (if (= n 2) (sleep 2.5)) (if (= n 3)
               (return :end))))""",
        ["0 1", "1 2", "4 3", ":END"],
    ),
    "one that ends just at the next is not overrun": (
        """(let ((n 0)) (periodically 1 (note (incf n)) (if (= n 2) (sleep 2)) (if (= n 3)
               (return :end))))""",
        ["0 1", "1 2", "3 3", ":END"],
    ),
    "an abort between two runs leaves with cleanups": (
        """(let ((task (spawn (cleaned (note :cleaned) (periodically 1 (note :run))))))
             (sleep 1.5) (abort-task task) (wait-for-task task) nil)""",
        ["0 :ENTER 1", "0 :RUN", "1 :RUN", "1.5 :CLEAN 1", "1.5 :CLEANED", "None"],
    ),
    "an interrupt between two runs changes none": (
        """(let ((n 0) (task (current-task)))
             (spawn (progn (sleep 0.5) (interrupt-task task (lambda () (note :interrupt)))))
             (periodically 1 (note (incf n)) (if (= n 3) (return :end))))""",
        ["0 1", "0.5 :INTERRUPT", "1 2", "2 3", ":END"],
    ),
}


@pytest.mark.parametrize("claim", PERIODS)
def test_period(claim: str) -> None:
    plan, expected = PERIODS[claim]
    assert trace_of(plan) == expected


def test_an_overrun_is_told() -> None:
    run = Run().evaluate("(let ((n 0)) (periodically 1 (if (> (incf n) 1) (return)) (sleep 3.5)))")
    (missed,) = [line for line in run.told if "period-missed" in line]
    assert missed.endswith("missed=3 seconds=1.0")


def test_a_tenth_of_a_second_stays_one() -> None:
    run = Run().evaluate("(let ((n 0)) (periodically 0.1 (note) (if (= (incf n) 101) (return))))")
    assert run.lines[-1].strip() == "10"
    assert not any("period-missed" in line for line in run.told)
