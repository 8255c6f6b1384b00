"""The laws of the logical database.

A query answers what trying every substitution finds; indexes are what a scan
would find; a snapshot is what was there; and who watches is woken if and only
if something that was read has changed.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from typing import Any

import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st

from asking import as_datum
from eslang.base.failure import Failure
from eslang.base.lists import Cons, from_items, items
from eslang.base.symbols import Symbol, Value
from eslang.base.text import String
from eslang.facts.goals import UNBOUND
from eslang.facts.query import Facts
from eslang.facts.rules import UNSTRATIFIED
from eslang.facts.watching import Change, unwatch, watch
from naive.queries import TESTS, Goal, Rule, Term, Text, Unsafe, World, key, strata, variables

pytestmark = pytest.mark.slow
LAW = settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
CONNECTIVES = ("and", "or", "not")


@pytest.fixture(autouse=True, scope="module")
def small_buckets() -> Iterator[None]:
    """Let a bucket be large when it has three rows."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("eslang.facts.relations.SMALL", 2)
        yield


def lisp(term: Term) -> Value:
    """A term of the oracle, as a Lisp value."""
    if term.__class__ is tuple:
        return from_items([lisp(part) for part in term])
    if term.__class__ is Text:
        return String(term.text)
    if term.__class__ is str:
        return Symbol.intern(term.upper(), "COMMON-LISP" if term in CONNECTIVES else "ESL-USER")
    return term


def plain(value: Value) -> Term:
    """A Lisp value as a term of the oracle."""
    if value.__class__ is Cons:
        return tuple(plain(part) for part in items(value))
    if value.__class__ is String:
        return Text(value.text)
    assert not isinstance(value, str), "a code has got out"
    return value.name.lower() if isinstance(value, Symbol) else value


def call(name: Symbol, arguments: list[Value]) -> bool:
    """Ask one of the oracle's tests."""
    return TESTS[name.name.lower()](*[plain(as_datum(argument)) for argument in arguments])


def database(facts: list[Goal]) -> Facts:
    """A database that holds FACTS."""
    made = Facts(lambda name: name.name.lower() in TESTS, call)
    for fact in facts:
        made.add(lisp(fact))
    return made


def solved(solutions: Any) -> list[frozenset[tuple[str, Any]]]:
    """Solutions as the oracle tells them."""
    return [
        frozenset((variable.name.lower(), key(plain(value))) for variable, value in solution.items())
        for solution in solutions
    ]


GROUND = st.sampled_from(["a", "b", "c", 1, 1.0, Text("a"), ("f", "a"), ("f", "b")])
VARIABLE = st.sampled_from(["?x", "?y", "?z"])
TERM = st.one_of(
    *[VARIABLE] * 5, st.sampled_from("ab"), GROUND, st.just("?_"), VARIABLE.map(lambda name: ("f", name))
)
STORED = {"p": 1, "q": 2, "r": 2}
DERIVED = {"d": 1, "e": 2, "g": 2}
RELATIONS = {**STORED, **DERIVED}


@st.composite
def said(draw: Any, relations: dict[str, int], terms: st.SearchStrategy[Term]) -> Goal:
    """An atom about one of RELATIONS."""
    name = draw(st.sampled_from(sorted(relations)))
    return (name, *(draw(terms) for _ in range(relations[name])))


FACTS = st.lists(said(RELATIONS, st.one_of(*[st.sampled_from("ab")] * 3, GROUND)), min_size=4, max_size=16)
TEST = st.one_of(
    st.tuples(st.sampled_from(["smaller", "same"]), VARIABLE, st.one_of(VARIABLE, GROUND)),
    st.tuples(st.just("is-number"), VARIABLE),
)
ATOM = said(RELATIONS, TERM)
LEAF = st.one_of(ATOM, ATOM, ATOM, TEST)
GOALS = st.recursive(
    LEAF,
    lambda goals: st.one_of(
        st.lists(goals, min_size=1, max_size=3).map(lambda parts: ("and", *parts)),
        st.lists(goals, min_size=1, max_size=2).map(lambda parts: ("or", *parts)),
        goals.map(lambda part: ("not", part)),
    ),
    max_leaves=4,
)
QUERIES = st.one_of(
    GOALS,
    ATOM,
    st.tuples(st.just("and"), ATOM, LEAF),
    st.tuples(st.just("and"), ATOM, GOALS),
    st.tuples(st.just("and"), GOALS, ATOM, ATOM),
)


