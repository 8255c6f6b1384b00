"""FORMAT: where its text goes."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~a" 1)', '"1"'),
        ('(format nil "plain")', '"plain"'),
    ],
)
def test_nil_returns_a_string(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (
            (
                '(let ((s (make-string-output-stream))) (list (format s "~a~%" 1) '
                "(get-output-stream-string s)))"
            ),
            '(NIL "1\n")',
        ),
    ],
)
def test_a_stream_takes_the_text(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (
            (
                '(let ((s (make-string-output-stream))) (write-string "abc" s) (format s "~&x~5Ty") '
                "(get-output-stream-string s))"
            ),
            '"abc\nx    y"',
        ),
    ],
)
def test_columns_count_from_what_stands_there(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format 5 "a")', "failure :TYPE-ERROR"),
        ("(format nil 5)", "failure :TYPE-ERROR"),
        ('(format "no fill pointer" "a")', "failure :ERROR"),
    ],
)
def test_other_destinations_are_type_errors(form: str, value: str) -> None:
    assert value_of(form) == value
