"""Python's errors, as failures with causes and arguments of the host language."""

from __future__ import annotations

import pytest

from eslang import Failure, Interpreter
from eslang.base.errors import to_failure


def failure_of(form: str) -> str:
    """The cause and arguments of the failure that FORM ends in, printed."""
    interp = Interpreter(clock="virtual")
    text = f"(with-recovery-procedures ((:error (abort (cons (failure-cause) (failure-arguments))))) {form})"
    return str(interp.eval(f"(prin1-to-string {text})"))


@pytest.mark.parametrize(
    ("form", "expected"),
    [
        ("(+ 1 nil)", "(:TYPE-ERROR NIL NUMBER)"),
        ('(+ "a" "b")', '(:TYPE-ERROR "a" NUMBER +)'),
        ("(* 'x 3)", "(:TYPE-ERROR X NUMBER *)"),
        ("(< #\\a 1)", "(:TYPE-ERROR #\\a NUMBER <)"),
        ("(car 5)", "(:TYPE-ERROR 5 LIST)"),
        ("(funcall 5)", "(:TYPE-ERROR 5 FUNCTION)"),
        ("(mod 5 0)", "(:DIVISION-BY-ZERO /)"),
        ("(/ 5 0)", "(:DIVISION-BY-ZERO / 5 0)"),
        ("nowhere", "(:UNBOUND-VARIABLE NOWHERE)"),
        ("(nothing 1)", "(:UNDEFINED-FUNCTION NOTHING)"),
        ("#'nothing", "(:UNDEFINED-FUNCTION NOTHING)"),
        ("(setf (nothing 1) 2)", "(:UNDEFINED-FUNCTION (SETF NOTHING))"),
        ("(aref (vector 1) 1)", "(:INDEX-OUT-OF-RANGE 1 #(1))"),
        (
            "(progn (defun two (a b) (list a b)) (two 1))",
            '(:WRONG-NUMBER-OF-ARGUMENTS TWO "missing 1 required argument")',
        ),
    ],
)
def test_each_situation_has_its_cause_and_arguments(form: str, expected: str) -> None:
    assert failure_of(form) == expected


def test_a_failure_stays_the_failure_that_it_is() -> None:
    failure = Failure("grip-lost", 3)
    assert to_failure(failure) is failure


def test_an_error_of_foreign_code_is_a_python_error_and_is_kept() -> None:
    error = KeyError("sensor")
    failure = to_failure(error)
    assert str(failure.cause) == ":PYTHON-ERROR"
    assert failure.__cause__ is error
    assert failure.arguments[2] is error
