"""Powers, roots, logarithms, angles, floats and rationals."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(expt 2 10)", "1024"),
        ("(expt 2 -3)", "1/8"),
        ("(expt 1/2 3)", "1/8"),
        ("(expt 0 0)", "1"),
        ("(expt 2.0 3)", "8.0"),
        ("(expt 4 0.5)", "2.0"),
        ("(expt 2 100)", "1267650600228229401496703205376"),
        ("(expt 0 -1)", "failure :DIVISION-BY-ZERO"),
        ("(expt -8 1/3)", "failure :ERROR"),
    ],
)
def test_expt_is_exact_where_it_can_be(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(sqrt 16)", "4.0"),
        ("(sqrt 1/4)", "0.5"),
        ("(exp 0)", "1.0"),
        ("(log 1)", "0.0"),
        ("(log 8 2)", "3.0"),
        ("(sqrt -1)", "failure :ERROR"),
        ("(log -1)", "failure :ERROR"),
        ("(log 0)", "failure :DIVISION-BY-ZERO"),
        ("(sqrt 'a)", "failure :TYPE-ERROR"),
    ],
)
def test_roots_and_logarithms(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(sin 0)", "0.0"),
        ("(cos 0)", "1.0"),
        ("(atan 1 0)", "1.5707963267948966"),
        ("(atan 0 -1)", "3.141592653589793"),
        ("(acos 1)", "0.0"),
        ("(asin 2)", "failure :ERROR"),
        ("(tanh 0)", "0.0"),
        ("(acosh 1)", "0.0"),
        ("(atanh 0)", "0.0"),
    ],
)
def test_angles(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(float 1/2)", "0.5"),
        ("(float 3)", "3.0"),
        ("(rational 0.5)", "1/2"),
        ("(rational 0.1)", "3602879701896397/36028797018963968"),
        ("(rationalize 0.1)", "1/10"),
        ("(rationalize 0.333)", "333/1000"),
        ("(rationalize 2.0)", "2"),
        ("(numerator 6/4)", "3"),
        ("(denominator 6/4)", "2"),
        ("(denominator 5)", "1"),
        ("(numerator 0.5)", "failure :TYPE-ERROR"),
    ],
)
def test_floats_and_rationals(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(float (expt 10 400))", "failure :ERROR"),
        ("(exp 1000)", "failure :ERROR"),
        ("(expt 10.0 1000)", "failure :ERROR"),
        ("(+ 1.0 (expt 10 400))", "failure :ERROR"),
        ("(sqrt (expt 10 400))", "failure :ERROR"),
    ],
)
def test_what_no_double_can_hold_is_a_failure(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(random 1)", "0"),
        ("(< -1 (random 10) 10)", "T"),
        ("(<= 0.0 (random 2.0) 2.0)", "T"),
        ("(random 0)", "failure :ERROR"),
        ("(random -1)", "failure :ERROR"),
        ("(random 'a)", "failure :TYPE-ERROR"),
    ],
)
def test_random_stays_below_its_limit(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("most-positive-fixnum", "4611686018427387903"),
        ("pi", "3.141592653589793"),
        ("(> most-positive-double-float 1.0e308)", "T"),
    ],
)
def test_constants(form: str, value: str) -> None:
    assert value_of(form) == value
