"""How elements are chosen: :test, :test-not and :key, and the -IF families.

A judge is a function of an element that answers as Lisp does (NIL: no). It
comes with a sign, False where its answer is to be turned round, so that the
walkers of the room call a user's predicate without a frame in between:
`(judge(element) is not None) is sign`.
"""

from __future__ import annotations

from eslang.base.failure import simple_error
from eslang.base.hashing import eql_key, equal_key, equalp_key
from eslang.base.hints import Any, Callable
from eslang.base.running import to_function
from eslang.base.sameness import is_eql
from eslang.base.symbols import Symbol, T, Value
from eslang.base.text import Character
from eslang.lisp.predicates import eq, eql, equal, equalp, is_equal, is_equalp

Judge = Callable[[Value], Value]
Choice = tuple[Judge, bool]  # a judge and its sign
Agreement = Callable[[Value, Value], bool]

_KNOWN: dict[Any, tuple[Agreement, Callable[[Value], Any]]] = {
    eq: (is_eql, eql_key),
    eql: (is_eql, eql_key),
    equal: (is_equal, equal_key),
    equalp: (is_equalp, equalp_key),
}


def judge_item(item: Value, test: Value, test_not: Value, key: Value) -> Choice:
    """The judge, and its sign, of what matches ITEM."""
    if test is None and test_not is None:
        judge = _same_as(item)
        return (judge if key is None else _after(key, judge)), True
    compare = _test_function(test, test_not)
    known = _KNOWN.get(compare)
    if known is not None:
        agrees = known[0]
        judge = _same_as(item) if agrees is is_eql else lambda element: T if agrees(item, element) else None
        if key is not None:
            judge = _after(key, judge)
    elif key is None:
        judge = lambda element: compare(item, element)  # noqa: E731
    else:
        take = to_function(key)
        judge = lambda element: compare(item, take(element))  # noqa: E731
    return judge, test is not None


def _same_as(item: Value) -> Judge:
    if item is None or isinstance(item, (Symbol, Character)):
        return lambda element: T if element is item else None
    if item.__class__ is int:
        return lambda element: T if element.__class__ is int and element == item else None
    return lambda element: T if is_eql(item, element) else None


def _after(key: Value, judge: Judge) -> Judge:
    take = to_function(key)
    return lambda element: judge(take(element))


def judge_if(predicate: Value, sign: bool, key: Value) -> Choice:
    """The judge of what satisfies PREDICATE, or, with the SIGN False, of what fails it."""
    judge: Judge = to_function(predicate)
    return (judge if key is None else _after(key, judge)), sign


def _test_function(test: Value, test_not: Value) -> Any:
    if test is not None and test_not is not None:
        raise simple_error("both :TEST and :TEST-NOT are given")
    return to_function(test if test is not None else test_not)


def agreement(test: Value, test_not: Value) -> Agreement:
    """Whether two values match: EQL, unless a test is given."""
    if test is None and test_not is None:
        return is_eql
    compare = _test_function(test, test_not)
    if test is None:
        return lambda a, b: compare(a, b) is None
    known = _KNOWN.get(compare)
    return known[0] if known is not None else lambda a, b: compare(a, b) is not None


def hash_key(test: Value, test_not: Value) -> Callable[[Value], Any] | None:
    """The keys that are equal where values match; None where the test is a stranger."""
    if test_not is not None:
        return None
    known = _KNOWN.get(to_function(test)) if test is not None else (is_eql, eql_key)
    return known[1] if known is not None else None


def keyed(elements: list[Value], key: Value) -> list[Value]:
    """What the :key function takes of each element."""
    if key is None:
        return elements
    take = to_function(key)
    taken = []
    for element in elements:
        taken.append(take(element))
    return taken
