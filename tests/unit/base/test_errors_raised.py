"""Python's errors, as failures of the host: the right cause, and arguments that tell what happened."""

from __future__ import annotations

from io import StringIO
from typing import Any

import pytest

from eslang import Failure, Interpreter
from support import run

CASES = {
    "(car 5)": ":TYPE-ERROR 5 LIST",
    '(+ "a" "b")': ':TYPE-ERROR "a" NUMBER',
    '(< "a" 1)': ':TYPE-ERROR "a"',
    '(* "a" 3)': ':TYPE-ERROR "a" NUMBER',
    "(1+ nil)": ":TYPE-ERROR NIL NUMBER",
    "(- nil)": ":TYPE-ERROR NIL NUMBER",
    "(funcall 5)": ":TYPE-ERROR 5 FUNCTION",
    '(funcall "car" 1)': ':TYPE-ERROR "car" FUNCTION',
    "(let ((f nil)) (funcall f))": ":UNDEFINED-FUNCTION NIL",
    "(length 5)": ":TYPE-ERROR 5 SEQUENCE",
    "(/ 1 0)": ":DIVISION-BY-ZERO",
    "(/ 1.5 0)": ":DIVISION-BY-ZERO",
    "(mod 5 0)": ":DIVISION-BY-ZERO",
    "(floor 5 0)": ":DIVISION-BY-ZERO",
    "nosuch": ":UNBOUND-VARIABLE NOSUCH",
    "(setf (symbol-value 'x) 1 x nosuch)": ":UNBOUND-VARIABLE NOSUCH",
    "(nosuch (car 5))": ":UNDEFINED-FUNCTION NOSUCH",
    "(funcall 'nosuch)": ":UNDEFINED-FUNCTION NOSUCH",
    "#'nosuch": ":UNDEFINED-FUNCTION NOSUCH",
    "(setf (nosuch 1) 2)": ":UNDEFINED-FUNCTION (SETF NOSUCH)",
    "(mapcar 'nosuch '(1))": ":UNDEFINED-FUNCTION NOSUCH",
    "(defun f (x) x) (f)": ":WRONG-NUMBER-OF-ARGUMENTS F",
    "(defun f (x) x) (f 1 2)": ":WRONG-NUMBER-OF-ARGUMENTS F",
    "(flet ((g (x) x)) (g))": ":WRONG-NUMBER-OF-ARGUMENTS G",
    "(funcall (lambda (x) x))": ":WRONG-NUMBER-OF-ARGUMENTS LAMBDA",
    "(car)": ":WRONG-NUMBER-OF-ARGUMENTS CAR",
    "(funcall #'cons 1)": ":WRONG-NUMBER-OF-ARGUMENTS CONS",
    "(operate-widget 1 2)": ":WRONG-NUMBER-OF-ARGUMENTS OPERATE-WIDGET",
    "(aref (vector 1 2) 2)": ":INDEX-OUT-OF-RANGE 2 #(1 2)",
    "(aref (vector 1 2) -1)": ":INDEX-OUT-OF-RANGE -1 #(1 2)",
    '(char "ab" 2)': ':INDEX-OUT-OF-RANGE 2 "ab"',
    "(elt '(1) 1)": ":INDEX-OUT-OF-RANGE 1 (1)",
    '(error "~a is odd" 5)': ':ERROR "5 is odd"',
}


DEEP = "(labels ((f () (+ 1 (f)))) (f))"


def told(failure: Failure) -> str:
    """The cause and arguments of FAILURE, as they print."""
    from eslang.base.printer import prin1

    return " ".join(map(prin1, (failure.cause, *failure.arguments)))


@pytest.mark.parametrize("text", CASES)
def test_a_host_error_has_its_own_cause(text: str) -> None:
    assert told(run(text).failure).startswith(CASES[text])


@pytest.mark.parametrize("text", CASES)
def test_a_recovery_procedure_can_take_it(text: str) -> None:
    cause = CASES[text].partition(" ")[0]
    clause = f"({cause} (abort (failure-cause)))"
    defined, _, form = text.rpartition(") (f") if text.startswith("(defun") else ("", "", "")
    if defined:
        text = f"(f{form}"
    with Interpreter(clock="virtual", output=StringIO()) as interp:
        if defined:
            interp.eval(defined + ")")
        assert str(interp.eval(f"(with-recovery-procedures ({clause}) {text})")) == cause


@pytest.mark.slow
def test_recursion_without_end_exhausts_the_stack_and_can_be_answered() -> None:
    assert told(run(DEEP).failure) == ":STACK-EXHAUSTED"
    with Interpreter(clock="virtual", output=StringIO()) as interp:
        assert interp.eval(f"(with-recovery-procedures ((:stack-exhausted (abort 7))) {DEEP})") == 7


def test_an_error_of_a_primitive_is_a_python_error_with_its_message() -> None:
    with Interpreter(clock="virtual", output=StringIO()) as interp:

        @interp.primitive
        def read_sensor() -> Any:
            raise OSError("no such port")

        with pytest.raises(Failure) as caught:
            interp.eval("(read-sensor)")
    assert told(caught.value).startswith(':PYTHON-ERROR "OSError" "no such port"')


def test_an_error_inside_a_primitive_is_not_taken_for_one_of_the_plan() -> None:
    """A primitive's own TypeError or ZeroDivisionError is its own business."""
    with Interpreter(clock="virtual", output=StringIO()) as interp:

        @interp.primitive
        def read_sensor() -> Any:
            return 1 // 0

        with pytest.raises(Failure) as caught:
            interp.eval("(read-sensor)")
    assert str(caught.value.cause) == ":PYTHON-ERROR"


def test_the_python_error_is_kept_behind_its_failure() -> None:
    with Interpreter(clock="virtual", output=StringIO()) as interp:

        @interp.primitive
        def read_sensor() -> Any:
            raise OSError("no such port")

        with pytest.raises(Failure) as caught:
            interp.eval("(read-sensor)")
    assert isinstance(caught.value.__cause__, OSError)


@pytest.mark.parametrize(
    ("text", "told_as"),
    [
        ("(special-operator-p 5)", ":TYPE-ERROR 5 SYMBOL"),
        ("(macroexpand 'x 5)", ":TYPE-ERROR 5 ENVIRONMENT"),
        ("(subtypep 5 6)", ":TYPE-ERROR 5 SYMBOL"),
    ],
)
def test_the_languages_own_functions_complain_in_its_words(text: str, told_as: str) -> None:
    assert told(run(text).failure) == told_as


def test_an_attribute_error_of_python_code_is_not_taken_for_one_of_the_plan() -> None:
    with Interpreter(clock="virtual", output=StringIO()) as interp:

        @interp.primitive
        def read_sensor() -> Any:
            return object().name  # type: ignore[attr-defined]

        with pytest.raises(Failure) as caught:
            interp.eval("(read-sensor)")
    assert str(caught.value.cause) == ":PYTHON-ERROR"
