"""Reading forms from strings and streams."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(multiple-value-list (read-from-string "a b"))', "(A 2)"),
        ('(multiple-value-list (read-from-string "(a) b"))', "((A) 4)"),
        ('(multiple-value-list (read-from-string "a b c" t nil :start 2))', "(B 4)"),
        ('(multiple-value-list (read-from-string "a b" t nil :preserve-whitespace t))', "(A 1)"),
        ('(read-from-string "abc" t nil :end 2)', "AB"),
        ('(read-from-string "nil")', "NIL"),
    ],
)
def test_a_form_and_the_place_behind_it(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(read-from-string "")', "failure :ERROR"),
        ('(read-from-string " ; nothing" nil :end)', ":END"),
        ('(read-from-string "(a" nil :end)', "failure :ERROR"),
    ],
)
def test_the_end_of_the_text(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(read-from-string "(a")', "failure :ERROR"),
        ('(read-from-string ")")', "failure :ERROR"),
        ('(read-from-string "#.(+ 1 2)")', "failure :ERROR"),
        ('(read-from-string "nosuch:a")', "failure :ERROR"),
        ("(read-from-string 5)", "failure :TYPE-ERROR"),
    ],
)
def test_wrong_text_is_a_failure(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (
            (
                '(let ((s (make-string-input-stream "a b (c) \'d"))) (list (read s) (read-char s) '
                "(read s) (read s nil :end) (read s nil :end)))"
            ),
            r"(A #\b (C) 'D :END)",
        ),
        ('(read (make-string-input-stream ""))', "failure :ERROR"),
    ],
)
def test_forms_from_a_stream(form: str, value: str) -> None:
    assert value_of(form) == value
