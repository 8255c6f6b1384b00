"""SORT, STABLE-SORT, MERGE."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from values import call, fails, fn, lisp, raw, symbol

numbers = st.lists(st.integers(0, 20))


@pytest.mark.parametrize("make", [list, tuple])
@given(elements=numbers)
def test_sort_puts_in_order(make: Any, elements: list[int]) -> None:
    for name in ("sort", "stable-sort"):
        assert call(name, make(elements), fn("<")) == (make(sorted(elements)) or call("list*", make([])))
        assert list(call(name, make(elements), lambda x, y: x > y) or []) == sorted(elements, reverse=True)
        assert list(call(name, make(elements), fn(">")) or []) == sorted(elements, reverse=True)


@given(st.lists(st.tuples(st.integers(0, 3), st.integers())))
def test_sort_is_stable(pairs: list[tuple[int, int]]) -> None:
    wanted = sorted(pairs, key=lambda pair: pair[0])
    falling = sorted(pairs, key=lambda pair: -pair[0])
    for precedes in (fn("<"), lambda x, y: x < y):
        assert call("stable-sort", tuple(pairs), precedes, key=lambda pair: pair.items[0]) == tuple(wanted)
    for follows in (fn(">"), lambda x, y: x > y):
        assert call("stable-sort", tuple(pairs), follows, key=lambda pair: pair.items[0]) == tuple(falling)


def test_the_list_itself_is_sorted() -> None:
    lst = lisp([3, 1, 2])
    assert raw("sort", lst, fn("<")) is lst
    assert call("list*", lst) == [1, 2, 3]


def test_strings_are_sorted_too() -> None:
    assert call("sort", "hello", fn("char<")) == "ehllo"


def test_what_is_in_order_needs_few_comparisons() -> None:
    asked: list[int] = []

    def less(x: int, y: int) -> bool:
        asked.append(x)
        return x < y

    call("sort", list(range(1000)), less)
    assert len(asked) < 1000


def test_two_elements_are_compared_once() -> None:
    asked: list[tuple[int, int]] = []
    call("sort", [2, 1], lambda x, y: asked.append((x, y)))
    assert asked == [(1, 2)]


def test_what_cannot_be_compared_fails() -> None:
    with fails("TYPE-ERROR"):
        call("sort", [1, "a"], fn("<"))
    with fails("TYPE-ERROR"):
        call("sort", 5, fn("<"))


@given(numbers, numbers)
def test_merge_joins_what_is_in_order(first: list[int], second: list[int]) -> None:
    merged = call("merge", symbol("vector"), sorted(first), tuple(sorted(second)), fn("<"))
    assert merged == tuple(sorted(first + second))


def test_merge_takes_the_first_of_equals_from_the_first() -> None:
    merged = call("merge", symbol("list"), [[1, "a"], [2, "b"]], [[1, "c"]], fn("<"), key=fn("car"))
    assert merged == [[1, "a"], [1, "c"], [2, "b"]]
