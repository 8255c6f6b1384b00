"""Sequences: lists, vectors and strings alike; their parts, and making them.

The functions without a Lisp name say how a sequence is read and written; the
other sequence files stand on them. Generators here only walk: they never call
a Lisp function.
"""

from __future__ import annotations

from eslang.base.arguments import check_index, take_keys
from eslang.base.failure import index_out_of_range, simple_error, type_error
from eslang.base.hints import Callable, Iterable, Iterator
from eslang.base.lists import SUSPICIOUS, Cons, cells, check_end, from_items, items
from eslang.base.symbols import Symbol, Value
from eslang.base.text import CHARACTERS, Character, String, Vector
from eslang.compile.registry import function
from eslang.lisp.conses import nreconc, revappend
from eslang.lisp.types import expand_type

Builder = Callable[[list[Value]], Value]


def elements(sequence: Value) -> list[Value]:
    """The elements of SEQUENCE; for a vector this may be its very storage."""
    kind = sequence.__class__
    if kind is Cons:
        return items(sequence)
    if kind is Vector:
        active: list[Value] = sequence.active()
        return active
    if kind is String:
        characters = CHARACTERS
        return [characters[char] for char in sequence.text]
    if sequence is None:
        return []
    raise type_error(sequence, "SEQUENCE")


def limits(sequence: Value, length: int, start: Value, end: Value) -> tuple[int, int]:
    """The bounds START and END of SEQUENCE as numbers, if it has them; NIL means all of it."""
    first = 0 if start is None else start
    stop = length if end is None else end
    if first.__class__ is not int:
        raise type_error(first, "UNSIGNED-BYTE")
    if stop.__class__ is not int:
        raise type_error(stop, "UNSIGNED-BYTE")
    if not 0 <= stop <= length:
        raise index_out_of_range(sequence, stop)
    if not 0 <= first <= stop:
        raise index_out_of_range(sequence, first)
    return first, stop


def section(sequence: Value, start: Value = None, end: Value = None) -> list[Value]:
    """The elements of SEQUENCE from START up to END, in a list of their own."""
    whole = elements(sequence)
    first, stop = limits(sequence, len(whole), start, end)
    return whole[first:stop]


def walk(sequence: Value, start: Value = None, end: Value = None) -> Iterable[Value]:
    """The elements of SEQUENCE from START up to END; a list is followed no further than asked."""
    if sequence.__class__ is not Cons:
        return section(sequence, start, end)
    if start is None and end is None:
        return _walk_list(sequence)
    return _walk_part(sequence, start, end)


def _walk_list(lst: Value) -> Iterator[Value]:
    return (cell.car for cell in cells(lst))


def _walk_part(lst: Value, start: Value, end: Value) -> Iterator[Value]:
    first = check_index(start or 0, "ELT")
    stop = check_index(end, "ELT") if end is not None else None
    if stop is not None and stop < first:
        raise index_out_of_range(lst, first)
    place = 0
    for element in _walk_list(lst):
        if place == stop:
            return
        if place >= first:
            yield element
        place += 1
    if place < first or (stop is not None and place < stop):
        raise index_out_of_range(lst, first if place < first else stop)


def text_of(characters: Iterable[Value]) -> str:
    """The text of CHARACTERS; a type error if one is none."""
    try:
        return "".join([character.char for character in characters])
    except AttributeError:
        for value in characters:
            if value.__class__ is not Character:
                raise type_error(value, "CHARACTER") from None
        raise


def like(sequence: Value, contents: list[Value]) -> Value:
    """A new sequence of CONTENTS, of the kind that SEQUENCE is."""
    if sequence.__class__ is String:
        return String(text_of(contents))
    return Vector(contents) if sequence.__class__ is Vector else from_items(contents)


def store(sequence: Value, contents: list[Value], start: int = 0) -> Value:
    """Write CONTENTS over the elements of SEQUENCE from START on; return SEQUENCE."""
    if sequence.__class__ is String:
        text = sequence.text
        sequence.text = text[:start] + text_of(contents) + text[start + len(contents) :]
    elif sequence.__class__ is Vector:
        sequence.items[start : start + len(contents)] = contents
    else:
        rest = sequence
        for _ in range(start):
            rest = rest.cdr
        for value in contents:
            rest.car = value
            rest = rest.cdr
    return sequence


def is_character_type(specifier: Value) -> bool:
    """Whether an array with elements of the type SPECIFIER is a string."""
    return isinstance(specifier, Symbol) and specifier.name in ("CHARACTER", "BASE-CHAR", "STANDARD-CHAR")


def sequence_type(specifier: Value) -> tuple[Builder, int | None]:
    """What makes a sequence of the type SPECIFIER of its elements, and how many it must have."""
    expanded = expand_type(specifier)
    head, *arguments = items(expanded) if expanded.__class__ is Cons else [expanded]
    name = head.name if isinstance(head, Symbol) else ""
    if name in ("LIST", "CONS"):
        return from_items, None
    if name == "NULL" or head is None:
        return from_items, 0
    if name.endswith("STRING"):
        return make_text, _size(arguments)
    if name == "SIMPLE-VECTOR":
        return Vector, _size(arguments)
    if name not in ("VECTOR", "ARRAY", "SIMPLE-ARRAY"):
        raise type_error(specifier, "SEQUENCE")
    make = make_text if arguments and is_character_type(arguments[0]) else Vector
    sizes = arguments[1:]
    if sizes and name != "VECTOR":
        sizes = items(sizes[0]) if sizes[0].__class__ is Cons else []
    return make, _size(sizes)


