"""Division with a remainder: floor, ceiling, truncate, round, mod, rem (CLHS 12).

Each of the four gives the quotient as an integer and, as second value, what
remains; the F-variants give the quotient as a float. ROUND rounds halves to
the even neighbour.
"""

from __future__ import annotations

from eslang.base.failure import division_by_zero
from eslang.base.hints import Callable
from eslang.base.many import Values
from eslang.base.symbols import Value
from eslang.compile.registry import function
from eslang.lisp.numbers import check_number, too_large

Pair = tuple[Value, Value]
Divide = Callable[[Value, Value, str], Pair]


def truncate_pair(number: Value, divisor: Value, name: str) -> Pair:
    """Quotient, rounded towards zero, and remainder; NAME is the function that fails."""
    check_number(number, name)
    if check_number(divisor, name) == 0:
        raise division_by_zero(name, number, divisor)
    if isinstance(number, float) or isinstance(divisor, float):
        try:
            number, divisor = float(number), float(divisor)
            whole = int(number / divisor)
            return whole, number - whole * divisor
        except (OverflowError, ValueError):
            raise too_large(name, number, divisor) from None
    above = number.numerator * divisor.denominator
    below = number.denominator * divisor.numerator
    whole = above // below if (above < 0) == (below < 0) else -(-above // below)
    return whole, number - whole * divisor


def floor_pair(number: Value, divisor: Value, name: str) -> Pair:
    """Quotient, rounded down, and remainder."""
    if number.__class__ is int and divisor.__class__ is int and divisor:
        return divmod(number, divisor)
    whole, rest = truncate_pair(number, divisor, name)
    if rest != 0 and (number > 0 if divisor < 0 else number < 0):
        return whole - 1, rest + divisor
    return whole, rest


def ceiling_pair(number: Value, divisor: Value, name: str) -> Pair:
    """Quotient, rounded up, and remainder."""
    whole, rest = truncate_pair(number, divisor, name)
    if rest != 0 and (number < 0 if divisor < 0 else number > 0):
        return whole + 1, rest - divisor
    return whole, rest


def round_pair(number: Value, divisor: Value, name: str) -> Pair:
    """Quotient, rounded to the nearest integer, halves to the even one, and remainder."""
    whole, rest = truncate_pair(number, divisor, name)
    twice, size = 2 * abs(rest), abs(divisor)
    if twice < size or (twice == size and whole % 2 == 0):
        return whole, rest
    if (rest < 0) == (divisor < 0):
        return whole + 1, rest - divisor
    return whole - 1, rest + divisor


def _register(name: str, divide: Divide, how: str) -> None:
    def many(number: Value, divisor: Value = 1) -> Value:
        return Values(divide(number, divisor, name))

    def one(number: Value, divisor: Value = 1) -> Value:
        return divide(number, divisor, name)[0]

    def many_float(number: Value, divisor: Value = 1) -> Value:
        whole, rest = divide(number, divisor, "f" + name)
        return Values((_as_float(whole, "f" + name), rest))

    def one_float(number: Value, divisor: Value = 1) -> Value:
        return _as_float(divide(number, divisor, "f" + name)[0], "f" + name)

    one.__name__, one_float.__name__ = name, "f" + name
    one.__doc__ = f"Divide NUMBER by DIVISOR and round {how} to an integer.\n\n{_VALUES}"
    one_float.__doc__ = f"Divide NUMBER by DIVISOR and round {how} to a whole float.\n\n{_VALUES}"
    function(f"({name} number &optional (divisor 1))", many=many)(one)
    function(f"(f{name} number &optional (divisor 1))", many=many_float)(one_float)


def _as_float(whole: int, name: str) -> float:
    try:
        return float(whole)
    except OverflowError:
        raise too_large(name, whole) from None


_VALUES = """Returns: the quotient and, as second value, the remainder.
    Fails:   :division-by-zero."""

_register("floor", floor_pair, "down")
_register("ceiling", ceiling_pair, "up")
_register("truncate", truncate_pair, "towards zero")
_register("round", round_pair, "to the nearest")


@function("(mod number divisor)")
def mod(number: Value, divisor: Value) -> Value:
    """Return what remains of NUMBER after FLOOR by DIVISOR.

    Fails: :division-by-zero.
    """
    return floor_pair(number, divisor, "mod")[1]


@function("(rem number divisor)")
def rem(number: Value, divisor: Value) -> Value:
    """Return what remains of NUMBER after TRUNCATE by DIVISOR.

    Fails: :division-by-zero.
    """
    return truncate_pair(number, divisor, "rem")[1]
