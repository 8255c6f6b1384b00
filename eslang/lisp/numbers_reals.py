"""Powers, roots, logarithms, angles; floats and rationals; chance (CLHS 12).

All results that are not exact are doubles. Where Common Lisp would answer with
a complex number, there is a failure that says so.
"""

from __future__ import annotations

import math
import sys

from eslang.base.failure import Failure, division_by_zero, simple_error, type_error
from eslang.base.hints import Callable
from eslang.base.number_kinds import is_number, is_rational
from eslang.base.running import running
from eslang.base.symbols import Value
from eslang.compile.registry import function, variable
from eslang.lisp.numbers import check_number, is_integer, too_large

variable("pi", math.pi, "The ratio of a circle's circumference to its diameter.", constant=True)
for _kind in ("short", "single", "double", "long"):
    variable(f"most-positive-{_kind}-float", sys.float_info.max, "The greatest float.", constant=True)
    variable(f"most-negative-{_kind}-float", -sys.float_info.max, "The least float.", constant=True)
    variable(f"least-positive-{_kind}-float", 5e-324, "The smallest float above zero.", constant=True)
    variable(f"least-negative-{_kind}-float", -5e-324, "The greatest float below zero.", constant=True)
    variable(
        f"{_kind}-float-epsilon",
        1.1102230246251568e-16,
        "The smallest float that added to 1.0 makes a difference.",
        constant=True,
    )


def no_real(name: str, *operands: Value) -> Failure:
    """The failure for a result that is no real number."""
    return simple_error(f"{name.upper()}: the result is no real number", *operands)


def as_float(number: Value, name: str) -> float:
    """NUMBER as a float; a failure if it is no number or too large."""
    try:
        return float(check_number(number, name))
    except OverflowError:
        raise too_large(name, number) from None


@function("(float number &optional prototype)")
def to_float(number: Value, prototype: Value = 1.0) -> Value:
    """Return NUMBER as a float."""
    return as_float(number, "float")


@function("(numerator rational)")
def numerator(rational: Value) -> Value:
    """Return what stands above the line of RATIONAL in lowest terms."""
    return _check_rational(rational, "numerator").numerator


@function("(denominator rational)")
def denominator(rational: Value) -> Value:
    """Return what stands below the line of RATIONAL in lowest terms."""
    return _check_rational(rational, "denominator").denominator


def _check_rational(value: Value, name: str) -> Value:
    if is_rational(value):
        return value
    raise type_error(value, "RATIONAL", name)


@function("(rational number)")
def rational(number: Value) -> Value:
    """Return the rational that is exactly NUMBER."""
    return _exactly(check_number(number, "rational"), "rational")


def _exactly(number: Value, name: str) -> Value:
    if not isinstance(number, float):
        return number
    try:
        above, below = number.as_integer_ratio()
    except (OverflowError, ValueError):
        raise no_real(name, number) from None
    if below == 1:
        return above
    from eslang.base.ratios import Ratio

    return Ratio(above, below)


@function("(rationalize number)")
def rationalize(number: Value) -> Value:
    """Return the simplest rational that is NUMBER, as far as floats can tell."""
    check_number(number, "rationalize")
    if not isinstance(number, float) or number == int(_exactly(number, "rationalize")):
        return _exactly(number, "rationalize")
    from eslang.base.ratios import divide

    size = abs(number)
    # Continue the fraction until its value is the float again.
    rest_above, rest_below = size.as_integer_ratio()
    above, below, last_above, last_below = 1, 0, 0, 1
    while rest_below:
        whole, rest = divmod(rest_above, rest_below)
        above, last_above = whole * above + last_above, above
        below, last_below = whole * below + last_below, below
        if above / below == size:
            break
        rest_above, rest_below = rest_below, rest
    return divide(above if number > 0 else -above, below)


@function("(expt base power)")
def expt(base: Value, power: Value) -> Value:
    """Raise BASE to POWER; exact if BASE is rational and POWER an integer.

    Fails: :division-by-zero for zero to a negative power; :error if the
    result is no real number or too large.
    """
    check_number(base, "expt")
    if base == 0 and check_number(power, "expt") < 0:
        raise division_by_zero("expt", base, power)
    try:
        if is_integer(power):
            if is_integer(base) and power < 0:
                from eslang.base.ratios import divide

                return divide(1, base**-power)
            return base**power
        result = as_float(base, "expt") ** as_float(power, "expt")
    except OverflowError:
        raise too_large("expt", base, power) from None
    if isinstance(result, complex):
        raise no_real("expt", base, power)
    return result


@function("(log number &optional base)")
def log(number: Value, base: Value = None) -> Value:
    """Return the logarithm of NUMBER to BASE, or its natural logarithm.

    Fails: :division-by-zero for 0; :error for a negative NUMBER or BASE.
    """
    if base is None:
        return _natural_log(number)
    if base == 2 and is_integer(base) and check_number(number, "log") > 0:
        return math.log2(number)
    divisor = _natural_log(base)
    if divisor == 0:
        raise division_by_zero("log", number, base)
    return _natural_log(number) / divisor


def _natural_log(number: Value) -> float:
    if check_number(number, "log") == 0:
        raise division_by_zero("log", number)
    if number < 0:
        raise no_real("log", number)
    try:
        return math.log(number)
    except OverflowError:  # a ratio of huge numbers
        return math.log(number.numerator) - math.log(number.denominator)


def _register(name: str, compute: Callable[[float], float], what: str) -> None:
    def apply(number: Value) -> Value:
        try:
            return compute(as_float(number, name))
        except ValueError:
            raise no_real(name, number) from None
        except OverflowError:
            raise too_large(name, number) from None

    apply.__name__ = name
    apply.__doc__ = f"Return {what} of NUMBER.\n\n    Fails: :error if that is no real number.\n    "
    function(f"({name} number)")(apply)


_register("sqrt", math.sqrt, "the square root")
_register("exp", math.exp, "e to the power")
_register("sin", math.sin, "the sine")
_register("cos", math.cos, "the cosine")
_register("tan", math.tan, "the tangent")
_register("asin", math.asin, "the arc sine")
_register("acos", math.acos, "the arc cosine")
_register("sinh", math.sinh, "the hyperbolic sine")
_register("cosh", math.cosh, "the hyperbolic cosine")
_register("tanh", math.tanh, "the hyperbolic tangent")
_register("asinh", math.asinh, "the inverse hyperbolic sine")
_register("acosh", math.acosh, "the inverse hyperbolic cosine")
_register("atanh", math.atanh, "the inverse hyperbolic tangent")


@function("(atan number &optional divisor)")
def atan(number: Value, divisor: Value = None) -> Value:
    """Return the arc tangent of NUMBER, or of NUMBER / DIVISOR."""
    if divisor is None:
        return math.atan(as_float(number, "atan"))
    return math.atan2(as_float(number, "atan"), as_float(divisor, "atan"))


@function("(random limit &optional state)")
def random(limit: Value, state: Value = None) -> Value:
    """Return a number from 0 up to, not including, LIMIT, of LIMIT's kind.

    The choice comes from the run's one source, so the same seed gives the same numbers.
    """
    if is_integer(limit) and limit > 0:
        return running.session.chance.randrange(limit)
    if isinstance(limit, float) and limit > 0:
        return running.session.chance.random() * limit
    if is_number(limit):
        raise simple_error("RANDOM: the limit is not above zero", limit)
    raise type_error(limit, "REAL", "random")
