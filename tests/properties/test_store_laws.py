"""The laws of what is held: indexes are what a scan would find, and a snapshot is what was there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from worlds import (
    ASKED,
    ATOM,
    CHANGES,
    FACTS,
    LEAF,
    QUERIES,
    RELATIONS,
    UPHEAVALS,
    change,
    database,
    lisp,
    plain,
    rules,
    solved,
    taken,
)

from eslang.base.failure import Failure
from eslang.base.symbols import Symbol
from eslang.facts.query import Facts
from eslang.facts.watching import Change
from naive.queries import Goal, Rule, World, key, variables

pytestmark = pytest.mark.slow
LAW = settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
PROPERTIES = st.frozensets(st.sampled_from(sorted({name for name, _ in RELATIONS})))


@pytest.fixture(autouse=True, scope="module")
def small_buckets() -> Iterator[None]:
    """Let a bucket be large when it has three rows."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("eslang.facts.relations.SMALL", 2)
        yield


def held(facts: Facts) -> list[Any]:
    """The keys of all facts."""
    return [key(plain(fact)) for fact in facts.facts()]


def changed(before: list[Goal], what: tuple[Any, ...], properties: frozenset[str]) -> list[Goal]:
    """The facts after a change, as a plain list does it."""
    pattern, fact = (None, what[1]) if what[0] == "add" else (what[1], what[-1])
    wanted = key(fact) if what[0] != "retract" else None
    after = list(before)
    if pattern is not None:
        gone = {key(each) for each in before if matches(pattern, each)}
        after = [each for each in after if key(each) not in gone or key(each) == wanted]
    if wanted is not None and wanted not in map(key, after):
        if fact[0] in properties and len(fact) > 1:
            after = [each for each in after if not is_rival(each, fact)]
        after.append(fact)
    return after


def is_rival(one: Goal, other: Goal) -> bool:
    """Whether two facts of a property differ in the last argument at most."""
    return len(one) == len(other) and key(one[:-1]) == key(other[:-1])


def matches(pattern: Goal, fact: Goal) -> bool:
    """Whether FACT is an instance of PATTERN."""
    return bool(World([fact], []).solutions(pattern))


@LAW
@given(FACTS, PROPERTIES, CHANGES, st.lists(ATOM, max_size=4), st.lists(QUERIES, max_size=3))
def test_indexes_hold_what_a_scan_finds_whatever_was_changed(
    told: list[Goal],
    properties: frozenset[str],
    changes: list[Any],
    queries: list[Goal],
    open_queries: list[Goal],
) -> None:
    facts = database([])
    for name in sorted(properties):
        facts.declare_property(lisp(name))
    expected: list[Goal] = []
    heard: dict[Any, None] = {}
    facts.subscribe(lambda told: note(heard, told))
    snapshots: list[Any] = []
    for number, what in enumerate([("add", fact) for fact in told] + changes):
        if number < len(queries):
            facts.all(lisp(queries[number]))  # now there is an index
        if number % 5 == 4 and open_queries:
            snapshots += entered(facts, open_queries.pop())
        change(facts, what)
        expected = changed(expected, what, properties)
        assert sorted(map(repr, held(facts))) == sorted(repr(key(fact)) for fact in expected)
        assert list(heard) == [key(fact) for fact in expected]
        check_indexes(facts)


def entered(facts: Facts, query: Goal) -> list[Any]:
    """The solutions of QUERY, of which the first was asked for; nothing, if it is unsafe."""
    try:
        solutions = facts.solutions(lisp(query))
    except Failure:
        return []
    next(solutions, None)
    return [solutions]


def check_indexes(facts: Facts) -> None:
    """Every index holds all rows of its relation in their order, and nothing else."""
    for relation in facts.relations.values():
        order = {row: number for number, row in enumerate(relation.rows)}
        for index in relation.indexes:
            found = [(place, row) for place, rows in index.buckets.items() for row in rows]
            assert sorted(map(repr, found)) == sorted(repr((index.project(row), row)) for row in order)
            for rows in index.buckets.values():
                numbers = [order[row] for row in rows]
                assert numbers == sorted(numbers) and numbers


def note(heard: dict[Any, None], told: Change) -> None:
    """Keep what a subscriber hears of as it would keep the facts."""
    if told.added:
        assert key(plain(told.fact)) not in heard
        heard[key(plain(told.fact))] = None
    else:
        del heard[key(plain(told.fact))]


