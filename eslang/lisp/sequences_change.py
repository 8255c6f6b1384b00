"""Sequences with some elements less, or others in their place.

REMOVE and SUBSTITUTE with their -IF families, FILL, REPLACE, and
REMOVE-DUPLICATES; DELETE and the N-variants may reuse what they are given.
"""

from __future__ import annotations

from eslang.base.arguments import take_keys
from eslang.base.failure import type_error
from eslang.base.hints import Any
from eslang.base.lists import Cons
from eslang.base.symbols import Value
from eslang.base.text import Vector
from eslang.compile.registry import function
from eslang.lisp.matching import Agreement, agreement, hash_key, keyed
from eslang.lisp.sequences import elements, length, like, limits, section, store
from eslang.lisp.sequences_search import Chosen, by_item, by_predicate

_RANGE = ("FROM-END", "START", "END", "COUNT")
_TESTS = ("TEST", "TEST-NOT", "KEY", *_RANGE)
_KEY = ("KEY", *_RANGE)
_UNLIMITED = [None] * len(_RANGE)
_ITEM_KEYS = "&key test test-not key from-end start end count"
_PREDICATE_KEYS = "&key key from-end start end count"


def _places(whole: list[Value], sequence: Value, chosen: Chosen) -> list[int]:
    """The places, in rising order, of at most COUNT elements that the judge accepts."""
    (judge, sign), (from_end, start, end, count) = chosen
    first, stop = limits(sequence, len(whole), start, end)
    if count is not None and count.__class__ is not int:
        raise type_error(count, "INTEGER")
    places: list[int] = []
    backwards = from_end is not None and count is not None
    for place in range(stop - 1, first - 1, -1) if backwards else range(first, stop):
        if count is not None and len(places) >= count:
            break
        if (judge(whole[place]) is not None) is sign:
            places.append(place)
    if backwards:
        places.reverse()
    return places


def _without(whole: list[Value], places: list[int]) -> list[Value]:
    dropped = set(places)
    return [element for place, element in enumerate(whole) if place not in dropped]


def _remove(sequence: Value, chosen: Chosen) -> Value:
    (judge, sign), options = chosen
    whole = elements(sequence)
    if options == _UNLIMITED:
        kept = []
        for element in whole:
            if (judge(element) is None) is sign:
                kept.append(element)
        return like(sequence, kept)
    places = _places(whole, sequence, chosen)
    return like(sequence, _without(whole, places)) if places else sequence


def _delete(sequence: Value, chosen: Chosen) -> Value:
    whole = elements(sequence)
    return _drop(sequence, whole, _places(whole, sequence, chosen))


def _drop(sequence: Value, whole: list[Value], places: list[int]) -> Value:
    """SEQUENCE without the elements at PLACES, changed in place where that can be."""
    if not places:
        return sequence
    if sequence.__class__ is Cons:
        return _unlink(sequence, set(places))
    kept = _without(whole, places)
    if sequence.__class__ is Vector and sequence.fill is not None:
        sequence.fill = len(kept)
        return store(sequence, kept)
    return like(sequence, kept)


def _unlink(lst: Value, places: set[int]) -> Value:
    head = end = Cons(None, lst)
    place, rest = 0, lst
    while rest is not None:
        if place not in places:
            end.cdr = rest
            end = rest
        place, rest = place + 1, rest.cdr
    end.cdr = None
    return head.cdr


@function(f"(remove item sequence {_ITEM_KEYS})")
def remove(item: Value, sequence: Value, *options: Value) -> Value:
    """Return SEQUENCE without the elements that ITEM matches."""
    return _remove(sequence, by_item(item, options, _TESTS))


@function(f"(remove-if predicate sequence {_PREDICATE_KEYS})")
def remove_if(predicate: Value, sequence: Value, *options: Value) -> Value:
    """Return SEQUENCE without the elements that satisfy PREDICATE."""
    return _remove(sequence, by_predicate(predicate, True, options, _KEY))


@function(f"(remove-if-not predicate sequence {_PREDICATE_KEYS})")
def remove_if_not(predicate: Value, sequence: Value, *options: Value) -> Value:
    """Return SEQUENCE without the elements that fail PREDICATE."""
    return _remove(sequence, by_predicate(predicate, False, options, _KEY))


@function(f"(delete item sequence {_ITEM_KEYS})")
def delete(item: Value, sequence: Value, *options: Value) -> Value:
    """Return SEQUENCE, changed to lack the elements that ITEM matches."""
    return _delete(sequence, by_item(item, options, _TESTS))


@function(f"(delete-if predicate sequence {_PREDICATE_KEYS})")
def delete_if(predicate: Value, sequence: Value, *options: Value) -> Value:
    """Return SEQUENCE, changed to lack the elements that satisfy PREDICATE."""
    return _delete(sequence, by_predicate(predicate, True, options, _KEY))


@function(f"(delete-if-not predicate sequence {_PREDICATE_KEYS})")
def delete_if_not(predicate: Value, sequence: Value, *options: Value) -> Value:
    """Return SEQUENCE, changed to lack the elements that fail PREDICATE."""
    return _delete(sequence, by_predicate(predicate, False, options, _KEY))