@st.composite
def rules(draw: Any) -> Rule:
    """A rule; it derives what its patterns bind."""
    patterns = draw(st.lists(ATOM, min_size=1, max_size=2))
    bound = sorted({name for goal in patterns for name in variables(goal)})
    names = st.sampled_from(bound) if bound else GROUND
    conditions = st.one_of(
        said(RELATIONS, st.one_of(names, GROUND)).map(lambda atom: ("not", atom)),
        st.tuples(st.sampled_from(["smaller", "same"]), names, st.one_of(names, GROUND)),
        st.tuples(st.just("or"), said(RELATIONS, names), said(RELATIONS, names)),
    )
    body = draw(st.permutations([*patterns, *draw(st.lists(conditions, max_size=1))]))
    return Rule(draw(said(DERIVED, st.one_of(names, names, GROUND))), tuple(body))


def taken(facts: Facts, candidates: list[Rule]) -> list[Rule]:
    """The rules that mean something; FACTS takes these and refuses the others."""
    found: list[Rule] = []
    for rule in candidates:
        means_something = strata([*found, rule]) is not None
        try:
            facts.define_rule(lisp(rule.head), lisp(rule.body))
        except Failure as failure:
            assert failure.cause is UNSTRATIFIED and not means_something
            continue
        assert means_something
        found.append(rule)
    return found


@LAW
@given(FACTS, st.lists(rules(), max_size=4), st.lists(QUERIES, min_size=1, max_size=4))
def test_a_query_answers_what_trying_everything_finds(
    told: list[Goal], candidates: list[Rule], queries: list[Goal]
) -> None:
    facts = database(told)
    world = World(told, taken(facts, candidates), queries)
    for query in queries:
        try:
            expected = world.solutions(query)
        except Unsafe:
            event("unsafe")
            check_refused(facts, query)
            continue
        answers = solved(facts.all(lisp(query)))
        event("answers" if answers else "no answers")
        event(f"rules {len(world.rules)}")
        assert len(answers) == len(set(answers))
        assert set(answers) == expected
        assert solved(facts.solutions(lisp(query))) == answers
        first = facts.first(lisp(query))
        assert (solved([first]) if first is not None else []) == answers[:1]


def check_refused(facts: Facts, query: Goal) -> None:
    """An unsafe query fails and says why."""
    try:
        facts.all(lisp(query))
    except Failure as failure:
        assert failure.cause is UNBOUND
    else:
        raise AssertionError("an unsafe query was answered")


CHANGES = st.lists(
    st.one_of(
        st.tuples(st.just("add"), said(RELATIONS, GROUND)),
        st.tuples(st.just("retract"), ATOM),
        st.tuples(st.just("update"), ATOM, said(RELATIONS, GROUND)),
    ),
    max_size=12,
)


def change(facts: Facts, what: tuple[Any, ...]) -> None:
    """Do one of CHANGES."""
    if what[0] == "add":
        facts.add(lisp(what[1]))
    elif what[0] == "retract":
        facts.retract(lisp(what[1]))
    else:
        facts.update(lisp(what[1]), lisp(what[2]))


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
        if fact[0] in properties:
            after = [each for each in after if key(each[:-1]) != key(fact[:-1])]
        after.append(fact)
    return after


def matches(pattern: Goal, fact: Goal) -> bool:
    """Whether FACT is an instance of PATTERN."""
    return bool(World([fact], [], [pattern]).solutions(pattern))


