"""The laws of answers: a query answers what trying every substitution finds, and in which order."""

from __future__ import annotations

from itertools import permutations
from typing import Any

import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from worlds import (
    ASKED,
    FACTS,
    GOALS,
    GROUND,
    LEAF,
    QUERIES,
    RELATIONS,
    TERM,
    VARIABLE,
    database,
    given_as,
    lisp,
    plain,
    rules,
    said,
    solved,
    taken,
)

from eslang.base.failure import Failure
from eslang.base.lists import items
from eslang.base.symbols import Symbol, Value
from eslang.facts.goals import UNBOUND
from eslang.facts.query import Facts
from naive.queries import Bindings, Goal, Rule, Unsafe, World, check_safe, key, variables, ways

pytestmark = pytest.mark.slow
LAW = settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])


@LAW
@given(
    FACTS,
    st.lists(rules(), max_size=5),
    st.lists(QUERIES, min_size=1, max_size=4),
    st.sampled_from([1, 16]),
)
def test_a_query_answers_what_trying_everything_finds(
    told: list[Goal], candidates: list[Rule], queries: list[Goal], many: int
) -> None:
    facts = database(told)
    world = World(told, taken(facts, candidates))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("eslang.facts.steps.MANY", many)  # ways through ORs before they are joined
        for query in queries:
            check_answers(facts, world, query, {})
    event(f"rules {len(world.rules)}")


@LAW
@given(
    FACTS,
    st.lists(rules(), max_size=3),
    QUERIES,
    st.dictionaries(VARIABLE, GROUND, max_size=2),
)
def test_values_that_are_given_constrain_a_query(
    told: list[Goal], candidates: list[Rule], query: Goal, bindings: Bindings
) -> None:
    facts = database(told)
    check_answers(facts, World(told, taken(facts, candidates)), query, bindings)


def check_answers(facts: Facts, world: World, query: Goal, bindings: Bindings) -> None:
    """All ways to ask agree with the oracle."""
    asked, values = lisp(query), given_as(bindings)
    try:
        expected = world.solutions(query, bindings)
    except Unsafe:
        event("unsafe")
        check_refused(facts, query, bindings)
        return
    answers = solved(facts.all(asked, values))
    event("answers" if answers else "no answers")
    assert len(answers) == len(set(answers))
    assert set(answers) == expected
    assert solved(facts.solutions(asked, values)) == answers
    for first in (facts.first(asked, values), facts.ask(asked, values)[0]):
        assert (solved([first]) if first is not None else []) == answers[:1]
    if not bindings:
        assert solved(map(from_alist, items(facts.alists(asked, lambda whole: whole)))) == answers
    assert solved(facts.all(asked, values)) == answers


def from_alist(alist: Value) -> dict[Symbol, Value]:
    """A solution as Python has it."""
    return {pair.car: pair.cdr for pair in items(alist)}


def check_refused(facts: Facts, query: Goal, bindings: Bindings) -> None:
    """An unsafe query fails and says why, whatever is held."""
    for each in (facts, database([])):
        for ask in (each.all, each.first, each.solutions, each.ask):
            with pytest.raises(Failure) as caught:
                ask(lisp(query), given_as(bindings))
            assert caught.value.cause is UNBOUND
            assert len(caught.value.arguments) == 2


@LAW
@given(FACTS, st.lists(rules(), max_size=3), st.lists(LEAF, min_size=2, max_size=3), st.booleans())
def test_the_order_of_goals_makes_no_difference(
    told: list[Goal], candidates: list[Rule], goals: list[Goal], negated: bool
) -> None:
    facts = database(told)
    taken(facts, candidates)
    if negated:
        goals = [*goals[:-1], ("not", goals[-1])]
    assert len({answers_or_cause(facts, ("and", *order)) for order in permutations(goals)}) == 1


def answers_or_cause(facts: Facts, query: Goal) -> Any:
    """What comes of asking."""
    try:
        return frozenset(solved(facts.all(lisp(query))))
    except Failure as failure:
        return failure.cause


@LAW
@given(FACTS, said(RELATIONS, TERM))
def test_a_pattern_finds_facts_in_the_order_of_their_assertion(told: list[Goal], pattern: Goal) -> None:
    facts = database(told)
    found = dict.fromkeys(
        solution
        for fact in {key(fact): fact for fact in told}.values()
        for solution in World([fact], []).solutions(pattern)
    )
    assert solved(facts.all(lisp(pattern))) == list(found)
    gone = [fact for fact in told if World([fact], []).solutions(pattern)]
    assert facts.retract(lisp(pattern)) == len({key(fact) for fact in gone})
    left = [key(plain(fact)) for fact in facts.facts()]
    assert set(left) == {key(fact) for fact in told} - {key(fact) for fact in gone}


@LAW
@given(FACTS, st.lists(rules(), max_size=2), ASKED, GOALS)
def test_a_rule_says_what_its_body_says(
    told: list[Goal], candidates: list[Rule], before: Goal, body: Goal
) -> None:
    """Whatever is known already of what its head tells."""
    names = variables(body)
    written_out = ("and", before, body)
    if any(missing(("and", before, *way[1:]), names) for way in ways(body)):
        return
    facts = database(told)
    taken(facts, candidates)
    expected = solved(facts.all(lisp(written_out)))
    facts.define_rule(lisp(("h", *names)), lisp((body,)))
    for query in (("and", before, ("h", *names)), ("and", ("h", *names), before)):
        assert set(solved(facts.all(lisp(query)))) == set(expected)
    event("answers" if expected else "no answers")


def missing(conjunction: Goal, names: list[str]) -> bool:
    """Whether no pattern in CONJUNCTION gives a value to some of NAMES, or a test or NOT needs one."""
    try:
        check_safe(conjunction)
    except Unsafe:
        return True
    return not set(names) <= set(variables(conjunction))
