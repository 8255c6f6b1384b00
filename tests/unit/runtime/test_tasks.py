"""Aborts and interrupts: whole traces. `1 :X` is a note at second 1."""

from __future__ import annotations

import pytest

from trees.running import trace_of

ABORTS = {
    "a task that is aborted before its first step does nothing": (
        """(let ((task (spawn (protected (note :never)))))
             (abort-task task) (wait-for-task task) (task-status task))""",
        [":ABORTED"],
    ),
    "an abort that comes twice is one": (
        """(let ((task (spawn (cleaned (progn (note :begins) (sleep 3) (note :ends)) (sleep 9)))))
             (sleep 1) (abort-task task) (sleep 1) (abort-task task) (wait-for-task task)
                 (task-status task))""",
        ["0 :ENTER 1", "1 :CLEAN 1", "1 :BEGINS", "4 :ENDS", ":ABORTED"],
    ),
    "an abort during a cleanup waits for it": (
        """(let ((task (spawn (progn (protected (sleep 1) (sleep 2) (note :cleaned)) (note :on) (sleep 1)
                                     (note :never)))))
             (sleep 2) (abort-task task) (wait-for-task task) (task-status task))""",
        ["0 :ENTER-PROTECTED 1", "1 :CLEAN-PROTECTED 1", "3 :CLEANED", "3 :ON", ":ABORTED"],
    ),
    "an abort during WITHOUT-INTERRUPTS comes at its end": (
        """(let ((task (spawn (progn (without-interrupts (sleep 2) (note :mine)) (note :never)))))
             (sleep 1) (abort-task task) (wait-for-task task) (task-status task))""",
        ["2 :MINE", ":ABORTED"],
    ),
    "a failing cleanup does not keep a task from ending as aborted": (
        """(let ((task (spawn (cleaned (fail :in-cleanup) (sleep 9)))))
             (sleep 1) (abort-task task) (wait-for-task task) (task-status task))""",
        ["0 :ENTER 1", "1 :CLEAN 1", ":ABORTED"],
    ),
    "a recovery procedure cannot answer an abort": (
        """(let ((task (spawn (with-recovery-procedures (:general-failure :retries :infinite (retry))
               (sleep 9)))))
             (sleep 1) (abort-task task) (wait-for-task task) (task-status task))""",
        [":ABORTED"],
    ),
    "a task may abort itself": (
        """(let ((task (spawn (cleaned (note :cleaned) (abort-task (current-task)) (note :never)))))
             (wait-for-task task) (task-status task))""",
        ["0 :ENTER 1", "0 :CLEAN 1", "0 :CLEANED", ":ABORTED"],
    ),
    "an aborted main task is a failure of who called": (
        """(cleaned (note :cleaned) (abort-task (current-task)))""",
        ["0 :ENTER 1", "0 :CLEAN 1", "0 :CLEANED", "failure :ABORTED"],
    ),
    "an endless loop ends": (
        """(let ((task (spawn (loop)))) (sleep 0.5) (abort-task task) (wait-for-task task)
               (task-status task))""",
        [":ABORTED"],
    ),
    "what an aborted task has spawned is aborted after its own cleanups": (
        """(let ((task (spawn (progn (spawn (cleaned (note :child) (sleep 9)))
                                     (cleaned (note :owner) (sleep 9))))))
             (sleep 1) (abort-task task) (wait-for-task task) (note (task-status task)))""",
        [
            "0 :ENTER 1",
            "0 :ENTER 2",
            "1 :CLEAN 1",
            "1 :OWNER",
            "1 :CLEAN 2",
            "1 :CHILD",
            "1 :ABORTED",
            "None",
        ],
    ),
    "daemons of a task are aborted when its other children have ended": (
        """(let ((tick (make-event)))
             (task-net (owner (spawn (cleaned (note :daemon-ends) (loop (sleep 1) (signal tick))) :daemon t)
                              (spawn (progn (dotimes (i 3) (wait-for-events tick)) (note :three)))
                              (note :body-ends)))
             5)""",
        ["0 :BODY-ENDS", "0 :ENTER 1", "3 :THREE", "3 :CLEAN 1", "3 :DAEMON-ENDS", "5"],
    ),
}

