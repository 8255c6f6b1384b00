"""FORMAT: directives that enclose others."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~{~a~^, ~}" \'(1 2 3))', '"1, 2, 3"'),
        ('(format nil "~:{~a-~a ~}" \'((1 2) (3 4)))', '"1-2 3-4 "'),
        ('(format nil "~@{~a ~}" 1 2 3)', '"1 2 3 "'),
        ("(format nil \"~:@{~a-~a ~}\" '(1 2) '(3 4))", '"1-2 3-4 "'),
        ('(format nil "~2{~a ~}" \'(1 2 3))', '"1 2 "'),
        ('(format nil "~{x~:}" nil)', '"x"'),
        ('(format nil "~{~}" "~a." \'(1 2))', '"1.2."'),
        ('(format nil "~:{~a~:^, ~}" \'((1) (2) (3)))', '"1, 2, 3"'),
        ('(format nil "~:{~a~^-~a ~}" \'((1) (3 4)))', '"13-4 "'),
        ('(format nil "~{~a~}" 5)', "failure :TYPE-ERROR"),
        ('(format nil "~{~a ~a~}" \'(1 2 3))', "failure :ERROR"),
        ('(format nil "~{x~}" \'(1))', "failure :ERROR"),
    ],
)
def test_iteration(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~[a~;b~:;c~]" 0)', '"a"'),
        ('(format nil "~[a~;b~:;c~]" 5)', '"c"'),
        ('(format nil "~[a~;b~]" 5)', '""'),
        ('(format nil "~:[no~;yes~]" nil)', '"no"'),
        ('(format nil "~:[no~;yes~]" 1)', '"yes"'),
        ('(format nil "~@[x=~a~]" 5)', '"x=5"'),
        ('(format nil "~@[x=~a~]" nil)', '""'),
        ('(format nil "~1[a~;b~]")', '"b"'),
        ('(format nil "~#[none~;one~:;many~]" 1)', '"one"'),
        ('(format nil "~[a~]" "x")', "failure :ERROR"),
    ],
)
def test_choice(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~(HeLLo~)")', '"hello"'),
        ('(format nil "~:(heLLo world~)")', '"Hello World"'),
        ('(format nil "~@(heLLo world~)")', '"Hello world"'),
        ('(format nil "~:@(heLLo~)")', '"HELLO"'),
        ('(format nil "~(~a~^~a~)" "AB")', '"ab"'),
    ],
)
def test_case(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~10<abc~>|")', '"       abc|"'),
        ('(format nil "~10@<abc~>|")', '"abc       |"'),
        ('(format nil "~10:@<abc~>|")', '"   abc    |"'),
        ('(format nil "~10<a~;b~;c~>|")', '"a   b    c|"'),
        ('(format nil "~11:@<a~;b~>|")', '"   a   b   |"'),
        ('(format nil "~3<abcdef~>|")', '"abcdef|"'),
        ('(format nil "~,5<abcdef~>|")', '"    abcdef|"'),
        ('(format nil "~,,3<a~;b~>|")', '"a   b|"'),
        ('(format nil "~10,,,\'*<a~;b~>|")', '"a********b|"'),
        ('(format nil "~20<a~;~a~^~;b~>|" 1)', '"                   a|"'),
    ],
)
def test_justification(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~<(~;~a ~a~;)~:>" \'(1 2))', '"(1 2)"'),
        ('(format nil "~@<~a ~a~:>" 1 2)', '"1 2"'),
        ('(format nil "~:<~a~:>" \'(1 2))', '"(1)"'),
    ],
)
def test_a_logical_block_is_written_in_one_line(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~? ~a" "~a" \'(1 2) 3)', '"1 3"'),
        ('(format nil "~@? ~a" "~a ~a" 1 2 3)', '"1 2 3"'),
        ('(format nil "~?" 5 \'())', "failure :TYPE-ERROR"),
    ],
)
def test_another_control_string(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~a~^ ~a" 1)', '"1"'),
        ('(format nil "~a~1^x" 1)', '"1x"'),
        ('(format nil "~a~0^x" 1)', '"1"'),
        ('(format nil "~a~1,1^x" 1)', '"1"'),
        ('(format nil "~a~1,2,3^x" 1)', '"1"'),
    ],
)
def test_going_no_further(form: str, value: str) -> None:
    assert value_of(form) == value
