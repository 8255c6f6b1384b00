"""FIND, POSITION, COUNT, SEARCH, MISMATCH."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from values import call, char, fails, fn, lisp, raw, symbol

KINDS = ("list", "simple-vector", "string")


@st.composite
def ranges(draw: st.DrawFn) -> tuple[str, dict[str, Any], range]:
    """A text, keywords that choose a part of it, and the places to look at, in order."""
    text = draw(st.text("abc", max_size=8))
    start = draw(st.integers(0, len(text)))
    end = draw(st.integers(start, len(text)))
    from_end = draw(st.booleans())
    places = range(end - 1, start - 1, -1) if from_end else range(start, end)
    return text, {"start": start, "end": end, "from_end": from_end}, places


@pytest.mark.parametrize("kind", KINDS)
@given(ranges())
def test_all_kinds_of_sequences_are_searched_alike(
    kind: str, chosen: tuple[str, dict[str, Any], range]
) -> None:
    text, keywords, places = chosen
    sequence = raw("coerce", text, symbol(kind))
    hits = [place for place in places if text[place] == "b"]
    others = [place for place in places if text[place] != "b"]
    first = hits[0] if hits else None
    assert call("position", char("b"), sequence, **keywords) == first
    assert call("find", char("b"), sequence, **keywords) == (char("b") if hits else None)
    assert call("count", char("b"), sequence, **keywords) == len(hits)
    is_b = lambda each: each is char("b")  # noqa: E731
    assert call("position-if", is_b, sequence, **keywords) == first
    assert call("position-if-not", is_b, sequence, **keywords) == (others[0] if others else None)
    assert call("count-if", is_b, sequence, **keywords) == len(hits)
    assert call("count-if-not", is_b, sequence, **keywords) == len(others)
    assert call("find-if", is_b, sequence, **keywords) == (char("b") if hits else None)
    assert call("find-if-not", is_b, sequence, **keywords) == (char(text[others[0]]) if others else None)


def test_tests_and_keys() -> None:
    assert call("find", 2, [[1, "a"], [2, "b"]], key=fn("car")) == [2, "b"]
    assert call("find", 3, [1, 2, 3, 4], test=fn("<")) == 4
    assert call("find", 3, [1, 2, 3, 4], test_not=fn("<")) == 1
    assert call("position", "b", ["a", "b"], test=fn("equal")) == 1
    assert call("count", 1, [1, 1.0, 1]) == 2
    assert call("find", 2.0, [1, 2]) is None


def test_a_list_is_followed_no_further_than_needed() -> None:
    ring = lisp([1, 2])
    ring.cdr.cdr = ring
    assert call("find", 2, ring) == 2
    assert call("position-if", lambda x: x == 2, ring, start=2) == 3


@pytest.mark.parametrize("keywords", [{"start": 4}, {"end": 4}, {"start": 2, "end": 1}])
@pytest.mark.parametrize("sequence", [[1, 2, 3], (1, 2, 3)])
def test_bounds_that_are_not_there_are_out_of_range(sequence: Any, keywords: dict[str, int]) -> None:
    for name in ("find", "count", "position"):
        with fails("INDEX-OUT-OF-RANGE"):
            call(name, 9, sequence, **keywords)


def test_wrong_arguments_fail() -> None:
    with fails("TYPE-ERROR"):
        call("find", 1, 5)
    with fails("TYPE-ERROR"):
        call("find", 9, raw("cons", 1, 2))
    with fails("ERROR"):
        call("find", 1, [1], unknown=1)


def test_a_predicate_needs_no_test() -> None:
    with fails("ERROR"):
        call("find-if", lambda x: x, [1], test=fn("eql"))


@given(st.text("ab", max_size=3), st.text("ab", max_size=10))
def test_search_finds_what_python_finds(wanted: str, text: str) -> None:
    first, last = text.find(wanted), text.rfind(wanted)
    assert call("search", wanted, text) == (first if first >= 0 else None)
    assert call("search", wanted, text, from_end=True) == (last if last >= 0 else None)


def test_search_in_a_part() -> None:
    assert call("search", [0, 2, 3], (1, 2, 3), start1=1) == 1
    assert call("search", "b", "abab", start2=2) == 3
    assert call("search", "b", "ab", end2=1) is None
    assert call("search", "BC", "abc", test=fn("char-equal")) == 1


@pytest.mark.parametrize(
    ("first", "second", "keywords", "place"),
    [
        ("abcd", "abxd", {}, 2),
        ("abcd", "abcd", {}, None),
        ("abcd", "xbcd", {"from_end": True}, 1),
        ([1, 2, 3], (1, 2), {}, 2),
        ([1, 2, 3], [2, 3], {"from_end": True}, 1),
        ("abc", "xabc", {"start2": 1}, None),
        ("xab", "aby", {"start1": 1, "end2": 2}, None),
        ("xab", "aby", {"start1": 1}, 3),
    ],
)
def test_mismatch(first: Any, second: Any, keywords: dict[str, Any], place: int | None) -> None:
    assert call("mismatch", first, second, **keywords) == place
