"""How many look-ups named queries make, and how many rows they look at: exact, on any machine."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from asking import Asking, read
from eslang import Interpreter
from eslang.facts.relations import Access
from tests.benchmarks.test_counts import calls_of

COUNT = 100


class Counter:
    """Counts what the queries of a database read."""

    def __init__(self) -> None:
        self.look_ups = 0
        self.rows = 0

    def counting(self, access: Access, reader: Callable[..., Any]) -> Callable[..., Any]:
        """READER, which counts."""

        def look(*arguments: Any) -> Any:
            self.look_ups += 1
            found = reader(*arguments)
            self.rows += bool(found) if access.is_ground else len(found)
            return found

        return look


@pytest.fixture
def counter(monkeypatch: pytest.MonkeyPatch) -> Counter:
    """What counts the reads of all queries that are planned from now on."""
    made, reader = Counter(), Access.reader
    monkeypatch.setattr(Access, "reader", lambda access: made.counting(access, reader(access)))
    return made


@pytest.fixture
def facts() -> Asking:
    """A chain of numbers with a way on at each, a property, and the kinds of some."""
    made = Asking(*(f"(next {number} {number + 1})" for number in range(COUNT)))
    for number in range(COUNT):
        made.add(read(f"(kind {number} {'even' if number % 2 == 0 else 'odd'})"))
    made.add_all([read(f"(lamp {number} on)") for number in (3, 50)])
    for rule in (
        "((walk ?x ?y) (next ?x ?y))",
        "((walk ?x ?y) (next ?x ?z) (walk ?z ?y))",
        "((left ?x ?y) (next ?x ?y))",
        "((left ?x ?y) (left ?x ?z) (next ?z ?y))",
        "((path ?x ?y) (next ?x ?y))",
        "((path ?x ?y) (path ?x ?z) (path ?z ?y))",
        "((dark ?x) (kind ?x even) (not (lamp ?x on)))",
    ):
        made.rule(rule)
    return made


@pytest.mark.parametrize(
    ("query", "look_ups", "rows"),
    [
        ("(next 7 ?y)", 1, 1),
        ("(next 7 8)", 1, 1),
        ("(next ?x 7)", 1, 1),
        ("(next ?x ?y)", 1, COUNT),
        ("(and (next ?x ?y) (next ?y ?z))", 1 + COUNT, COUNT + COUNT - 1),
        ("(and (kind ?x odd) (lamp ?x on))", 1 + 50, 50 + 1),
        ("(and (next ?x ?y) (kind 3 even))", 1, 0),
        ("(and (next ?x ?y) (lamp ?y on) (next ?y 51))", 1 + 2 + 1, 2 + 1 + 1),
        ("(dark ?x)", 1 + 1 + 50, 50 + 1),
        ("(walk 0 ?y)", 2 * (COUNT + 1), COUNT),
        ("(left 0 ?y)", 2 + COUNT, COUNT),
        ("(path 0 ?y)", 3 * (COUNT + 1), COUNT),
        ("(walk ?x 100)", 2 + COUNT, COUNT),
        ("(path ?x 100)", 3 * (COUNT + 1), COUNT),
    ],
)
def test_what_a_query_reads(facts: Asking, counter: Counter, query: str, look_ups: int, rows: int) -> None:
    facts.all(read(query))
    assert (counter.look_ups, counter.rows) == (look_ups, rows)


LISP = """
(dotimes (number 20) (assert `(next ,number ,(1+ number))))
(defproperty lamp)
(defun ask (rounds) (dotimes (round rounds) (db-query '(next 7 ?x))))
(defun join (rounds) (dotimes (round rounds) (db-query '(and (next 7 ?x) (next ?x ?y)))))
(defun bind (rounds) (dotimes (round rounds) (with-query-bindings '(next 7 ?x) #?x)))
(defun switch (rounds)
  (dotimes (round rounds) (assert '(lamp 1 on)) (assert '(lamp 1 off))))
(defun idle (count)
  (dotimes (number count) (spawn (wait-until `(lamp ,(+ 2 number) on)) :daemon t))
  (sleep 0))
"""


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter that knows some facts and plans."""
    with Interpreter(clock="virtual", output=io.StringIO()) as made:
        made.eval(LISP)
        yield made


@pytest.mark.parametrize(("name", "calls"), [("ask", 5), ("join", 7), ("bind", 23), ("switch", 2 * 15)])
def test_what_one_round_calls(agent: Interpreter, name: str, calls: int) -> None:
    assert calls_of(agent, name, 20) - calls_of(agent, name, 10) == 10 * calls


def test_a_change_costs_the_same_whoever_waits_for_others(agent: Interpreter) -> None:
    alone = calls_of(agent, "switch", 10)
    agent.call("idle", 200)
    watched = calls_of(agent, "switch", 10)
    agent.call("idle", 400)
    assert calls_of(agent, "switch", 10) == watched <= 2 * alone
