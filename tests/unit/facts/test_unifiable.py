"""Whether two terms can be made the same, each with variables of its own."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from asking import read
from eslang.base.lists import Cons
from eslang.base.symbols import Symbol
from eslang.facts.unify import match, unifiable

CASES = {
    "on on": True,
    "on off": False,
    "?x off": True,
    "?x ?x": True,
    "?_ (room 3)": True,
    "(a ?x) (?y b)": True,
    "(?x ?x) (a b)": False,
    "(?x ?x) (a ?x)": True,
    "(?x b) (a ?x)": True,
    "(?_ ?_) (a b)": True,
    "(?x ?x) (?y (f ?y))": False,
    "(?x (f ?x)) ((f ?y) ?y)": False,
    "(?x ?y ?x) (?a (f ?a) ?a)": True,
    "1 1.0": False,
    '"a" "a"': True,
    '"a" "b"': False,
    "(a . ?rest) (a b c)": True,
    "(a b) (a)": False,
    "nil ()": True,
    "((?y ?_ . a) . ?y) (((a . ?y) ?y . a) . ?y)": False,
}


@pytest.mark.parametrize("text", CASES)
def test_two_terms_unify_or_not(text: str) -> None:
    both = read(f"({text})")
    assert unifiable(both.car, both.cdr.car) is CASES[text]
    assert unifiable(both.cdr.car, both.car) is CASES[text]


atoms = st.sampled_from([Symbol.intern(name, "ESL") for name in ("A", "B", "?X", "?Y", "?_")])
terms = st.recursive(atoms, lambda inner: st.builds(Cons, inner, inner), max_leaves=8)
ground = st.recursive(
    st.sampled_from([Symbol.intern(name, "ESL") for name in "AB"]),
    lambda inner: st.builds(Cons, inner, inner),
    max_leaves=8,
)


@given(terms, terms)
def test_the_order_of_the_two_is_no_matter(left: object, right: object) -> None:
    assert unifiable(left, right) is unifiable(right, left)


@given(terms, ground)
def test_with_a_term_without_variables_it_is_a_match(pattern: object, term: object) -> None:
    assert unifiable(pattern, term) is (match(pattern, term) is not None)
