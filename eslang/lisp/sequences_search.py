"""Looking for elements: FIND, POSITION, COUNT, SEARCH, MISMATCH."""

from __future__ import annotations

from eslang.base.arguments import take_keys
from eslang.base.symbols import Value
from eslang.base.text import Character, String
from eslang.compile.registry import function
from eslang.lisp.matching import Choice, agreement, judge_if, judge_item, keyed
from eslang.lisp.sequences import elements, limits, section, walk

_RANGE = ("FROM-END", "START", "END")
_TESTS = ("TEST", "TEST-NOT", "KEY", *_RANGE)
_KEY = ("KEY", *_RANGE)


Chosen = tuple[Choice, list[Value]]  # what is looked for, and the options after :key


def by_item(item: Value, options: tuple[Value, ...], names: tuple[str, ...]) -> Chosen:
    """What ITEM matches, and the options after :key among NAMES."""
    if not options:
        return judge_item(item, None, None, None), [None] * (len(names) - 3)
    test, test_not, key, *others = take_keys(options, names)
    return judge_item(item, test, test_not, key), others


def by_predicate(predicate: Value, sign: bool, options: tuple[Value, ...], names: tuple[str, ...]) -> Chosen:
    """What satisfies PREDICATE (or fails it), and the options after :key among NAMES."""
    key, *others = take_keys(options, names)
    return judge_if(predicate, sign, key), others


def _place(sequence: Value, chosen: Chosen) -> tuple[Value, Value]:
    """The first (or last) element that the judge accepts, and its place; NIL, NIL for none."""
    (judge, sign), (from_end, start, end) = chosen
    if from_end is not None:
        whole = elements(sequence)
        first, stop = limits(sequence, len(whole), start, end)
        for place in range(stop - 1, first - 1, -1):
            if (judge(whole[place]) is not None) is sign:
                return whole[place], place
        return None, None
    place = start or 0
    for element in walk(sequence, start, end):
        if (judge(element) is not None) is sign:
            return element, place
        place += 1
    return None, None


@function("(find item sequence &key test test-not key from-end start end)")
def find(item: Value, sequence: Value, *options: Value) -> Value:
    """Return the first element of SEQUENCE that ITEM matches, or NIL."""
    return _place(sequence, by_item(item, options, _TESTS))[0]


@function("(find-if predicate sequence &key key from-end start end)")
def find_if(predicate: Value, sequence: Value, *options: Value) -> Value:
    """Return the first element of SEQUENCE that satisfies PREDICATE, or NIL."""
    return _place(sequence, by_predicate(predicate, True, options, _KEY))[0]


@function("(find-if-not predicate sequence &key key from-end start end)")
def find_if_not(predicate: Value, sequence: Value, *options: Value) -> Value:
    """Return the first element of SEQUENCE that fails PREDICATE, or NIL."""
    return _place(sequence, by_predicate(predicate, False, options, _KEY))[0]


@function("(position item sequence &key test test-not key from-end start end)")
def position(item: Value, sequence: Value, *options: Value) -> Value:
    """Return where in SEQUENCE ITEM first matches an element, or NIL."""
    if not options and item.__class__ is Character and sequence.__class__ is String:
        at = sequence.text.find(item.char)
        return at if at >= 0 else None
    return _place(sequence, by_item(item, options, _TESTS))[1]


@function("(position-if predicate sequence &key key from-end start end)")
def position_if(predicate: Value, sequence: Value, *options: Value) -> Value:
    """Return where in SEQUENCE an element first satisfies PREDICATE, or NIL."""
    return _place(sequence, by_predicate(predicate, True, options, _KEY))[1]


@function("(position-if-not predicate sequence &key key from-end start end)")
def position_if_not(predicate: Value, sequence: Value, *options: Value) -> Value:
    """Return where in SEQUENCE an element first fails PREDICATE, or NIL."""
    return _place(sequence, by_predicate(predicate, False, options, _KEY))[1]


def _count(sequence: Value, chosen: Chosen) -> int:
    (judge, sign), (from_end, start, end) = chosen
    counted = section(sequence, start, end)
    number = 0
    for element in counted if from_end is None else reversed(counted):
        if (judge(element) is not None) is sign:
            number += 1
    return number


@function("(count item sequence &key test test-not key from-end start end)")
def count(item: Value, sequence: Value, *options: Value) -> Value:
    """Return how many elements of SEQUENCE ITEM matches."""
    if not options and item.__class__ is Character and sequence.__class__ is String:
        return sequence.text.count(item.char)
    return _count(sequence, by_item(item, options, _TESTS))


@function("(count-if predicate sequence &key key from-end start end)")
def count_if(predicate: Value, sequence: Value, *options: Value) -> Value:
    """Return how many elements of SEQUENCE satisfy PREDICATE."""
    return _count(sequence, by_predicate(predicate, True, options, _KEY))


@function("(count-if-not predicate sequence &key key from-end start end)")
def count_if_not(predicate: Value, sequence: Value, *options: Value) -> Value:
    """Return how many elements of SEQUENCE fail PREDICATE."""
    return _count(sequence, by_predicate(predicate, False, options, _KEY))


_TWO_RANGES = ("TEST", "TEST-NOT", "KEY", "FROM-END", "START1", "END1", "START2", "END2")


@function("(search sequence-1 sequence-2 &key test test-not key from-end start1 end1 start2 end2)")
def search(first: Value, second: Value, *options: Value) -> Value:
    """Return where SEQUENCE-1 first (or last) stands in SEQUENCE-2, or NIL."""
    if not options and first.__class__ is String and second.__class__ is String:
        at = second.text.find(first.text)
        return at if at >= 0 else None
    test, test_not, key, from_end, start1, end1, start2, end2 = take_keys(options, _TWO_RANGES)
    agrees = agreement(test, test_not)
    wanted = keyed(section(first, start1, end1), key)
    found = keyed(section(second, start2, end2), key)
    places = range(len(found) - len(wanted) + 1)
    for place in places if from_end is None else reversed(places):
        for offset, element in enumerate(wanted):
            if not agrees(element, found[place + offset]):
                break
        else:
            return place + (start2 or 0)
    return None


@function("(mismatch sequence-1 sequence-2 &key test test-not key from-end start1 end1 start2 end2)")
def mismatch(first: Value, second: Value, *options: Value) -> Value:
    """Return where SEQUENCE-1 first differs from SEQUENCE-2, or NIL.

    With FROM-END, one more than the last such place.
    """
    test, test_not, key, from_end, start1, end1, start2, end2 = take_keys(options, _TWO_RANGES)
    agrees = agreement(test, test_not)
    left, right = keyed(section(first, start1, end1), key), keyed(section(second, start2, end2), key)
    shorter = min(len(left), len(right))
    same = 0
    if from_end is None:
        while same < shorter and agrees(left[same], right[same]):
            same += 1
    else:
        while same < shorter and agrees(left[-same - 1], right[-same - 1]):
            same += 1
    if same == len(left) == len(right):
        return None
    return (start1 or 0) + (same if from_end is None else len(left) - same)
