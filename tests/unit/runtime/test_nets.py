"""Nets: whole traces of how they end. `1 :X` is a note at second 1."""

from __future__ import annotations

import pytest

from trees.running import trace_of

NETS = {
    "the first failure is kept, though a sibling's cleanup fails": (
        """(with-recovery-procedures (:general-failure (abort (list (failure-cause) (failure-arguments))))
             (task-net (a (sleep 1) (fail :first 1)) (b (cleaned (fail :second) (sleep 9)))))""",
        ["0 :ENTER 1", "1 :CLEAN 1", "[Keyword('FIRST'), [1]]"],
    ),
    "a net ends when the slowest cleanup has": (
        """(with-recovery-procedures (:x (note :answered) (abort 5))
             (task-net (a (sleep 1) (fail :x)) (b (cleaned (sleep 3) (sleep 9))) (c (cleaned (sleep 1)
                 (sleep 9)))))""",
        ["0 :ENTER 1", "0 :ENTER 2", "1 :CLEAN 1", "1 :CLEAN 2", "4 :ANSWERED", "5"],
    ),
    "two that fail in one step: the first is told": (
        """(let ((e (make-event)))
             (task-net (a (wait-for-events e) (fail :a)) (b (wait-for-events e) (fail :b)) (c (yield)
                 (signal e))))""",
        ["failure :A"],
    ),
    "a failure goes through three nets with its arguments": (
        """(task-net (a (task-net (b (task-net (c (sleep 1) (fail :deep 1 2)) (d (cleaned (note :d)
               (sleep 9)))))
                                  (e (cleaned (note :e) (sleep 9)))))
                     (f (cleaned (note :f) (sleep 9))))""",
        [
            "0 :ENTER 1",
            "0 :ENTER 2",
            "0 :ENTER 3",
            "1 :CLEAN 3",
            "1 :D",
            "1 :CLEAN 2",
            "1 :E",
            "1 :CLEAN 1",
            "1 :F",
            "failure :DEEP 1 2",
        ],
    ),
    "a retry outside makes the net anew, when the old one has ended": (
        """(let ((n 0))
             (with-recovery-procedures (:x :retries 2 (note :again) (retry))
               (task-net (a (cleaned (progn (sleep 1) (note :cleaned n)) (sleep 5)) :a)
                         (b (sleep 1) (if (< (incf n) 3) (fail :x))))))""",
        [
            "0 :ENTER 1",
            "1 :CLEAN 1",
            "2 :CLEANED 1",
            "2 :AGAIN",
            "2 :ENTER 2",
            "3 :CLEAN 2",
            "4 :CLEANED 2",
            "4 :AGAIN",
            "4 :ENTER 3",
            "9 :LEAVE 3",
            ":A",
        ],
    ),
    "a retry of an outer form leaves a net that is alive": (
        """(let ((n 0) (me (current-task)))
             (with-recovery-procedures (:x (note :again) (retry))
               (spawn (progn (sleep 1) (if (= n 1) (interrupt-task me (lambda () (fail :x))))))
               (incf n)
               (task-net (a (cleaned (sleep 2) (sleep 3)) :done))))""",
        ["0 :ENTER 1", "1 :AGAIN", "1 :CLEAN 1", "3 :ENTER 2", "6 :LEAVE 2", ":DONE"],
    ),
    "a recovery procedure may run a net": (
        """(with-recovery-procedures (:x (note (task-net (a (sleep 1) :a) (b (fail :y)))) (abort 1))
             (with-recovery-procedures (:y (abort 2)) (fail :x)))""",
        ["failure :Y"],
    ),
    "a cleanup may run a net, which an abort does not reach": (
        """(let ((task (spawn (cleaned (task-net (a (sleep 2) (note :a)) (b (note :b))) (sleep 9)))))
             (sleep 1) (abort-task task) (sleep 1) (abort-task task) (wait-for-task task)
                 (task-status task))""",
        ["0 :ENTER 1", "1 :CLEAN 1", "1 :B", "3 :A", ":ABORTED"],
    ),
    "an aborted member does not fail its net": (
        """(multiple-value-list (task-net (a (sleep 9) 1) (b (sleep 1) (abort-task a) 2)))""",
        ["[None, 2]"],
    ),
    "a member that aborts itself does not, either": (
        """(multiple-value-list (task-net (a (abort-task (current-task)) 1) (b 2)))""",
        ["[None, 2]"],
    ),
    "with :allow-failures all others go on": (
        """(multiple-value-list (task-net :allow-failures (a (fail :a)) (b (sleep 2) (note :b) 2)))""",
        ["2 :B", "[None, 2]"],
    ),
    "the loser of a race may fail in its cleanup": (
        """(or-parallel (cleaned (fail :in-cleanup) (sleep 9)) (progn (sleep 1) :won))""",
        ["0 :ENTER 1", "1 :CLEAN 1", ":WON"],
    ),
    "the loser of a race may take its time": (
        """(progn (note (or-parallel (cleaned (sleep 3) (sleep 9)) (progn (sleep 1) :won))) 1)""",
        ["0 :ENTER 1", "1 :CLEAN 1", "4 :WON", "1"],
    ),
    "a race that all lose tells all causes in their order": (
        """(with-recovery-procedures (:all-subtasks-failed (abort (first (failure-arguments))))
             (or-parallel (progn (sleep 2) (fail :a 1)) (fail :b) (abort-task (current-task))))""",
        ["[[Keyword('A'), 1], [Keyword('B')]]"],
    ),
    "a race of nobody is lost": ("(or-parallel)", ["failure :ALL-SUBTASKS-FAILED None"]),
    "a net of nobody ends at once": ("(task-net)", ["None"]),
    "two winners in one step: the first is it": (
        """(let ((e (make-event)))
             (or-parallel (progn (wait-for-events e) 1) (progn (wait-for-events e) 2) (progn (yield)
                 (signal e) (sleep 9))))""",
        ["1"],
    ),
    "a jump out of a member is its failure": (
        """(catch 'k (task-net (a (throw 'k 1)) (b (cleaned (note :b) (sleep 9)))))""",
        ["failure :CONTROL-ERROR no CATCH is active for the tag thrown to"],
    ),
    "a return-from out of a member is its failure": (
        """(block b (task-net (a (return-from b 1))))""",
        ["failure :CONTROL-ERROR this jump leads out of the task that makes it"],
    ),
}


@pytest.mark.parametrize("claim", NETS)
def test_net(claim: str) -> None:
    plan, expected = NETS[claim]
    assert trace_of(plan) == expected


def test_a_deadlock_in_a_cleanup_does_not_hide_why_its_net_was_decided() -> None:
    plan = """(task-net (k (sleep 1) (fail :first))
                        (a (cleaned (wait-for-task b) (sleep 9)))
                        (b (cleaned (wait-for-task a) (sleep 9))))"""
    assert trace_of(plan)[-1] == "failure :FIRST"


def test_a_deadlock_in_a_cleanup_does_not_hide_who_won() -> None:
    plan = "(or-parallel (cleaned (wait-for-events *e1*) (sleep 9)) (progn (sleep 1) :won))"
    assert trace_of(plan)[-1] == ":WON"
