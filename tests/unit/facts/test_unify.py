"""Matching patterns against terms."""

from __future__ import annotations

import pytest

from asking import read
from eslang.base.printer import prin1
from eslang.facts.unify import Patterns, is_same_pattern, match


@pytest.mark.parametrize(
    ("pattern", "term", "expected"),
    [
        ("(at ?x 1)", "(at a 1)", "?X A"),
        ("(at ?x 1)", "(at a 1.0)", None),
        ("(at ?x ?x)", "(at (1) (1))", "?X (1)"),
        ("(at ?x ?x)", "(at 1 2)", None),
        ("(at ?_ ?_)", "(at 1 2)", ""),
        ("(at . ?rest)", "(at 1 2)", "?REST (1 2)"),
        ('"a"', '"a"', ""),
        ("0.0", "-0.0", None),
        ("1/2", "1/2", ""),
        ("?", "a", None),
        (":?x", "a", None),
    ],
)
def test_what_a_pattern_matches(pattern: str, term: str, expected: str | None) -> None:
    found = match(read(pattern), read(term))
    shown = None if found is None else " ".join(prin1(part) for pair in found.items() for part in pair)
    assert shown == expected


def test_patterns_are_the_same_whatever_their_variables_are_called() -> None:
    assert is_same_pattern(read("(p ?x ?y)"), read("(p ?a ?b)"))
    assert not is_same_pattern(read("(p ?x ?y)"), read("(p ?a ?a)"))
    assert not is_same_pattern(read("(p ?x ?x)"), read("(p ?a ?b)"))


def test_a_variable_that_is_bound_to_nothing_is_the_same_as_itself_only() -> None:
    assert is_same_pattern(read("(p ?_ ?x ?_)"), read("(p ?_ ?y ?_)"))
    assert not is_same_pattern(read("(p ?_ ?_)"), read("(p ?x ?x)"))
    assert not is_same_pattern(read("(p ?x ?x)"), read("(p ?_ ?_)"))


def test_what_has_no_variables_is_found_before_what_has() -> None:
    patterns = Patterns()
    patterns.define(read("(on ?x)"), 1)
    patterns.define(read("(on lamp)"), 2)
    patterns.define(read("(on ?y)"), 3)
    assert [patterns.find(read(text))[1] for text in ("(on lamp)", "(on fan)", "(off fan)")] == [2, 3, None]
    assert patterns.exact(read("(on lamp)")) == 2 and patterns.exact(read("(on fan)")) is None
