"""Functions over the elements of sequences."""

from __future__ import annotations

from typing import Any

import pytest
from values import call, char, fails, fn, lisp, raw, symbol


def even(number: int) -> bool:
    """A predicate."""
    return number % 2 == 0


def test_map_makes_a_sequence_of_the_type_asked_for() -> None:
    assert call("map", symbol("vector"), fn("+"), [1, 2], (10, 20, 30)) == (11, 22)
    assert call("map", symbol("string"), fn("char-upcase"), "abc") == "ABC"
    assert call("map", symbol("list"), fn("list"), "ab", [1, 2]) == [[char("a"), 1], [char("b"), 2]]
    assert call("map", None, fn("list"), [1]) is None


def test_map_into_stores_as_many_as_there_are() -> None:
    assert call("map-into", [1, 2, 3], fn("+"), [10, 20], [1, 1]) == [11, 21, 3]
    assert call("map-into", (0, 0), lambda x: x + 1, [1, 2, 3]) == (2, 3)
    assert call("map-into", (0, 0), lambda: 5) == (5, 5)
    filled = raw("make-array", 5, fill_pointer=1)
    assert call("map-into", filled, lambda x: x, [1, 2, 3]) == (1, 2, 3)


@pytest.mark.parametrize("kind", ["list", "vector"])
@pytest.mark.parametrize(
    ("numbers", "keywords", "result"),
    [
        ([1, 2, 3, 4], {}, [[[1, 2], 3], 4]),
        ([1, 2, 3, 4], {"from_end": True}, [1, [2, [3, 4]]]),
        ([1, 2], {"initial_value": 0}, [[0, 1], 2]),
        ([1, 2], {"initial_value": None}, [[None, 1], 2]),
        ([1, 2], {"from_end": True, "initial_value": 0}, [1, [2, 0]]),
        ([1, 2, 3, 4], {"start": 1, "end": 3}, [2, 3]),
        ([1, 2], {"key": lambda x: x * 10}, [10, 20]),
        ([5], {}, 5),
        ([], {}, None),
        ([], {"initial_value": 7}, 7),
    ],
)
def test_reduce(kind: str, numbers: list[int], keywords: dict[str, Any], result: Any) -> None:
    assert call("reduce", fn("list"), raw("coerce", numbers, symbol(kind)), **keywords) == result


@pytest.mark.parametrize("make", [list, tuple])
def test_quantifiers(make: Any) -> None:
    assert call("some", even, make([1, 2])) is True
    assert call("some", lambda x: x * 10 if x > 1 else None, make([1, 2])) == 20
    assert call("some", even, make([1, 3])) is None
    assert call("every", even, make([2, 4])) is True
    assert call("every", even, make([])) is True
    assert call("every", even, make([2, 3])) is None
    assert call("notany", even, make([1, 3])) is True
    assert call("notany", even, make([1, 2])) is None
    assert call("notevery", even, make([2, 3])) is True
    assert call("notevery", even, make([2])) is None


def test_quantifiers_stop_at_the_end_of_the_shortest() -> None:
    assert call("every", fn("="), [1, 2], (1, 2, 3)) is True
    assert call("some", fn(">"), [1, 5], [2, 3]) is True


def test_quantifiers_stop_as_soon_as_they_know() -> None:
    ring = lisp([1, 2])
    ring.cdr.cdr = ring
    assert call("some", even, ring) is True
    assert call("every", even, ring) is None
    assert call("some", fn("="), ring, [5, 2]) is True


def test_what_is_no_sequence_is_a_type_error() -> None:
    for name in ("some", "every", "notany", "notevery"):
        with fails("TYPE-ERROR"):
            call(name, even, 5)
    with fails("TYPE-ERROR"):
        call("reduce", fn("+"), 5)
    with fails("TYPE-ERROR"):
        call("map", symbol("list"), even, raw("cons", 2, 3))
