"""Conses and the lists they make."""

from __future__ import annotations

from typing import Any

import pytest
from values import call, fails, lisp, raw

from eslang.base.lists import Cons


def dotted(*elements: Any) -> Any:
    """A list whose last cdr is the last of ELEMENTS."""
    return raw("list*", *elements)


def circular() -> Cons:
    """A list of two elements, over and over."""
    ring: Cons = lisp([1, 2])
    ring.cdr.cdr = ring
    return ring


@pytest.mark.parametrize(
    ("name", "lst", "part"),
    [
        ("car", [1, 2], 1),
        ("cdr", [1, 2], [2]),
        ("car", None, None),
        ("cdr", None, None),
        ("cadr", [1, 2, 3], 2),
        ("cddr", [1, 2, 3], [3]),
        ("caar", [[1], 2], 1),
        ("cdar", [[1, 5], 2], [5]),
        ("caddr", [1, 2, 3], 3),
        ("cadddr", [1, 2, 3, 4], 4),
        ("cddddr", [1, 2, 3, 4, 5], [5]),
        ("caaaar", [[[[7]]]], 7),
        ("cadr", [1], None),
        ("cddr", [1], None),
        ("first", [1, 2], 1),
        ("third", [1, 2, 3], 3),
        ("tenth", list(range(10)), 9),
        ("fifth", [1, 2], None),
        ("rest", [1, 2], [2]),
    ],
)
def test_parts_of_lists(name: str, lst: Any, part: Any) -> None:
    assert call(name, lst) == part


@pytest.mark.parametrize(
    "name", ["car", "cdr", "cadr", "caar", "first", "third", "endp", "last", "copy-list"]
)
def test_what_is_no_list_has_no_parts(name: str) -> None:
    with fails("TYPE-ERROR"):
        call(name, 5)


def test_a_part_beyond_an_atom_is_a_type_error() -> None:
    with fails("TYPE-ERROR"):
        call("caar", [1])
    with fails("TYPE-ERROR"):
        call("third", dotted(1, 2))


@pytest.mark.parametrize(
    ("name", "changed"),
    [("car", [9, [2, 3], 4]), ("cdr", [1, ".", 9]), ("second", [1, 9, 4]), ("caadr", [1, [9, 3], 4])],
)
def test_parts_can_be_set(name: str, changed: Any) -> None:
    lst = lisp([1, [2, 3], 4])
    assert call(f"%set-{name}", lst, 9) == 9
    assert call("list*", lst) == changed


def test_only_a_cons_has_parts_to_set() -> None:
    for name in ("%set-car", "%set-cdr", "rplaca", "rplacd", "%set-third"):
        with fails("TYPE-ERROR"):
            call(name, None, 1)


def test_nth_counts_from_zero_and_is_nil_beyond_the_end() -> None:
    assert [call("nth", n, [1, 2]) for n in range(3)] == [1, 2, None]
    assert call("nthcdr", 1, [1, 2]) == [2]
    assert call("nthcdr", 5, [1, 2]) is None
    assert call("nthcdr", 2, dotted(1, 2, 3)) == 3


def test_nth_wants_a_natural_number() -> None:
    for wrong in (-1, 1.0, "a"):
        with fails("TYPE-ERROR"):
            call("nth", wrong, [1])


def test_setting_an_element_that_is_not_there_is_a_type_error() -> None:
    with fails("TYPE-ERROR"):
        call("%set-nth", 5, [1], 9)


def test_last_and_butlast_count_conses() -> None:
    assert call("last", [1, 2, 3]) == [3]
    assert call("last", [1, 2, 3], 2) == [2, 3]
    assert call("last", [1, 2, 3], 0) is None
    assert call("last", dotted(1, 2, 3)) == [2, ".", 3]
    assert call("last", dotted(1, 2, 3), 0) == 3
    assert call("last", None) is None
    assert call("butlast", [1, 2, 3]) == [1, 2]
    assert call("butlast", [1, 2, 3], 5) is None
    assert call("butlast", dotted(1, 2, 3)) == [1]


def test_nbutlast_cuts_the_list_itself() -> None:
    lst = lisp([1, 2, 3])
    assert call("nbutlast", lst, 2) == [1]
    assert call("length", lst) == 1


@pytest.mark.parametrize(
    ("lists", "joined"),
    [
        ([], None),
        ([[1], [2, 3]], [1, 2, 3]),
        ([[1], 2], [1, ".", 2]),
        ([None, [1], None, [2], None], [1, 2]),
        ([5], 5),
        ([None, None], None),
    ],
)
@pytest.mark.parametrize("name", ["append", "nconc"])
def test_lists_are_joined(name: str, lists: list[Any], joined: Any) -> None:
    assert call(name, *lists) == joined


def test_append_shares_its_last_list_and_nconc_changes_all_others() -> None:
    first, second = lisp([1]), lisp([2])
    assert raw("append", first, second).cdr is second
    assert first.cdr is None
    assert raw("nconc", first, second) is first
    assert first.cdr is second


def test_only_lists_are_joined() -> None:
    for name in ("append", "nconc"):
        with fails("TYPE-ERROR"):
            call(name, 5, [1])
    with fails("TYPE-ERROR"):
        call("append", dotted(1, 2), [3])


def test_lists_are_turned_round() -> None:
    assert call("revappend", [1, 2], [3]) == [2, 1, 3]
    lst = lisp([1, 2])
    assert call("nreconc", lst, 5) == [2, 1, ".", 5]


def test_list_length_tells_a_circular_list() -> None:
    assert call("list-length", [1, 2, 3]) == 3
    assert call("list-length", circular()) is None
    with fails("TYPE-ERROR"):
        call("list-length", dotted(1, 2))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["length", "last", "copy-list", "reverse", "butlast", "copy-alist"])
def test_a_circular_list_where_a_proper_one_is_needed_is_a_type_error(name: str) -> None:
    with fails("TYPE-ERROR"):
        call(name, circular())


@pytest.mark.slow
@pytest.mark.parametrize("name", ["member", "find", "position", "count", "remove"])
def test_nothing_is_looked_for_in_a_circular_list_for_ever(name: str) -> None:
    for item in (9, None):
        with fails("TYPE-ERROR"):
            call(name, item, circular())


@pytest.mark.slow
def test_a_circular_alist_is_a_type_error() -> None:
    ring = lisp([[1, 2]])
    ring.cdr = ring
    for item in (9, None):
        with fails("TYPE-ERROR"):
            call("assoc", item, ring)


def test_tails() -> None:
    lst = lisp([1, 2, 3])
    assert call("ldiff", lst, lst.cdr) == [1]
    assert call("ldiff", lst, lisp([3])) == [1, 2, 3]
    assert call("ldiff", dotted(1, 2), 2) == [1]
    assert call("tailp", lst.cdr, lst) is True
    assert call("tailp", lisp([2, 3]), lst) is None
    assert call("tailp", 2, dotted(1, 2)) is True


def test_making_lists() -> None:
    assert call("list", 1, 2) == [1, 2]
    assert call("list*", 1) == 1
    assert call("list*", 1, 2, [3]) == [1, 2, 3]
    assert call("make-list", 2, initial_element="x") == ["x", "x"]
    assert call("copy-list", dotted(1, 2)) == [1, ".", 2]
    assert call("cons", 1, [2]) == [1, 2]