SURVIVORS = {
    "return-from": "(loop (block b (unwind-protect (sleep 1) (return-from b))))",
    "go": "(tagbody again (unwind-protect (sleep 1) (go again)))",
    "throw": "(loop (catch 'k (unwind-protect (sleep 1) (throw 'k 1))))",
    "a failure": "(loop (ignore-errors (unwind-protect (sleep 1) (fail :x))))",
    "a retry": "(with-recovery-procedures (:x :retries 99 (retry)) (unwind-protect (sleep 1) (fail :x)))",
    "a cleanup procedure": "(loop (block b (cleaned (return-from b 1) (sleep 1))))",
    "a cleanup around one": "(loop (block b (unwind-protect (unwind-protect (sleep 1)) (return-from b))))",
    "a host error": "(loop (handler-case (unwind-protect (sleep 1) (car 5)) (error () 1)))",
}

INTERRUPTS = {
    "of a task that waits: it goes on waiting": (
        """(let* ((e (make-event)) (task (spawn (note (wait-for-events e)))))
             (yield) (interrupt-task task (lambda () (note :interrupt))) (sleep 1) (signal e 7))""",
        ["0 :INTERRUPT", "1 7", "None"],
    ),
    "of a task that sleeps: it wakes no earlier": (
        """(let ((task (spawn (progn (sleep 3) (note :woken)))))
             (sleep 1) (interrupt-task task (lambda () (note :interrupt))) (wait-for-task task) nil)""",
        ["1 :INTERRUPT", "3 :WOKEN", "None"],
    ),
    "that lasts longer than the sleep": (
        """(let ((task (spawn (progn (sleep 3) (note :woken)))))
             (sleep 1) (interrupt-task task (lambda () (sleep 5))) (wait-for-task task) nil)""",
        ["6 :WOKEN", "None"],
    ),
    "a signal that comes during it is not lost": (
        """(let* ((e (make-event)) (task (spawn (note (wait-for-events e)))))
             (yield) (interrupt-task task (lambda () (sleep 2) (note :interrupt)))
             (sleep 1) (signal e 7) (wait-for-task task) nil)""",
        ["2 :INTERRUPT", "2 7", "None"],
    ),
    "of a task in a loop": (
        """(let ((done nil) (task nil))
             (setq task (spawn (progn (loop (when done (return))) (note :out))))
             (sleep 0.5) (interrupt-task task (lambda () (setq done t))) (wait-for-task task) nil)""",
        ["0.501 :OUT", "None"],
    ),
    "inside WITHOUT-INTERRUPTS it is put off, of oneself too": (
        """(progn (without-interrupts (interrupt-task (current-task) (lambda () (note :interrupt)))
               (note :first))
                  (note :then))""",
        ["0 :FIRST", "0 :INTERRUPT", "0 :THEN", "None"],
    ),
    "nested WITHOUT-INTERRUPTS put it off to the end of the outer": (
        """(without-interrupts
             (without-interrupts (interrupt-task (current-task) (lambda () (note :interrupt))) (sleep 1))
             (sleep 1) (note :mine))""",
        ["2 :MINE", "2 :INTERRUPT", "None"],
    ),
    "inside a cleanup it is put off": (
        """(progn (protected 1 (interrupt-task (current-task) (lambda () (note :interrupt))) (sleep 1)
               (note :clean))
                  (sleep 1) (note :end))""",
        ["0 :ENTER-PROTECTED 1", "0 :CLEAN-PROTECTED 1", "1 :CLEAN", "1 :INTERRUPT", "2 :END", "None"],
    ),
    "of a task that leaves a cleanup by a jump": (
        """(let ((task (spawn (progn (with-recovery-procedures (:x (abort))
                                       (protected (sleep 1) (sleep 2) (fail :x)))
                                     (note :out) (sleep 2) (note :end)))))
             (sleep 2) (interrupt-task task (lambda () (note :interrupt))) (wait-for-task task) nil)""",
        ["0 :ENTER-PROTECTED 1", "1 :CLEAN-PROTECTED 1", "3 :OUT", "3 :INTERRUPT", "5 :END", "None"],
    ),
    "of a task that leaves WITHOUT-INTERRUPTS by a jump": (
        """(let ((task (spawn (progn (block b (without-interrupts (sleep 2) (return-from b 1)))
                                     (note :out) (sleep 2) (note :end)))))
             (sleep 1) (interrupt-task task (lambda () (note :interrupt))) (wait-for-task task) nil)""",
        ["2 :OUT", "2 :INTERRUPT", "4 :END", "None"],
    ),
    "it may jump out of what it interrupts, which is cleaned up": (
        """(block b
             (let ((me (current-task)))
               (spawn (interrupt-task me (lambda () (return-from b :jumped))))
               (cleaned (note :cleaned) (sleep 9))))""",
        ["0 :ENTER 1", "0 :CLEAN 1", "0 :CLEANED", ":JUMPED"],
    ),
    "its failure is answered where it stands": (
        """(let ((task (spawn (with-recovery-procedures (:x (note :answered) (abort 5)) (sleep 9)))))
             (sleep 1) (interrupt-task task (lambda () (fail :x))) (wait-for-task task))""",
        ["1 :ANSWERED", "5"],
    ),
    "interrupts come in their order": (
        """(let ((task (spawn (sleep 2))))
             (yield)
             (dolist (i '(1 2 3)) (let ((i i)) (interrupt-task task (lambda () (note i)))))
             (wait-for-task task) nil)""",
        ["0 1", "0 2", "0 3", "None"],
    ),
    "an interrupt may interrupt another": (
        """(let ((task (spawn (sleep 5))))
             (yield)
             (interrupt-task task (lambda () (note :outer) (sleep 2) (note :outer-ends)))
             (sleep 1)
             (interrupt-task task (lambda () (note :inner) (sleep 2) (note :inner-ends)))
             (wait-for-task task) nil)""",
        ["0 :OUTER", "1 :INNER", "3 :INNER-ENDS", "3 :OUTER-ENDS", "None"],
    ),
    "what it spawns while its task waits for its children is waited for, too": (
        """(task-net (owner (spawn (sleep 3)) (note :body-ends))
                     (other (sleep 1)
                            (interrupt-task owner (lambda () (spawn (progn (sleep 5) (note :whole)))))))""",
        ["0 :BODY-ENDS", "6 :WHOLE", "None"],
    ),
    "of a task that has ended nothing comes": (
        """(let ((task (spawn 1))) (wait-for-task task) (interrupt-task task (lambda () (note :never))) 2)""",
        ["2"],
    ),
    "of a task before its first step: it comes first": (
        """(let ((task (spawn (note :body))))
             (interrupt-task task (lambda () (note :interrupt))) (wait-for-task task) nil)""",
        ["0 :INTERRUPT", "0 :BODY", "None"],
    ),
}


@pytest.mark.parametrize("claim", ABORTS)
def test_abort(claim: str) -> None:
    plan, expected = ABORTS[claim]
    assert trace_of(plan) == expected


@pytest.mark.parametrize("way", SURVIVORS)
def test_no_task_survives_an_abort_by_jumping_out_of_its_cleanup_by(way: str) -> None:
    plan = f"""(let ((task (spawn {SURVIVORS[way]})))
                 (sleep 0.5) (abort-task task)
                 (with-deadline (9) (wait-for-task task)) (task-status task))"""
    assert trace_of(plan)[-1] == ":ABORTED"


@pytest.mark.parametrize("claim", INTERRUPTS)
def test_interrupt(claim: str) -> None:
    plan, expected = INTERRUPTS[claim]
    assert trace_of(plan) == expected
