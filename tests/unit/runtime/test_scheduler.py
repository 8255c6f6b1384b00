"""Whose turn it is; and what a switch takes along. `1 :X` is a note at second 1."""

from __future__ import annotations

import gc
import weakref
from io import StringIO

import pytest

from eslang import Interpreter
from eslang.runtime.clock import SLICE
from trees.remains import remains
from trees.running import Run, trace_of

TURNS = {
    "the ready take turns, first in, first out": (
        """(task-net (a (dotimes (i 3) (note :a i) (yield))) (b (dotimes (i 3) (note :b i) (yield))))""",
        ["0 :A 0", "0 :B 0", "0 :A 1", "0 :B 1", "0 :A 2", "0 :B 2", "None"],
    ),
    "who is woken waits for its turn": (
        """(task-net (a (wait-for-events *e1*) (note :a)) (b (yield) (note :b)) (c (signal *e1*)
               (note :c)))""",
        ["0 :C", "0 :B", "0 :A", "None"],
    ),
    "a sleep of no time gives way": (
        """(task-net (a (sleep 0) (note :a)) (b (note :b)))""",
        ["0 :B", "0 :A", "None"],
    ),
    "of those that sleep to the same moment the first is first": (
        """(task-net (a (sleep 2) (note :a)) (b (sleep 1) (sleep 1) (note :b)) (c (sleep 2) (note :c)))""",
        ["2 :A", "2 :C", "2 :B", "None"],
    ),
    "a loop does not starve those that sleep": (
        f"""(task-net (a (loop (when (= *v1* 1) (return))) (note :a))
                      (b (sleep {SLICE * 2.5}) (setq *v1* 1) (note :b)))""",
        ["0.005 :B", "0.005 :A", "None"],
    ),
    "two loops share the time": (
        """(let ((m 0) (n 0) (most 0))
             (task-net (a (dotimes (i 9000) (incf m) (setq most (max most (abs (- m n))))))
                       (b (dotimes (i 9000) (incf n) (setq most (max most (abs (- m n)))))))
             (<= most 2000))""",
        ["True"],
    ),
    "a condition that a step makes true is seen, though that step goes on to wait for one itself": (
        """(task-net (a (wait-until (= *v1* 1)) (setq *v2* 1) (note :a))
                     (b (yield) (setq *v1* 1) (wait-until (= *v2* 1)) (note :b)))""",
        ["0 :A", "0 :B", "None"],
    ),
    "a condition that an interrupt makes true is seen": (
        """(let ((other (spawn (progn (wait-until (= *v2* 1)) (note :end)))))
             (yield)
             (spawn (progn (wait-until (= *v1* 1)) (note :seen) (setq *v2* 1)))
             (yield)
             (interrupt-task other (lambda () (setq *v1* 1)))
             (wait-for-task other) nil)""",
        ["0 :SEEN", "0 :END", "None"],
    ),
    "a condition that holds for a moment only may be missed": (
        """(task-net (a (with-recovery-procedures (:timeout (abort :missed)) (wait-until
               (= *v1* 1) :timeout 1)))
                     (b (yield) (setq *v1* 1) (setq *v1* 0)))""",
        [":MISSED"],
    ),
    "of a timeout and a change at one moment the timeout is first": (
        """(with-recovery-procedures (:timeout (abort :timeout))
             (task-net (b (sleep 2) (setq *v1* 1)) (a (wait-until (= *v1* 1) :timeout 2) (note :a))))""",
        [":TIMEOUT"],
    ),
    "a sort waits in its predicate": (
        """(task-net (a (note (sort (list 3 1 2) (lambda (a b) (yield) (< a b))))) (b (note :b)))""",
        ["0 :B", "0 [1, 2, 3]", "None"],
    ),
    "a walk through a table waits, and the table may be changed meanwhile": (
        """(let ((table (make-hash-table)) (seen 0))
             (setf (gethash 1 table) 1 (gethash 2 table) 2)
             (task-net (a (maphash (lambda (k v) (sleep 1) (setf (gethash k table) (* 10 v))
                 (incf seen)) table))
                       (b (sleep 1.5) (incf (gethash 2 table))))
             (list seen (gethash 1 table) (gethash 2 table)))""",
        ["[2, 10, 20]"],
    ),
    "an expander waits": (
        """(progn (task-net (a (eval '(slowly (note :a)))) (b (note :b))) nil)""",
        ["0 :B", "0 :SLOWLY", "0 :A", "None"],
    ),
    "a print function waits": (
        """(task-net (a (princ (make-shown :value 1)) (note :a)) (b (note :b)))""",
        ["0 :B", "0 :SHOWN", "0 :A", "None"],
    ),
    "a call through Python and back waits": (
        """(task-net (a (note (through (lambda () (sleep 2) 7)))) (b (sleep 1) (note :b)))""",
        ["1 :B", "2 7", "None"],
    ),
    "a failure goes through Python": (
        """(with-recovery-procedures (:x (abort 5)) (through (lambda () (sleep 1) (fail :x))))""",
        ["5"],
    ),
    "an abort goes through Python": (
        """(let ((task (spawn (cleaned (note :out) (through (lambda () (cleaned (note :in) (sleep 9))))))))
             (sleep 1) (abort-task task) (wait-for-task task) nil)""",
        ["0 :ENTER 1", "0 :ENTER 2", "1 :CLEAN 2", "1 :IN", "1 :CLEAN 1", "1 :OUT", "None"],
    ),
    "a throw crosses a wait": (
        """(catch 'out (task-net (a (catch 'in (sleep 1) (throw 'in 1)) (note :a))) (throw 'out 2))""",
        ["1 :A", "2"],
    ),
}

