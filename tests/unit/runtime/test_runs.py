"""Runs: roots, what belongs to the run, and how it ends."""

from __future__ import annotations

import pytest

from eslang import Failure
from trees.remains import remains
from trees.running import Run


def test_the_next_call_finds_what_the_last_one_spawned() -> None:
    run = Run()
    run.interp.eval("(defun start () (spawn (progn (wait-for-events *e1*) (note :woken))) nil)")
    run.interp.call("start")
    run.interp.eval("(progn (yield) (signal *e1*) (yield))")
    assert run.lines == ["0 :WOKEN"]
    assert remains(run.evaluate("nil")) == []


def test_a_run_ends_when_what_it_spawned_has() -> None:
    run = Run().evaluate(
        "(spawn (progn (sleep 3) (note :end))) (spawn (cleaned (note :clean) (sleep 9)) :daemon t)"
    )
    assert run.lines == ["0 :ENTER 1", "3 :END", "3 :CLEAN 1", "3 :CLEAN"]
    assert remains(run) == []


def test_a_failure_that_nobody_saw_is_the_runs() -> None:
    run = Run().evaluate("(progn (spawn (fail :lost 1)) 5)")
    assert run.outcome == " 5 failure :LOST 1"
    assert remains(run) == []


def test_a_failure_that_somebody_saw_is_not() -> None:
    run = Run().evaluate("(let ((task (spawn (fail :lost 1)))) (wait-for-task task) 5)")
    assert run.outcome == " 5 None"


def test_a_look_at_one_failed_task_does_not_hide_another() -> None:
    plan = """(let ((one (spawn (fail :one))) (two (spawn (fail :two))))
                (sleep 1) (task-status one) 5)"""
    assert Run().evaluate(plan).outcome == " 5 failure :TWO"
    assert Run().evaluate(f"(task-net (owner {plan}))").outcome == " failure :TWO None"


def test_a_run_that_was_stopped_leaves_no_failure_to_the_next() -> None:
    run = Run().evaluate(
        "(progn (spawn (fail :lost)) (spawn (progn (sleep 1) (quit 3))) (spawn (sleep 9)) 5)"
    )
    assert run.outcome == " 5 stopped: quit"
    run.begin()
    assert run.evaluate("7").outcome == " 7 None"


def test_a_call_within_a_task_is_part_of_it() -> None:
    run = Run().evaluate("(through (lambda () (task-net (a (through (lambda () (sleep 1) (note :a)))))))")
    assert run.lines == ["1 :A"]
    assert remains(run) == []


@pytest.mark.parametrize("error", [SystemExit, KeyboardInterrupt])
@pytest.mark.parametrize(
    "where", ["main", "a net", "a spawned task", "a cleanup", "two cleanups", "a guardian"]
)
def test_what_python_raises_to_leave_everything_leaves_nothing(
    where: str, error: type[BaseException]
) -> None:
    run = Run()

    @run.interp.primitive
    def crash() -> None:
        raise error

    plans = {
        "main": "(cleaned (note :clean) (crash))",
        "a net": "(task-net (a (task-net (b (sleep 1) (crash)) (c (cleaned (sleep 1) (sleep 9))))))",
        "a spawned task": "(progn (spawn (progn (sleep 1) (crash))) (cleaned (sleep 1) (sleep 9)))",
        "a cleanup": "(task-net (a (cleaned (crash) (sleep 9))) (b (sleep 1) (fail :x)))",
        "two cleanups": """(task-net (a (cleaned (crash) (sleep 9))) (b (cleaned (crash) (sleep 9)))
                                     (c (sleep 1) (fail :x)) (d (cleaned (sleep 2) (sleep 9))))""",
        "a guardian": "(with-guardian (progn (sleep 1) (crash)) (note :alarm) (cleaned (sleep 1) (sleep 9)))",
    }
    with pytest.raises(error):
        run.evaluate(f"(let ((*d* 1)) {plans[where]})")
    run.call("list")
    assert remains(run) == []


def test_an_interpreter_at_work_cannot_be_entered_from_another_ones_call() -> None:
    inner, outer = Run(), Run()
    inner.note = lambda *words: outer.interp.eval("(sleep 1)")  # type: ignore[method-assign]

    @outer.interp.primitive
    def ask_other() -> None:
        inner.interp.call(lambda: outer.interp.eval("(note 1)"))

    outer.interp.eval("(ask-other)")
    assert outer.lines == ["0 1"]


def test_a_closed_interpreter_is_not_entered() -> None:
    run = Run()
    run.interp.close()
    with pytest.raises(Failure):
        run.interp.eval("1")
