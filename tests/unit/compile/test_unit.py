"""Variants: a function gives all its values where they are wanted, and one where not."""

from __future__ import annotations

import pytest
from compiling import values_of

TAILS = [
    "(progn 0 {})",
    "(let ((v 1)) v {})",
    "(let ((*%u* 1)) {})",
    "(let* ((v 1) (*%u* v)) {})",
    "(if t {} 0)",
    "(if nil 0 {})",
    "(cond (nil 0) (t {}))",
    "(case 1 (1 {}))",
    "(when t {})",
    "(unless nil {})",
    "(and 1 {})",
    "(or nil {})",
    "(block b {})",
    "(block b (return-from b {}))",
    "(block b (funcall (lambda () (return-from b {}))))",
    "(catch 'c {})",
    "(catch 'c (throw 'c {}))",
    "(unwind-protect {} (values 7 8 9))",
    "(multiple-value-prog1 {} (values 7 8 9))",
    "(multiple-value-call #'values {})",
    "(multiple-value-bind (v) (values 7 8 9) v {})",
    "(flet ((f () {})) (f))",
    "(labels ((f (n) (if (= n 0) {} (f (- n 1))))) (f 2))",
    "(funcall (lambda () {}))",
    "(apply (lambda (v) v {}) '(1))",
    "(macrolet ((m () '{})) (m))",
    "(symbol-macrolet ((s {})) s)",
    "(locally {})",
    "(the t {})",
    "(eval '{})",
    "(progv '() '() {})",
    "(dolist (v '(1) {}))",
    "(dotimes (v 2) (return {}))",
    "(loop (return {}))",
    "(destructuring-bind (v) '(1) v {})",
    "(handler-case {} (error () 0))",
    "(with-recovery-procedures ((:x 0)) {})",
    "(with-cleanup-procedure 0 {})",
]
ONE_VALUE = ["(prog1 {} 0)", "(list {})", "(setq *%u* {})", "(or {} 0)", "(cond ({}))", "(let ((v {})) v)"]


@pytest.mark.parametrize(
    "values", ["(values 1 2)", "(values)", "(values 1)", "(floor 7 2)", "(values-list '(4 5))"]
)
@pytest.mark.parametrize("tail", TAILS)
def test_all_values_come_out_of_every_tail(tail: str, values: str) -> None:
    form = tail.format(values)
    wanted = values_of(values)
    assert values_of(f"(defvar *%u* 0) {form}") == wanted
    assert values_of(f"(multiple-value-list {form})") == (f"({wanted})" if wanted else "NIL")
    first = wanted.split(" ")[0] or "NIL"
    assert values_of(f"(list {form} (values {form}))") == f"({first} {first})"


@pytest.mark.parametrize("form", ONE_VALUE)
def test_one_value_comes_out_of_what_is_no_tail(form: str) -> None:
    assert " " not in values_of(f"(defvar *%u* 0) {form.format('(values 1 2)')}")


def test_no_stale_values_come_along() -> None:
    text = """
    (defun %u1 () (values 1 2 3))
    (defun %u2 () (%u1) (car '(5)))
    (defun %u3 (x) (if x (%u1) 6))
    (list (multiple-value-list (%u2)) (multiple-value-list (%u3 nil)) (multiple-value-list (%u3 t)))"""
    assert values_of(text) == "((5) (6) (1 2 3))"


@pytest.mark.parametrize(
    "body",
    [
        "(values 1 y)",
        "(values 1 (progn y))",
        "(values 1 (let ((z 1)) z y))",
        "(values 1 z y)",
        "(values y 1)",
    ],
)
def test_a_variant_sees_the_variables_that_its_function_captured(body: str) -> None:
    text = f"(let ((y 2) (z 3)) (flet ((g () {body})) (list (g) (multiple-value-list (g)))))"
    assert "2" in values_of(text)


def test_a_variant_shares_variables_with_its_function() -> None:
    text = """
    (let ((n 0))
      (flet ((f () (setq n (+ n 1)) (values n (* 2 n))))
        (f)
        (multiple-value-bind (a b) (f) (list a b (f) n))))"""
    assert values_of(text) == "(2 4 3 3)"


def test_a_redefinition_is_seen_by_those_who_want_all_values() -> None:
    text = "(defun %u4 () (values 1 2)) (defun %u5 () (multiple-value-list (%u4)))"
    assert values_of(f"{text} (%u5)") == "(1 2)"
    assert values_of("(defun %u4 () (values 3 4 5)) (%u5)") == "(3 4 5)"
