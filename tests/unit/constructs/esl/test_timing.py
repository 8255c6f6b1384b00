"""Time: what wakes a condition."""

from __future__ import annotations

from support import lines_of, run


def test_a_condition_is_looked_at_again_after_each_step_of_another_task() -> None:
    text = """
    (defvar *cups* 0)
    (task-net (watcher (wait-until (= *cups* 2)) (print *cups*))
              (filler (dotimes (i 5) (incf *cups*) (yield))))
    """
    assert lines_of(text) == ["2"]


def test_a_condition_that_nothing_can_change_is_a_deadlock() -> None:
    came = run("(wait-until nil)")
    assert str(came.failure.cause) == ":DEADLOCK"
