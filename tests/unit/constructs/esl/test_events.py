"""Events: what wakes whom."""

from __future__ import annotations

from eslang.interpreter import Interpreter
from support import lines_of


def test_a_test_is_asked_in_the_waiting_task() -> None:
    text = """
    (defevent seen)
    (task-net
      (waiter (with-recovery-procedures ((:odd (abort (print :answered-where-it-waits))))
                (wait-for-events seen (lambda (n) (if (oddp n) (fail :odd) (= n 4))))))
      (signaller (yield) (signal seen 2) (signal seen 3) (print :signalled)))
    """
    assert lines_of(text) == [":SIGNALLED", ":ANSWERED-WHERE-IT-WAITS"]


def test_no_signal_is_lost_while_a_test_waits() -> None:
    text = """
    (defevent seen)
    (task-net
      (waiter (print (wait-for-events seen (lambda (n) (sleep 1) (= n 3)))))
      (signaller (yield) (signal seen 1) (signal seen 2) (sleep 0.5) (signal seen 3)))
    """
    assert lines_of(text) == ["3"]


def test_a_variable_that_held_something_else_holds_an_event_then() -> None:
    with Interpreter() as agent:
        agent.eval("(defvar bell 5) (defevent bell)")
        assert agent.eval("(typep bell 'event)") is True
        agent.eval("(defvar *kept* bell) (defevent bell)")
        assert agent.eval("(eq bell *kept*)") is True
