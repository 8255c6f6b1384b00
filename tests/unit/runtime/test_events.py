"""Events, checkpoints, ends of tasks: who is woken, when, and who is not. `1 :X` is a note at second 1."""

from __future__ import annotations

import pytest

from eslang.runtime.events import Event
from trees.running import Run, trace_of

WAITS = {
    "one signal wakes all who wait, in their order, each once": (
        """(task-net (a (note :a (wait-for-events *e1*))) (b (note :b (wait-for-events *e1*)))
                     (c (yield) (signal *e1* 5) (note :signalled) (signal *e1* 6)))""",
        ["0 :SIGNALLED", "0 :A 5", "0 :B 5", "None"],
    ),
    "a signal that nobody waits for is lost": (
        """(progn (signal *e1*) (with-recovery-procedures (:deadlock (abort :lost))
               (wait-for-events *e1*)))""",
        [":LOST"],
    ),
    "a task that waits for several events leaves all of them": (
        """(task-net (a (note (wait-for-events (list *e1* *e2*))) (sleep 2) (note :slept))
                     (b (sleep 1) (signal *e2* 2) (signal *e1* 1)))""",
        ["1 2", "3 :SLEPT", "None"],
    ),
    "a task that waits twice for the same event waits once": (
        """(task-net (a (note (wait-for-events (list *e1* *e1*)))) (b (yield) (signal *e1* 1)))""",
        ["0 1", "None"],
    ),
    "all that came with a signal are values": (
        """(progn (spawn (signal *e1* 1 2 3)) (multiple-value-list (wait-for-events *e1*)))""",
        ["[1, 2, 3]"],
    ),
    "a test that fails is a failure of the task that waits": (
        """(task-net :allow-failures
             (a (note (with-recovery-procedures (:bad (abort :answered))
                        (wait-for-events *e1* (lambda (x) (fail :bad x))))))
             (b (yield) (signal *e1* 1) (note :innocent)))""",
        ["0 :INNOCENT", "0 :ANSWERED", "None"],
    ),
    "a test is put to all signals, those that come while it waits among them": (
        """(task-net (a (note (wait-for-events *e1* (lambda (x) (note :asked x) (sleep 2) (= x 3)))))
                     (b (dolist (i '(1 2 3 4)) (sleep 0.5) (signal *e1* i))))""",
        ["0.5 :ASKED 1", "2.5 :ASKED 2", "4.5 :ASKED 3", "6.5 3", "None"],
    ),
    "a task that leaves its wait by a failure is not woken by it": (
        """(let ((task (spawn (progn (with-recovery-procedures (:out (abort)) (wait-for-events *e1*))
                                     (sleep 3) (note :end)))))
             (yield) (interrupt-task task (lambda () (fail :out))) (sleep 1) (signal *e1*)
             (wait-for-task task) nil)""",
        ["3 :END", "None"],
    ),
    "a checkpoint that was passed before is not missed": (
        """(task-net (a (checkpoint :cp) (sleep 1) (note :a)) (b (sleep 0.5) (checkpoint-wait a :cp)
               (note :b)))""",
        ["0.5 :B", "1 :A", "None"],
    ),
    "a checkpoint that comes later is waited for": (
        """(task-net (a (sleep 1) (checkpoint '(1 "x"))) (b (checkpoint-wait a (list 1 "x")) (note :b)))""",
        ["1 :B", "None"],
    ),
    "a checkpoint of a task that has ended was passed all the same": (
        """(let ((task (spawn (checkpoint 1)))) (wait-for-task task) (checkpoint-wait task 1) :passed)""",
        [":PASSED"],
    ),
    "a checkpoint is not the end of its task": (
        """(task-net (a (checkpoint 1) (sleep 1) (note :end)) (b (wait-for-task a) (note :after)))""",
        ["1 :END", "1 :AFTER", "None"],
    ),
    "a task that has failed has ended": (
        """(let ((task (spawn (fail :x)))) (list (wait-for-task task) (task-status task)))""",
        ["[None, Keyword('FAILED')]"],
    ),
    "a task that was aborted has ended": (
        """(let ((task (spawn (sleep 9))))
             (spawn (progn (sleep 1) (abort-task task)))
             (list (wait-for-task task) (task-status task)))""",
        ["[None, Keyword('ABORTED')]"],
    ),
    "a task is an event that its end signals, with its values": (
        """(let ((task (spawn (progn (sleep 1) (values 1 2)))))
             (multiple-value-list (wait-for-events (list *e1* task))))""",
        ["[1, 2]"],
    ),
    "multiple values come through the end of a task": (
        """(multiple-value-list (wait-for-task (spawn (progn (sleep 1) (values 1 2)))))""",
        ["[1, 2]"],
    ),
    "a signal to a task that is in an interrupt waits for it there": (
        """(let ((task (spawn (note (wait-for-events *e1*)))))
             (yield)
             (interrupt-task task (lambda () (note (wait-for-events *e2*))))
             (sleep 1) (signal *e1* 1) (sleep 1) (signal *e2* 2))""",
        ["2 2", "2 1", "None"],
    ),
    "who is woken goes on after who signals": (
        """(task-net (a (wait-for-events *e1*) (note :woken)) (b (yield) (signal *e1*) (note :signaller)))""",
        ["0 :SIGNALLER", "0 :WOKEN", "None"],
    ),
}


@pytest.mark.parametrize("claim", WAITS)
def test_wait(claim: str) -> None:
    plan, expected = WAITS[claim]
    assert trace_of(plan) == expected


def test_an_event_that_nobody_waits_for_keeps_nothing() -> None:
    run = Run().evaluate("(task-net (a (wait-for-events (list *e1* *e2*))) (b (yield) (signal *e1*)))")
    assert not any(run.interp.value(name).waits for name in ("*e1*", "*e2*"))
    assert not Event().waits
