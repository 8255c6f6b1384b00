"""A rule that needs itself twice to go on from step to step is walked, and answers the same."""

from __future__ import annotations

from itertools import product
from random import Random

import pytest

from asking import Asking, read

TWICE = "((path ?x ?y) (path ?x ?z) (path ?z ?y))"
BACKWARD = "((path ?x ?y) (path ?z ?y) (path ?x ?z))"
EDGES = "((path ?x ?y) (edge ?x ?y))"
BOTH_WAYS = "((path ?x ?y) (path ?y ?x))"
NODES = range(7)


def drawn(seed: int, name: str) -> set[tuple[int, int]]:
    """Some pairs of nodes."""
    chance = Random(f"{seed}{name}")
    return {(chance.choice(NODES), chance.choice(NODES)) for _ in range(6)}


def closure(pairs: set[tuple[int, int]], both_ways: bool = False) -> set[tuple[int, int]]:
    """What follows by going on, and by going back if that is said."""
    found = set(pairs)
    while True:
        more = {(one, other) for (one, via), (again, other) in product(found, found) if via == again}
        if both_ways:
            more |= {(other, one) for one, other in found}
        if more <= found:
            return found
        found |= more


def asked(facts: Asking) -> set[tuple[int, int]]:
    """The paths, found in all four ways to ask, which agree."""
    every = {tuple(map(int, answer.split())) for answer in facts.answers("(path ?x ?y)")}
    onward = {(one, int(end)) for one in NODES for end in facts.answers(f"(path {one} ?y)")}
    back = {(int(end), other) for other in NODES for end in facts.answers(f"(path ?x {other})")}
    single = {pair for pair in product(NODES, NODES) if facts.answers("(path {} {})".format(*pair))}
    assert every == onward == back == single
    return every  # type: ignore[return-value]


@pytest.mark.parametrize("rule", [TWICE, BACKWARD], ids=["in order", "the other way around"])
@pytest.mark.parametrize("seed", range(5))
def test_paths_are_those_that_follow_from_edges_and_asserted_paths(rule: str, seed: int) -> None:
    edges, paths = drawn(seed, "edge"), drawn(seed, "path")
    facts = Asking(*(f"(edge {one} {other})" for one, other in edges))
    for one, other in paths:
        facts.add(read(f"(path {one} {other})"))
    facts.rule(EDGES)
    facts.rule(rule)
    assert asked(facts) == closure(edges | paths)


@pytest.mark.parametrize("seed", range(5))
def test_another_rule_may_need_the_paths_too(seed: int) -> None:
    edges = drawn(seed, "edge")
    facts = Asking(*(f"(edge {one} {other})" for one, other in edges))
    for rule in (EDGES, TWICE, BOTH_WAYS):
        facts.rule(rule)
    assert asked(facts) == closure(edges, both_ways=True)


def test_two_transitive_rules_of_one_relation_hold_both() -> None:
    facts = Asking("(path 1 2)", "(path 2 3)", "(path 3 4)")
    facts.rule(TWICE)
    facts.rule(BACKWARD)
    assert asked(facts) == closure({(1, 2), (2, 3), (3, 4)})


def test_what_stands_in_all_three_goals_is_carried_along() -> None:
    facts = Asking("(line red 1 2)", "(line red 2 3)", "(line blue 3 4)", "(line blue 4 1)")
    facts.rule("((line ?c ?x ?y) (line ?c ?x ?z) (line ?c ?z ?y))")
    assert facts.answers("(line red 1 ?y)") == ["2", "3"]
    assert facts.answers("(line ?c 3 1)") == ["BLUE"]
    assert facts.answers("(line red 1 4)") == []


@pytest.mark.parametrize(
    ("rule", "ends"),
    [
        ("((path ?x ?x) (path ?x ?z) (path ?z ?x))", "2"),
        ("((path ?x 3) (path ?x ?z) (path ?z 3))", "2 3"),
        ("((path ?x ?y) (path ?x ?z) (path ?y ?z))", "1 2 3"),
        ("((path ?x ?y) (path ?z ?x) (path ?z ?y))", "1 2 3"),
        ("((path ?x ?y) (path ?x ?_) (path ?_ ?y))", "1 2 3"),
    ],
)
def test_a_rule_that_is_no_way_of_two_steps_is_tabled(rule: str, ends: str) -> None:
    facts = Asking("(path 1 2)", "(path 2 3)", "(path 3 1)")
    facts.rule(rule)
    assert {each.kind for each in facts.explain(read("(path 1 ?y)")).rules} == {"tabled"}
    assert sorted(facts.answers("(path 1 ?y)")) == ends.split()
