"""Arrays of any rank."""

from __future__ import annotations

from typing import Any

import pytest
from values import call, char, fails, lisp, python, raw, symbol

from eslang.base.symbols import Symbol


def matrix() -> Any:
    """Two rows of two."""
    return raw("make-array", [2, 2], initial_contents=[[1, 2], (3, 4)])


def test_make_array_of_one_dimension_is_a_vector() -> None:
    assert call("make-array", 3) == (0, 0, 0)
    assert call("make-array", 2, initial_element=None) == (None, None)
    assert call("make-array", [2], initial_contents="ab") == (char("a"), char("b"))
    assert call("make-array", 2, element_type=symbol("double-float")) == (0.0, 0.0)
    assert call("vector", 1, 2) == (1, 2)


def test_an_array_of_characters_is_a_string() -> None:
    kind = symbol("character")
    assert call("make-array", 3, element_type=kind, initial_element=char("x")) == "xxx"
    assert call("make-array", 2, element_type=kind, initial_contents=[char("a"), char("b")]) == "ab"
    assert call("length", raw("make-array", 5, element_type=kind, fill_pointer=0)) == 0
    with fails("TYPE-ERROR"):
        call("make-array", 1, element_type=kind, initial_element=5)


def test_arrays_of_other_ranks_are_read_and_written() -> None:
    array = matrix()
    assert [call("aref", array, row, column) for row in (0, 1) for column in (0, 1)] == [1, 2, 3, 4]
    assert call("%set-aref", array, 1, 0, 9) == 9
    assert [call("row-major-aref", array, place) for place in range(4)] == [1, 2, 9, 4]
    assert call("%set-row-major-aref", array, 3, 8) == 8
    assert call("aref", array, 1, 1) == 8
    assert call("array-row-major-index", array, 1, 1) == 3
    assert call("aref", raw("make-array", None, initial_element=5)) == 5


def test_what_arrays_tell_of_themselves() -> None:
    array = raw("make-array", [2, 3])
    assert call("array-dimensions", array) == [2, 3]
    assert call("array-dimension", array, 1) == 3
    assert call("array-rank", array) == 2
    assert call("array-total-size", array) == 6
    assert call("array-in-bounds-p", array, 1, 2) is True
    assert call("array-in-bounds-p", array, 2, 0) is None
    assert call("array-in-bounds-p", array, -1, 0) is None
    assert call("array-element-type", "a") is symbol("character")
    assert call("array-element-type", array) is True
    assert call("adjustable-array-p", array) is True


@pytest.mark.parametrize("index", [-1, 2])
def test_an_index_that_is_not_there_is_out_of_range(index: int) -> None:
    for array in ((1, 2), "ab"):
        with fails("INDEX-OUT-OF-RANGE"):
            call("aref", array, index)
        with fails("INDEX-OUT-OF-RANGE"):
            call("%set-aref", array, index, char("x"))
    with fails("INDEX-OUT-OF-RANGE"):
        call("aref", matrix(), 0, index)
    with fails("INDEX-OUT-OF-RANGE"):
        call("svref", (1, 2), index)
    with fails("INDEX-OUT-OF-RANGE"):
        call("row-major-aref", (1, 2), 2)


def test_subscripts_are_integers_and_as_many_as_dimensions() -> None:
    with fails("ERROR"):
        call("aref", (1, 2))
    with fails("ERROR"):
        call("aref", matrix(), 0)
    with fails("ERROR"):
        call("%set-aref", (1, 2), 0)
    for wrong in (1.0, None):
        with fails("TYPE-ERROR"):
            call("aref", (1, 2), wrong)
    with fails("TYPE-ERROR"):
        call("aref", [1, 2], 0)
    with fails("TYPE-ERROR"):
        call("svref", "ab", 0)


def test_strings_are_written_by_character() -> None:
    text = lisp("abc")
    call("%set-aref", text, 1, char("X"))
    assert text.text == "aXc"
    with fails("TYPE-ERROR"):
        call("%set-aref", text, 1, 5)


def test_contents_must_have_the_shape_of_the_array() -> None:
    with fails("ERROR"):
        call("make-array", [2, 2], initial_contents=[[1, 2], [3]])


@pytest.mark.parametrize("dimensions", [-1, 1.5, [2, -1], Symbol("x")])
def test_dimensions_are_natural_numbers(dimensions: Any) -> None:
    with fails("TYPE-ERROR"):
        call("make-array", dimensions)


def test_a_displaced_array_is_refused() -> None:
    with fails("ERROR"):
        call("make-array", 2, displaced_to=(1, 2, 3))


def test_adjust_array_keeps_what_both_shapes_have() -> None:
    array = matrix()
    assert raw("adjust-array", array, [3, 1], initial_element=0) is array
    assert call("array-dimensions", array) == [3, 1]
    assert array.items == [1, 3, 0]
    vector = lisp((1, 2))
    assert python(raw("adjust-array", vector, 3, initial_element=9)) == (1, 2, 9)
    with fails("ERROR"):
        call("adjust-array", vector, [2, 2])


def test_a_fill_pointer_hides_elements_from_sequences_not_from_aref() -> None:
    vector = raw("make-array", 5, fill_pointer=2, initial_element=1)
    assert call("aref", vector, 4) == 1
    assert call("array-dimension", vector, 0) == 5
    assert call("make-array", 3, fill_pointer=True, initial_element=1) == (1, 1, 1)
    with fails("ERROR"):
        call("make-array", 2, fill_pointer=3)
