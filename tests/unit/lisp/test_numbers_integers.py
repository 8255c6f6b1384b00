"""Integers and their bits."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(evenp 0)", "T"),
        ("(evenp -3)", "NIL"),
        ("(oddp -3)", "T"),
        ("(oddp 2)", "NIL"),
        ("(evenp 1.0)", "failure :TYPE-ERROR"),
    ],
)
def test_parity(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(gcd)", "0"),
        ("(gcd 12 -18)", "6"),
        ("(gcd 0 5)", "5"),
        ("(lcm)", "1"),
        ("(lcm 4 6)", "12"),
        ("(lcm 0 5)", "0"),
        ("(gcd 1.0)", "failure :TYPE-ERROR"),
    ],
)
def test_common_divisors_and_multiples(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(isqrt 16)", "4"),
        ("(isqrt 17)", "4"),
        ("(isqrt 0)", "0"),
        ("(isqrt (expt 10 40))", "100000000000000000000"),
        ("(isqrt -1)", "failure :TYPE-ERROR"),
    ],
)
def test_isqrt_is_the_integer_part_of_the_root(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(logand 12 10)", "8"),
        ("(logand)", "-1"),
        ("(logior 12 10)", "14"),
        ("(logior)", "0"),
        ("(logxor 12 10)", "6"),
        ("(logeqv 1 2)", "-4"),
        ("(lognot 5)", "-6"),
        ("(logandc2 7 2)", "5"),
        ("(logtest 1 2)", "NIL"),
        ("(logtest 3 2)", "T"),
        ("(logbitp 3 8)", "T"),
        ("(logbitp 100 -1)", "T"),
        ("(logcount 255)", "8"),
        ("(logcount -256)", "8"),
        ("(integer-length 255)", "8"),
        ("(integer-length -256)", "8"),
        ("(logand 1.0)", "failure :TYPE-ERROR"),
    ],
)
def test_bits_are_those_of_twos_complement(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(ash 1 10)", "1024"),
        ("(ash 1024 -3)", "128"),
        ("(ash -5 -1)", "-3"),
        ("(ash 1 100)", "1267650600228229401496703205376"),
        ("(ash 1 -100)", "0"),
    ],
)
def test_ash_shifts_either_way(form: str, value: str) -> None:
    assert value_of(form) == value