@LAW
@given(FACTS, st.frozensets(st.sampled_from(sorted(RELATIONS))), CHANGES, st.lists(ATOM, max_size=4))
def test_indexes_hold_what_a_scan_finds_whatever_was_changed(
    told: list[Goal], properties: frozenset[str], changes: list[Any], queries: list[Goal]
) -> None:
    facts = database([])
    for name in sorted(properties):
        facts.declare_property(Symbol.intern(name.upper(), "ESL-USER"))
    expected: list[Goal] = []
    heard: dict[Any, None] = {}
    facts.subscribe(lambda told: note(heard, told))
    steps = [("add", fact) for fact in told] + changes
    for number, what in enumerate(steps):
        if number < len(queries):
            facts.all(lisp(queries[number]))  # now there is an index
        change(facts, what)
        expected = changed(expected, what, properties)
        assert sorted(map(repr, held(facts))) == sorted(repr(key(fact)) for fact in expected)
    assert list(heard) == [key(fact) for fact in expected]
    for relation in facts.relations.values():
        for index in relation.indexes:
            found = [(place, row) for place, rows in index.buckets.items() for row in rows]
            assert sorted(map(repr, found)) == sorted(
                repr((index.project(row), row)) for row in relation.rows
            )
            order = list(relation.rows)
            assert all(sorted(rows, key=order.index) == list(rows) for rows in index.buckets.values())


def note(heard: dict[Any, None], told: Change) -> None:
    """Keep what a subscriber hears of as it would keep the facts."""
    if told.added:
        assert key(plain(told.fact)) not in heard
        heard[key(plain(told.fact))] = None
    else:
        del heard[key(plain(told.fact))]


@LAW
@given(FACTS, st.lists(rules(), max_size=3), QUERIES, CHANGES)
def test_a_snapshot_is_a_snapshot(
    told: list[Goal], candidates: list[Rule], query: Goal, changes: list[Any]
) -> None:
    facts = database(told)
    taken(facts, candidates)
    try:
        expected = solved(facts.all(lisp(query)))
    except Failure:
        return
    solutions = facts.solutions(lisp(query))
    answers = []
    for what in [*changes, *[None] * len(expected)]:
        answers += solved([found] if (found := next(solutions, None)) is not None else [])
        if what is not None:
            change(facts, what)
    assert answers == expected
    assert next(solutions, None) is None
    assert not any(relation.views for relation in facts.relations.values())


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
    assert not any(relation.views for relation in busy.relations.values())
    assert not busy.pauses.left


@LAW
@given(FACTS, st.lists(rules(), max_size=3), QUERIES, CHANGES)
def test_who_watches_is_woken_if_and_only_if_what_was_read_has_changed(
    told: list[Goal], candidates: list[Rule], query: Goal, changes: list[Any]
) -> None:
    facts = database(told)
    taken(facts, candidates)
    for what in changes:
        try:
            before, reads = facts.ask(lisp(query))
        except Failure:
            return
        told_of: list[Change] = []
        woken: list[Any] = []
        unsubscribe = facts.subscribe(told_of.append)
        watching = watch(reads, woken.append)
        change(facts, what)
        unwatch(watching)
        unsubscribe()
        read = {
            (relation.name, relation.arity, positions, repr(each))
            for (relation, positions), keys in reads.keys.items()
            for each in keys
        }
        touched = [each for each in told_of if was_read(each, read)]
        assert woken == touched[:1]
        if not woken:
            assert solved([before] if before is not None else []) == solved(facts.all(lisp(query))[:1])
    assert not any(relation.watched for relation in facts.relations.values())


def was_read(told: Change, read: set[Any]) -> bool:
    """Whether a look-up that is in READ finds what TOLD tells of."""
    arity = len(told.row)
    for size in range(arity + 1):
        for positions in combinations(range(arity), size):
            parts = tuple(told.row[place] for place in positions)
            looked = None if not positions else parts[0] if size == 1 and arity > 1 else parts
            if (told.name, arity, positions, repr(looked)) in read:
                return True
    return False