BINDINGS = """
(task-net (a (let ((*d* 1)) (dotimes (i 3) (here 1) (yield)) (setq *d* 11) (sleep 1) (here 11)))
          (b (dotimes (i 4) (here 0) (yield)) (let ((*d* 2)) (task-net (c (here 2) (setq *d* 3)
              (yield) (here 3)))
                                                            (here 2)))
          (d (let ((*d* 4)) (checkpoint :in) (cleaned (here 4) (sleep 2))))
          (e (progv '(*d*) '() (yield) (note (boundp '*d*))) (here 0) (checkpoint-wait d :in)
              (interrupt-task d (lambda () (here 4))))
          (f (sleep 1) (abort-task d)))
"""


@pytest.mark.parametrize("claim", TURNS)
def test_turn(claim: str) -> None:
    plan, expected = TURNS[claim]
    assert trace_of(plan) == expected


def test_dynamic_bindings_are_those_of_the_task_whose_turn_it_is() -> None:
    for seed in range(5):
        lines = trace_of(BINDINGS, shuffle=seed > 0, seed=seed)
        assert not [line for line in lines if "WRONG" in line]
        assert "0 None" in lines


def test_chance_permutes_the_ready_as_the_seed_has_it() -> None:
    plan = "(task-net (a (note :a)) (b (note :b)) (c (note :c)) (d (note :d)))"
    traces = [tuple(trace_of(plan, shuffle=True, seed=seed)) for seed in (1, 1, 2, 3, 4)]
    assert traces[0] == traces[1]
    assert len(set(traces)) > 1
    assert {tuple(sorted(trace)) for trace in traces} == {tuple(sorted(trace_of(plan)))}


def test_what_is_posted_is_done_between_two_steps() -> None:
    run = Run()
    run.at_note = {1: lambda run: run.interp.scheduler.post(lambda: run.note("posted"))}
    run.evaluate("(progn (note :before) (note :in-the-same-step) (yield) (note :after))")
    assert run.lines == ["0 :BEFORE", "0 :IN-THE-SAME-STEP", "0 posted", "0 :AFTER"]


def test_a_post_reaches_a_loop_that_nobody_shares() -> None:
    run = Run()
    run.at_note = {1: lambda run: run.interp.scheduler.post(lambda: run.interp.set_value("*v1*", 1))}
    assert run.evaluate("(progn (note) (loop (when (= *v1* 1) (return :out))))").outcome == " :OUT None"


def test_a_stop_gives_the_main_task_the_next_turn() -> None:
    run = Run()
    run.at_note = {1: lambda run: run.interp.interrupt("enough")}
    run.evaluate("(task-net (a (note :a) (sleep 5)) (b (note :b)) (c (note :c)))")
    assert (run.lines, run.outcome) == (["0 :A"], " stopped: enough None")
    assert remains(run) == []


def test_a_stop_reaches_a_task_that_only_calls() -> None:
    run = Run()
    run.at_note = {1: lambda run: run.interp.interrupt("enough")}
    run.evaluate("(progn (defun fib (n) (if (< n 2) n (+ (fib (- n 1)) (fib (- n 2))))) (note) (fib 90))")
    assert run.outcome == " stopped: enough None"
    assert remains(run) == []


def test_quit_in_a_task_ends_all_with_their_cleanups() -> None:
    plan = """(spawn (cleaned (sleep 1) (wait-for-events *e1*)) :daemon t)
              (spawn (cleaned (note :other) (sleep 9)))
              (spawn (progn (sleep 1) (quit 3)))"""
    run = Run().evaluate(plan)
    assert run.lines == ["0 :ENTER 1", "0 :ENTER 2", "1 :CLEAN 1", "1 :CLEAN 2", "1 :OTHER"]
    assert run.outcome.endswith("stopped: quit")
    assert remains(run) == []


def test_an_interpreter_that_ran_tasks_can_be_forgotten() -> None:
    interp = Interpreter(clock="virtual", output=StringIO())
    interp.eval("(task-net (a (sleep 1)) (b (yield)))")
    reference = weakref.ref(interp)
    del interp
    gc.collect()
    assert reference() is None


def test_what_is_left_of_a_task_is_only_what_somebody_holds() -> None:
    run = Run()
    for plan in ("(task-net (a (sleep 1)) (b (yield)))", "(progn (spawn (fail :x)) (sleep 1))"):
        run.evaluate(plan)
    references = [weakref.ref(task.dynamic) for task in run.tasks if hasattr(task.dynamic, "__weakref__")]
    run.begin()
    gc.collect()
    assert not [reference for reference in references if reference() is not None]
