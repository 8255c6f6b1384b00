"""Lists as sets: membership, union, difference and the like.

Where the test is one of the four of Common Lisp, elements are looked up by
their hash keys; else each is compared with each. Results keep the order of
the first list, then of the second.
"""

from __future__ import annotations

from itertools import repeat

from eslang.base.arguments import take_keys
from eslang.base.failure import type_error
from eslang.base.hints import Callable
from eslang.base.lists import SUSPICIOUS, Cons, cells, from_items, items
from eslang.base.symbols import Datum, Value, truth
from eslang.compile.registry import function
from eslang.lisp.matching import Choice, agreement, hash_key, judge_if, judge_item, keyed

_TESTS = ("TEST", "TEST-NOT", "KEY")
_KEY = ("KEY",)


def _tail(lst: Value, choice: Choice) -> Value:
    """The first tail of LST whose car the judge accepts."""
    judge, sign = choice
    for cell in cells(lst):
        if (judge(cell.car) is not None) is sign:
            return cell
    return None


@function("(member item list &key test test-not key)")
def member(item: Value, lst: Value, *options: Value) -> Value:
    """Return the first tail of LIST whose element matches ITEM, or NIL."""
    if not options and (item is None or isinstance(item, Datum)):
        rest = lst
        for _ in repeat(None, SUSPICIOUS):
            if rest.__class__ is not Cons:
                if rest is None:
                    return None
                raise type_error(lst, "LIST", "MEMBER")
            if rest.car is item:
                return rest
            rest = rest.cdr
    return _tail(lst, judge_item(item, *take_keys(options, _TESTS)))


@function("(member-if predicate list &key key)")
def member_if(predicate: Value, lst: Value, *options: Value) -> Value:
    """Return the first tail of LIST whose element satisfies PREDICATE, or NIL."""
    return _tail(lst, judge_if(predicate, True, *take_keys(options, _KEY)))


@function("(member-if-not predicate list &key key)")
def member_if_not(predicate: Value, lst: Value, *options: Value) -> Value:
    """Return the first tail of LIST whose element fails PREDICATE, or NIL."""
    return _tail(lst, judge_if(predicate, False, *take_keys(options, _KEY)))


@function("(adjoin item list &key test test-not key)")
def adjoin(item: Value, lst: Value, *options: Value) -> Value:
    """Return LIST with ITEM in front, unless an element matches it already."""
    test, test_not, key = take_keys(options, _TESTS)
    (sought,) = keyed([item], key)
    if _tail(lst, judge_item(sought, test, test_not, key)) is not None:
        return lst
    return Cons(item, lst)


def _membership(
    elements: list[Value], test: Value, test_not: Value, *, swap: bool
) -> Callable[[Value], bool]:
    """Whether a value matches one of ELEMENTS; the test gets the element first if SWAP."""
    key_of = hash_key(test, test_not)
    if key_of is not None:
        keys = {key_of(element) for element in elements}
        return lambda value: key_of(value) in keys
    agrees = agreement(test, test_not)

    def has(value: Value) -> bool:
        for element in elements:
            if agrees(element, value) if swap else agrees(value, element):
                break
        else:
            return False
        return True

    return has


def _select(
    chosen: Value, others: Value, options: tuple[Value, ...], present: bool, *, swap: bool = False
) -> list[Value]:
    """The elements of CHOSEN that are PRESENT (or absent) among OTHERS."""
    test, test_not, key = take_keys(options, _TESTS)
    elements = items(chosen)
    has = _membership(keyed(items(others), key), test, test_not, swap=swap)
    selected = []
    for element, taken in zip(elements, keyed(elements, key), strict=True):
        if has(taken) is present:
            selected.append(element)
    return selected


@function("(intersection list-1 list-2 &key test test-not key)")
def intersection(first: Value, second: Value, *options: Value) -> Value:
    """Return the elements of LIST-1 that match one of LIST-2."""
    return from_items(_select(first, second, options, True))


@function("(set-difference list-1 list-2 &key test test-not key)")
def set_difference(first: Value, second: Value, *options: Value) -> Value:
    """Return the elements of LIST-1 that match none of LIST-2."""
    return from_items(_select(first, second, options, False))


@function("(union list-1 list-2 &key test test-not key)")
def union(first: Value, second: Value, *options: Value) -> Value:
    """Return the elements of LIST-1, and those of LIST-2 that match none."""
    return from_items(items(first) + _select(second, first, options, False, swap=True))


@function("(set-exclusive-or list-1 list-2 &key test test-not key)")
def set_exclusive_or(first: Value, second: Value, *options: Value) -> Value:
    """Return the elements of LIST-1 and LIST-2 that match none of the other."""
    only_first = _select(first, second, options, False)
    return from_items(only_first + _select(second, first, options, False, swap=True))


@function("(subsetp list-1 list-2 &key test test-not key)")
def subsetp(first: Value, second: Value, *options: Value) -> Value:
    """True if each element of LIST-1 matches one of LIST-2."""
    return truth(not _select(first, second, options, False))


for _name, _implementation in (
    ("nunion", union),
    ("nintersection", intersection),
    ("nset-difference", set_difference),
    ("nset-exclusive-or", set_exclusive_or),
):
    function(f"({_name} list-1 list-2 &key test test-not key)")(_implementation)
