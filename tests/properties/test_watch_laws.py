"""The laws of waiting for facts: whoever watches is woken where there is a cause, and not otherwise."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from worlds import (
    CHANGES,
    FACTS,
    QUERIES,
    UPHEAVALS,
    change,
    database,
    lisp,
    looked_up,
    rules,
    solved,
    taken,
    was_read,
)

from eslang.base.failure import Failure
from eslang.facts.query import Facts
from eslang.facts.watching import Change, unwatch, watch
from naive.queries import Goal, Rule

pytestmark = pytest.mark.slow
LAW = settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])


@LAW
@given(FACTS, st.lists(rules(), max_size=3), QUERIES, CHANGES)
def test_who_watches_is_woken_if_and_only_if_what_was_read_has_changed(
    told: list[Goal], candidates: list[Rule], query: Goal, changes: list[Any]
) -> None:
    facts = database(told)
    taken(facts, candidates)
    for what in changes:
        try:
            _, reads = facts.ask(lisp(query))
        except Failure:
            return
        told_of: list[Change] = []
        woken: list[Any] = []
        unsubscribe = facts.subscribe(told_of.append)
        watching = watch(reads, woken.append)
        change(facts, what)
        unwatch(watching)
        unsubscribe()
        read = looked_up(reads)
        touched = [each for each in told_of if was_read(each, read)]
        assert [(each.added, each.row) for each in woken] == [(each.added, each.row) for each in touched[:1]]
    assert not any(relation.watched for relation in facts.relations.values())


class Waiting:
    """Somebody who waits for a query to change its first solution: it is asked only after a wake."""

    def __init__(self, facts: Facts, query: Goal) -> None:
        self.facts, self.query = facts, lisp(query)
        self.asked = self.stale = 0
        self.ask()

    def ask(self) -> None:
        """Find what holds, and watch that."""
        self.asked += 1
        self.solution, reads = self.facts.ask(self.query)
        self.watch = watch(reads, self.wake)

    def wake(self, _: Any) -> None:
        """Ask again: later, since a change may not be whole."""
        self.stale += 1

    def look(self) -> None:
        """Ask again, if there is a reason."""
        if self.stale:
            self.stale = 0
            unwatch(self.watch)
            self.ask()

    def check(self) -> None:
        """What was found last is what holds."""
        now = self.facts.first(self.query)
        assert solved([self.solution] if self.solution else []) == solved([now] if now else [])
        assert (self.solution is None) == (now is None)


@LAW
@given(FACTS, st.lists(rules(), max_size=4), st.lists(QUERIES, min_size=1, max_size=4), UPHEAVALS)
def test_who_asks_again_only_when_woken_always_knows_what_holds(
    told: list[Goal], candidates: list[Rule], queries: list[Goal], changes: list[Any]
) -> None:
    facts = database(told)
    taken(facts, candidates)
    try:
        waiting = [Waiting(facts, query) for query in queries]
    except Failure:
        return
    for what in changes:
        change(facts, what)
        for each in waiting:
            each.look()
            each.check()
    for each in waiting:
        event(f"asked {each.asked}")
        unwatch(each.watch)
    assert not any(relation.watched for relation in facts.relations.values())


@LAW
@given(FACTS, st.lists(rules(), max_size=4), QUERIES, CHANGES)
def test_a_change_of_relations_that_nothing_rests_on_wakes_nobody(
    told: list[Goal], candidates: list[Rule], query: Goal, changes: list[Any]
) -> None:
    facts = database(told)
    known = taken(facts, candidates)
    try:
        waiting = Waiting(facts, query)
    except Failure:
        return
    needed = needs(query, known)
    for what in changes:
        before = waiting.stale
        change(facts, what)
        touched = {(each[0], len(each) - 1) for each in what[1:]}
        if not touched & needed:
            assert waiting.stale == before
        waiting.look()
    unwatch(waiting.watch)


def needs(query: Goal, known: list[Rule]) -> set[tuple[str, int]]:
    """The relations that QUERY speaks of, directly or through rules."""
    from naive.queries import atoms, relation

    found = {relation(atom) for atom, _ in atoms(query)}
    while True:
        bodies = [("and", *rule.body) for rule in known if relation(rule.head) in found]
        more = {relation(atom) for body in bodies for atom, _ in atoms(body)} - found
        if not more:
            return found
        found |= more
