"""Vectors with fill pointers."""

from __future__ import annotations

from typing import Any

from hypothesis import given
from hypothesis import strategies as st
from values import call, char, fails, raw, symbol


def growing(size: int = 0) -> Any:
    """A vector with a fill pointer at 0."""
    return raw("make-array", size, fill_pointer=0, adjustable=True)


def test_vector_push_stops_at_the_end() -> None:
    vector = growing(1)
    assert call("vector-push", "a", vector) == 0
    assert call("vector-push", "b", vector) is None
    assert call("vector-push-extend", "b", vector) == 1
    assert call("list*", vector) == ("a", "b")


@given(st.lists(st.integers() | st.none()))
def test_push_and_pop_are_those_of_a_stack(moves: list[int | None]) -> None:
    vector, stack = growing(), []
    for move in moves:
        if move is not None:
            assert call("vector-push-extend", move, vector) == len(stack)
            stack.append(move)
        elif stack:
            assert call("vector-pop", vector) == stack.pop()
        else:
            with fails("ERROR"):
                call("vector-pop", vector)
        assert call("fill-pointer", vector) == call("length", vector) == len(stack)


def test_strings_grow_by_characters() -> None:
    text = raw("make-array", 0, element_type=symbol("character"), fill_pointer=0, adjustable=True)
    assert call("vector-push-extend", char("a"), text) == 0
    assert call("vector-push", char("b"), text) == 1
    assert call("list*", text) == "ab"
    assert call("vector-pop", text) is char("b")
    with fails("TYPE-ERROR"):
        call("vector-push-extend", 5, text)


def test_a_fill_pointer_can_be_set() -> None:
    vector = raw("make-array", 3, fill_pointer=1, initial_element=7)
    assert call("%set-fill-pointer", vector, 3) == 3
    assert call("length", vector) == 3
    with fails("INDEX-OUT-OF-RANGE"):
        call("%set-fill-pointer", vector, 4)


def test_only_a_vector_with_a_fill_pointer_has_one() -> None:
    assert call("array-has-fill-pointer-p", growing()) is True
    assert call("array-has-fill-pointer-p", (1,)) is None
    assert call("array-has-fill-pointer-p", "a") is None
    for wrong in ((1,), "a", [1]):
        for name in ("fill-pointer", "vector-pop"):
            with fails("TYPE-ERROR"):
                call(name, wrong)
        with fails("TYPE-ERROR"):
            call("vector-push", 1, wrong)
