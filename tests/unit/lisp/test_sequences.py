"""Parts of sequences, and making them."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from values import call, char, fails, lisp, raw, symbol

KINDS = ("list", "simple-vector", "string")


def as_kind(kind: str, text: str) -> Any:
    """The characters of TEXT in a sequence of KIND."""
    return raw("coerce", text, symbol(kind))


def text_of(sequence: Any) -> str:
    """The characters of SEQUENCE."""
    result: str = call("coerce", sequence, symbol("string"))
    return result


def specifier(words: Any) -> Any:
    """A type specifier: words are symbols, lists are lists."""
    if isinstance(words, list):
        return lisp([specifier(each) for each in words])
    return symbol(words) if isinstance(words, str) else words


@pytest.mark.parametrize("kind", KINDS)
@given(text=st.text("abc", max_size=6), data=st.data())
def test_lists_vectors_and_strings_have_the_same_parts(kind: str, text: str, data: st.DataObject) -> None:
    sequence = as_kind(kind, text)
    start = data.draw(st.integers(0, len(text)))
    end = data.draw(st.integers(start, len(text)))
    assert call("length", sequence) == len(text)
    assert text_of(raw("subseq", sequence, start, end)) == text[start:end]
    assert text_of(raw("reverse", sequence)) == text[::-1]
    assert text_of(raw("copy-seq", sequence)) == text
    for place, each in enumerate(text):
        assert call("elt", sequence, place) is char(each)
    assert text_of(raw("nreverse", sequence)) == text[::-1]


@pytest.mark.parametrize("sequence", [[1, 2], (1, 2), "ab", None, raw("make-array", 5, fill_pointer=2)])
def test_an_index_that_is_not_there_is_out_of_range(sequence: Any) -> None:
    for wrong in (2, -1):
        with fails("INDEX-OUT-OF-RANGE"):
            call("elt", sequence, wrong)
        with fails("INDEX-OUT-OF-RANGE"):
            call("%set-elt", sequence, wrong, char("x"))
    with fails("TYPE-ERROR"):
        call("elt", sequence, 1.0)


@pytest.mark.parametrize("bounds", [(2, 9), (2, 1), (4,), (-1,)])
@pytest.mark.parametrize("sequence", [[1, 2, 3], (1, 2, 3), "abc"])
def test_bounds_that_are_not_there_are_out_of_range(sequence: Any, bounds: tuple[int, ...]) -> None:
    with fails("INDEX-OUT-OF-RANGE"):
        call("subseq", sequence, *bounds)


@pytest.mark.parametrize("name", ["length", "reverse", "nreverse", "copy-seq"])
def test_what_is_no_sequence_is_a_type_error(name: str) -> None:
    for wrong in (5, raw("cons", 1, 2)):
        with fails("TYPE-ERROR"):
            call(name, wrong)


def test_elements_can_be_set() -> None:
    for sequence, value in (([1, 2, 3], 9), ((1, 2, 3), 9), ("abc", char("x"))):
        changed = lisp(sequence)
        assert call("%set-elt", changed, 1, value) is value
        assert call("elt", changed, 1) is value
        assert call("length", changed) == 3


def test_a_string_takes_only_characters() -> None:
    with fails("TYPE-ERROR"):
        call("%set-elt", "abc", 1, 5)


def test_a_part_can_be_overwritten() -> None:
    lst, text = lisp([1, 2, 3, 4]), lisp("hello")
    call("%set-subseq", lst, 1, 3, [8, 9, 10])
    assert call("list*", lst) == [1, 8, 9, 4]
    call("%set-subseq", text, 3, "LO WORLD")
    assert text.text == "helLO"


@pytest.mark.parametrize(
    ("result_type", "sequences", "result"),
    [
        ("string", ["ab", [char("c")]], "abc"),
        ("list", ["a", (1,)], [char("a"), 1]),
        ("vector", [[1], (2,)], (1, 2)),
        ("simple-vector", [], ()),
        (["vector", "t", 3], [[1, 2], [3]], (1, 2, 3)),
        (["vector", "character"], ["a", "b"], "ab"),
        (["simple-array", "character", ["*"]], ["a"], "a"),
    ],
)
def test_concatenate(result_type: Any, sequences: list[Any], result: Any) -> None:
    assert call("concatenate", specifier(result_type), *sequences) == result


def test_what_does_not_fit_the_result_type_is_refused() -> None:
    with fails("TYPE-ERROR"):
        call("concatenate", symbol("string"), [1])
    with fails("TYPE-ERROR"):
        call("concatenate", symbol("integer"), [1])
    with fails("ERROR"):
        call("concatenate", specifier(["vector", "t", 3]), [1, 2])


def test_make_sequence() -> None:
    assert call("make-sequence", symbol("list"), 2, initial_element=7) == [7, 7]
    assert call("make-sequence", symbol("vector"), 2, initial_element=7) == (7, 7)
    assert call("make-sequence", symbol("string"), 2, initial_element=char("x")) == "xx"
    assert call("make-sequence", symbol("string"), 2) == "  "


def test_a_fill_pointer_ends_a_vector() -> None:
    vector = raw("make-array", 5, fill_pointer=2, initial_element=1)
    assert call("length", vector) == 2
    assert call("reverse", vector) == (1, 1)
    assert call("concatenate", symbol("list"), vector) == [1, 1]
