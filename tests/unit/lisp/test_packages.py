"""Packages as plans see them."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(multiple-value-list (intern "ZORK1"))', "(ZORK1 NIL)"),
        ('(multiple-value-list (intern "CAR"))', "(CAR :INHERITED)"),
        ('(multiple-value-list (find-symbol "NOSUCH"))', "(NIL NIL)"),
        ('(multiple-value-list (find-symbol "CAR" :cl))', "(CAR :EXTERNAL)"),
        ('(multiple-value-list (intern "A" :keyword))', "(:A :EXTERNAL)"),
        ("(intern 'a)", "failure :TYPE-ERROR"),
        ('(intern "A" :nosuch)', "failure :ERROR"),
    ],
)
def test_interning(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(package-name (find-package :cl))", '"COMMON-LISP"'),
        ('(find-package "NOSUCH")', "NIL"),
        ('(package-name "NOSUCH")', "failure :ERROR"),
        ("(package-name (symbol-package 'car))", '"COMMON-LISP"'),
        ("(package-name (symbol-package :a))", '"KEYWORD"'),
    ],
)
def test_finding(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(package-name (make-package "P1"))', '"P1"'),
        ('(progn (make-package "P2") (make-package "P2"))', "failure :ERROR"),
        ('(progn (make-package "P3") (delete-package "P3") (find-package "P3"))', "NIL"),
    ],
)
def test_a_package_can_be_made_once(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (
            (
                '(let ((p (make-package "P4")) (q (make-package "P5"))) (export (intern "X" p) p) '
                '(use-package p q) (list (find-symbol "X" q) (package-use-list p)))'
            ),
            '(X (#<PACKAGE "COMMON-LISP">))',
        ),
        (
            '(let ((p (make-package "P6"))) (use-package p (make-package "P7")) (delete-package p))',
            "failure :ERROR",
        ),
        ('(export \'elsewhere (make-package "P8"))', "failure :ERROR"),
        (
            (
                '(let ((p (make-package "P9")) found) (export (list (intern "A" p) (intern "B" p)) '
                'p) (unexport (intern "B" p) p) (do-external-symbols (s p found) (push s found)))'
            ),
            "(A)",
        ),
    ],
)
def test_what_is_exported_is_inherited(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (
            (
                "(progn (defpackage :q1 (:nicknames :q1-nick) (:use :cl) (:shadow :car) "
                "(:import-from :esl :fail) (:intern :internal) (:export :move)) (list (package-name "
                ':q1-nick) (multiple-value-list (find-symbol "CAR" :q1)) (multiple-value-list '
                '(find-symbol "MOVE" :q1)) (multiple-value-list (find-symbol "CONS" :q1)) '
                "(package-shadowing-symbols :q1)))"
            ),
            '("Q1" (CAR :INTERNAL) (MOVE :EXTERNAL) (CONS :INHERITED) (CAR))',
        ),
    ],
)
def test_defpackage_imports_shadows_and_exports(form: str, value: str) -> None:
    assert value_of(form) == value
