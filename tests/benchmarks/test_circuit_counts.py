"""How often the conditions of circuits are asked: exact, on any machine."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import Any

import pytest

from eslang import Interpreter
from eslang.facts.query import Facts
from eslang.runtime.circuits import Level
from tests.benchmarks.circuits import ELSEWHERE, PROGRAM
from tests.benchmarks.test_counts import calls_of

PLANS = """
(defun begin-timing () nil)
(defun end-timing () nil)
(defvar *asked* 0)
(defvar *counted* 0)
(defun counted-acts (rounds)
  (setq *asked* 0)
  (acts rounds)
  (setq *counted* *asked*))
(defun asks () (incf *asked*))
(defun under-asks (depth work)
  (if (= depth 0)
      (funcall work)
      (scs:do :while (asks) (under-asks (1- depth) work))))
(defun asks-around (depth rounds)
  (under-asks depth (lambda () (counted-acts rounds))))
(defun changing-best-of (count number rounds)
  (let ((clauses (clauses count t (lambda () (moves number rounds)))))
    (scs::%do-best 'do-best nil clauses nil nil)))
(defun asks-of-first (rounds)
  (do-first ((and (asks) nil) (act))
            ((and (asks) nil) (act))
            ((asks) (counted-acts rounds))
            ((asks) (act))))
(defun asks-of-best (rounds)
  (do-best ((asks) 1 (act))
           ((asks) 2 (counted-acts rounds))
           ((asks) 1 (act))))
"""


class Tally:
    """How many queries conditions made, and how many levels were asked."""

    def __init__(self) -> None:
        self.queries = 0
        self.levels = 0


@pytest.fixture
def tally(monkeypatch: pytest.MonkeyPatch) -> Tally:
    """What counts from now on."""
    made, ask, ask_level = Tally(), Facts.ask, Level.ask

    def counted(facts: Facts, *arguments: Any) -> Any:
        made.queries += 1
        return ask(facts, *arguments)

    def counted_level(level: Level) -> None:
        made.levels += 1
        ask_level(level)

    monkeypatch.setattr(Facts, "ask", counted)
    monkeypatch.setattr(Level, "ask", counted_level)
    return made


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter that knows the plans; all gates are there."""
    with Interpreter(output=io.StringIO(), clock="virtual") as made:
        made.load(PROGRAM)
        made.eval(PLANS)
        made.eval("(open-gates 0 101)")
        yield made


def queries(tally: Tally, agent: Interpreter, name: str, *arguments: Any) -> int:
    """How many queries are made for each action of a plan, beside what entering and leaving takes."""
    counts = []
    for rounds in (10, 20):  # even, so that each changes something
        before = tally.queries
        agent.call(name, *arguments, rounds)
        counts.append(tally.queries - before)
    few, many = counts
    assert (many - few) % 10 == 0
    return (many - few) // 10


@pytest.mark.parametrize("depth", [1, 10, 100])
def test_what_does_not_change_is_not_asked(agent: Interpreter, tally: Tally, depth: int) -> None:
    assert queries(tally, agent, "facts-around", depth) == 0
    assert queries(tally, agent, "changes-around", depth, ELSEWHERE) == 0


def test_where_nothing_changes_no_level_is_asked(agent: Interpreter, tally: Tally) -> None:
    agent.call("facts-around", 100, 100)
    agent.call("changes-around", 100, ELSEWHERE, 100)
    assert tally.levels == 0


@pytest.mark.parametrize("depth", [1, 10, 100])
def test_what_changes_is_asked_once_for_an_action(agent: Interpreter, tally: Tally, depth: int) -> None:
    assert queries(tally, agent, "changes-around", depth, 1) == 1


@pytest.mark.parametrize(
    "count", [10, pytest.param(1000, marks=pytest.mark.slow), pytest.param(10_000, marks=pytest.mark.slow)]
)
def test_of_many_alternatives_the_one_that_changes_is_asked(
    agent: Interpreter, tally: Tally, count: int
) -> None:
    agent.eval("(retract '(gate ?number ?state)) (open-gates 0 1)")
    assert queries(tally, agent, "first-of", count) == 0
    assert queries(tally, agent, "changing-first-of", count) == 1
    assert queries(tally, agent, "changing-best-of", count, 0) == 1
    assert queries(tally, agent, "changing-best-of", count, 1) == 0  # only when it has to choose again


@pytest.mark.slow
def test_entering_ten_thousand_alternatives_asks_each_once(agent: Interpreter, tally: Tally) -> None:
    agent.eval("(retract '(gate ?number ?state)) (open-gates 0 1)")
    agent.call("first-of", 10_000, 10)
    assert tally.queries == 10_000


@pytest.mark.parametrize("depth", [1, 10, 100])
def test_what_asks_lisp_is_asked_once_for_an_action(agent: Interpreter, depth: int) -> None:
    agent.call("asks-around", depth, 100)
    assert agent.eval("*counted*") == 100 * depth


@pytest.mark.parametrize(
    ("plan", "asked"),
    [
        ("asks-of-first", 3),  # those before it, and its own
        ("asks-of-best", 1),
    ],
)
def test_a_choice_over_lisp_asks_those_that_could_leave_it(agent: Interpreter, plan: str, asked: int) -> None:
    agent.call(plan, 100)
    assert agent.eval("*counted*") == 100 * asked


def test_what_is_not_changed_costs_no_call_at_any_depth(agent: Interpreter) -> None:
    def calls(depth: int) -> int:
        return calls_of(agent, "facts-around", depth, 200) - calls_of(agent, "facts-around", depth, 100)

    assert calls(100) == calls(1)
