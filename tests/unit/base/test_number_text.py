"""Numbers as Lisp writes them."""

from __future__ import annotations

import pytest

from eslang.base.number_text import (
    decimal_digits,
    digits_value,
    float_text,
    integer_text,
    is_number_token,
    rational_text,
)
from eslang.base.ratios import Ratio


@pytest.mark.parametrize(
    ("number", "base", "text"),
    [
        (0, 10, "0"),
        (-42, 10, "-42"),
        (255, 16, "FF"),
        (-5, 2, "-101"),
        (35, 36, "Z"),
        (0, 3, "0"),
        (9, 3, "100"),
    ],
)
def test_integers_in_any_base(number: int, base: int, text: str) -> None:
    assert integer_text(number, base) == text


@pytest.mark.parametrize("base", [3, 10, 36])
def test_integers_of_any_size_are_written_and_read(base: int) -> None:
    number = base**7000 + base**3500 - 1
    text = integer_text(number, base)
    assert len(text) == 7001
    assert digits_value(text, base) == number


def test_a_radix_is_marked_as_the_reader_wants_it() -> None:
    assert rational_text(31, 16, radix=True) == "#x1F"
    assert rational_text(31, 10, radix=True) == "31."
    assert rational_text(5, 3, radix=True) == "#3r12"
    assert rational_text(Ratio(1, 2), 10, radix=True) == "#10r1/2"


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (1.0, "1.0"),
        (-0.0, "-0.0"),
        (0.001, "0.001"),
        (0.00099, "9.9e-4"),
        (9999999.0, "9999999.0"),
        (1e7, "1.0e7"),
        (1e100, "1.0e100"),
        (5e-324, "5.0e-324"),
    ],
)
def test_floats_print_plain_between_a_thousandth_and_ten_million(number: float, text: str) -> None:
    assert float_text(number) == text


def test_decimal_digits_tell_where_the_point_stands() -> None:
    assert decimal_digits(123.456) == ("123456", 3)
    assert decimal_digits(0.00012) == ("12", -3)
    assert decimal_digits(1e21) == ("1", 22)
    assert decimal_digits(0.0) == ("0", 1)


@pytest.mark.parametrize("name", ["1", "-1", "+1", "1.", "1/2", ".5", "-1.5", "1E5", "1.5E-3", "1D0", "1.E5"])
def test_what_the_reader_takes_for_a_number(name: str) -> None:
    assert is_number_token(name)


@pytest.mark.parametrize(
    "name", ["", "+", "-", ".", "1+", "1-", "1A", "E5", "1/", "/2", "1/2/3", "1E", "²", "..", "1_0"]
)
def test_what_the_reader_takes_for_a_symbol(name: str) -> None:
    assert not is_number_token(name)
