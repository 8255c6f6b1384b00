"""Definitions: DEFUN, DEFMACRO, and the DEFVAR family."""

from __future__ import annotations

import pytest
from compiling import failure_of, mistake_of, values_of


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("(defun %f1 (x) (* x 2))", "%F1"),
        ("(defun %f1 (x) (* x 2)) (%f1 4)", "8"),
        ('(defun %f2 (x) "Doc." (declare (ignorable x)) (return-from %f2 (values 1 2)) 3) (%f2 1)', "1 2"),
        ('(defun %f3 () "just a value") (%f3)', '"just a value"'),
        ("(let ((n 0)) (defun %f4 () (setq n (+ n 1)))) (%f4) (%f4)", "2"),
        ("(defun (setf %f5) (v x) (list v x)) (setf (%f5 1) 2)", "(2 1)"),
        ("(defmacro %m1 (x &rest r) `(list ,x ,@r)) (%m1 1 2 3)", "(1 2 3)"),
        ("(defmacro %m2 (&body b) `(progn ,@b)) (%m2 1 (values 2 3))", "2 3"),
        ("(progn (defmacro %m3 () 5) (list (%m3)))", "(5)"),
        ("(defun %f6 () (%m4)) (defmacro %m4 () 5) 1", "1"),
        ("(defvar *%d1*) (defvar *%d1* 5) (defvar *%d1* 6) *%d1*", "5"),
        ("(defparameter *%d2* 5) (defparameter *%d2* 6) *%d2*", "6"),
        ("(defconstant +%d3+ 5) (list +%d3+)", "(5)"),
        ("(defvar *%d4* 1 \"Doc.\") (documentation '*%d4* 'variable)", '"Doc."'),
        ("(defun %f7 () (%f8)) (defun %f8 () 1) (defun %f8 () 2) (%f7)", "2"),
        ("(defun %f9 (n) (if (= n 0) 0 (+ 1 (%f9 (- n 1))))) (%f9 1000)", "1000"),
    ],
)
def test_what_a_definition_gives(text: str, expected: str) -> None:
    assert values_of(text) == expected


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("(defun)", "malformed-form"),
        ("(defun 5 ())", "malformed-form"),
        ("(defun :k ())", "malformed-form"),
        ("(defun if ())", "redefined-special-form"),
        ("(defun %f (x x) x)", "malformed-lambda-list"),
        ("(defconstant +%d5+ 1) (setq +%d5+ 2)", "constant-assignment"),
        ("(defconstant +%d6+ 1) (let ((+%d6+ 2)) 1)", "constant-assignment"),
        ("(defmacro %m (&optional 5) 1)", "malformed-lambda-list"),
    ],
)
def test_a_wrong_definition_is_refused(text: str, name: str) -> None:
    assert mistake_of(text) == name


def test_a_variable_without_a_value_is_special_but_unbound() -> None:
    assert failure_of("(defvar *%d7*) *%d7*") == ":UNBOUND-VARIABLE *%D7*"
    assert values_of("(let ((*%d7* 1)) (symbol-value '*%d7*))") == "1"


def test_a_definition_takes_effect_when_it_is_run() -> None:
    assert values_of("(if nil (defun %f10 () 1)) (fboundp '%f10)") == "NIL"
