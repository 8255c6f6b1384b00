"""What a plan hears that gives the constructs of tasks something wrong."""

from __future__ import annotations

import pytest

from eslang.base.symbols import Keyword
from eslang.tools.expectations import failure_text
from eslang.tools.report import sentence_of
from support import run

REFUSED = {
    "(task-net (a 1) b)": "`b` is no task of a task net",
    "(task-net (a 1) ())": "`nil` is no task of a task net",
    "(task-net (a 1) (b 2) (a 3))": "two tasks of this net are called `a`",
    "(task-net (:a 1))": "`(:a 1)` is no task of a task net",
    '(task-net ("a" 1))': '`("a" 1)` is no task of a task net',
    "(task-net ((a b) 1))": "`((a b) 1)` is no task of a task net",
    "(task-net (nil 1))": "`(nil 1)` is no task of a task net",
    "(task-net (t 1))": "`t` is a constant and cannot be bound",
    "(task-net :allow-failure (a 1))": "`:allow-failure` is no task of a task net",
    "(task-net (a 1) :allow-failures)": "`:allow-failures` is no task of a task net",
    "(task-net (a 1) . b)": "a form cannot end in a dot",
    "(with-deadline 3 (print 1))": "`3` is no deadline",
    "(with-deadline () (print 1))": "`nil` is no deadline",
    "(with-deadline (1 2) (print 1))": "`(1 2)` is no deadline",
    "(with-guardian (sleep 1))": "`with-guardian` takes at least 2 arguments, found 1",
    "(spawn)": "`spawn` takes at least 1 argument, found 0",
    "(wait-until)": "`wait-until` takes at least 1 argument, found 0",
    "(periodically)": "`periodically` takes at least 1 argument, found 0",
    "(whenever)": "`whenever` takes at least 1 argument, found 0",
    "(defevent :obstacle)": "`:obstacle` cannot name a variable",
}
FAILING = {
    "(checkpoint-wait 5 :cp)": ":TYPE-ERROR 5 TASK CHECKPOINT-WAIT",
    "(checkpoint-wait 'a :cp)": ":TYPE-ERROR A TASK CHECKPOINT-WAIT",
    "(wait-for-task nil)": ":TYPE-ERROR NIL TASK WAIT-FOR-TASK",
    "(wait-for-task (make-event 'bell))": ":TYPE-ERROR #<EVENT BELL> TASK WAIT-FOR-TASK",
    "(task-status 3)": ":TYPE-ERROR 3 TASK TASK-STATUS",
    "(abort-task nil)": ":TYPE-ERROR NIL TASK ABORT-TASK",
    "(interrupt-task 5 (lambda ()))": ":TYPE-ERROR 5 TASK INTERRUPT-TASK",
    "(interrupt-task (current-task) 5)": ":TYPE-ERROR 5 FUNCTION",
    "(wait-for-events 5)": ":TYPE-ERROR 5 EVENT WAIT-FOR-EVENTS",
    "(wait-for-events (list (make-event) 5))": ":TYPE-ERROR 5 EVENT WAIT-FOR-EVENTS",
    "(wait-for-events (make-event) 5)": ":TYPE-ERROR 5 FUNCTION",
    "(wait-for-events nil)": ':DEADLOCK ("main" "an event of an empty list" "nothing can end such a wait")',
    "(signal 'bell 1)": ":TYPE-ERROR BELL EVENT SIGNAL",
    "(sleep -1)": ":TYPE-ERROR -1 NON-NEGATIVE-REAL SLEEP",
    "(sleep :long)": ":TYPE-ERROR :LONG NON-NEGATIVE-REAL SLEEP",
    "(with-deadline (-1) 2)": ":TYPE-ERROR -1 NON-NEGATIVE-REAL WITH-DEADLINE",
    '(with-deadline ("3") 2)': ':TYPE-ERROR "3" NON-NEGATIVE-REAL WITH-DEADLINE',
    "(wait-until nil :timeout -1)": ":TYPE-ERROR -1 NON-NEGATIVE-REAL WAIT-UNTIL",
    "(wait-until nil :timeou 1)": ":ERROR unknown keyword argument :TIMEOU",
    "(wait-until nil :timeout)": ":ERROR odd number of keyword arguments :TIMEOUT",
    "(periodically 0 1)": ":TYPE-ERROR 0 POSITIVE-REAL PERIODICALLY",
    "(spawn 1 :deamon t)": ":ERROR unknown keyword argument :DEAMON",
    "(spawn 1 :name 5)": ":TYPE-ERROR 5 SYMBOL SPAWN",
}


@pytest.mark.parametrize("form", REFUSED)
def test_a_form_that_is_written_wrongly_is_refused(form: str) -> None:
    came = run(form)
    assert came.error is not None
    assert came.error.diagnostic.message == REFUSED[form]


@pytest.mark.parametrize("form", FAILING)
def test_a_wrong_value_is_a_failure_that_names_it(form: str) -> None:
    came = run(form)
    assert came.failure is not None
    assert failure_text(came.failure) == FAILING[form]


def test_the_types_that_failures_name_are_those_of_plans() -> None:
    came = run("(with-recovery-procedures (((:type-error it type) (print type) (abort))) (wait-for-task 1))")
    assert came.output == "\nTASK "


def test_a_sentence_leaves_the_name_that_it_begins_with_as_it_is() -> None:
    failure = run("(checkpoint)").failure
    assert sentence_of(failure) == "CHECKPOINT missing 1 required argument"


def test_the_body_of_a_repetition_may_be_an_atom() -> None:
    assert run("(with-deadline (3) (periodically 1 t))").failure.cause is Keyword("DEADLINE-EXPIRED")
    assert run("(with-deadline (3) (let ((on t)) (whenever on on)))").failure.cause is Keyword(
        "DEADLINE-EXPIRED"
    )
