"""Functions: LAMBDA, FUNCTION, FLET, LABELS, MACROLET."""

from __future__ import annotations

import pytest
from compiling import failure_of, mistake_of, values_of


@pytest.mark.parametrize(
    ("form", "expected"),
    [
        ("((lambda (x) (values x x)) 1)", "1 1"),
        ("(funcall (lambda ()))", "NIL"),
        ("(funcall #'(lambda (x) x) 5)", "5"),
        ("(funcall #'car '(1))", "1"),
        ("(funcall 'car '(1))", "1"),
        ("(flet ((f (x) (* x 2)) (g (x) (+ x 1))) (f (g 3)))", "8"),
        ("(flet ((f () 1)) (flet ((f () (+ 1 (f)))) (f)))", "2"),
        ("(flet ((f () 1)) (labels ((f (n) (if (= n 0) 0 (+ 1 (f (- n 1)))))) (f 3)))", "3"),
        (
            "(labels ((e (n) (or (= n 0) (o (1- n)))) (o (n) (and (/= n 0) (e (1- n))))) (e 10))",
            "T",
        ),
        ("(flet ((f (x) (return-from f (values 1 2)) x)) (f 1))", "1 2"),
        (
            "(flet ((car (x) (list :mine x))) (list (car 1) (mapcar #'car '((1)))))",
            "((:MINE 1) ((:MINE (1))))",
        ),
        ("(flet (((setf f) (v x) (list v x))) (setf (f 1) 2))", "(2 1)"),
        ("(let ((x 1)) (flet ((f () x)) (let ((x 2)) (list x (f)))))", "(2 1)"),
        ("(let ((n 0)) (flet ((f () (setq n (+ n 1)))) (f) (f) n))", "2"),
        ("(macrolet ((m (x) `(+ 1 ,x))) (m 2))", "3"),
        ("(macrolet ((m () '(values 1 2))) (m))", "1 2"),
        ("(macrolet ((m (x) `(list ,x)) (n (x) `(m ,x))) (n 1))", "(1)"),
        ("(macrolet ((m () 1)) (macrolet ((n () `(+ 1 (m)))) (n)))", "2"),
        ("(macrolet ((m () 1)) (flet ((m () 2)) (m)))", "2"),
        ("(flet ((f () 2)) (macrolet ((f () 1)) (f)))", "1"),
        ("(funcall (lambda (&optional (f (lambda () 3))) (funcall f)))", "3"),
        ("(apply #'+ 1 2 '(3 4))", "10"),
        ("(apply (lambda (&rest r) r) '(1 2 3 4 5 6 7))", "(1 2 3 4 5 6 7)"),
        ("(mapcar (lambda (x y) (- x y)) '(5 6) '(1 2))", "(4 4)"),
    ],
)
def test_the_values_of_a_form(form: str, expected: str) -> None:
    assert values_of(form) == expected


@pytest.mark.parametrize(
    ("form", "name"),
    [
        ("#'if", "bad-operator"),
        ("#'when", "bad-operator"),
        ("#'5", "bad-operator"),
        ("(flet ((5 () 1)))", "malformed-binding"),
        ("(flet (f))", "malformed-binding"),
        ("(macrolet ((m (x) x)) #'m)", "bad-operator"),
    ],
)
def test_what_is_no_function_is_refused(form: str, name: str) -> None:
    assert mistake_of(form) == name


@pytest.mark.parametrize(("called", "datum"), [("5", "5"), ("'(1)", "(1)"), ('"f"', '"f"')])
def test_a_call_of_what_is_no_function_is_a_failure(called: str, datum: str) -> None:
    assert failure_of(f"(let ((f {called})) (funcall f 1))", 2) == f":TYPE-ERROR {datum} FUNCTION"


@pytest.mark.parametrize(
    "call", ["(%f1)", "(%f1 1 2)", "(funcall #'%f1)", "(apply #'%f1 '(1 2))", "(funcall '%f1 1 2 3 4 5 6)"]
)
def test_a_wrong_number_of_arguments_is_a_failure(call: str) -> None:
    assert failure_of(f"(defun %f1 (x) x) {call}", 0) == ":WRONG-NUMBER-OF-ARGUMENTS"


def test_a_call_may_have_three_hundred_arguments() -> None:
    numbers = " ".join(map(str, range(300)))
    assert values_of(f"(+ {numbers})") == str(sum(range(300)))
    assert values_of(f"(funcall (lambda (&rest r) (length r)) {numbers})") == "300"
    names = " ".join(f"a{n}" for n in range(300))
    assert values_of(f"(funcall (lambda ({names}) (list a0 a299)) {numbers})") == "(0 299)"
    counted = " ".join("(setq n (+ n 1))" for _ in range(300))
    assert values_of(f"(let ((n 0)) (length (list {counted} n)))") == "301"
