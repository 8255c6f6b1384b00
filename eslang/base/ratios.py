"""Ratios: exact quotients of integers.

Python's Fraction with one difference: a result that is whole is an integer,
as Common Lisp wants it. Imported only when a ratio first appears, since
Python's fractions are slow to load; `is_ratio` in numbers asks without it.
"""

from __future__ import annotations

from fractions import Fraction

from eslang.base.hints import Any, Callable


class Ratio(Fraction):
    """A Fraction whose arithmetic gives integers where it can."""

    __slots__ = ()


def canonical(value: Any) -> Any:
    """VALUE as Lisp holds it: a Fraction becomes an integer or a Ratio."""
    if not isinstance(value, Fraction):
        return value
    if value.denominator == 1:
        return value.numerator
    return value if value.__class__ is Ratio else Ratio(value.numerator, value.denominator)


def divide(dividend: Any, divisor: Any) -> Any:
    """The exact quotient of two rationals."""
    return canonical(Fraction(dividend) / divisor)


def _whole(name: str) -> Callable[[Any, Any], Any]:
    operation: Callable[[Any, Any], Any] = getattr(Fraction, name)

    def operate(self: Any, other: Any) -> Any:
        result = operation(self, other)
        return canonical(result) if isinstance(result, Fraction) else result

    operate.__name__ = name
    return operate


for _name in ("add", "radd", "sub", "rsub", "mul", "rmul", "truediv", "rtruediv", "mod", "rmod", "pow"):
    setattr(Ratio, f"__{_name}__", _whole(f"__{_name}__"))
Ratio.__neg__ = lambda self: Ratio(-self.numerator, self.denominator)  # type: ignore[method-assign]
Ratio.__abs__ = lambda self: Ratio(abs(self.numerator), self.denominator)  # type: ignore[method-assign]
