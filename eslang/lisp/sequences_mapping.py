"""Functions over the elements of sequences: MAP, REDUCE, SOME and their kin."""

from __future__ import annotations

from eslang.base.arguments import UNSUPPLIED, take_keys
from eslang.base.calls import spread
from eslang.base.hints import Any
from eslang.base.running import to_function
from eslang.base.symbols import Value, truth
from eslang.base.text import Vector
from eslang.compile.registry import function
from eslang.lisp.matching import keyed
from eslang.lisp.sequences import build, elements, length, section, store, walk


def _results(f: Value, sequences: tuple[Value, ...]) -> list[Value]:
    """What F makes of the elements side by side, as far as the shortest sequence goes."""
    call = to_function(f)
    results = []
    if len(sequences) == 1:
        for element in walk(sequences[0]):
            results.append(call(element))
    else:
        for row in zip(*[walk(sequence) for sequence in sequences], strict=False):
            results.append(spread(call, list(row)))
    return results


@function("(map result-type function sequence &rest more-sequences)")
def map_(result_type: Value, f: Value, sequence: Value, *more: Value) -> Value:
    """Return a sequence of what FUNCTION makes of the elements of SEQUENCE.

    RESULT-TYPE NIL means that only the effects are wanted. With
    MORE-SEQUENCES, FUNCTION gets an element of each.
    """
    results = _results(f, (sequence, *more))
    return None if result_type is None else build(result_type, results)


@function("(map-into result-sequence function &rest sequences)")
def map_into(target: Value, f: Value, *sequences: Value) -> Value:
    """Store in RESULT-SEQUENCE what FUNCTION makes of SEQUENCES."""
    call = to_function(f)
    filled = target.__class__ is Vector and target.fill is not None
    size = len(target.items) if filled else length(target)
    results: list[Value] = []
    if not sequences:
        while len(results) < size:
            results.append(call())
    else:
        for row in zip(range(size), *[walk(sequence) for sequence in sequences], strict=False):
            results.append(spread(call, list(row[1:])))
    store(target, results)
    if filled:
        target.fill = len(results)
    return target


@function("(reduce function sequence &key key from-end start end initial-value)")
def reduce(f: Value, sequence: Value, *options: Value) -> Value:
    """Combine the elements of SEQUENCE by FUNCTION, two at a time.

    Of an empty sequence without INITIAL-VALUE, the value of FUNCTION called
    without arguments.
    """
    call = to_function(f)
    if not options:
        return _fold(call, elements(sequence), False, UNSUPPLIED)
    names = ("INITIAL-VALUE", "KEY", "FROM-END", "START", "END")
    initial, *others = take_keys(options, names, UNSUPPLIED)
    key, from_end, start, end = [None if value is UNSUPPLIED else value for value in others]
    return _fold(call, keyed(section(sequence, start, end), key), from_end is not None, initial)


def _fold(call: Any, values: list[Value], from_end: bool, initial: Value) -> Value:
    if from_end:
        values = values[::-1]
    if initial is not UNSUPPLIED:
        result, first = initial, 0
    elif values:
        result, first = values[0], 1
    else:
        return call()
    for place in range(first, len(values)):
        result = call(values[place], result) if from_end else call(result, values[place])
    return result


def _first_result(predicate: Value, sequences: tuple[Value, ...], wanted: bool) -> Value:
    """What PREDICATE first answers that is true (or false, if that is wanted); else UNSUPPLIED."""
    call = to_function(predicate)
    if len(sequences) == 1:
        for element in walk(sequences[0]):
            result = call(element)
            if (result is not None) is wanted:
                return result
        return UNSUPPLIED
    for row in zip(*[walk(sequence) for sequence in sequences], strict=False):
        result = spread(call, list(row))
        if (result is not None) is wanted:
            return result
    return UNSUPPLIED


@function("(some predicate sequence &rest more-sequences)")
def some(predicate: Value, sequence: Value, *more: Value) -> Value:
    """Return what PREDICATE first says that is true of an element, or NIL."""
    result = _first_result(predicate, (sequence, *more), True)
    return None if result is UNSUPPLIED else result


@function("(every predicate sequence &rest more-sequences)")
def every(predicate: Value, sequence: Value, *more: Value) -> Value:
    """True if PREDICATE is true of all elements."""
    return truth(_first_result(predicate, (sequence, *more), False) is UNSUPPLIED)


@function("(notany predicate sequence &rest more-sequences)")
def notany(predicate: Value, sequence: Value, *more: Value) -> Value:
    """True if PREDICATE is true of no element."""
    return truth(_first_result(predicate, (sequence, *more), True) is UNSUPPLIED)


@function("(notevery predicate sequence &rest more-sequences)")
def notevery(predicate: Value, sequence: Value, *more: Value) -> Value:
    """True if PREDICATE is false of some element."""
    return truth(_first_result(predicate, (sequence, *more), False) is not UNSUPPLIED)
