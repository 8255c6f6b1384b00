"""Laws of the printer: what it writes reads back."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from eslang.base.image import PACKAGE, Image
from eslang.base.lists import Cons, from_items
from eslang.base.number_text import digits_value, integer_text
from eslang.base.printer import READABLE, WriteSettings, prin1
from eslang.base.ratios import canonical
from eslang.base.resolve import resolve_in
from eslang.base.spans import Source
from eslang.base.symbols import Symbol, T, Value
from eslang.base.text import Array, Character, String, Vector, character
from eslang.reader.reader import read_forms

IMAGE = Image()
IMAGE.cell(PACKAGE).value = IMAGE.packages["ESL-USER"]
SETTINGS = READABLE._replace(package=IMAGE.packages["ESL-USER"], packages=IMAGE.packages)
MARKS = ("QUOTE", "FUNCTION", "QUASIQUOTE", "UNQUOTE", "UNQUOTE-SPLICING")

texts = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"))  # no text may hold a NUL
pieces = st.sampled_from([*"ABZ019+-*/.:#|\\;'`,@()\" \n?eéß", "E5", "1.5", "NIL", "..", "1/2"])
names = st.one_of(texts, st.lists(pieces, max_size=6).map("".join))
homes = st.sampled_from(["ESL-USER", "KEYWORD", "ESL", "SCS", "CL-USER"])
symbols = st.builds(lambda home, name: IMAGE.packages[home].intern(name), homes, names)
atoms = st.one_of(
    st.none(),
    st.just(T),
    st.integers(),
    st.fractions().map(canonical),
    st.floats(allow_nan=False, allow_infinity=False),
    texts.map(String),
    st.characters(exclude_categories=["Cs"]).map(character),
    symbols,
    st.sampled_from(MARKS).map(lambda name: Symbol.intern(name, "COMMON-LISP")),
)


def compound(children: st.SearchStrategy[Value]) -> st.SearchStrategy[Value]:
    """Lists, proper and dotted, and vectors of CHILDREN."""
    marked = st.tuples(st.sampled_from(MARKS), children).map(
        lambda pair: from_items([Symbol.intern(pair[0], "COMMON-LISP"), pair[1]])
    )
    return st.one_of(
        st.lists(children, max_size=4).map(from_items),
        st.tuples(st.lists(children, min_size=1, max_size=3), atoms).map(lambda both: from_items(*both)),
        st.lists(children, max_size=4).map(Vector),
        marked,
    )


values = st.recursive(atoms, compound, max_leaves=15)


def same(one: Value, other: Value) -> bool:
    """Whether two values are alike in kind and content, all the way down."""
    kind = one.__class__
    if kind is not other.__class__:
        return False
    if kind is Cons:
        return same(one.car, other.car) and same(one.cdr, other.cdr)
    if kind is Vector:
        return len(one.items) == len(other.items) and all(map(same, one.items, other.items))
    if kind is String:
        return bool(one.text == other.text)
    if kind is float:
        return bool(one.hex() == other.hex())
    if isinstance(one, (Symbol, Character)):
        return one is other
    return bool(one == other)


def read_back(text: str) -> Any:
    """The one form of TEXT."""
    (reading,) = read_forms(Source("<law>", text), resolve_in(IMAGE))
    return reading.form


@given(values)
def test_what_is_printed_reads_back_to_the_same(value: Value) -> None:
    assert same(read_back(prin1(value, SETTINGS)), value)


@given(values, st.sampled_from([2, 3, 8, 16, 36]), st.sampled_from(["DOWNCASE", "CAPITALIZE"]))
def test_a_marked_base_and_another_case_change_nothing(value: Value, base: int, case: str) -> None:
    settings: WriteSettings = SETTINGS._replace(base=base, radix=True, case=case)
    assert same(read_back(prin1(value, settings)), value)


@given(st.integers(), st.integers(2, 36))
def test_digits_mean_what_they_were_made_of(number: int, base: int) -> None:
    text = integer_text(number, base)
    assert digits_value(text.lstrip("-"), base) == abs(number)
    assert text.startswith("-") == (number < 0)


@pytest.mark.slow
@given(st.lists(st.sampled_from("abcd"), min_size=1, max_size=6), st.data())
def test_printing_ends_whatever_contains_whatever(shape: list[str], draw: st.DataObject) -> None:
    makers: dict[str, Callable[[], Value]] = {
        "a": lambda: Cons(1, 2),
        "b": lambda: Vector([1, 2]),
        "c": lambda: Array((2, 1), [1, 2]),
        "d": lambda: Cons(None, None),
    }
    parts = [makers[letter]() for letter in shape]
    chosen = st.sampled_from([*parts, None, 5])
    for part in parts:
        first, second = draw.draw(chosen), draw.draw(chosen)
        if part.__class__ is Cons:
            part.car, part.cdr = first, second
        else:
            part.items[:] = [first, second]
    for circle in (False, True):
        text = prin1(parts[0], READABLE._replace(circle=circle))
        assert text.count("(") == text.count(")")
