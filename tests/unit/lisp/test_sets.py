"""Lists as sets."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from values import call, fails, fn, lisp, raw, symbol

numbers = st.lists(st.integers(0, 8), max_size=12)
A, B = symbol("a"), symbol("b")


def near(x: int, y: int) -> bool:
    """A test that is no equivalence."""
    return abs(x - y) <= 1


def test_member_returns_the_tail() -> None:
    assert call("member", 2, [1, 2, 3]) == [2, 3]
    assert call("member", B, [A, B]) == [B]
    assert call("member", 2.0, [1, 2]) is None
    assert call("member", None, [1, None]) == [None]
    assert call("member", "b", ["a", "b"], test=fn("equal")) == ["b"]
    assert call("member", 2, [[1], [2]], key=fn("car")) == [[2]]
    assert call("member", 1, [1, 2], test_not=fn("eql")) == [2]


def test_member_passes_the_item_first() -> None:
    assert call("member", 2, [1, 2, 3], test=lambda item, element: item < element) == [3]


def test_member_of_what_is_no_list_is_a_type_error() -> None:
    for item in (1, A):
        with fails("TYPE-ERROR"):
            call("member", item, 5)
        with fails("TYPE-ERROR"):
            call("member", item, raw("cons", 2, 3))


def test_both_tests_together_are_an_error() -> None:
    with fails("ERROR"):
        call("member", 1, [1], test=fn("eql"), test_not=fn("eql"))


def test_member_by_predicate() -> None:
    assert call("member-if", lambda x: x > 1, [1, 2, 3]) == [2, 3]
    assert call("member-if-not", lambda x: x < 3, [1, 2, 3]) == [3]


def test_adjoin_adds_what_is_not_there() -> None:
    lst = lisp([1, 2])
    assert raw("adjoin", 1, lst) is lst
    assert call("adjoin", 3, lst) == [3, 1, 2]
    assert call("adjoin", [1, "x"], [[1, "a"]], key=fn("car")) == [[1, "a"]]


@given(numbers, numbers)
def test_set_functions_agree_with_sets(first: list[int], second: list[int]) -> None:
    for n in ("", "n"):
        assert set(call(f"{n}union", first, second) or []) == set(first) | set(second)
        assert set(call(f"{n}intersection", first, second) or []) == set(first) & set(second)
        assert set(call(f"{n}set-difference", first, second) or []) == set(first) - set(second)
        assert set(call(f"{n}set-exclusive-or", first, second) or []) == set(first) ^ set(second)
    assert (call("subsetp", first, second) is True) == (set(first) <= set(second))


@pytest.mark.parametrize("name", ["union", "intersection", "set-difference", "set-exclusive-or", "subsetp"])
@given(first=numbers, second=numbers)
def test_an_unknown_test_gives_what_the_known_one_gives(
    name: str, first: list[int], second: list[int]
) -> None:
    assert call(name, first, second, test=lambda x, y: x == y) == call(name, first, second)


def test_the_element_of_the_first_list_is_the_first_argument() -> None:
    seen: list[tuple[int, int]] = []

    def note(x: int, y: int) -> bool:
        seen.append((x, y))
        return False

    for name in ("union", "intersection", "set-difference", "set-exclusive-or", "subsetp"):
        call(name, [1], [2], test=note)
    assert set(seen) == {(1, 2)}


def test_elements_are_compared_by_key_and_test() -> None:
    assert call("union", [[1, "a"]], [[1, "b"], [2, "c"]], key=fn("car")) == [[1, "a"], [2, "c"]]
    assert call("intersection", ["a", "b"], ["B", "c"], test=fn("equalp")) == ["b"]
    assert call("set-difference", [1, 5], [2], test=near) == [5]


def test_set_functions_keep_the_order_of_their_lists() -> None:
    assert call("union", [3, 1, 2], [5, 1, 4]) == [3, 1, 2, 5, 4]
    assert call("intersection", [3, 1, 2], [2, 3]) == [3, 2]
    assert call("set-difference", [3, 1, 2], [1]) == [3, 2]
    assert call("set-exclusive-or", [3, 1, 2], [5, 1, 4]) == [3, 2, 5, 4]
