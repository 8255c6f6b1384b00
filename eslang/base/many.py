"""Multiple values, where somebody asked for them.

A function returns its primary value. Who wants them all calls `many(f)`: a
variant of f that returns a Values where the body gives other than exactly one
value, and the plain value where it gives one. For compiled functions the
variant is compiled when first wanted (compile/variants.py).
"""

from __future__ import annotations

from eslang.base.hints import Any, Sequence
from eslang.base.symbols import Value


class Values(tuple[Value, ...]):
    """None, two or more values. One value is never wrapped."""

    __slots__ = ()


def values_list(result: Value) -> list[Value]:
    """All the values of a result that came from a many-variant."""
    return list(result) if result.__class__ is Values else [result]


def primary(result: Value) -> Value:
    """The first value of a result that came from a many-variant; NIL if there is none."""
    if result.__class__ is Values:
        return result[0] if result else None
    return result


def pack(values: Sequence[Any]) -> Value:
    """A result for a many-variant to return."""
    return values[0] if len(values) == 1 else Values(values)


def many_of(function: Any) -> Any:
    """The variant of FUNCTION that gives all its values.

    Code compiled from Lisp makes it when first wanted, through the maker that
    its unit keeps under `%many`; anything else without one has a single value.
    """
    variant = getattr(function, "many", None)
    if variant is None:
        make = getattr(function, "__globals__", {}).get("%many")
        if make is None:
            return function
        variant = function.many = make(function)
    return variant
