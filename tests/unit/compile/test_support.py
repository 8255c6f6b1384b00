"""What compiled code calls."""

from __future__ import annotations

import pytest

from eslang.base.failure import Failure
from eslang.base.sameness import is_eq, is_eql
from eslang.base.symbols import Keyword
from eslang.base.text import String
from eslang.compile.support import UNSUPPLIED, receive, spread, take_keys

DEPTH, WIDTH, ALLOW = Keyword("DEPTH"), Keyword("WIDTH"), Keyword("ALLOW-OTHER-KEYS")


def test_equal_integers_are_eq_whatever_their_size() -> None:
    assert is_eq(10**30, 10**29 * 10)
    assert not is_eq(1, 1.0)
    assert not is_eq(String("a"), String("a"))


def test_numbers_of_different_types_are_not_eql() -> None:
    assert is_eql(1.5, 3 / 2)
    assert not is_eql(1, 1.0)
    assert not is_eql(String("a"), String("a"))


def test_a_receiver_gets_nil_for_values_that_are_missing() -> None:
    assert receive(5, 3) == (5, None, None)


@pytest.mark.parametrize("count", [0, 1, 4, 5, 300])
def test_a_list_of_any_length_can_be_spread(count: int) -> None:
    assert spread(lambda *given: given, list(range(count))) == tuple(range(count))


def test_the_first_of_two_equal_keywords_counts() -> None:
    assert take_keys((DEPTH, 1, DEPTH, 2), (DEPTH, WIDTH), False) == [1, UNSUPPLIED]


def test_an_unknown_keyword_fails_unless_it_is_allowed() -> None:
    with pytest.raises(Failure):
        take_keys((WIDTH, 1), (DEPTH,), False)
    assert take_keys((WIDTH, 1, ALLOW, True), (DEPTH,), False) == [UNSUPPLIED]


def test_keywords_come_in_pairs() -> None:
    with pytest.raises(Failure):
        take_keys((DEPTH,), (DEPTH,), False)
