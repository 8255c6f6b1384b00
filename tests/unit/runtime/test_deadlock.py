"""Deadlock: where it is raised, and what it tells. `1 :X` is a note at second 1."""

from __future__ import annotations

import pytest

from eslang import Failure, Interpreter
from trees.running import Run, trace_of

DEADLOCKS = {
    "it is raised in the task that the run waits for, and leaves it with its cleanups": (
        "(cleaned (note :cleaned) (wait-for-events *e1*))",
        ["0 :ENTER 1", "0 :CLEAN 1", "0 :CLEANED", "failure :DEADLOCK ['main.2', 'event *e1*', 'no task"],
    ),
    "it can be answered": (
        "(with-recovery-procedures (:deadlock (abort :out)) (wait-for-events *e1*))",
        [":OUT"],
    ),
    "it has no place to go on: a procedure that returns declines": (
        """(with-recovery-procedures (:deadlock (abort :outer))
             (with-recovery-procedures (:deadlock (note :inner)) (wait-for-events *e1*)))""",
        ["0 :INNER", ":OUTER"],
    ),
    "a retry may run into it again": (
        """(with-recovery-procedures ((:deadlock :retries 2 (note :again) (retry)) (:deadlock (abort :out)))
             (wait-for-events *e1*))""",
        ["0 :AGAIN", "0 :AGAIN", ":OUT"],
    ),
    "the children of a net that it leaves are aborted": (
        """(with-recovery-procedures (:deadlock (note :answered) (abort :out))
             (task-net (a (cleaned (note :a) (wait-for-events *e1*))) (b (cleaned (note :b)
                 (wait-for-task a)))))""",
        ["0 :ENTER 1", "0 :ENTER 2", "0 :ANSWERED", "0 :CLEAN 1", "0 :A", "0 :CLEAN 2", "0 :B", ":OUT"],
    ),
    "WITHOUT-INTERRUPTS does not hold it off": (
        "(with-recovery-procedures (:deadlock (abort :out)) (without-interrupts (wait-for-events *e1*)))",
        [":OUT"],
    ),
    "a cleanup that waits for nothing is left by it, and it takes the place of the jump": (
        """(with-recovery-procedures (:x (abort :out)) (cleaned (wait-for-events *e1*) (fail :x)))""",
        ["0 :ENTER 1", "0 :CLEAN 1", "failure :DEADLOCK"],
    ),
    "a child's cleanup that waits for nothing is left by it, where the child is waited for": (
        """(with-recovery-procedures (:x (abort :out))
             (task-net (a (cleaned (progn (wait-for-events *e1*) (note :never)) (sleep 9))) (b
                 (sleep 1) (fail :x))))""",
        ["0 :ENTER 1", "1 :CLEAN 1", ":OUT"],
    ),
    "two cleanups that wait for each other's tasks": (
        """(let ((me (current-task)))
             (with-recovery-procedures (:out (abort :out))
               (spawn (progn (sleep 1) (interrupt-task me (lambda () (fail :out)))))
               (task-net (a (cleaned (wait-for-task b) (sleep 9))) (b (cleaned (wait-for-task a)
                   (sleep 9))))))""",
        ["0 :ENTER 1", "0 :ENTER 2", "1 :CLEAN 1", "1 :CLEAN 2", ":OUT"],
    ),
    "a task that waits for itself": (
        """(with-recovery-procedures (:deadlock (abort :out)) (wait-for-task (current-task)))""",
        [":OUT"],
    ),
    "a cleanup that waits for its own task": (
        """(let ((task (spawn (cleaned (wait-for-task (current-task)) (fail :x)))))
             (with-recovery-procedures (:deadlock (abort :out)) (wait-for-task task))
             (interrupt-task task (lambda () (note :held-off)))
             (with-recovery-procedures (:deadlock (abort :out)) (wait-for-task task)))""",
        ["0 :ENTER 1", "0 :CLEAN 1", ":OUT"],
    ),
    "a checkpoint of a task that has ended without it": (
        """(with-recovery-procedures (:deadlock (abort (third (first (failure-arguments)))))
             (let ((task (spawn 1))) (wait-for-task task) (checkpoint-wait task :cp)))""",
        ["has ended without it"],
    ),
    "a condition that nobody can make true": (
        """(with-recovery-procedures (:deadlock (abort (second (first (failure-arguments)))))
               (wait-until (= *v1* 9)))""",
        ["the condition (= *v1* 9)"],
    ),
}


