"""FORMAT: objects, characters, layout, arguments."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~a ~s" "a" "a")', r'"a \"a\""'),
        (r'(format nil "~a ~s" #\a #\a)', r'"a #\\a"'),
        ('(format nil "~10a|" "abc")', '"abc       |"'),
        ('(format nil "~10@a|" "abc")', '"       abc|"'),
        ('(format nil "~10,3a|" "abc")', '"abc         |"'),
        ('(format nil "~1,1,3a|" "abc")', '"abc   |"'),
        ('(format nil "~10,,,\'*a|" "abc")', '"abc*******|"'),
        ('(format nil "~:a ~:s ~a" nil nil nil)', '"() () NIL"'),
        ('(format nil "~v,va|" 5 1 "a")', '"a    |"'),
        ('(format nil "~va|" nil "a")', '"a|"'),
        ('(format nil "~#a|" "a" "b")', '"a |"'),
        ('(format nil "~w" "a")', r'"\"a\""'),
    ],
)
def test_objects(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        (r'(format nil "~c ~:c ~@c" #\a #\Space #\Space)', r'"a Space #\\Space"'),
        ('(format nil "~c" "a")', "failure :TYPE-ERROR"),
    ],
)
def test_characters(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~%~%")', '"\n\n"'),
        ('(format nil "a~&b")', '"a\nb"'),
        ('(format nil "~&a~2&b")', '"a\n\nb"'),
        ('(format nil "~2~")', '"~~"'),
        ('(format nil "a~0&b")', '"ab"'),
    ],
)
def test_newlines_tildes_and_pages(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "a~10Tb")', '"a         b"'),
        ('(format nil "abcdef~3,4Tb")', '"abcdef b"'),
        ('(format nil "ab~3@Tc")', '"ab   c"'),
        ('(format nil "ab~1,8@Tc")', '"ab      c"'),
        ('(format nil "abcd~2,0Tc")', '"abcdc"'),
    ],
)
def test_columns(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~a ~*~a" 1 2 3)', '"1 3"'),
        ('(format nil "~a ~:*~a" 1 2)', '"1 1"'),
        ('(format nil "~a ~a ~0@*~a" 1 2)', '"1 2 1"'),
        ('(format nil "~a ~2:*~a" 1 2)', "failure :ERROR"),
        ('(format nil "~3*" 1)', "failure :ERROR"),
    ],
)
def test_moving_among_the_arguments(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~d item~:p" 1)', '"1 item"'),
        ('(format nil "~d item~:p" 2)', '"2 items"'),
        ('(format nil "~d fl~:@p" 1)', '"1 fly"'),
        ('(format nil "~d fl~:@p" 3)', '"3 flies"'),
        ('(format nil "item~p" 5)', '"items"'),
        ('(format nil "~:p")', "failure :ERROR"),
    ],
)
def test_plurals(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "a~\n    b")', '"ab"'),
        ('(format nil "a~:\n    b")', '"a    b"'),
        ('(format nil "a~@\n    b")', '"a\nb"'),
    ],
)
def test_a_newline_directive_joins_lines(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~i~_~a" 1)', '"1"'),
    ],
)
def test_hints_for_a_pretty_printer_write_nothing(form: str, value: str) -> None:
    assert value_of(form) == value
