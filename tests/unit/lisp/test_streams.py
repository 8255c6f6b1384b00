"""Streams of strings."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (
            (
                '(let ((s (make-string-output-stream))) (write-string "abc" s) (list '
                "(get-output-stream-string s) (get-output-stream-string s)))"
            ),
            '("abc" "")',
        ),
        ("(get-output-stream-string 5)", "failure :TYPE-ERROR"),
        ('(write-string "a" 5)', "failure :TYPE-ERROR"),
    ],
)
def test_a_string_stream_keeps_what_is_written(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(let ((s (make-string-output-stream))) (close s) (write-string "abc" s))', "failure :ERROR"),
    ],
)
def test_a_closed_stream_is_written_to_no_more(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(streamp (make-string-output-stream))", "T"),
        ("(streamp 5)", "NIL"),
        ('(input-stream-p (make-string-input-stream ""))', "T"),
        ('(output-stream-p (make-string-input-stream ""))', "NIL"),
    ],
)
def test_kinds_of_stream(form: str, value: str) -> None:
    assert value_of(form) == value
