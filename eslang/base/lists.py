"""Conses, and the lists made of them.

A list is NIL or a Cons whose cdr is a list. Tails are shared and may be
dotted; whoever needs a proper list says so with `items`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from eslang.base.failure import type_error
from eslang.base.symbols import Datum, Value


class Cons(Datum):
    """A pair. Identity is EQ; `equal` (lisp/predicates) compares structure."""

    __slots__ = ("car", "cdr")

    def __init__(self, car: Value, cdr: Value) -> None:
        self.car = car
        self.cdr = cdr

    def __iter__(self) -> Iterator[Value]:
        return iter(items(self))

    def __repr__(self) -> str:
        from eslang.base.printer import prin1  # for people at a Python prompt

        return prin1(self)


def from_items(elements: Iterable[Value], tail: Value = None) -> Value:
    """The list of ELEMENTS, ending in TAIL."""
    result = tail
    for element in reversed(elements if isinstance(elements, (list, tuple)) else list(elements)):
        result = Cons(element, result)
    return result


def lisp_list(*elements: Value) -> Value:
    """(list &rest elements)."""
    return from_items(elements)


def items(lst: Value) -> list[Value]:
    """The elements of a proper list, as a Python list; a type error for anything else."""
    result = []
    rest = lst
    while rest is not None:
        if rest.__class__ is not Cons:
            raise type_error(lst, "LIST")
        result.append(rest.car)
        rest = rest.cdr
    return result


def is_proper(lst: Value) -> bool:
    """True if LST ends in NIL (a circular list does not)."""
    seen = set()
    while lst.__class__ is Cons:
        if id(lst) in seen:
            return False
        seen.add(id(lst))
        lst = lst.cdr
    return lst is None
