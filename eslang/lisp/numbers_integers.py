"""Integers: parity, common divisors, roots, and their bits (CLHS 12.8-12.10).

Negative integers are seen as two's complement of endless length.
"""

from __future__ import annotations

import math

from eslang.base.failure import type_error
from eslang.base.symbols import T, Value, truth
from eslang.compile.registry import function, variable
from eslang.lisp.numbers import check_integer

variable("most-positive-fixnum", 2**62 - 1, "The greatest integer of type FIXNUM.", constant=True)
variable("most-negative-fixnum", -(2**62), "The least integer of type FIXNUM.", constant=True)
_MOST_BITS = 1 << 33  # a shift beyond this asks for more memory than there is


@function("(evenp integer)")
def evenp(integer: Value) -> Value:
    """Return T if INTEGER is even."""
    return None if check_integer(integer, "evenp") % 2 else T


@function("(oddp integer)")
def oddp(integer: Value) -> Value:
    """Return T if INTEGER is odd."""
    return T if check_integer(integer, "oddp") % 2 else None


@function("(gcd &rest integers)")
def gcd(*integers: Value) -> Value:
    """Return the greatest common divisor of INTEGERS; 0 for none."""
    return math.gcd(*[check_integer(integer, "gcd") for integer in integers])


@function("(lcm &rest integers)")
def lcm(*integers: Value) -> Value:
    """Return the least common multiple of INTEGERS; 1 for none."""
    return math.lcm(*[check_integer(integer, "lcm") for integer in integers])


@function("(isqrt natural)")
def isqrt(natural: Value) -> Value:
    """Return the greatest integer whose square is not above NATURAL."""
    if check_integer(natural, "isqrt") < 0:
        raise type_error(natural, "UNSIGNED-BYTE", "isqrt")
    return math.isqrt(natural)


@function("(logand &rest integers)")
def logand(*integers: Value) -> Value:
    """Return the bits that are in each of INTEGERS; -1 for none."""
    bits = -1
    for integer in integers:
        bits &= check_integer(integer, "logand")
    return bits


@function("(logior &rest integers)")
def logior(*integers: Value) -> Value:
    """Return the bits that are in any of INTEGERS."""
    bits = 0
    for integer in integers:
        bits |= check_integer(integer, "logior")
    return bits


@function("(logxor &rest integers)")
def logxor(*integers: Value) -> Value:
    """Return the bits that are in an odd number of INTEGERS."""
    bits = 0
    for integer in integers:
        bits ^= check_integer(integer, "logxor")
    return bits


@function("(logeqv &rest integers)")
def logeqv(*integers: Value) -> Value:
    """Return the bits in which INTEGERS agree, taken two by two; -1 for none."""
    bits = -1
    for integer in integers:
        bits = ~(bits ^ check_integer(integer, "logeqv"))
    return bits


@function("(logandc2 integer other)")
def logandc2(integer: Value, other: Value) -> Value:
    """Return the bits of INTEGER that are not in OTHER."""
    return check_integer(integer, "logandc2") & ~check_integer(other, "logandc2")


@function("(lognot integer)")
def lognot(integer: Value) -> Value:
    """Return INTEGER with every bit turned over."""
    return ~check_integer(integer, "lognot")


@function("(logtest integer other)")
def logtest(integer: Value, other: Value) -> Value:
    """Return T if INTEGER and OTHER have a bit in common."""
    return truth(check_integer(integer, "logtest") & check_integer(other, "logtest") != 0)


@function("(logbitp index integer)")
def logbitp(index: Value, integer: Value) -> Value:
    """Return T if bit INDEX of INTEGER, counted from 0, is 1."""
    if check_integer(index, "logbitp") < 0:
        raise type_error(index, "UNSIGNED-BYTE", "logbitp")
    return truth(check_integer(integer, "logbitp") >> index & 1 == 1)


@function("(logcount integer)")
def logcount(integer: Value) -> Value:
    """Count the 1 bits of INTEGER, or its 0 bits if it is negative."""
    check_integer(integer, "logcount")
    return (integer if integer >= 0 else ~integer).bit_count()


@function("(integer-length integer)")
def integer_length(integer: Value) -> Value:
    """Return how many bits INTEGER needs, its sign not counted."""
    check_integer(integer, "integer-length")
    return (integer if integer >= 0 else ~integer).bit_length()


@function("(ash integer count)")
def ash(integer: Value, count: Value) -> Value:
    """Shift INTEGER left by COUNT bits, or right if COUNT is negative."""
    check_integer(integer, "ash")
    if check_integer(count, "ash") > _MOST_BITS and integer:
        raise type_error(count, "FIXNUM", "ash")
    return integer << count if count >= 0 else integer >> -count
