"""Arrays of any rank, and vectors with fill pointers.

An array of rank one is a Vector, or a String where its elements are
characters; any other is an Array (base/text). Each may be adjusted; none is
displaced to another.
"""

from __future__ import annotations

from itertools import product
from math import prod

from eslang.base.arguments import UNSUPPLIED, check_index, take_keys
from eslang.base.failure import index_out_of_range, simple_error, type_error
from eslang.base.lists import Cons, from_items, items
from eslang.base.symbols import Symbol, T, Value, truth
from eslang.base.text import CHARACTERS, Array, Character, String, Vector
from eslang.compile.registry import function, variable
from eslang.lisp.sequences import elements, is_character_type, text_of

_MAKING = (
    "INITIAL-ELEMENT",
    "INITIAL-CONTENTS",
    "ELEMENT-TYPE",
    "FILL-POINTER",
    "ADJUSTABLE",
    "DISPLACED-TO",
    "DISPLACED-INDEX-OFFSET",
)
_KEYS = "&key element-type initial-element initial-contents adjustable fill-pointer"

variable("array-rank-limit", 1024, "One more than the highest rank of an array.", constant=True)
variable("array-dimension-limit", 1 << 62, "One more than the highest dimension of an array.", constant=True)
variable("array-total-size-limit", 1 << 62, "One more than the largest size of an array.", constant=True)


def _sizes(dimensions: Value) -> tuple[int, ...]:
    sizes = items(dimensions) if dimensions is None or dimensions.__class__ is Cons else [dimensions]
    return tuple([check_index(size, "MAKE-ARRAY") for size in sizes])


def _flatten(contents: Value, sizes: tuple[int, ...]) -> list[Value]:
    """The elements of CONTENTS, sequences nested as SIZES say, in row-major order."""
    flat = [contents]
    for size in sizes:
        deeper: list[Value] = []
        for part in flat:
            row = elements(part)
            if len(row) != size:
                raise simple_error("initial contents of another shape than the array", contents, size)
            deeper += row
        flat = deeper
    return flat


def _fill_pointer(pointer: Value, size: int) -> int | None:
    if pointer is None:
        return None
    fill = size if pointer is T else check_index(pointer, "MAKE-ARRAY")
    if fill > size:
        raise simple_error("a fill pointer beyond the end of the vector", fill, size)
    return fill


@function(f"(make-array dimensions {_KEYS})")
def make_array(dimensions: Value, *options: Value) -> Value:
    """Return a new array: DIMENSIONS is a list, or the length of a vector.

    Elements of ELEMENT-TYPE character make a vector a string.
    Fails: :error, where the array were to be displaced to another.
    """
    element, contents, kind, pointer, _, displaced, _ = take_keys(options, _MAKING, UNSUPPLIED)
    if displaced is not UNSUPPLIED and displaced is not None:
        raise simple_error("displaced arrays are not supported")
    sizes = _sizes(dimensions)
    is_text = is_character_type(kind)
    if contents is not UNSUPPLIED:
        flat = _flatten(contents, sizes)
    else:
        flat = [_blank(kind) if element is UNSUPPLIED else element] * prod(sizes)
    return _make(sizes, flat, is_text, None if pointer is UNSUPPLIED else pointer)


def _blank(kind: Value) -> Value:
    """What stands in an array of the element type KIND before anything is stored there."""
    if is_character_type(kind):
        return CHARACTERS[" "]
    return 0.0 if isinstance(kind, Symbol) and kind.name.endswith("FLOAT") else 0


def _make(sizes: tuple[int, ...], flat: list[Value], is_text: bool, pointer: Value) -> Value:
    if len(sizes) != 1:
        if pointer is not None:
            raise simple_error("only a vector has a fill pointer")
        return Array(sizes, flat)
    fill = _fill_pointer(pointer, len(flat))
    if is_text:
        return String(text_of(flat)[:fill], fill is not None)
    return Vector(flat, fill)


