"""Numbers: what is one, the four operations, comparison (CLHS 12).

Integers of any size, ratios and floats, which are all doubles; there are no
complex numbers. What is no number is a type error here, never Python's idea of
an answer. Division with a remainder is numbers_division.py, bits and the like
numbers_integers.py, powers and angles numbers_reals.py.
"""

from __future__ import annotations

import operator

from eslang.base.failure import Failure, division_by_zero, simple_error, type_error
from eslang.base.hints import Callable
from eslang.base.number_kinds import is_number
from eslang.base.symbols import Value, truth
from eslang.compile.registry import function


def is_integer(value: Value) -> bool:
    """True for an integer."""
    return value.__class__ is int


def check_number(value: Value, name: str) -> Value:
    """VALUE, if it is a number; else a type error of the function NAME."""
    if value.__class__ is int or is_number(value):
        return value
    raise type_error(value, "NUMBER", name)


def check_integer(value: Value, name: str) -> int:
    """VALUE, if it is an integer; else a type error of the function NAME."""
    if value.__class__ is int:
        integer: int = value
        return integer
    raise type_error(value, "INTEGER", name)


def too_large(name: str, *operands: Value) -> Failure:
    """The failure for a result, or an operand, that no double can hold."""
    return simple_error(f"{name.upper()}: too large for a float", *operands)


@function("(+ &rest numbers)")
def add(*numbers: Value) -> Value:
    """Add NUMBERS; no number at all gives 0."""
    total: Value = 0
    try:
        for number in numbers:
            total = total + check_number(number, "+")
    except OverflowError:
        raise too_large("+", *numbers) from None
    return total


@function("(* &rest numbers)")
def multiply(*numbers: Value) -> Value:
    """Multiply NUMBERS; no number at all gives 1."""
    product: Value = 1
    try:
        for number in numbers:
            product = product * check_number(number, "*")
    except OverflowError:
        raise too_large("*", *numbers) from None
    return product


@function("(- number &rest more-numbers)")
def subtract(number: Value, *others: Value) -> Value:
    """Subtract MORE-NUMBERS from NUMBER, or negate NUMBER if it stands alone."""
    result = check_number(number, "-")
    if not others:
        return -result
    try:
        for other in others:
            result = result - check_number(other, "-")
    except OverflowError:
        raise too_large("-", number, *others) from None
    return result


@function("(/ number &rest more-numbers)")
def divide(number: Value, *others: Value) -> Value:
    """Divide NUMBER by MORE-NUMBERS, or 1 by NUMBER if it stands alone.

    Integers divide exactly: the result is an integer or a ratio.
    Fails: :division-by-zero, for floats too.
    """
    if not others:
        return quotient(1, check_number(number, "/"))
    result = check_number(number, "/")
    for other in others:
        result = quotient(result, check_number(other, "/"))
    return result


def quotient(dividend: Value, divisor: Value) -> Value:
    """DIVIDEND / DIVISOR, two numbers: exact where both are rational."""
    if divisor == 0:
        raise division_by_zero("/", dividend, divisor)
    if isinstance(dividend, int) and isinstance(divisor, int):
        if dividend % divisor == 0:
            return dividend // divisor
        from eslang.base.ratios import divide as divide_exactly

        return divide_exactly(dividend, divisor)
    try:
        return dividend / divisor
    except OverflowError:
        raise too_large("/", dividend, divisor) from None


@function("(1+ number)")
def one_more(number: Value) -> Value:
    """Add 1 to NUMBER."""
    return check_number(number, "1+") + 1


@function("(1- number)")
def one_less(number: Value) -> Value:
    """Subtract 1 from NUMBER."""
    return check_number(number, "1-") - 1


def _register_comparison(name: str, holds: Callable[[Value, Value], bool], claim: str) -> None:
    def compare(number: Value, *others: Value) -> Value:
        left = check_number(number, name)
        result = True
        for right in others:
            if result and not holds(left, check_number(right, name)):
                result = False
            left = check_number(right, name)
        return truth(result)

    compare.__doc__ = f"Return T if {claim}."
    compare.__name__ = name
    function(f"({name} number &rest more-numbers)")(compare)


_register_comparison("=", operator.eq, "all the numbers are equal")
_register_comparison("<", operator.lt, "each number is less than the next")
_register_comparison(">", operator.gt, "each number is greater than the next")
_register_comparison("<=", operator.le, "no number is greater than the next")
_register_comparison(">=", operator.ge, "no number is less than the next")


@function("(/= number &rest more-numbers)")
def all_different(number: Value, *others: Value) -> Value:
    """Return T if no two of the numbers are equal."""
    numbers = [check_number(each, "/=") for each in (number, *others)]
    return truth(
        not any(left == right for place, left in enumerate(numbers) for right in numbers[place + 1 :])
    )


@function("(max number &rest more-numbers)")
def greatest(number: Value, *others: Value) -> Value:
    """Return the greatest of the numbers."""
    best = check_number(number, "max")
    for other in others:
        if check_number(other, "max") > best:
            best = other
    return best


@function("(min number &rest more-numbers)")
def least(number: Value, *others: Value) -> Value:
    """Return the least of the numbers."""
    best = check_number(number, "min")
    for other in others:
        if check_number(other, "min") < best:
            best = other
    return best


@function("(abs number)")
def absolute(number: Value) -> Value:
    """Return NUMBER without its sign."""
    return abs(check_number(number, "abs"))


@function("(signum number)")
def signum(number: Value) -> Value:
    """Return -1, 0 or 1, as a number of NUMBER's kind."""
    check_number(number, "signum")
    sign = (number > 0) - (number < 0)
    return float(sign) if isinstance(number, float) else sign


@function("(zerop number)")
def zerop(number: Value) -> Value:
    """Return T if NUMBER is zero."""
    return truth(check_number(number, "zerop") == 0)


@function("(plusp number)")
def plusp(number: Value) -> Value:
    """Return T if NUMBER is greater than zero."""
    return truth(check_number(number, "plusp") > 0)


@function("(minusp number)")
def minusp(number: Value) -> Value:
    """Return T if NUMBER is less than zero."""
    return truth(check_number(number, "minusp") < 0)
