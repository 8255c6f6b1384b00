"""EQ and EQL."""

from __future__ import annotations

from eslang.base.ratios import Ratio
from eslang.base.sameness import is_eq, is_eql
from eslang.base.text import String

NAN = float("nan")


def test_equal_integers_are_the_same_object() -> None:
    assert is_eq(10**20, 10**20)
    assert not is_eq(1.5, 3.0 / 2)
    assert not is_eq(1, 1.0)


def test_numbers_are_eql_if_type_and_value_agree() -> None:
    assert is_eql(1.5, 3.0 / 2)
    assert is_eql(Ratio(1, 2), Ratio(1, 2))
    assert is_eql(NAN, float("nan"))
    assert not is_eql(1, 1.0)
    assert not is_eql(Ratio(1, 2), 0.5)
    assert not is_eql(0.0, -0.0)


def test_equal_strings_are_not_eql() -> None:
    assert not is_eql(String("a"), String("a"))
