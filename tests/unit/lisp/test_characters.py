"""Characters."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (r"(char-code #\A)", "65"),
        ("(code-char 97)", r"#\a"),
        (r"(char-int #\a)", "97"),
        ("(char-code 1)", "failure :TYPE-ERROR"),
        ('(character "a")', r"#\a"),
        ("(character 'b)", r"#\B"),
        ('(character "ab")', "failure :TYPE-ERROR"),
    ],
)
def test_codes_and_characters(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (r"(char-upcase #\a)", r"#\A"),
        (r"(char-downcase #\A)", r"#\a"),
        (r"(char-upcase #\1)", r"#\1"),
        (r"(upper-case-p #\A)", "T"),
        (r"(lower-case-p #\A)", "NIL"),
        (r"(both-case-p #\1)", "NIL"),
        (r"(char-upcase #\ß)", r"#\ß"),
    ],
)
def test_case(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (r"(alpha-char-p #\a)", "T"),
        (r"(alpha-char-p #\1)", "NIL"),
        (r"(alphanumericp #\1)", "T"),
        (r"(graphic-char-p #\Space)", "T"),
        (r"(graphic-char-p #\Newline)", "NIL"),
        (r"(standard-char-p #\é)", "NIL"),
    ],
)
def test_kinds(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (r"(digit-char-p #\7)", "7"),
        (r"(digit-char-p #\a)", "NIL"),
        (r"(digit-char-p #\f 16)", "15"),
        ("(digit-char 11 16)", r"#\B"),
        ("(digit-char 10)", "NIL"),
        (r"(digit-char-p #\1 50)", "failure :TYPE-ERROR"),
    ],
)
def test_digits(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (r"(char-name #\Space)", '"Space"'),
        (r"(char-name #\a)", "NIL"),
        ('(name-char "newline")', r"#\Newline"),
        ('(name-char "nosuch")', "NIL"),
        (r"#\Tab", r"#\Tab"),
        (r"#\Rubout", r"#\Rubout"),
    ],
)
def test_names(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (r"(char= #\a #\a #\a)", "T"),
        (r"(char= #\a #\A)", "NIL"),
        (r"(char-equal #\a #\A)", "T"),
        (r"(char< #\a #\b #\c)", "T"),
        (r"(char/= #\a #\b #\a)", "NIL"),
        (r"(char-lessp #\a #\B)", "T"),
        (r"(char>= #\b #\a)", "T"),
        (r"(char= 1 #\a)", "failure :TYPE-ERROR"),
    ],
)
def test_comparison(form: str, value: str) -> None:
    assert value_of(form) == value
