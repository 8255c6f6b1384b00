"""Association lists and property lists."""

from __future__ import annotations

from values import call, fails, fn, lisp, many, raw, symbol

from eslang.base.lists import Cons, from_items
from eslang.base.symbols import Keyword

A, B, C = Keyword("a"), Keyword("b"), Keyword("c")
X = symbol("x")


def alist(*pairs: tuple[object, object]) -> object:
    """An association list of PAIRS."""
    return from_items([Cons(lisp(key), lisp(value)) for key, value in pairs])


def test_assoc_finds_the_first_entry_and_passes_over_nil() -> None:
    entries = Cons(None, alist((A, 1), (2, "two"), (A, 3)))
    assert call("assoc", A, entries) == [A, ".", 1]
    assert call("assoc", 2, entries) == [2, ".", "two"]
    assert call("assoc", B, entries) is None


def test_assoc_takes_a_test_and_a_key() -> None:
    entries = alist(("a", 1), ("b", 2))
    assert call("assoc", "b", entries) is None
    assert call("assoc", "b", entries, test=fn("equal")) == ["b", ".", 2]
    assert call("assoc", 3, alist((1, A), (2, B)), key=lambda number: number + 1) == [2, ".", B]


def test_rassoc_looks_at_the_values() -> None:
    assert call("rassoc", B, alist((1, A), (2, B))) == [2, ".", B]


def test_entries_by_predicate() -> None:
    entries = alist((1, 10), (2, 21))

    def even(number: int) -> bool:
        return number % 2 == 0

    assert call("assoc-if", even, entries) == [2, ".", 21]
    assert call("assoc-if-not", even, entries) == [1, ".", 10]
    assert call("rassoc-if", even, entries) == [1, ".", 10]
    assert call("rassoc-if-not", even, entries) == [2, ".", 21]


def test_an_entry_that_is_no_cons_is_a_type_error() -> None:
    for item in (A, 1):
        with fails("TYPE-ERROR"):
            call("assoc", item, [5])
        with fails("TYPE-ERROR"):
            call("assoc", item, 5)


def test_building_alists() -> None:
    assert call("acons", A, 1, None) == [[A, ".", 1]]
    assert call("pairlis", [1, 2], [A, B], alist((3, C))) == [[1, ".", A], [2, ".", B], [3, ".", C]]
    with fails("ERROR"):
        call("pairlis", [1], [A, B])
    original = alist((1, A))
    copy = raw("copy-alist", original)
    copy.car.cdr = B
    assert call("list*", original) == [[1, ".", A]]


def test_getf() -> None:
    assert call("getf", [A, 1, B, 2], B) == 2
    assert call("getf", [A, 1], C) is None
    assert call("getf", [A, 1], C, 9) == 9
    assert call("getf", [A, None], A, 9) is None


def test_a_malformed_property_list_is_an_error() -> None:
    with fails("ERROR"):
        call("getf", [A], B)
    with fails("TYPE-ERROR"):
        call("getf", 5, B)


def test_get_properties_gives_indicator_value_and_tail() -> None:
    assert many("get-properties", [A, 1, B, 2], [B, C]) == [B, 2, [B, 2]]
    assert many("get-properties", [A, 1], [X]) == [None, None, None]
