"""Writing values."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(write-to-string 255 :base 16)", '"FF"'),
        ("(write-to-string 255 :base 16 :radix t)", '"#xFF"'),
        ("(write-to-string 10 :radix t)", '"10."'),
        ("(write-to-string '(1 2 3 4) :length 2)", '"(1 2 ...)"'),
        ("(write-to-string '(1 (2 (3 (4)))) :level 2)", '"(1 (2 #))"'),
        ("(write-to-string 'foo :case :downcase)", '"foo"'),
        ("(write-to-string 'foo-bar :case :capitalize)", '"Foo-Bar"'),
        ('(write-to-string \'("a") :escape nil)', '"(a)"'),
        ("(write-to-string 5 :base 50)", "failure :TYPE-ERROR"),
        ("(write-to-string 5 :nosuch 1)", "failure :ERROR"),
    ],
)
def test_write_to_string_takes_what_the_printer_variables_say(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (r'(prin1-to-string "a\"b")', r'"\"a\\\"b\""'),
        (r'(princ-to-string "a\"b")', r'"a\"b"'),
        (r"(prin1-to-string #\a)", r'"#\\a"'),
        ('(princ-to-string \'("a" #\\b c))', '"(a b C)"'),
        ("(princ-to-string :a)", '"A"'),
        ("(prin1-to-string '|foo bar|)", '"|foo bar|"'),
        ("(princ-to-string '|foo bar|)", '"foo bar"'),
    ],
)
def test_prin1_and_princ_to_string(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (
            (
                '(let ((s (make-string-output-stream))) (list (print 1 s) (prin1 "a" s) (princ "b" '
                's) (terpri s) (fresh-line s) (write-string "hello" s :start 1 :end 3) (fresh-line '
                r's) (write-line "x" s) (write-char #\y s) (pprint 1 s) (write 5 :stream s :base 2) '
                "(get-output-stream-string s)))"
            ),
            '(1 "a" "b" NIL NIL "hello" T "x" #\\y NIL 5 "\n1 \\"a\\"b\nel\nx\ny\n1101")',
        ),
    ],
)
def test_streams(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (
            '(let ((s (make-string-output-stream))) (print \'(a "b") s) (get-output-stream-string s))',
            '"\n(A \\"b\\") "',
        ),
    ],
)
def test_print_writes_a_newline_the_value_and_a_blank(form: str, value: str) -> None:
    assert value_of(form) == value