def _replaced(new: Value, sequence: Value, chosen: Chosen) -> list[Value]:
    whole = elements(sequence)
    result = whole[:]
    for place in _places(whole, sequence, chosen):
        result[place] = new
    return result


@function(f"(substitute new old sequence {_ITEM_KEYS})")
def substitute(new: Value, old: Value, sequence: Value, *options: Value) -> Value:
    """Return a copy of SEQUENCE with NEW for all that OLD matches."""
    return like(sequence, _replaced(new, sequence, by_item(old, options, _TESTS)))


@function(f"(substitute-if new predicate sequence {_PREDICATE_KEYS})")
def substitute_if(new: Value, predicate: Value, sequence: Value, *options: Value) -> Value:
    """Return a copy of SEQUENCE with NEW for all that satisfies PREDICATE."""
    return like(sequence, _replaced(new, sequence, by_predicate(predicate, True, options, _KEY)))


@function(f"(substitute-if-not new predicate sequence {_PREDICATE_KEYS})")
def substitute_if_not(new: Value, predicate: Value, sequence: Value, *options: Value) -> Value:
    """Return a copy of SEQUENCE with NEW for all that fails PREDICATE."""
    return like(sequence, _replaced(new, sequence, by_predicate(predicate, False, options, _KEY)))


@function(f"(nsubstitute new old sequence {_ITEM_KEYS})")
def nsubstitute(new: Value, old: Value, sequence: Value, *options: Value) -> Value:
    """Store NEW for all in SEQUENCE that OLD matches."""
    return store(sequence, _replaced(new, sequence, by_item(old, options, _TESTS)))


@function(f"(nsubstitute-if new predicate sequence {_PREDICATE_KEYS})")
def nsubstitute_if(new: Value, predicate: Value, sequence: Value, *options: Value) -> Value:
    """Store NEW for all in SEQUENCE that satisfies PREDICATE."""
    return store(sequence, _replaced(new, sequence, by_predicate(predicate, True, options, _KEY)))


@function(f"(nsubstitute-if-not new predicate sequence {_PREDICATE_KEYS})")
def nsubstitute_if_not(new: Value, predicate: Value, sequence: Value, *options: Value) -> Value:
    """Store NEW for all in SEQUENCE that fails PREDICATE."""
    return store(sequence, _replaced(new, sequence, by_predicate(predicate, False, options, _KEY)))


def _duplicates(sequence: Value, options: tuple[Value, ...]) -> tuple[list[Value], list[int]]:
    """The elements of SEQUENCE, and the places of those that stand there twice.

    Of equal elements the last stays, or the first with :from-end.
    """
    test, test_not, key, from_end, start, end = take_keys(options, _TESTS[:-1])
    whole = elements(sequence)
    first, stop = limits(sequence, len(whole), start, end)
    values = keyed(whole[first:stop], key)
    key_of = hash_key(test, test_not)
    if key_of is None:
        return whole, _matched(values, agreement(test, test_not), from_end is not None, first)
    seen: set[Any] = set()
    dropped = []
    for place in range(len(values)) if from_end is not None else range(len(values) - 1, -1, -1):
        mark = key_of(values[place])
        if mark in seen:
            dropped.append(first + place)
        seen.add(mark)
    return whole, dropped


def _matched(values: list[Value], agrees: Agreement, from_end: bool, first: int) -> list[int]:
    """The places of VALUES, counted from FIRST, that a later (or earlier) value matches."""
    places = []
    for place in range(len(values)):
        for other in range(place) if from_end else range(place + 1, len(values)):
            if agrees(values[place], values[other]):
                places.append(first + place)
                break
    return places


@function("(remove-duplicates sequence &key test test-not key from-end start end)")
def remove_duplicates(sequence: Value, *options: Value) -> Value:
    """Return SEQUENCE with no two elements that match; the last of such stays."""
    whole, dropped = _duplicates(sequence, options)
    return like(sequence, _without(whole, dropped)) if dropped else sequence


@function("(delete-duplicates sequence &key test test-not key from-end start end)")
def delete_duplicates(sequence: Value, *options: Value) -> Value:
    """Return SEQUENCE, changed to have no two elements that match."""
    whole, dropped = _duplicates(sequence, options)
    return _drop(sequence, whole, dropped)


@function("(fill sequence item &key start end)")
def fill(sequence: Value, item: Value, *options: Value) -> Value:
    """Store ITEM in the elements of SEQUENCE from START up to END."""
    first, stop = limits(sequence, length(sequence), *take_keys(options, ("START", "END")))
    return store(sequence, [item] * (stop - first), first)


@function("(replace sequence-1 sequence-2 &key start1 end1 start2 end2)")
def replace(target: Value, source: Value, *options: Value) -> Value:
    """Store elements of SEQUENCE-2 in SEQUENCE-1; return SEQUENCE-1."""
    start1, end1, start2, end2 = take_keys(options, ("START1", "END1", "START2", "END2"))
    first, stop = limits(target, length(target), start1, end1)
    return store(target, section(source, start2, end2)[: stop - first], first)
