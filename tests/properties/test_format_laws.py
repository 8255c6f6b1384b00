"""Laws of FORMAT: what it writes means what it was given."""

from __future__ import annotations

from decimal import ROUND_HALF_UP, Decimal, localcontext

from hypothesis import given
from hypothesis import strategies as st

import eslang.lisp.format_machine  # noqa: F401 -- the directives register themselves
from eslang.base.failure import Failure
from eslang.base.text import String
from eslang.lisp.format_control import Directive, parse_control
from eslang.lisp.format_floats import exponential_text, fixed_text
from eslang.lisp.format_words import LARGEST_IN_WORDS, cardinal, ordinal, roman

floats = st.floats(allow_nan=False, allow_infinity=False)
pieces = st.sampled_from([*"~~~~~~aAsdf{}[]()<>;^:@,'#v5-0*?/%&$tTp\n ", "~a", "~{", "~}", "~;", "~:}"])
VALUES = {"M": 1000, "D": 500, "C": 100, "L": 50, "X": 10, "V": 5, "I": 1}


@given(floats)
def test_all_the_digits_of_a_float_give_it_back(number: float) -> None:
    assert float(fixed_text(number, None, None, 0, False)) == number
    text, _ = exponential_text(number, None, None, None, 1, "e", False)
    assert float(text) == number


@given(floats, st.integers(0, 12))
def test_a_fixed_point_rounds_the_exact_value(number: float, places: int) -> None:
    found = Decimal(fixed_text(number, None, places, 0, False))
    with localcontext() as exact:
        exact.prec = 800
        rounded = Decimal(number).quantize(Decimal(1).scaleb(-places), ROUND_HALF_UP)
        shortest = Decimal(repr(number)).quantize(Decimal(1).scaleb(-places), ROUND_HALF_UP)
    assert found in (rounded, shortest)  # the shortest digits, where there are no more than PLACES


@given(floats, st.integers(1, 12), st.integers(1, 30))
def test_a_width_is_filled(number: float, places: int, width: int) -> None:
    text = fixed_text(number, width, places, 0, False)
    assert len(text.partition(".")[2]) == places


@given(st.integers(1, 4999))
def test_roman_figures_add_up(number: int) -> None:
    old = roman(number, old=True)
    assert sum(VALUES[figure] for figure in old) == number
    if number < 4000:
        figures = [VALUES[figure] for figure in roman(number, old=False)]
        signed = [-one if one < after else one for one, after in zip(figures, [*figures[1:], 0], strict=True)]
        assert sum(signed) == number


@given(st.integers(-LARGEST_IN_WORDS, LARGEST_IN_WORDS), st.integers(-LARGEST_IN_WORDS, LARGEST_IN_WORDS))
def test_different_numbers_have_different_words(one: int, other: int) -> None:
    assert (cardinal(one) == cardinal(other)) == (one == other)
    assert (ordinal(one) == ordinal(other)) == (one == other)


@given(st.one_of(st.text(), st.lists(pieces).map("".join)))
def test_a_control_string_is_parsed_or_refused_at_a_directive(text: str) -> None:
    try:
        items = parse_control(text)
    except Failure as failure:
        assert "directive ~" in failure.arguments[0]
        assert failure.arguments[1].__class__ is String
    else:
        assert all(isinstance(item, str | Directive) for item in items)
