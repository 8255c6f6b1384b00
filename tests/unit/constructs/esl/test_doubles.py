"""Doubles: scripted stand-ins for what a plan calls."""

from __future__ import annotations

import pytest

from eslang.base.failure import Failure
from eslang.interpreter import Interpreter
from support import lines_of


def test_steps_answer_calls_in_order_and_the_last_one_all_others() -> None:
    text = """
    (with-doubles ((f (:returns 1) (:times 2 (:returns 2)) (:returns 3)))
      (print (list (f) (f) (f) (f) (f))))
    """
    assert lines_of(text) == ["(1 2 2 3 3)"]


def test_a_double_can_compute_pass_on_and_give_many_values() -> None:
    text = """
    (defun f (x) (list :real x))
    (with-doubles ((f (:calls (lambda (x) (* x x))) (:passes) (:returns 1 2)))
      (print (f 4))
      (print (f 5))
      (print (multiple-value-list (f))))
    (print (f 6))
    """
    assert lines_of(text) == ["16", "(:REAL 5)", "(1 2)", "(:REAL 6)"]


def test_a_doubles_failure_is_raised_at_the_place_of_the_call() -> None:
    text = """
    (with-doubles ((grip-force (:fails :grip-lost 4)))
      (print (with-recovery-procedures (((:grip-lost n) (* n 10)))
               (+ 1 (grip-force)))))
    """
    assert lines_of(text) == ["41"]


def test_a_delay_lets_time_pass() -> None:
    with Interpreter(clock="virtual") as interp:
        interp.eval("(with-doubles ((f (:delays 2.5 (:returns 1)))) (f) (f))")
        assert interp.clock.now() == 5.0


def test_doubles_leave_however_the_body_is_left() -> None:
    text = """
    (defun f () :real)
    (with-doubles ((f (:returns :outer)))
      (print (with-doubles ((f (:returns :inner))) (f)))
      (print (f))
      (block out (with-doubles ((f (:returns :inner))) (return-from out)))
      (print (f)))
    (print (f))
    """
    assert lines_of(text) == [":INNER", ":OUTER", ":OUTER", ":REAL"]


def test_a_name_without_a_function_has_none_afterwards() -> None:
    with pytest.raises(Failure) as caught:
        lines_of("(with-doubles ((no-such-device)) (no-such-device)) (no-such-device)")
    assert str(caught.value.cause) == ":UNDEFINED-FUNCTION"


@pytest.mark.parametrize("name", ["car", "when", ":key"])
def test_what_is_no_function_of_a_plan_has_no_double(name: str) -> None:
    with pytest.raises(Failure):
        lines_of(f"(double {name} (:returns 1))")


def test_a_double_can_be_written_in_python() -> None:
    with Interpreter(clock="virtual") as interp:
        double = interp.double("grip-force").returns(3.5, times=2).fails("grip-lost", 4, after=1.5)
        interp.eval(
            "(defun f (side) (with-recovery-procedures (((:grip-lost n) (abort n))) (grip-force side)))"
        )
        assert [interp.call("f", "left") for _ in range(3)] == [3.5, 3.5, 4]
        assert double.calls == [["left"]] * 3
        assert interp.clock.now() == 1.5
        double.does(lambda side: side.upper())
        assert interp.call("f", "left") == "LEFT"
        double.remove()
        with pytest.raises(Failure):
            interp.call("grip-force", "left")