@LAW
@given(FACTS, st.lists(rules(), max_size=3), st.lists(QUERIES, min_size=1, max_size=3), UPHEAVALS, st.data())
def test_a_snapshot_is_a_snapshot(
    told: list[Goal], candidates: list[Rule], queries: list[Goal], changes: list[Any], data: Any
) -> None:
    """Several are open at once; they are gone on with between changes of facts and of rules, or given up."""
    facts = database(told)
    taken(facts, candidates)
    snapshots: list[tuple[Any, list[Any]]] = []
    for what in [*changes, *[None] * 12]:
        if len(snapshots) < 5:
            query = lisp(data.draw(st.sampled_from(queries)))
            try:
                snapshots.append((facts.solutions(query), solved(facts.all(query))))
            except Failure:
                return
        if what is not None:
            change(facts, what)
        which, act = data.draw(st.tuples(st.integers(0, len(snapshots) - 1), st.sampled_from("nnnnc")))
        solutions, expected = snapshots[which]
        if act == "c":
            solutions.close()
            expected.clear()
        found = next(solutions, None)
        assert solved([] if found is None else [found]) == expected[:1]
        del expected[:1]
    for solutions, expected in snapshots:
        assert solved(solutions) == expected
        assert next(solutions, None) is None
    check_nothing_is_open(facts)


@LAW
@given(FACTS, st.lists(rules(), max_size=3), QUERIES, UPHEAVALS)
def test_a_test_that_changes_the_facts_does_not_disturb_the_query_that_asks_it(
    told: list[Goal], candidates: list[Rule], query: Goal, changes: list[Any]
) -> None:
    facts = database(told)
    taken(facts, candidates)
    try:
        expected = solved(facts.all(lisp(query)))
    except Failure:
        return
    left = list(changes)
    ask = facts.call

    def disturb(name: Symbol, arguments: list[Any]) -> bool:
        if left:
            change(facts, left.pop())
        facts.first(lisp(("p", "?x")))
        return ask(name, arguments)

    facts.call = disturb
    facts._forget_plans()
    assert solved(facts.all(lisp(query))) == expected
    check_nothing_is_open(facts)


@LAW
@given(FACTS, st.lists(rules(), max_size=3), QUERIES, CHANGES, st.sampled_from(["all", "first", "solutions"]))
def test_what_changes_in_the_pauses_of_a_query_is_not_seen(
    told: list[Goal], candidates: list[Rule], query: Goal, changes: list[Any], how: str
) -> None:
    def ask(facts: Facts) -> list[Any]:
        found = getattr(facts, how)(lisp(query))
        return solved([found] if isinstance(found, dict) else found or [])

    quiet, busy = database(told), database(told)
    taken(quiet, candidates)
    taken(busy, candidates)
    left = list(changes)

    def give_way() -> None:
        event("paused")
        for what in left[:2]:
            change(busy, what)
        del left[:2]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("eslang.facts.views.SLICE", 1)
        for _ in range(2):  # the second time it runs on what was kept
            try:
                expected = ask(quiet)
            except Failure:
                return
            busy.pauses.give_way = give_way
            assert ask(busy) == expected
            busy.pauses.give_way = lambda: None
            for what in changes[: len(changes) - len(left)]:
                change(quiet, what)
            changes = list(left)
    check_nothing_is_open(busy)
    assert not busy.pauses.left


@LAW
@given(
    FACTS,
    st.lists(rules(), max_size=4),
    ASKED,
    LEAF,
    st.integers(1, 6),
    st.sampled_from(["all", "first", "ask"]),
)
def test_a_test_that_fails_leaves_everything_as_it_was(
    told: list[Goal], candidates: list[Rule], pattern: Goal, goal: Goal, calls: int, how: str
) -> None:
    names = variables(pattern)
    query = lisp(("and", pattern, goal, *(("same", name, name) for name in names)))
    facts = database(told)
    taken(facts, candidates)
    try:
        expected = solved(facts.all(query))
    except Failure:
        return
    left, ask = [calls], facts.call

    def fail_once(name: Symbol, arguments: list[Any]) -> bool:
        left[0] -= 1
        if left[0] == 0:
            raise ZeroDivisionError
        return ask(name, arguments)

    facts.call = fail_once
    facts._forget_plans()
    solutions, found = facts.solutions(query), []
    while True:  # it goes on where it was
        try:
            found += solved([next(solutions)])
        except ZeroDivisionError:
            event("a solution failed")
        except StopIteration:
            break
    assert found == expected
    left[0] = calls
    try:
        getattr(facts, how)(query)
    except ZeroDivisionError:
        event("an answer failed")
    left[0] = 0
    assert solved(facts.all(query)) == expected
    check_nothing_is_open(facts)


def check_nothing_is_open(facts: Facts) -> None:
    """No snapshot keeps anybody waiting any more."""
    assert not any(relation.views for relation in facts.relations.values())