def _size(sizes: list[Value]) -> int | None:
    return sizes[0] if sizes and sizes[0].__class__ is int else None


def make_text(contents: list[Value]) -> String:
    """The string of the characters CONTENTS."""
    return String(text_of(contents))


def build(specifier: Value, contents: list[Value]) -> Value:
    """A sequence of the type SPECIFIER of CONTENTS."""
    make, size = sequence_type(specifier)
    if size is not None and len(contents) != size:
        raise simple_error("a sequence of another length than its type says", len(contents), specifier)
    return make(contents)


@function("(length sequence)")
def length(sequence: Value) -> Value:
    """Return the number of elements of SEQUENCE."""
    kind = sequence.__class__
    if kind is String:
        return len(sequence.text)
    if kind is Vector:
        return len(sequence.items) if sequence.fill is None else sequence.fill
    if sequence is not None and kind is not Cons:
        raise type_error(sequence, "SEQUENCE", "LENGTH")
    count, rest = 0, sequence
    while rest.__class__ is Cons:
        rest = rest.cdr
        count += 1
        if count == SUSPICIOUS:
            check_end(sequence)
    if rest is not None:
        raise type_error(sequence, "LIST", "LENGTH")
    return count


@function("(elt sequence index)")
def elt(sequence: Value, index: Value) -> Value:
    """Return element INDEX of SEQUENCE, counted from 0.

    Fails: :index-out-of-range, where SEQUENCE has no such element.
    """
    if index.__class__ is not int:
        raise type_error(index, "INTEGER", "ELT")
    if index >= 0:
        if sequence.__class__ is Cons:
            rest = sequence
            for _ in range(index):
                rest = rest.cdr
                if rest.__class__ is not Cons:
                    raise index_out_of_range(sequence, index)
            return rest.car
        if sequence.__class__ is String and index < len(sequence.text):
            return CHARACTERS[sequence.text[index]]
        if sequence.__class__ is Vector and index < length(sequence):
            return sequence.items[index]
    length(sequence)
    raise index_out_of_range(sequence, index)


@function("(%set-elt sequence index value)")
def set_elt(sequence: Value, index: Value, value: Value) -> Value:
    """Make VALUE element INDEX of SEQUENCE; return VALUE."""
    elt(sequence, index)
    store(sequence, [value], index)
    return value


@function("(subseq sequence start &optional end)")
def subseq(sequence: Value, start: Value, end: Value = None) -> Value:
    """Return a copy of the elements of SEQUENCE from START up to END."""
    if sequence.__class__ is String:
        first, stop = limits(sequence, len(sequence.text), start, end)
        return String(sequence.text[first:stop])
    return like(sequence, section(sequence, start, end))


@function("(%set-subseq sequence start &rest end-and-value)")
def set_subseq(sequence: Value, start: Value, *end_and_value: Value) -> Value:
    """Write the last argument over SEQUENCE from START up to END."""
    *end, value = end_and_value
    first, stop = limits(sequence, length(sequence), start, end[0] if end else None)
    store(sequence, section(value)[: stop - first], first)
    return value


@function("(copy-seq sequence)")
def copy_seq(sequence: Value) -> Value:
    """Return a copy of SEQUENCE."""
    return String(sequence.text) if sequence.__class__ is String else like(sequence, section(sequence))


@function("(reverse sequence)")
def reverse(sequence: Value) -> Value:
    """Return the elements of SEQUENCE in the opposite order."""
    if sequence.__class__ is String:
        return String(sequence.text[::-1])
    if sequence.__class__ is Cons:
        return revappend(sequence, None)
    return like(sequence, elements(sequence)[::-1])


@function("(nreverse sequence)")
def nreverse(sequence: Value) -> Value:
    """Turn SEQUENCE round in place."""
    if sequence.__class__ is Cons:
        return nreconc(sequence, None)
    return store(sequence, elements(sequence)[::-1])


@function("(concatenate result-type &rest sequences)")
def concatenate(result_type: Value, *sequences: Value) -> Value:
    """Return a sequence of RESULT-TYPE with the elements of all SEQUENCES."""
    contents: list[Value] = []
    for sequence in sequences:
        contents += elements(sequence)
    return build(result_type, contents)


@function("(make-sequence result-type size &key initial-element)")
def make_sequence(result_type: Value, size: Value, *options: Value) -> Value:
    """Return a sequence of RESULT-TYPE of SIZE elements, each INITIAL-ELEMENT."""
    (element,) = take_keys(options, ("INITIAL-ELEMENT",))
    if element is None and sequence_type(result_type)[0] is make_text:
        element = CHARACTERS[" "]
    return build(result_type, [element] * check_index(size, "MAKE-SEQUENCE"))
