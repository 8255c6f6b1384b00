"""Keyword arguments."""

from __future__ import annotations

from values import fails

from eslang.base.arguments import UNSUPPLIED, check_index, take_keys
from eslang.base.symbols import Keyword, T

A, B, ALLOW = Keyword("a"), Keyword("b"), Keyword("allow-other-keys")


def test_values_come_in_the_order_of_the_names() -> None:
    assert take_keys((B, 2, A, 1), ("A", "B")) == [1, 2]


def test_absent_keywords_get_the_default() -> None:
    assert take_keys((), ("A",)) == [None]
    assert take_keys((A, 1), ("A", "B"), UNSUPPLIED) == [1, UNSUPPLIED]


def test_the_first_of_two_equal_keywords_counts() -> None:
    assert take_keys((A, 1, A, 2), ("A",)) == [1]


def test_an_unknown_keyword_is_an_error_unless_allowed() -> None:
    with fails("ERROR"):
        take_keys((B, 1), ("A",))
    assert take_keys((B, 1, ALLOW, T), ("A",)) == [None]
    with fails("ERROR"):
        take_keys((B, 1, ALLOW, None), ("A",))


def test_an_odd_number_of_arguments_is_an_error() -> None:
    with fails("ERROR"):
        take_keys((A,), ("A",))


def test_an_index_is_a_natural_number() -> None:
    assert check_index(0, "NTH") == 0
    for wrong in (-1, 1.0, None):
        with fails("TYPE-ERROR"):
            check_index(wrong, "NTH")
