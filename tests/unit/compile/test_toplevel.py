"""Top-level forms: each sees what those before it defined; and EVAL."""

from __future__ import annotations

import pytest
from compiling import failure_of, mistake_of, values_of


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("(progn)", "NIL"),
        ("(progn (defmacro %t1 () ''a) (%t1))", "A"),
        ("(progn (defvar *%t2* 1) (let ((*%t2* 2)) (symbol-value '*%t2*)))", "2"),
        ("(eval-when (:compile-toplevel :execute) (defmacro %t3 () 3)) (%t3)", "3"),
        ("(macrolet ((m () '(defun %t4 () 4))) (m)) (%t4)", "4"),
        ("(eval '(progn (defmacro %t5 () 5) (+ 1 (%t5))))", "6"),
        ("(eval '(values 1 2))", "1 2"),
        ("(let ((x 1)) (list x (eval '(let ((x 2)) x))))", "(1 2)"),
        ("(eval ''a)", "A"),
        ("(eval (list 'list 1 (list 'quote '(b c))))", "(1 (B C))"),
    ],
)
def test_forms_one_after_the_other(text: str, expected: str) -> None:
    assert values_of(text) == expected


def test_what_is_before_a_mistake_has_been_run() -> None:
    assert mistake_of("(progn (defun %t6 () 6) (if))") == "malformed-form"
    assert values_of("(%t6)") == "6"


def test_a_wrong_form_is_a_failure_for_eval() -> None:
    assert failure_of("(eval '(if))", 0) == ":ERROR"
    assert values_of("(handler-case (eval '(go nowhere)) (error () :taken))") == ":TAKEN"


def test_an_expansion_without_end_is_refused() -> None:
    assert mistake_of("(defmacro %t7 (x) `(+ 1 (%t7 ,x))) (%t7 1)") == "nested-too-deep"
