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
        ('(make-package "P1")', "failure :ERROR"),
        ('(intern "X" "P1")', "X"),
        ('(multiple-value-list (find-symbol "X" "P1"))', "(X :INTERNAL)"),
        ('(export (find-symbol "X" "P1") "P1")', "T"),
        ('(multiple-value-list (find-symbol "X" "P1"))', "(X :EXTERNAL)"),
        ('(let (found) (do-external-symbols (s "P1" found) (push s found)))', "(X)"),
        ('(export \'elsewhere "P1")', "failure :ERROR"),
        ('(use-package "P1" (make-package "P2"))', "T"),
        ('(multiple-value-list (find-symbol "X" "P2"))', "(X :INHERITED)"),
        ('(delete-package "P1")', "failure :ERROR"),
    ],
)
def test_making_and_changing(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (
            "(package-name (defpackage :p3 (:nicknames :p3-nick) (:use :cl) (:shadow :car) "
            "(:import-from :esl :fail) (:intern :internal) (:export :move)))",
            '"P3"',
        ),
        ("(package-name :p3-nick)", '"P3"'),
        ('(multiple-value-list (find-symbol "CAR" :p3))', "(CAR :INTERNAL)"),
        ('(multiple-value-list (find-symbol "MOVE" :p3))', "(MOVE :EXTERNAL)"),
        ('(multiple-value-list (find-symbol "CONS" :p3))', "(CONS :INHERITED)"),
        ("(package-shadowing-symbols :p3)", "(CAR)"),
    ],
)
def test_defpackage_imports_shadows_and_exports(form: str, value: str) -> None:
    assert value_of(form) == value
