"""Backquote: templates, at any depth."""

from __future__ import annotations

import pytest
from compiling import mistake_of, values_of


@pytest.mark.parametrize(
    ("template", "expected"),
    [
        ("`a", "A"),
        ("`5", "5"),
        ("`()", "NIL"),
        ("`(a b)", "(A B)"),
        ("`(1 ,(+ 1 1))", "(1 2)"),
        ("`(,@(list 1 2) 3)", "(1 2 3)"),
        ("`(0 ,@(list 1 2))", "(0 1 2)"),
        ("`(,@nil)", "NIL"),
        ("`(1 . ,(+ 1 1))", "(1 . 2)"),
        ("`(,@(list 1) . 2)", "(1 . 2)"),
        ("`(1 (2 ,(+ 1 2) (,@(list 4 5))))", "(1 (2 3 (4 5)))"),
        ("`#(1 ,(+ 1 1) ,@(list 3 4))", "#(1 2 3 4)"),
        ("`(,@'(1 . 2))", "(1 . 2)"),
        ("`,@'(1)", None),
        ("`(a . ,@'(1))", None),
        ("`(a ',(+ 1 2))", "(A '3)"),
        ("`,(values 1 2)", "1 2"),
    ],
)
def test_templates(template: str, expected: str | None) -> None:
    if expected is None:
        assert mistake_of(template) == "misplaced-splice"
    else:
        assert values_of(template) == expected


@pytest.mark.parametrize(
    ("template", "expected"),
    [
        ("(eval ``(a ,(+ 1 ,(+ 1 1))))", "(A 3)"),
        ("(let ((x '(1 2))) (eval ``(a ,@',x)))", "(A 1 2)"),
        ("(let ((x '((list 1) (list 2)))) (eval ``(a ,@,(car x))))", "(A 1)"),
        ("(let ((x '((list 1) (list 2)))) (eval ``(a ,,@x)))", "(A (1) (2))"),
        ("(let ((x '((list 1) (list 2)))) (eval ``(a ,@,@x)))", "(A 1 2)"),
        ("(eval (eval ```(a ,,,(+ 1 2))))", "(A 3)"),
        ("(eval (eval ```(a ,(+ 1 ,(+ 1 ,(+ 1 1))))))", "(A 4)"),
        ("(eval ``(a b))", "(A B)"),
    ],
)
def test_templates_within_templates(template: str, expected: str) -> None:
    assert values_of(template) == expected


def test_a_macro_that_writes_a_macro() -> None:
    text = """
    (defmacro %b1 (name value) `(defmacro ,name (x) `(list ,',value ,x)))
    (%b1 %b2 7)
    (%b2 (+ 1 1))"""
    assert values_of(text) == "(7 2)"


def test_a_template_may_be_long_and_deep() -> None:
    assert values_of(f"(length `({' '.join(f',(+ 1 {n})' for n in range(1000))}))") == "1000"
    assert values_of("(length (list " + "`(" * 200 + ",(+ 1 2)" + ")" * 200 + "))") == "1"