@function("(vector &rest elements)")
def vector(*contents: Value) -> Value:
    """Return a vector of ELEMENTS."""
    return Vector(list(contents))


def dimensions_of(array: Value) -> tuple[int, ...]:
    """The dimensions of ARRAY, in full, whatever a fill pointer hides."""
    if array.__class__ is Vector:
        return (len(array.items),)
    if array.__class__ is String:
        return (len(array.text),)
    if array.__class__ is Array:
        dimensions: tuple[int, ...] = array.dimensions
        return dimensions
    raise type_error(array, "ARRAY")


def row_major_index(array: Value, subscripts: tuple[Value, ...]) -> int:
    """The place of the element of ARRAY that SUBSCRIPTS name."""
    sizes = dimensions_of(array)
    if len(sizes) != len(subscripts):
        raise simple_error("as many subscripts as dimensions are needed", len(sizes), len(subscripts))
    place = 0
    for size, subscript in zip(sizes, subscripts, strict=True):
        if subscript.__class__ is not int:
            raise type_error(subscript, "INTEGER", "AREF")
        if not 0 <= subscript < size:
            raise index_out_of_range(array, subscript)
        place = place * size + subscript
    return place


def _store(array: Value, place: int, value: Value) -> Value:
    if array.__class__ is not String:
        array.items[place] = value
    elif value.__class__ is Character:
        array.text = array.text[:place] + value.char + array.text[place + 1 :]
    else:
        raise type_error(value, "CHARACTER")
    return value


@function("(aref array &rest subscripts)")
def aref(array: Value, index: Value = UNSUPPLIED, *more: Value) -> Value:
    """Return the element of ARRAY at SUBSCRIPTS, each counted from 0.

    Fails: :index-out-of-range, where ARRAY has no such element.
    """
    if index.__class__ is int and array.__class__ is Vector and index >= 0 and not more:
        try:
            return array.items[index]
        except IndexError:
            raise index_out_of_range(array, index) from None
    place = row_major_index(array, () if index is UNSUPPLIED else (index, *more))
    return CHARACTERS[array.text[place]] if array.__class__ is String else array.items[place]


@function("(%set-aref array &rest subscripts-and-value)")
def set_aref(array: Value, index: Value, value: Value = UNSUPPLIED, *more: Value) -> Value:
    """Make the last argument the element of ARRAY at the others; return it."""
    direct = not more and value is not UNSUPPLIED
    if direct and index.__class__ is int and array.__class__ is Vector and index >= 0:
        try:
            array.items[index] = value
        except IndexError:
            raise index_out_of_range(array, index) from None
        return value
    *subscripts, value = (index, *more) if value is UNSUPPLIED else (index, value, *more)
    return _store(array, row_major_index(array, tuple(subscripts)), value)


@function("(svref vector index)")
def svref(array: Value, index: Value) -> Value:
    """Return element INDEX of VECTOR, which is simple and no string."""
    if array.__class__ is not Vector:
        raise type_error(array, "SIMPLE-VECTOR", "SVREF")
    return aref(array, index)


@function("(%set-svref vector index value)")
def set_svref(array: Value, index: Value, value: Value) -> Value:
    """Make VALUE element INDEX of VECTOR; return VALUE."""
    svref(array, index)
    return _store(array, index, value)


def _row_major_place(array: Value, index: Value) -> int:
    if not 0 <= check_index(index, "ROW-MAJOR-AREF") < prod(dimensions_of(array)):
        raise index_out_of_range(array, index)
    place: int = index
    return place


@function("(row-major-aref array index)")
def row_major_aref(array: Value, index: Value) -> Value:
    """Return element INDEX of ARRAY, its elements taken in row-major order."""
    place = _row_major_place(array, index)
    return CHARACTERS[array.text[place]] if array.__class__ is String else array.items[place]


