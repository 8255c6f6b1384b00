"""Guardians and deadlines: traces of the cases where moments fall together. `1 :X` is a note at second 1."""

from __future__ import annotations

import pytest

from trees.running import trace_of

GUARDIANS = {
    "a guardian that ends when its task stands still interrupts it there": (
        """(with-guardian (sleep 1) (note :alarm) (sleep 3) (note :end))""",
        ["1 :ALARM", "3 :END", "None"],
    ),
    "a guardian that fails counts as one that ends": (
        """(with-guardian (fail :lost) (note :alarm) (sleep 3) 5)""",
        ["0 :ALARM", "5"],
    ),
    "a guardian that ends in the step in which its body ends comes too late": (
        """(let ((e (make-event)))
             (with-guardian (wait-for-events e) (note :alarm)
               (spawn (signal e)) (wait-for-events e) (note :end) 5))""",
        ["0 :END", "5"],
    ),
    "a guardian that ends at the moment at which its body ends, which began to wait first": (
        """(with-guardian (sleep 2) (note :alarm) (sleep 2) (note :end) 5)""",
        ["2 :END", "5"],
    ),
    "a guardian that ends at the moment at which its body ends, which began to wait last": (
        """(with-guardian (sleep 2) (note :alarm) (sleep 1) (sleep 1) (note :end) 5)""",
        ["2 :ALARM", "2 :END", "5"],
    ),
    "of nested guardians that end together the outer one, which was set first, is first": (
        """(with-guardian (sleep 2) (note :outer)
             (with-guardian (sleep 2) (note :inner) (sleep 5) (note :end)))""",
        ["2 :OUTER", "2 :INNER", "5 :END", "None"],
    ),
    "the alarm of the outer guardian leaves the inner one with its cleanups": (
        """(with-recovery-procedures (:outer (note :answered) (abort 7))
             (with-guardian (sleep 2) (fail :outer)
               (with-guardian (cleaned (note :guard-cleaned) (sleep 9)) (note :never)
                 (cleaned (note :body-cleaned) (sleep 5)))))""",
        [
            "0 :ENTER 1",
            "0 :ENTER 2",
            "2 :ANSWERED",
            "2 :CLEAN 1",
            "2 :BODY-CLEANED",
            "2 :CLEAN 2",
            "2 :GUARD-CLEANED",
            "7",
        ],
    ),
    "a recovery procedure inside the body takes the alarm, and the body goes on": (
        """(with-guardian (sleep 1) (fail :alarm)
             (with-recovery-procedures (:alarm (note :taken)) (sleep 3) (note :end)))""",
        ["1 :TAKEN", "3 :END", "None"],
    ),
    "an alarm waits for a cleanup that is under way in the body, and is dropped if the body is left by it": (
        """(with-recovery-procedures (:x (abort :left))
             (with-guardian (sleep 2) (note :alarm)
               (protected (progn (sleep 1) (fail :x)) (sleep 3) (note :cleaned))))""",
        ["0 :ENTER-PROTECTED 1", "1 :CLEAN-PROTECTED 1", "4 :CLEANED", ":LEFT"],
    ),
    "an alarm waits for a cleanup that is under way in the body, and comes after it": (
        """(with-guardian (sleep 2) (note :alarm)
             (protected (sleep 1) (sleep 3) (note :cleaned)) (sleep 1) (note :end))""",
        ["0 :ENTER-PROTECTED 1", "1 :CLEAN-PROTECTED 1", "4 :CLEANED", "4 :ALARM", "5 :END", "None"],
    ),
    "a guardian inside a cleanup interrupts the cleanup": (
        """(with-recovery-procedures (:x (abort :left))
             (protected (fail :x) (with-guardian (sleep 1) (note :alarm) (sleep 2) (note :end))))""",
        ["0 :ENTER-PROTECTED 1", "0 :CLEAN-PROTECTED 1", "1 :ALARM", "2 :END", ":LEFT"],
    ),
    "an alarm waits for WITHOUT-INTERRUPTS": (
        """(with-guardian (sleep 1) (note :alarm) (without-interrupts (sleep 2) (note :mine)) (note :end))""",
        ["2 :MINE", "2 :ALARM", "2 :END", "None"],
    ),
    "an alarm reaches a loop that waits for nothing": (
        """(with-recovery-procedures (:alarm (abort :out)) (with-guardian (sleep 1) (fail :alarm) (loop)))""",
        [":OUT"],
    ),
    "the form ends only when the guardian has, cleanups and all": (
        """(with-guardian (cleaned (sleep 4) (sleep 9)) (note :alarm) (sleep 1) (note :end))""",
        ["0 :ENTER 1", "1 :END", "1 :CLEAN 1", "None"],
    ),
    "an aborted task aborts its guardian": (
        """(let ((task (spawn (with-guardian (cleaned (note :guard) (sleep 9)) (note :alarm)
                                (cleaned (note :body) (sleep 9))))))
             (sleep 1) (abort-task task) (wait-for-task task) (task-status task))""",
        ["0 :ENTER 1", "0 :ENTER 2", "1 :CLEAN 1", "1 :BODY", "1 :CLEAN 2", "1 :GUARD", ":ABORTED"],
    ),
}

