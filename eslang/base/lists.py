"""Conses, and the lists made of them.

A list is NIL or a Cons whose cdr is a list. Tails are shared and may be
dotted; whoever needs a proper list says so with `items`.
"""

from __future__ import annotations

from itertools import repeat

from eslang.base.failure import type_error
from eslang.base.hints import Iterable, Iterator
from eslang.base.symbols import Datum, Value

SUSPICIOUS = 1_000_000  # a list so long is asked whether it is circular


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
    result: list[Value] = []
    rest = lst
    while True:
        try:
            for _ in repeat(None, SUSPICIOUS):
                if rest is None:
                    return result
                result.append(rest.car)
                rest = rest.cdr
        except AttributeError:  # only conses have these parts
            raise type_error(lst, "LIST") from None
        check_end(lst)


def cells(lst: Value) -> Iterator[Cons]:
    """The conses of a proper list; a type error where it turns out to be none."""
    rest = lst
    while True:
        for _ in repeat(None, SUSPICIOUS):
            if rest.__class__ is not Cons:
                if rest is None:
                    return
                raise type_error(lst, "LIST")
            yield rest
            rest = rest.cdr
        check_end(lst)


def check_end(lst: Value) -> None:
    """A type error if LST is circular: whoever follows it would never arrive."""
    landmark = rest = lst
    steps, limit = 0, 2
    while rest.__class__ is Cons:
        rest = rest.cdr
        if rest is landmark:
            raise type_error(lst, "LIST")
        steps += 1
        if steps == limit:
            landmark, steps, limit = rest, 0, limit * 2


def check_finite(tree: Value) -> None:
    """A type error if TREE, a list of lists, contains itself."""
    around: set[int] = set()  # the conses that the one at hand stands in
    done: set[int] = set()
    pending: list[tuple[Value, bool]] = [(tree, False)]
    while pending:
        part, is_left = pending.pop()
        if is_left:
            around.remove(id(part))
            done.add(id(part))
        elif id(part) in around:
            raise type_error(tree, "LIST")
        elif part.__class__ is Cons and id(part) not in done:
            around.add(id(part))
            pending += [(part, True), (part.cdr, False), (part.car, False)]


def is_proper(lst: Value) -> bool:
    """True if LST ends in NIL (a circular list does not)."""
    seen = set()
    while lst.__class__ is Cons:
        if id(lst) in seen:
            return False
        seen.add(id(lst))
        lst = lst.cdr
    return lst is None