@function("(%set-row-major-aref array index value)")
def set_row_major_aref(array: Value, index: Value, value: Value) -> Value:
    """Make VALUE element INDEX of ARRAY in row-major order; return VALUE."""
    return _store(array, _row_major_place(array, index), value)


@function("(array-row-major-index array &rest subscripts)")
def array_row_major_index(array: Value, *subscripts: Value) -> Value:
    """Return the place, in row-major order, of the element at SUBSCRIPTS."""
    return row_major_index(array, subscripts)


@function("(array-dimensions array)")
def array_dimensions(array: Value) -> Value:
    """Return the list of the dimensions of ARRAY."""
    return from_items(dimensions_of(array))


@function("(array-dimension array axis)")
def array_dimension(array: Value, axis: Value) -> Value:
    """Return dimension AXIS of ARRAY, counted from 0."""
    sizes = dimensions_of(array)
    if not check_index(axis, "ARRAY-DIMENSION") < len(sizes):
        raise index_out_of_range(array, axis)
    return sizes[axis]


@function("(array-rank array)")
def array_rank(array: Value) -> Value:
    """Return the number of dimensions of ARRAY."""
    return len(dimensions_of(array))


@function("(array-total-size array)")
def array_total_size(array: Value) -> Value:
    """Return the number of elements of ARRAY, whatever a fill pointer hides."""
    return prod(dimensions_of(array))


@function("(array-in-bounds-p array &rest subscripts)")
def array_in_bounds_p(array: Value, *subscripts: Value) -> Value:
    """True if ARRAY has an element at SUBSCRIPTS."""
    sizes = dimensions_of(array)
    if len(sizes) != len(subscripts):
        raise simple_error("as many subscripts as dimensions are needed", len(sizes), len(subscripts))
    return truth(
        all(each.__class__ is int and 0 <= each < size for each, size in zip(subscripts, sizes, strict=True))
    )


@function("(array-element-type array)")
def array_element_type(array: Value) -> Value:
    """Return CHARACTER for a string, T for any other array."""
    dimensions_of(array)
    return Symbol.intern("CHARACTER", "COMMON-LISP") if array.__class__ is String else T


@function("(adjustable-array-p array)")
def adjustable_array_p(array: Value) -> Value:
    """True: all arrays are adjustable here."""
    dimensions_of(array)
    return T


def _moved(array: Value, old: tuple[int, ...], sizes: tuple[int, ...], blank: Value) -> list[Value]:
    """The elements of ARRAY, which has the dimensions OLD, as they stand in one of SIZES."""
    flat = []
    for subscripts in product(*[range(size) for size in sizes]):
        inside = all(subscript < size for subscript, size in zip(subscripts, old, strict=True))
        flat.append(aref(array, *subscripts) if inside else blank)
    return flat


@function(f"(adjust-array array dimensions {_KEYS})")
def adjust_array(array: Value, dimensions: Value, *options: Value) -> Value:
    """Give ARRAY new DIMENSIONS; elements that both shapes have stay."""
    old, sizes = dimensions_of(array), _sizes(dimensions)
    if len(old) != len(sizes):
        raise simple_error("an adjusted array keeps its rank", len(old), len(sizes))
    element, contents, _, pointer, _, displaced, _ = take_keys(options, _MAKING, UNSUPPLIED)
    if displaced is not UNSUPPLIED and displaced is not None:
        raise simple_error("displaced arrays are not supported")
    is_text = array.__class__ is String
    if contents is not UNSUPPLIED:
        flat = _flatten(contents, sizes)
    else:
        blank = _blank(array_element_type(array)) if element is UNSUPPLIED else element
        flat = _moved(array, old, sizes, blank)
    if array.__class__ is Array:
        array.dimensions, array.items = sizes, flat
    elif is_text:
        array.text = text_of(flat)
    else:
        array.items = flat
        if array.fill is not None:
            fill = array.fill if pointer is UNSUPPLIED or pointer is None else pointer
            array.fill = _fill_pointer(fill, len(flat))
    return array