DEADLINES = {
    "the earlier of nested deadlines counts, the inner": (
        """(with-recovery-procedures (:deadline-expired (note (first (failure-arguments))) (abort))
             (with-deadline (5) (with-deadline (2) (sleep 9))))""",
        ["2 2", "None"],
    ),
    "the earlier of nested deadlines counts, the outer": (
        """(with-recovery-procedures (:deadline-expired (note (first (failure-arguments))) (abort))
             (with-deadline (2) (with-deadline (5) (sleep 9))))""",
        ["2 2", "None"],
    ),
    "a deadline inside a guardian inside a deadline": (
        """(with-recovery-procedures (:deadline-expired (note (first (failure-arguments))) (abort))
             (with-deadline (4)
               (with-guardian (sleep 3) (note :alarm)
                 (with-recovery-procedures (:deadline-expired (note :inner) (abort))
                   (with-deadline (2) (sleep 9)))
                 (sleep 9))))""",
        ["2 :INNER", "3 :ALARM", "4 4", "None"],
    ),
    "a deadline that is answered by going on does not come again": (
        """(with-recovery-procedures (:deadline-expired (note :go-on))
             (with-deadline (1) (sleep 3) (note :end)))""",
        ["1 :GO-ON", "3 :END", "None"],
    ),
    "a deadline of no time still lets a body end that does not wait": (
        """(with-deadline (0) (note :end) 5)""",
        ["0 :END", "5"],
    ),
    "a body that ends at its deadline, which was set first, is too late": (
        """(with-recovery-procedures (:deadline-expired (abort :late)) (with-deadline (2)
               (sleep 2) :in-time))""",
        [":LATE"],
    ),
    "a deadline does not outlast its body": (
        """(progn (with-deadline (2) (sleep 1)) (sleep 5) :quiet)""",
        [":QUIET"],
    ),
    "a retry sets the deadline anew": (
        """(let ((n 0))
             (with-recovery-procedures (:deadline-expired :retries 2 (note :late) (retry))
               (with-deadline (2) (incf n) (sleep (if (= n 3) 1 9)) n)))""",
        ["2 :LATE", "4 :LATE", "3"],
    ),
    "a deadline fails inside the interrupt that the body is in": (
        """(let ((task (current-task)))
             (with-recovery-procedures (:deadline-expired (note :out) (abort))
               (with-deadline (2)
                 (spawn (progn (sleep 1) (interrupt-task task (lambda () (cleaned (note :interrupt)
                     (sleep 5))))))
                 (sleep 9))))""",
        ["1 :ENTER 1", "2 :OUT", "2 :CLEAN 1", "2 :INTERRUPT", "None"],
    ),
}


@pytest.mark.parametrize("claim", GUARDIANS)
def test_guardian(claim: str) -> None:
    plan, expected = GUARDIANS[claim]
    assert trace_of(plan) == expected


@pytest.mark.parametrize("claim", DEADLINES)
def test_deadline(claim: str) -> None:
    plan, expected = DEADLINES[claim]
    assert trace_of(plan) == expected
