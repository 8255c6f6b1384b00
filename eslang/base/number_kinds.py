"""Which kind of number a value is; asks without importing Python's fractions."""

from __future__ import annotations

from eslang.base.symbols import Value


def is_ratio(value: Value) -> bool:
    """A ratio."""
    return bool(value.__class__.__name__ == "Ratio")


def is_rational(value: Value) -> bool:
    """An integer or a ratio."""
    return value.__class__ is int or is_ratio(value)


def is_number(value: Value) -> bool:
    """An integer, ratio or float."""
    return value.__class__ is int or value.__class__ is float or is_ratio(value)
