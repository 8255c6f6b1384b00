"""Vectors with fill pointers: those that grow as elements are pushed on.

A string's fill pointer is its length: what it hides is forgotten.
"""

from __future__ import annotations

from eslang.base.arguments import check_index
from eslang.base.failure import index_out_of_range, simple_error, type_error
from eslang.base.symbols import Value, truth
from eslang.base.text import CHARACTERS, Character, String, Vector
from eslang.compile.registry import function


def _check_fill(array: Value, operator: str) -> None:
    """Fail, unless ARRAY has a fill pointer."""
    if array.__class__ is Vector and array.fill is not None:
        return
    if array.__class__ is String and array.fill:
        return
    raise type_error(array, "VECTOR-WITH-FILL-POINTER", operator)


@function("(array-has-fill-pointer-p array)")
def array_has_fill_pointer_p(array: Value) -> Value:
    """True if ARRAY has a fill pointer."""
    if array.__class__ is Vector:
        return truth(array.fill is not None)
    return truth(array.__class__ is String and array.fill)


@function("(fill-pointer vector)")
def fill_pointer(array: Value) -> Value:
    """Return the fill pointer of VECTOR: how many elements are active."""
    _check_fill(array, "FILL-POINTER")
    return len(array.text) if array.__class__ is String else array.fill


@function("(%set-fill-pointer vector value)")
def set_fill_pointer(array: Value, value: Value) -> Value:
    """Make the first VALUE elements of VECTOR its active ones; return VALUE."""
    _check_fill(array, "FILL-POINTER")
    size = check_index(value, "FILL-POINTER")
    if array.__class__ is String:
        array.text = array.text[:size].ljust(size)
    elif size > len(array.items):
        raise index_out_of_range(array, size)
    else:
        array.fill = size
    return value


@function("(vector-push new-element vector)")
def vector_push(element: Value, array: Value) -> Value:
    """Put NEW-ELEMENT at the fill pointer of VECTOR and advance it.

    Returns: the place of the element; NIL, if there was no room for it.
    """
    _check_fill(array, "VECTOR-PUSH")
    if array.__class__ is Vector and array.fill == len(array.items):
        return None
    return vector_push_extend(element, array)


@function("(vector-push-extend new-element vector &optional extension)")
def vector_push_extend(element: Value, array: Value, _extension: Value = None) -> Value:
    """Put NEW-ELEMENT at the fill pointer of VECTOR, making room for it.

    Returns: the place of the element.
    """
    _check_fill(array, "VECTOR-PUSH-EXTEND")
    if array.__class__ is String:
        if element.__class__ is not Character:
            raise type_error(element, "CHARACTER", "VECTOR-PUSH-EXTEND")
        array.text += element.char
        return len(array.text) - 1
    place = array.fill
    if place == len(array.items):
        array.items.append(element)
    else:
        array.items[place] = element
    array.fill = place + 1
    return place


@function("(vector-pop vector)")
def vector_pop(array: Value) -> Value:
    """Move the fill pointer of VECTOR back by one; return the element there."""
    _check_fill(array, "VECTOR-POP")
    if fill_pointer(array) == 0:
        raise simple_error("nothing to pop from the vector", array)
    if array.__class__ is String:
        last = array.text[-1]
        array.text = array.text[:-1]
        return CHARACTERS[last]
    array.fill -= 1
    return array.items[array.fill]
