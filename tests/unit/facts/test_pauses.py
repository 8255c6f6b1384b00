"""A long query lets others have their turn, and answers as of the moment in which it was asked."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator

import pytest

from asking import Asking, read, told
from eslang.facts.views import SLICE

MANY = 3 * SLICE + 1
REACH = ("((reach ?x ?y) (next ?x ?y))", "((reach ?x ?y) (next ?x ?z) (reach ?z ?y))")
BACK = ("((reach ?x ?y) (next ?x ?y))", "((reach ?x ?y) (reach ?x ?z) (next ?z ?y))")
TWICE = ("((reach ?x ?y) (next ?x ?y))", "((reach ?x ?y) (reach ?x ?z) (reach ?z ?y))")


class Busy(Asking):
    """A database in whose pauses something is done, the first time."""

    def __init__(self, facts: Iterator[str]) -> None:
        super().__init__(*facts)
        self.count = 0
        self.pauses.give_way = self.pause
        self.done: Callable[[], object] = lambda: None

    def pause(self) -> None:
        """Count it."""
        self.count += 1
        if self.count == 1:
            self.done()


@pytest.fixture
def chain() -> Busy:
    """Numbers, each behind the one before, all of one kind."""
    made = Busy(f"(next {number} {number + 1})" for number in range(MANY))
    made.add_all([read(f"(kind {number} odd)") for number in range(1, MANY, 2)])
    made.add_all([read(f"(kind {number} even)") for number in range(0, MANY, 2)])
    return made


def test_a_query_of_a_few_answers_does_not_pause(chain: Busy) -> None:
    for number in range(MANY):
        chain.all(read(f"(next {number} ?y)"))
    assert chain.count == 0


@pytest.mark.parametrize(
    ("query", "pauses"),
    [
        ("(next ?x ?y)", 3),
        ("(kind ?x even)", 1),
        ("(and (next ?x ?y) (next ?y ?z))", 3),
        ("(and (kind ?x even) (kind ?y odd) (next ?x ?y))", 1),
        ("(and (next ?x ?y) (not (kind ?x even)))", 3),
        ("(next ?x 0)", 0),
    ],
)
def test_rows_of_large_buckets_are_counted(chain: Busy, query: str, pauses: int) -> None:
    chain.all(read(query))
    assert chain.count == pauses


@pytest.mark.parametrize("rules", [REACH, BACK], ids=["walked", "tabled"])
def test_what_rules_derive_one_from_another_is_counted(chain: Busy, rules: tuple[str, ...]) -> None:
    for rule in rules:
        chain.rule(rule)
    assert len(chain.all(read("(reach 0 ?y)"))) == MANY
    assert chain.count > 1


@pytest.mark.parametrize("how", ["all", "solutions"])
@pytest.mark.parametrize(
    "query",
    [
        "(next ?x ?y)",
        "(kind ?x even)",
        "(and (next ?x ?y) (kind ?y even))",
        "(and (kind ?x even) (next ?x ?y) (not (kind ?y even)))",
        "(reach 0 ?y)",
        "(reach ?x 900)",
        "(and (kind ?x odd) (> ?x 3))",
    ],
)
def test_what_changes_in_a_pause_is_not_seen(chain: Busy, query: str, how: str) -> None:
    for rule in REACH:
        chain.rule(rule)
    quiet = list(map(told, chain.all(read(query))))

    def change() -> None:
        chain.retract(read("(next ?x 7)"))
        chain.retract(read(f"(next {MANY - 3} ?y)"))
        chain.add(read("(next 5 3)"))
        chain.add(read("(next new newer)"))
        chain.retract(read("(kind 6 ?k)"))
        chain.add(read("(kind 7 even)"))
        chain.retract(read(f"(kind {MANY - 4} ?k)"))
        assert len(chain.all(read("(next 5 ?y)"))) == 2

    chain.count, chain.done = 0, change
    assert list(map(told, getattr(chain, how)(read(query)))) == quiet
    assert chain.count > 0
    assert not any(relation.views for relation in chain.relations.values())
    chain.done = lambda: None
    assert list(map(told, chain.all(read(query)))) != quiet


def test_the_first_answer_is_one_of_the_moment_of_the_question(chain: Busy) -> None:
    query = read("(and (kind ?x even) (next ?x ?y) (last ?y))")
    chain.add(read(f"(last {MANY})"))
    chain.done = lambda: chain.retract(read("(last ?x)"))
    assert told(chain.first(query)) == f"{MANY - 1} {MANY}"
    assert chain.count > 0
    assert chain.first(query) is None


def test_another_may_ask_the_same_in_a_pause(chain: Busy) -> None:
    query = read("(next ?x ?y)")
    chain.all(query)
    inner: list[int] = []

    def ask() -> None:
        chain.add(read("(next new newer)"))
        inner.append(len(chain.all(query)))

    chain.count, chain.done = 0, ask
    assert len(chain.all(query)) == MANY
    assert inner == [MANY + 1]
    assert len(chain.all(query)) == MANY + 1


def test_a_query_that_is_left_in_a_pause_leaves_nothing_behind(chain: Busy) -> None:
    def leave() -> None:
        raise KeyboardInterrupt

    query = read("(next ?x ?y)")
    for how in (chain.all, chain.first):
        chain.all(query)
        chain.count, chain.done = 0, leave
        asked = query if how == chain.all else read("(and (next ?x ?y) (next ?y ?y))")
        with pytest.raises(KeyboardInterrupt):
            how(asked)
        assert not chain.pauses.left
        assert not any(relation.views for relation in chain.relations.values())
    assert len(chain.all(query)) == MANY


@pytest.mark.parametrize(
    ("change", "overtaken"),
    [("(kind new even)", True), ("(kind 4 odd)", False), ("(next 1 0)", True), ("(next 1 7)", False)],
)
def test_a_condition_knows_whether_what_it_read_has_changed_in_a_pause(
    chain: Busy, change: str, overtaken: bool
) -> None:
    query = read("(and (kind ?x even) (next ?x ?y) (next ?y ?x))")
    chain.ask(query)
    chain.count, chain.done = 0, lambda: chain.add(read(change))
    found, reads = chain.ask(query)
    assert found is None
    assert chain.count > 0
    assert reads.overtaken is overtaken
    assert not chain.ask(query)[1].overtaken


def test_a_rule_that_comes_in_a_pause_overtakes_a_condition(chain: Busy) -> None:
    chain.done = lambda: chain.rule("((kind ?x loop) (next ?x ?x))")
    assert chain.ask(read("(and (next ?x ?y) (next ?y ?x))"))[1].overtaken
    assert not chain.ask(read("(and (next ?x ?y) (next ?y ?x))"))[1].overtaken


def test_nobody_has_a_turn_while_a_change_is_told(chain: Busy) -> None:
    looks: list[int] = []
    chain.pauses.look = lambda: looks.append(1)
    chain.subscribe(lambda change: chain.all(read("(next ?x ?y)")))
    chain.add(read("(next new newer)"))
    assert (chain.count, len(looks)) == (0, 3)


@pytest.mark.parametrize("rules", [REACH, BACK, TWICE], ids=["walked", "tabled", "transitive"])
@pytest.mark.parametrize("how", ["all", "first", "ask", "solutions"])
def test_a_query_leaves_no_circles_of_references(rules: tuple[str, ...], how: str) -> None:
    facts = Asking(*(f"(next {number} {number + 1})" for number in range(50)))
    for rule in rules:
        facts.rule(rule)
    query = read("(reach 0 ?y)")

    def ask() -> None:
        found = getattr(facts, how)(query)
        if how == "solutions":
            next(found)

    ask()
    gc.collect()
    gc.disable()
    try:
        ask()
        assert gc.collect() == 0
    finally:
        gc.enable()
