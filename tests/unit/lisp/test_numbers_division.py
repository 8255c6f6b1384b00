"""Division with a remainder."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(multiple-value-list (floor 7 2))", "(3 1)"),
        ("(multiple-value-list (floor -7 2))", "(-4 1)"),
        ("(multiple-value-list (floor 7 -2))", "(-4 -1)"),
        ("(multiple-value-list (floor 2.5))", "(2 0.5)"),
        ("(multiple-value-list (floor -7/2))", "(-4 1/2)"),
        ("(floor -0.5)", "-1"),
    ],
)
def test_floor_rounds_down(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(multiple-value-list (ceiling 7 2))", "(4 -1)"),
        ("(multiple-value-list (ceiling -7 2))", "(-3 -1)"),
        ("(multiple-value-list (ceiling 2.5))", "(3 -0.5)"),
    ],
)
def test_ceiling_rounds_up(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(multiple-value-list (truncate 7 2))", "(3 1)"),
        ("(multiple-value-list (truncate -7 2))", "(-3 -1)"),
        ("(multiple-value-list (truncate -2.5))", "(-2 -0.5)"),
        ("(multiple-value-list (truncate 1/3))", "(0 1/3)"),
    ],
)
def test_truncate_rounds_towards_zero(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(multiple-value-list (round 5 2))", "(2 1)"),
        ("(multiple-value-list (round 7 2))", "(4 -1)"),
        ("(multiple-value-list (round -5 2))", "(-2 -1)"),
        ("(multiple-value-list (round 2.5))", "(2 0.5)"),
        ("(multiple-value-list (round 3.5))", "(4 -0.5)"),
        ("(multiple-value-list (round 7/3))", "(2 1/3)"),
        ("(round 0.5)", "0"),
        ("(round 1.5)", "2"),
    ],
)
def test_round_takes_halves_to_the_even_neighbour(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(multiple-value-list (ffloor 7 2))", "(3.0 1)"),
        ("(multiple-value-list (fround 2.5))", "(2.0 0.5)"),
        ("(multiple-value-list (fceiling 7/2))", "(4.0 -1/2)"),
        ("(multiple-value-list (ftruncate -7 2))", "(-3.0 -1)"),
    ],
)
def test_the_f_variants_give_whole_floats(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(mod -7 3)", "2"),
        ("(rem -7 3)", "-1"),
        ("(mod 7 -3)", "-2"),
        ("(rem 7 -3)", "1"),
        ("(mod 5.5 2)", "1.5"),
        ("(mod -7/2 2)", "1/2"),
    ],
)
def test_mod_and_rem_differ_for_negative_numbers(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(floor 1 0)", "failure :DIVISION-BY-ZERO"),
        ("(round 1.5 0.0)", "failure :DIVISION-BY-ZERO"),
        ("(mod 5 0)", "failure :DIVISION-BY-ZERO"),
        ("(rem 5.0 0)", "failure :DIVISION-BY-ZERO"),
        ("(truncate 0 0)", "failure :DIVISION-BY-ZERO"),
    ],
)
def test_division_by_zero_is_a_failure(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(floor 'a)", "failure :TYPE-ERROR"),
        ("(mod 5 nil)", "failure :TYPE-ERROR"),
        ('(round "1")', "failure :TYPE-ERROR"),
    ],
)
def test_what_is_no_number_is_a_type_error(form: str, value: str) -> None:
    assert value_of(form) == value
