"""Association lists and property lists."""

from __future__ import annotations

from itertools import repeat

from eslang.base.arguments import take_keys
from eslang.base.failure import simple_error, type_error
from eslang.base.lists import SUSPICIOUS, Cons, cells, from_items, items
from eslang.base.many import pack
from eslang.base.sameness import is_eql
from eslang.base.symbols import Datum, Value
from eslang.compile.registry import function
from eslang.lisp.matching import Choice, judge_if, judge_item

_TESTS = ("TEST", "TEST-NOT", "KEY")
_KEY = ("KEY",)


def _entry(alist: Value, by_car: bool, choice: Choice) -> Value:
    """The first entry of ALIST whose car (or cdr) the judge accepts."""
    judge, sign = choice
    for cell in cells(alist):
        entry = cell.car
        if entry is not None:
            if entry.__class__ is not Cons:
                raise type_error(entry, "LIST")
            if (judge(entry.car if by_car else entry.cdr) is not None) is sign:
                return entry
    return None


@function("(assoc item alist &key test test-not key)")
def assoc(item: Value, alist: Value, *options: Value) -> Value:
    """Return the first entry of ALIST whose car matches ITEM, or NIL."""
    if not options and (item is None or isinstance(item, Datum)):
        rest = alist
        try:
            for _ in repeat(None, SUSPICIOUS):
                if rest is None:
                    return None
                entry = rest.car
                if entry is not None and entry.car is item:
                    return entry
                rest = rest.cdr
        except AttributeError:
            pass  # what is wrong, the long way tells
    return _entry(alist, True, judge_item(item, *take_keys(options, _TESTS)))


@function("(assoc-if predicate alist &key key)")
def assoc_if(predicate: Value, alist: Value, *options: Value) -> Value:
    """Return the first entry of ALIST whose car satisfies PREDICATE, or NIL."""
    return _entry(alist, True, judge_if(predicate, True, *take_keys(options, _KEY)))


@function("(assoc-if-not predicate alist &key key)")
def assoc_if_not(predicate: Value, alist: Value, *options: Value) -> Value:
    """Return the first entry of ALIST whose car fails PREDICATE, or NIL."""
    return _entry(alist, True, judge_if(predicate, False, *take_keys(options, _KEY)))


@function("(rassoc item alist &key test test-not key)")
def rassoc(item: Value, alist: Value, *options: Value) -> Value:
    """Return the first entry of ALIST whose cdr matches ITEM, or NIL."""
    return _entry(alist, False, judge_item(item, *take_keys(options, _TESTS)))


@function("(rassoc-if predicate alist &key key)")
def rassoc_if(predicate: Value, alist: Value, *options: Value) -> Value:
    """Return the first entry of ALIST whose cdr satisfies PREDICATE, or NIL."""
    return _entry(alist, False, judge_if(predicate, True, *take_keys(options, _KEY)))


@function("(rassoc-if-not predicate alist &key key)")
def rassoc_if_not(predicate: Value, alist: Value, *options: Value) -> Value:
    """Return the first entry of ALIST whose cdr fails PREDICATE, or NIL."""
    return _entry(alist, False, judge_if(predicate, False, *take_keys(options, _KEY)))


@function("(acons key datum alist)")
def acons(key: Value, datum: Value, alist: Value) -> Value:
    """Return ALIST with the entry (KEY . DATUM) in front."""
    return Cons(Cons(key, datum), alist)


@function("(pairlis keys data &optional alist)")
def pairlis(keys: Value, values: Value, alist: Value = None) -> Value:
    """Return ALIST with an entry in front for each of KEYS and DATA."""
    left, right = items(keys), items(values)
    if len(left) != len(right):
        raise simple_error("lists of different lengths", keys, values)
    return from_items([Cons(key, value) for key, value in zip(left, right, strict=True)], alist)


@function("(copy-alist alist)")
def copy_alist(alist: Value) -> Value:
    """Return a copy of ALIST with entries of its own."""
    return from_items(
        [Cons(entry.car, entry.cdr) if entry.__class__ is Cons else entry for entry in items(alist)]
    )


def _find_property(plist: Value, indicators: list[Value]) -> Value:
    """The tail of PLIST that begins with one of INDICATORS, or NIL."""
    rest = plist
    while rest is not None:
        if rest.__class__ is not Cons or rest.cdr.__class__ is not Cons:
            raise _malformed(plist)
        key = rest.car
        for indicator in indicators:
            if is_eql(key, indicator):
                return rest
        rest = rest.cdr.cdr
    return None


def _malformed(plist: Value) -> Exception:
    if plist.__class__ is not Cons:
        return type_error(plist, "LIST")
    return simple_error("malformed property list", plist)


@function("(getf plist indicator &optional default)")
def getf(plist: Value, indicator: Value, default: Value = None) -> Value:
    """Return what PLIST holds under INDICATOR, or DEFAULT."""
    tail = _find_property(plist, [indicator])
    return default if tail is None else tail.cdr.car


def get_properties_values(plist: Value, indicators: Value) -> Value:
    """The values of GET-PROPERTIES: indicator, value and tail."""
    tail = _find_property(plist, items(indicators))
    return pack([None, None, None] if tail is None else [tail.car, tail.cdr.car, tail])


@function("(get-properties plist indicators)", many=get_properties_values)
def get_properties(plist: Value, indicators: Value) -> Value:
    """Return the first of INDICATORS in PLIST, its value, and the tail there."""
    return get_properties_values(plist, indicators)[0]
