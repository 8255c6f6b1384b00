"""SORT, STABLE-SORT and MERGE.

The predicate is a Lisp function and may suspend its task, so the sort is
written out here. Python's own serves where it calls no Lisp function: numbers
in the order of < or >.
"""

from __future__ import annotations

from eslang.base.arguments import take_keys
from eslang.base.hints import Any
from eslang.base.running import to_function
from eslang.base.symbols import Value
from eslang.compile.registry import function
from eslang.lisp.matching import keyed
from eslang.lisp.sequences import build, elements, store

_NUMBERS = {int, float}


def _is_number_order(predicate: Any, values: list[Value]) -> bool:
    """Whether PREDICATE is < or > itself and VALUES are numbers that Python orders alike."""
    if getattr(predicate, "__name__", "") not in ("<", ">"):
        return False
    return (
        bool(predicate.__module__ == "eslang.lisp.numbers")
        and {each.__class__ for each in values} <= _NUMBERS
    )


def _order(values: list[Value], precedes: Any) -> list[int]:
    """The places of VALUES in a stable order by PRECEDES."""
    if _is_number_order(precedes, values):
        return sorted(range(len(values)), key=values.__getitem__, reverse=precedes.__name__ == ">")
    order = list(range(len(values)))
    width = 1
    while width < len(order):
        merged: list[int] = []
        for start in range(0, len(order), 2 * width):
            middle = start + width
            merged += _merge(values, order[start:middle], order[middle : middle + width], precedes)
        order = merged
        width *= 2
    return order


def _merge(values: list[Value], left: list[int], right: list[int], precedes: Any) -> list[int]:
    """The places LEFT and RIGHT, each in order, in one order; LEFT first where neither precedes."""
    if not left or not right:
        return left + right
    if len(left) > 1 and precedes(values[right[0]], values[left[-1]]) is None:
        return left + right
    merged: list[int] = []
    taken, y = 0, values[right[0]]
    for done, place in enumerate(left):
        x = values[place]
        while precedes(y, x) is not None:
            merged.append(right[taken])
            taken += 1
            if taken == len(right):
                return merged + left[done:]
            y = values[right[taken]]
        merged.append(place)
    return merged + right[taken:]


def _sorted(sequence: Value, predicate: Value, options: tuple[Value, ...]) -> Value:
    """SEQUENCE, put in order in its place."""
    (key,) = take_keys(options, ("KEY",))
    whole = elements(sequence)
    order = _order(keyed(whole, key), to_function(predicate))
    return store(sequence, [whole[place] for place in order])


@function("(stable-sort sequence predicate &key key)")
def stable_sort(sequence: Value, predicate: Value, *options: Value) -> Value:
    """Put SEQUENCE in order: X before Y where (PREDICATE X Y); return it.

    Elements of which neither precedes keep their order.
    """
    return _sorted(sequence, predicate, options)


@function("(sort sequence predicate &key key)")
def sort(sequence: Value, predicate: Value, *options: Value) -> Value:
    """Put SEQUENCE in order: X before Y where (PREDICATE X Y); return it."""
    return _sorted(sequence, predicate, options)


@function("(merge result-type sequence-1 sequence-2 predicate &key key)")
def merge(result_type: Value, first: Value, second: Value, predicate: Value, *options: Value) -> Value:
    """Return both sequences, each in order by PREDICATE, as one in that order."""
    (key,) = take_keys(options, ("KEY",))
    left = elements(first)
    whole = left + elements(second)
    values = keyed(whole, key)
    places = range(len(whole))
    order = _merge(values, list(places[: len(left)]), list(places[len(left) :]), to_function(predicate))
    return build(result_type, [whole[place] for place in order])
