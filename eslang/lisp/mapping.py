"""MAPCAR and its five siblings: a function over the elements or tails of lists."""

from __future__ import annotations

from eslang.base.calls import spread
from eslang.base.failure import type_error
from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items
from eslang.base.running import to_function
from eslang.base.symbols import Value
from eslang.compile.registry import function
from eslang.lisp.conses import nconc


def _collect(f: Value, first: Value, more: tuple[Value, ...], by_element: bool) -> list[Value]:
    """The results of F over the elements (or tails) of all lists, as far as the shortest."""
    call = to_function(f)
    if more:
        return _collect_many(call, [first, *more], by_element)
    results = []
    rest = first
    while rest.__class__ is Cons:
        results.append(call(rest.car if by_element else rest))
        rest = rest.cdr
    if rest is not None:
        raise type_error(rest, "LIST")
    return results


def _collect_many(call: Any, rests: list[Value], by_element: bool) -> list[Value]:
    results: list[Value] = []
    if len(rests) == 2 and by_element:
        one, other = rests
        while one.__class__ is Cons and other.__class__ is Cons:
            results.append(call(one.car, other.car))
            one, other = one.cdr, other.cdr
        rests = [one, other]
    while True:
        for rest in rests:
            if rest is None:
                return results
            if rest.__class__ is not Cons:
                raise type_error(rest, "LIST")
        results.append(spread(call, [rest.car for rest in rests] if by_element else rests))
        rests = [rest.cdr for rest in rests]


@function("(mapcar function list &rest more-lists)")
def mapcar(f: Value, first: Value, *more: Value) -> Value:
    """Return what FUNCTION makes of each element of LIST.

    With MORE-LISTS, FUNCTION gets an element of each, as far as the shortest goes.
    """
    return from_items(_collect(f, first, more, True))


@function("(mapc function list &rest more-lists)")
def mapc(f: Value, first: Value, *more: Value) -> Value:
    """Call FUNCTION with each element of LIST, for effect; return LIST."""
    if more:
        _collect_many(to_function(f), [first, *more], True)
        return first
    call, rest = to_function(f), first
    while rest is not None:
        if rest.__class__ is not Cons:
            raise type_error(rest, "LIST")
        call(rest.car)
        rest = rest.cdr
    return first


@function("(mapcan function list &rest more-lists)")
def mapcan(f: Value, first: Value, *more: Value) -> Value:
    """Join, as NCONC does, the lists that FUNCTION makes of each element."""
    return nconc(*_collect(f, first, more, True))


@function("(maplist function list &rest more-lists)")
def maplist(f: Value, first: Value, *more: Value) -> Value:
    """Return what FUNCTION makes of LIST and of each of its tails."""
    return from_items(_collect(f, first, more, False))


@function("(mapl function list &rest more-lists)")
def mapl(f: Value, first: Value, *more: Value) -> Value:
    """Call FUNCTION with LIST and each of its tails, for effect; return LIST."""
    _collect(f, first, more, False)
    return first


@function("(mapcon function list &rest more-lists)")
def mapcon(f: Value, first: Value, *more: Value) -> Value:
    """Join, as NCONC does, the lists that FUNCTION makes of the tails."""
    return nconc(*_collect(f, first, more, False))
