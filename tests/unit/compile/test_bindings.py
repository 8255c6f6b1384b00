"""Bindings: LET and its kin, special variables, multiple values."""

from __future__ import annotations

import pytest
from compiling import failure_of, mistake_of, values_of

SPECIAL = "(defvar *%v* 0) (defun %v () *%v*)"


@pytest.mark.parametrize(
    ("form", "expected"),
    [
        ("(let ())", "NIL"),
        ("(let ((x 1) y (z)) (list x y z))", "(1 NIL NIL)"),
        ("(let ((x 1)) (let ((x (+ x 1)) (y x)) (list x y)))", "(2 1)"),
        ("(let ((x 1)) (let* ((x (+ x 1)) (y x)) (list x y)))", "(2 2)"),
        ("(let* ((x 1) (x (+ x 1))) x)", "2"),
        ("(let ((x 1)) (values x x))", "1 1"),
        ("(let ((x (values 1 2))) x)", "1"),
        ("(symbol-macrolet ((x (car c))) (let ((c (list 1 2))) (setq x 5) (list x c)))", "(5 (5 2))"),
        ("(symbol-macrolet ((x (values 1 2))) x)", "1 2"),
        ("(symbol-macrolet ((x 1)) (let ((x 2)) x))", "2"),
        ("(values)", ""),
        ("(values 1)", "1"),
        ("(values 1 nil 3)", "1 NIL 3"),
        ("(list (values) (values 1 2))", "(NIL 1)"),
        ("(multiple-value-bind (a b c) (values 1 2) (list a b c))", "(1 2 NIL)"),
        ("(multiple-value-bind (a) (values 1 2) a)", "1"),
        ("(multiple-value-bind () (values 1 2) 5)", "5"),
        ("(multiple-value-bind (a b) (floor 7 2) (values b a))", "1 3"),
        ("(multiple-value-bind (a b) 5 (list a b))", "(5 NIL)"),
        ("(multiple-value-bind (a b) (values) (list a b))", "(NIL NIL)"),
        ("(multiple-value-call #'list 1 (values 2 3) (values) 4)", "(1 2 3 4)"),
        ("(multiple-value-call #'floor (values 7 2))", "3 1"),
        ("(multiple-value-call 'list)", "NIL"),
        ("(multiple-value-prog1 (values 1 2) (values 3 4))", "1 2"),
        ("(multiple-value-list (values 1 2))", "(1 2)"),
        ("(let (a b) (multiple-value-setq (a b) (floor 7 2)) (list a b))", "(3 1)"),
        ("(nth-value 1 (floor 7 2))", "1"),
    ],
)
def test_the_values_of_a_form(form: str, expected: str) -> None:
    assert values_of(form) == expected


@pytest.mark.parametrize(
    ("form", "expected"),
    [
        ("(let ((*%v* 1)) (%v))", "1"),
        ("(let ((*%v* 1) (x *%v*)) (list x (%v)))", "(0 1)"),
        ("(let* ((*%v* 1) (x (%v))) (list x (%v)))", "(1 1)"),
        ("(let ((*%v* 1)) (values (%v) *%v*))", "1 1"),
        ("(list (let ((*%v* 1)) (setq *%v* 2) (%v)) (%v))", "(2 0)"),
        ("(list (funcall (lambda (*%v*) (%v)) 3) (%v))", "(3 0)"),
        ("(funcall (lambda (*%v* &optional (x (%v)) &aux (y (%v))) (list x y)) 3)", "(3 3)"),
        ("(funcall (lambda (x &optional (*%v* x p) &key (k (%v))) (list (%v) p k)) 3)", "(3 NIL 3)"),
        ("(funcall (lambda (&key ((:v *%v*) 4 p) (k (%v))) (list p k)) :v 7)", "(T 7)"),
        ("(funcall (lambda (&rest *%v*) (%v)) 1 2)", "(1 2)"),
        ("(multiple-value-bind (*%v* x) (values 5 6) (list (%v) x))", "(5 6)"),
        ("(list (progv '(*%v*) '(8) (%v)) (%v))", "(8 0)"),
        ("(progv '(*%v* *%w*) '(1 2) (list (%v) (symbol-value '*%w*)))", "(1 2)"),
        ("(list (catch 'c (let ((*%v* 1)) (throw 'c (%v)))) (%v))", "(1 0)"),
        ("(list (block b (let ((*%v* 1)) (return-from b (%v)))) (%v))", "(1 0)"),
        (
            "(let ((x 1)) (declare (special x)) (let ((x 2)) (list x (locally (declare (special x)) x))))",
            "(2 1)",
        ),
        ("(let ((%n 1)) (declare (special %n)) (flet ((f () (declare (special %n)) %n)) (f)))", "1"),
    ],
)
def test_special_variables_are_bound_dynamically(form: str, expected: str) -> None:
    assert values_of(f"{SPECIAL} {form}") == expected
    assert values_of("(%v)") == "0"


def test_progv_without_a_value_makes_unbound() -> None:
    assert failure_of(f"{SPECIAL} (progv '(*%v*) '() (%v))") == ":UNBOUND-VARIABLE *%V*"
    assert values_of("(%v)") == "0"


def test_progv_of_what_is_no_symbol_binds_nothing() -> None:
    assert failure_of(f"{SPECIAL} (progv '(*%v* 5) '(1 2) (%v))", 1) == ":TYPE-ERROR 5"
    assert values_of("(%v)") == "0"


@pytest.mark.parametrize(
    ("form", "name"),
    [
        ("(let (5))", "malformed-binding"),
        ("(let ((x 1 2)))", "malformed-binding"),
        ("(let x)", "malformed-binding"),
        ("(let ((:k 1)))", "constant-assignment"),
        ("(let ((t 1)))", "constant-assignment"),
        ("(multiple-value-bind (5) 1)", "malformed-binding"),
    ],
)
def test_a_wrong_binding_is_refused(form: str, name: str) -> None:
    assert mistake_of(form) == name


@pytest.mark.parametrize("star", ["", "*"])
def test_a_thousand_variables(star: str) -> None:
    pairs = " ".join(f"(a{n} {n})" for n in range(1000))
    assert values_of(f"(let{star} ({pairs}) (+ a0 a999))") == "999"
