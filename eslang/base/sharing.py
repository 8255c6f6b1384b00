"""Which parts of a structure are met more than once, and whether it contains itself.

Lists, vectors and structures can be joined to anything, themselves included.
Whoever walks them to the end asks here first. Nothing is kept on Python's
stack. An object of a higher floor tells its parts by a method `lisp_parts()`.
"""

from __future__ import annotations

from eslang.base.hints import Any
from eslang.base.lists import Cons
from eslang.base.symbols import Value
from eslang.base.text import Array, Vector

COMPOUND = frozenset((Cons, Vector, Array))


class Part:
    """A value among the texts that an object's `lisp_parts` gives."""

    __slots__ = ("value",)

    def __init__(self, value: Value) -> None:
        self.value = value


def object_parts(value: Value) -> list[Any] | None:
    """The texts and Parts that VALUE, an object of a higher floor, is written with; None if it has none."""
    make = getattr(type(value), "lisp_parts", None)
    parts: list[Any] | None = make(value) if make is not None else None
    return parts


def is_compound(value: Value) -> bool:
    """True for what is made of other values, and so may contain itself."""
    return value.__class__ in COMPOUND or object_parts(value) is not None


def parts_of(value: Value) -> list[Value]:
    """The compound values that a compound VALUE is made of."""
    parts: list[Value]
    if value.__class__ is Cons:
        parts = [value.car, value.cdr]
    elif value.__class__ is Vector or value.__class__ is Array:
        parts = value.items
    else:
        parts = [part.value for part in object_parts(value) or () if part.__class__ is Part]
    return [part for part in parts if is_compound(part)]


def shared_parts(value: Value) -> dict[int, int]:
    """The id of every part that is met more than once in VALUE, each without a label yet."""
    met: set[int] = set()
    shared: dict[int, int] = {}
    waiting = [value]
    while waiting:
        part = waiting.pop()
        if id(part) in met:
            shared[id(part)] = 0
            continue
        met.add(id(part))
        waiting.extend(reversed(parts_of(part)))
    return shared


def contains_itself(value: Value) -> bool:
    """True if VALUE, a compound one, is among its own parts, or one of its parts is."""
    around: set[int] = set()
    done: set[int] = set()
    waiting: list[tuple[Value, bool]] = [(value, False)]
    while waiting:
        part, leaving = waiting.pop()
        if leaving:
            around.discard(id(part))
            done.add(id(part))
        elif id(part) in around:
            return True
        elif id(part) not in done:
            around.add(id(part))
            waiting.append((part, True))
            waiting.extend((inner, False) for inner in parts_of(part))
    return False
