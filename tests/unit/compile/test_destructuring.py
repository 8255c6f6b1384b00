"""Destructuring: DESTRUCTURING-BIND and the lambda lists of macros."""

from __future__ import annotations

import pytest
from compiling import failure_of, mistake_of, values_of


@pytest.mark.parametrize(
    ("pattern", "value", "result", "expected"),
    [
        ("(a b)", "'(1 2)", "(list a b)", "(1 2)"),
        ("(a (b c) d)", "'(1 (2 3) 4)", "(list a b c d)", "(1 2 3 4)"),
        ("(a . b)", "'(1 2 3)", "(list a b)", "(1 (2 3))"),
        ("(a . b)", "'(1 . 2)", "(list a b)", "(1 2)"),
        ("((a . b) c)", "'((1 . 2) 3)", "(list a b c)", "(1 2 3)"),
        ("(a &optional (b 5 bp) c)", "'(1)", "(list a b bp c)", "(1 5 NIL NIL)"),
        ("(a &optional (b 5 bp))", "'(1 2)", "(list a b bp)", "(1 2 T)"),
        ("(&optional ((a b) '(8 9)))", "'()", "(list a b)", "(8 9)"),
        ("(a &rest r)", "'(1 2 3)", "(list a r)", "(1 (2 3))"),
        ("(a &rest (b c))", "'(1 2 3)", "(list a b c)", "(1 2 3)"),
        ("(a &body r)", "'(1)", "(list a r)", "(1 NIL)"),
        ("(&key x (y (+ x 1) yp))", "'(:x 3)", "(list x y yp)", "(3 4 NIL)"),
        ("(&key ((:x (a b))))", "'(:x (1 2))", "(list a b)", "(1 2)"),
        ("(a &key k &allow-other-keys)", "'(1 :z 2 :k 3)", "(list a k)", "(1 3)"),
        ("(&whole w a)", "'(1)", "(list w a)", "((1) 1)"),
        ("(a ((b)) &aux (c (+ a b)))", "'(1 ((2)))", "c", "3"),
        ("()", "'()", "1", "1"),
        ("(nil a)", "'(nil 2)", "a", "2"),
    ],
)
def test_patterns(pattern: str, value: str, result: str, expected: str) -> None:
    assert values_of(f"(destructuring-bind {pattern} {value} {result})") == expected


@pytest.mark.parametrize(
    ("pattern", "value"),
    [
        ("(a b)", "'(1)"),
        ("(a)", "'(1 2)"),
        ("((a))", "'(1)"),
        ("(a)", "5"),
        ("(&key a)", "'(:b 1)"),
        ("(&key a)", "'(:a)"),
    ],
)
def test_a_list_that_does_not_fit_is_a_failure(pattern: str, value: str) -> None:
    assert failure_of(f"(destructuring-bind {pattern} {value} 1)", 0).startswith((":ERROR", ":TYPE-ERROR"))


def test_declarations_may_stand_at_the_head() -> None:
    assert values_of("(destructuring-bind (a b) '(1 2) (declare (ignore a)) b)") == "2"


def test_a_macro_takes_its_form_apart() -> None:
    text = """
    (defmacro %d1 (&whole form (a b) &key (c 3) &environment e)
      (declare (ignore e))
      `'(,(car form) ,a ,b ,c))
    (list (%d1 (1 2)) (%d1 (1 2) :c 4))"""
    assert values_of(text) == "((%D1 1 2 3) (%D1 1 2 4))"


def test_a_macro_call_that_does_not_fit_is_refused() -> None:
    assert mistake_of("(defmacro %d2 ((a b)) (list a b)) (%d2 5)") == "macro-failed"
    assert mistake_of("(defmacro %d3 (a) a) (%d3)") == "malformed-form"