@pytest.mark.parametrize("claim", DEADLOCKS)
def test_deadlock(claim: str) -> None:
    plan, expected = DEADLOCKS[claim]
    found = trace_of(plan)
    assert found[:-1] == expected[:-1]
    assert expected[-1] in found[-1]


def test_of_the_tasks_of_the_run_the_first_that_is_no_daemon_is_told() -> None:
    plan = """(spawn (cleaned (note :daemon) (wait-for-events *e1*)) :daemon t)
              (spawn (cleaned (note :other) (wait-for-events *e1*)))"""
    assert trace_of(plan)[2:-1] == ["0 :CLEAN 2", "0 :OTHER", "0 :CLEAN 1", "0 :DAEMON"]


def test_a_task_that_sleeps_is_no_part_of_a_deadlock() -> None:
    assert trace_of("(progn (spawn (progn (sleep 5) (signal *e1* 1))) (wait-for-events *e1*))") == ["1"]


def test_an_abort_that_comes_between_a_deadlock_and_its_task_leaves_no_child() -> None:
    from trees.remains import remains
    from trees.running import stop

    run = Run()
    plan = "(with-recovery-procedures (:deadlock (abort)) (task-net (a (wait-for-events *e1*))))"
    told = [line.split()[2] for line in run.evaluate(plan).told]
    run.begin()
    run.at = {told.index("deadlock") + 1: stop}
    assert remains(run.evaluate(plan)) == []
    assert "stopped" in run.outcome


@pytest.mark.parametrize(
    ("body", "why"),
    [
        ("(signal *e1*)", "b has ended; a signal that nobody waits for is lost"),
        ("(fail :x) (signal *e1*)", "b, which signals it, has failed"),
        ("(abort-task (current-task)) (signal *e1*)", "b, which signals it, was aborted"),
        ("(signal *e2*)", "no task that is left signals it by name"),
    ],
)
def test_who_has_ended_and_would_have_signalled_is_told(body: str, why: str) -> None:
    text = f"""
        (with-recovery-procedures (((:deadlock main-one first-one) (abort (third first-one))))
          (task-net :allow-failures (a (sleep 1) (wait-for-events *e1*)) (b {body})))"""
    assert trace_of(text)[-1] == why


CONDITIONS = {
    "nobody asserts the fact": (
        "(task-net (a (wait-until (power ega-x :on))) (b (sleep 1)))",
        "the condition (power ega-x :on)",
        "no task that is left asserts or retracts facts of power in its body",
    ),
    "who could assert it waits": (
        "(task-net (a (wait-until (power ega-x :on))) (b (wait-for-task a) (assert `(power ,1 :on))))",
        "the condition (power ega-x :on)",
        "b could assert or retract facts of power",
    ),
    "who would have asserted it has failed": (
        """(task-net :allow-failures (a (wait-until (power ega-x :on)))
             (b (fail :x) (update '(power ?x :off) (list 'power 'ega-x :on))))""",
        "the condition (power ega-x :on)",
        "b, which asserts or retracts facts of power, has failed",
    ),
    "bindings have their values": (
        """(progn (assert '(is-a w1 widget))
             (with-query-bindings '(is-a ?w widget) (task-net (a (wait-until (power #?w :on))))))""",
        "the condition (power w1 :on)",
        "no task that is left asserts or retracts facts of power in its body",
    ),
    "what it is derived from counts, too": (
        """(progn (defrule (ready ?x) (power ?x :on) (not (busy ?x)))
             (task-net (a (wait-until (ready ?x))) (b (wait-for-task a) (retract '(busy arm)))))""",
        "the condition (ready ?x)",
        "b could assert or retract facts of ready or power or busy",
    ),
    "of a condition that asks Lisp nothing is known": (
        "(task-net (a (wait-until (or (power ega-x :on) (> 1 2)))))",
        "the condition (or (power ega-x :on) (> 1 2))",
        None,
    ),
}


@pytest.mark.parametrize("name", CONDITIONS)
def test_of_a_condition_over_facts_it_is_told_who_could_change_them(name: str) -> None:
    body, what, why = CONDITIONS[name]
    with Interpreter(clock="virtual") as interp, pytest.raises(Failure) as raised:
        interp.eval(body)
    told = [list(argument) for argument in raised.value.arguments]
    assert [parts for parts in told if parts[0] == "a"] == [["a", what, *([why] if why else [])]]
