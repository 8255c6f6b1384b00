"""Strings."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(string= "abc" "abc")', "T"),
        ('(string= "abc" \'abc)', "NIL"),
        ('(string-equal "abc" \'abc)', "T"),
        ('(string< "abc" "abd")', "2"),
        ('(string< "ab" "abc")', "2"),
        ('(string< "abc" "abc")', "NIL"),
        ('(string<= "abc" "abc")', "3"),
        ('(string/= "abc" "abd")', "2"),
        ('(string> "b" "a")', "0"),
        ('(string-lessp "abc" "ABD")', "2"),
        ('(string-not-equal "a" "A")', "NIL"),
        ('(string= "a" 1)', "failure :TYPE-ERROR"),
    ],
)
def test_comparison_tells_the_first_difference(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(string= "xabc" "abcx" :start1 1 :end2 3)', "T"),
        ('(string< "xxa" "b" :start1 2)', "2"),
        ('(string= "abc" "abc" :end1 5)', "failure :INDEX-OUT-OF-RANGE"),
    ],
)
def test_comparison_may_be_of_parts(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(string-upcase "hello")', '"HELLO"'),
        ('(string-upcase "hello" :start 1 :end 3)', '"hELlo"'),
        ("(string-downcase 'abc)", '"abc"'),
        ('(string-capitalize "hello wORLD foo-bar 3rd")', '"Hello World Foo-Bar 3rd"'),
        (r"(let ((s (make-string 2 :initial-element #\a))) (nstring-upcase s) s)", '"AA"'),
        ("(string-upcase 5)", "failure :TYPE-ERROR"),
    ],
)
def test_case(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(string-trim " " "  hi  ")', '"hi"'),
        ('(string-trim \'(#\\a #\\b) "abxab")', '"x"'),
        ('(string-left-trim "ab" "abxab")', '"xab"'),
        ('(string-right-trim "ab" "abxab")', '"abx"'),
        ('(string-trim "x" 5)', "failure :TYPE-ERROR"),
    ],
)
def test_trimming(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(char "abc" 1)', r"#\b"),
        ('(char "abc" 3)', "failure :INDEX-OUT-OF-RANGE"),
        ('(char "abc" -1)', "failure :INDEX-OUT-OF-RANGE"),
        ('(schar "abc" 0)', r"#\a"),
        ("(char 'abc 0)", "failure :TYPE-ERROR"),
        (r"(make-string 3 :initial-element #\x)", '"xxx"'),
        ("(string 'a)", '"A"'),
        (r"(string #\a)", '"a"'),
        ("(string 1)", "failure :TYPE-ERROR"),
    ],
)
def test_elements(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(parse-integer "12")', "12"),
        ('(multiple-value-list (parse-integer " -12 "))', "(-12 5)"),
        ('(multiple-value-list (parse-integer "12abc" :junk-allowed t))', "(12 2)"),
        ('(multiple-value-list (parse-integer "abc" :junk-allowed t))', "(NIL 0)"),
        ('(parse-integer "abc")', "failure :ERROR"),
        ('(parse-integer "")', "failure :ERROR"),
        ('(parse-integer "ff" :radix 16)', "255"),
        ('(parse-integer "xx12yy" :start 2 :end 4)', "12"),
    ],
)
def test_parse_integer_skips_blanks_and_refuses_the_rest(form: str, value: str) -> None:
    assert value_of(form) == value
