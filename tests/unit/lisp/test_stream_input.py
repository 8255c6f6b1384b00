"""Reading characters and lines."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (
            (
                '(let ((s (make-string-input-stream "a b"))) (list (multiple-value-list (read-line '
                "s)) (read-line s nil :end)))"
            ),
            '(("a b" T) :END)',
        ),
        ('(read-line (make-string-input-stream ""))', "failure :ERROR"),
        ('(read-line (make-string-input-stream "") nil)', "NIL"),
    ],
)
def test_lines(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (
            (
                '(let ((s (make-string-input-stream "ab"))) (list (read-char s) (peek-char nil s) '
                "(read-char s) (read-char s nil :end)))"
            ),
            r"(#\a #\b #\b :END)",
        ),
        (
            (
                '(let ((s (make-string-input-stream "  ab"))) (list (peek-char t s) (read-char s) '
                r"(unread-char #\a s) (peek-char #\b s)))"
            ),
            r"(#\a #\a NIL #\b)",
        ),
        ('(read-char (make-string-input-stream ""))', "failure :ERROR"),
    ],
)
def test_characters(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(read-line (make-string-input-stream "abcdef" 2 4))', '"cd"'),
        ('(make-string-input-stream "abc" 5)', "failure :INDEX-OUT-OF-RANGE"),
    ],
)
def test_a_stream_may_begin_and_end_within_its_string(form: str, value: str) -> None:
    assert value_of(form) == value
