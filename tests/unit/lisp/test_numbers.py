"""Arithmetic and comparison."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(+)", "0"),
        ("(+ 1 2 3)", "6"),
        ("(+ 1/2 1/3)", "5/6"),
        ("(+ 1/2 1/2)", "1"),
        ("(*)", "1"),
        ("(* 2 1/2)", "1"),
        ("(- 5)", "-5"),
        ("(- 5 1 1)", "3"),
        ("(/ 2)", "1/2"),
        ("(/ 6 3)", "2"),
        ("(/ 1 2 3)", "1/6"),
        ("(- 1/2)", "-1/2"),
        ("(* 99999999999 99999999999)", "9999999999800000000001"),
    ],
)
def test_the_four_operations_are_exact_on_rationals(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(+ 1 2.0)", "3.0"),
        ("(* 1/2 2.0)", "1.0"),
        ("(/ 1 2.0)", "0.5"),
        ("(- 0.5 1/2)", "0.0"),
    ],
)
def test_a_float_makes_the_result_a_float(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(/ 1 0)", "failure :DIVISION-BY-ZERO"),
        ("(/ 1.0 0)", "failure :DIVISION-BY-ZERO"),
        ("(/ 0)", "failure :DIVISION-BY-ZERO"),
        ("(/ 1 0.0)", "failure :DIVISION-BY-ZERO"),
    ],
)
def test_division_by_zero_is_a_failure_for_floats_too(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(+ 1 nil)", "failure :TYPE-ERROR"),
        ('(+ "a")', "failure :TYPE-ERROR"),
        ("(- 'a)", "failure :TYPE-ERROR"),
        (r"(* #\a 2)", "failure :TYPE-ERROR"),
        ("(/ 1 'a)", "failure :TYPE-ERROR"),
        ('(1+ "a")', "failure :TYPE-ERROR"),
        ("(= 1 'a)", "failure :TYPE-ERROR"),
        ("(< 1 nil)", "failure :TYPE-ERROR"),
        ("(max 'a)", "failure :TYPE-ERROR"),
        ("(max 1 'a)", "failure :TYPE-ERROR"),
        ("(abs nil)", "failure :TYPE-ERROR"),
        ("(zerop 'a)", "failure :TYPE-ERROR"),
        ("(+ '(1) 2)", "failure :TYPE-ERROR"),
        ("(< 3 2 'a)", "failure :TYPE-ERROR"),
    ],
)
def test_what_is_no_number_is_a_type_error(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(= 1 1.0)", "T"),
        ("(= 1/2 0.5)", "T"),
        ("(= 1 1 2)", "NIL"),
        ("(/= 1 2 3)", "T"),
        ("(/= 1 2 1)", "NIL"),
        ("(< 1 2 3)", "T"),
        ("(< 1 3 2)", "NIL"),
        ("(<= 1 1 2)", "T"),
        ("(>= 3 3 2)", "T"),
        ("(> 3 2 2)", "NIL"),
        ("(< 5)", "T"),
    ],
)
def test_comparison_takes_many_numbers(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(max 1 2.0)", "2.0"),
        ("(min 1 2.0)", "1"),
        ("(max 1/2 1/3)", "1/2"),
        ("(min 3 1 2)", "1"),
        ("(max 2 2.0)", "2"),
    ],
)
def test_max_and_min_return_one_of_their_arguments(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(abs -5)", "5"),
        ("(abs -1/2)", "1/2"),
        ("(abs -0.5)", "0.5"),
        ("(signum -3)", "-1"),
        ("(signum 0)", "0"),
        ("(signum -2.5)", "-1.0"),
        ("(signum 1/2)", "1"),
        ("(plusp 1)", "T"),
        ("(minusp -1/2)", "T"),
        ("(zerop 0.0)", "T"),
        ("(plusp 0)", "NIL"),
    ],
)
def test_signs(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(1+ 1)", "2"),
        ("(1- 1)", "0"),
        ("(1+ 1/2)", "3/2"),
        ("(1- 0.5)", "-0.5"),
    ],
)
def test_one_more_and_one_less(form: str, value: str) -> None:
    assert value_of(form) == value
