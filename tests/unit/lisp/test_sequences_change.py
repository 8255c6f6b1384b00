"""REMOVE, SUBSTITUTE, REMOVE-DUPLICATES, FILL, REPLACE."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from values import call, char, fails, fn, lisp, raw, symbol

KINDS = ("list", "simple-vector", "string")


@st.composite
def choices(draw: st.DrawFn) -> tuple[str, dict[str, Any], set[int]]:
    """A text, keywords that choose some of it, and the places of the b's so chosen."""
    text = draw(st.text("abc", max_size=8))
    start = draw(st.integers(0, len(text)))
    end = draw(st.integers(start, len(text)))
    count = draw(st.none() | st.integers(-1, 4))
    from_end = draw(st.booleans())
    hits = [place for place in range(start, end) if text[place] == "b"]
    if count is not None:
        kept = max(0, count)
        hits = hits[max(0, len(hits) - kept) :] if from_end else hits[:kept]
    return text, {"start": start, "end": end, "count": count, "from_end": from_end}, set(hits)


def same(sequence: Any, text: str, kind: str) -> bool:
    """Whether SEQUENCE is of KIND and has the characters of TEXT."""
    is_kind = {"list": list, "simple-vector": tuple, "string": str}[kind]
    converted = call("coerce", sequence, symbol(kind))
    return converted == call("coerce", text, symbol(kind)) and (not text or isinstance(converted, is_kind))


@pytest.mark.parametrize("kind", KINDS)
@given(choices())
def test_all_kinds_of_sequences_are_changed_alike(
    kind: str, chosen: tuple[str, dict[str, Any], set[int]]
) -> None:
    text, keywords, places = chosen
    is_b = lambda each: each is char("b")  # noqa: E731
    is_no_b = lambda each: each is not char("b")  # noqa: E731
    left = "".join(each for place, each in enumerate(text) if place not in places)
    changed = "".join("X" if place in places else each for place, each in enumerate(text))
    for suffix, item in (("", char("b")), ("-if", is_b), ("-if-not", is_no_b)):
        for name in ("remove", "delete"):
            sequence = raw("coerce", raw("copy-seq", text), symbol(kind))
            assert same(raw(name + suffix, item, sequence, **keywords), left, kind)
        for name in ("substitute", "nsubstitute"):
            sequence = raw("coerce", raw("copy-seq", text), symbol(kind))
            assert same(raw(name + suffix, char("X"), item, sequence, **keywords), changed, kind)


def test_remove_leaves_its_argument() -> None:
    lst = lisp([1, 2, 1])
    assert call("remove", 1, lst) == [2]
    assert call("substitute", 9, 1, lst) == [9, 2, 9]
    assert call("list*", lst) == [1, 2, 1]


def test_delete_unlinks_and_nsubstitute_stores() -> None:
    lst = lisp([1, 2, 1, 3])
    assert raw("delete", 2, lst) is lst
    assert raw("nsubstitute", 9, 1, lst) is lst
    assert call("list*", lst) == [9, 9, 3]


def test_delete_moves_a_fill_pointer() -> None:
    vector = raw("make-array", 3, fill_pointer=3, initial_contents=[1, 2, 3])
    assert raw("delete", 2, vector) is vector
    assert call("length", vector) == 2


def test_tests_and_keys() -> None:
    assert call("remove", 2, [[1], [2]], key=fn("car")) == [[1]]
    assert call("remove", 2, [1, 2, 3], test=fn("<")) == [1, 2]
    assert call("remove", 2, [1, 2, 3], test_not=fn("eql")) == [2]
    assert call("remove", "a", ["a", "b"], test=fn("equal")) == ["b"]


def test_a_string_takes_only_characters() -> None:
    with fails("TYPE-ERROR"):
        call("substitute", 1, char("a"), "abc")


@pytest.mark.parametrize("kind", KINDS)
@given(text=st.text("abcd", max_size=10))
def test_of_equal_elements_the_last_stays_or_the_first(kind: str, text: str) -> None:
    sequence = raw("coerce", text, symbol(kind))
    first = "".join(dict.fromkeys(text))
    last = "".join(dict.fromkeys(text[::-1]))[::-1]
    for name in ("remove-duplicates", "delete-duplicates"):
        for keywords in ({}, {"test": lambda x, y: x is y}):
            copy = raw("copy-seq", sequence)
            assert same(raw(name, copy, **keywords), last, kind)
            copy = raw("copy-seq", sequence)
            assert same(raw(name, copy, from_end=True, **keywords), first, kind)


def test_duplicates_by_test_and_key() -> None:
    assert call("remove-duplicates", "aAbB", test=fn("char-equal")) == "AB"
    assert call("remove-duplicates", [1, 2, 3, 4], test=fn("<")) == [4]
    assert call("remove-duplicates", [1, 2, 3, 4], test=fn(">"), from_end=True) == [1]
    assert call("remove-duplicates", [[1, "a"], [1, "b"]], key=fn("car")) == [[1, "b"]]
    assert call("remove-duplicates", [1, 1, 2, 1], start=1) == [1, 2, 1]


def test_fill_and_replace() -> None:
    assert call("fill", [1, 2, 3, 4], 0, start=1, end=3) == [1, 0, 0, 4]
    assert call("fill", raw("copy-seq", "abc"), char("x")) == "xxx"
    assert call("replace", [1, 2, 3, 4], ["a", "b", "c"], start1=1, end1=3) == [1, "a", "b", 4]
    assert call("replace", "hello", "XY", start1=2) == "heXYo"
    assert call("replace", (1, 2, 3), [7, 8, 9], start2=2) == (9, 2, 3)
    with fails("INDEX-OUT-OF-RANGE"):
        call("fill", [1], 0, end=2)


def test_replace_within_one_sequence_reads_before_it_writes() -> None:
    vector = lisp((1, 2, 3, 4))
    assert call("replace", vector, vector, start1=1) == (1, 1, 2, 3)
