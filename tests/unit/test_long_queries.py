"""A plan that asks for much does not keep the others waiting, nor outlive its end."""

from __future__ import annotations

import io
from collections.abc import Iterator

import pytest

from eslang import Failure, Interpreter

FACTS = """
(dotimes (number 100) (assert `(node ,number)))
(defvar *log* nil)
(defun endless ()
  (db-query '(and (node ?a) (node ?b) (node ?c) (node ?d) (node ?e) (not (node ?e)))))
"""


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter that knows a question that takes years."""
    with Interpreter(clock="virtual", output=io.StringIO()) as made:
        made.eval(FACTS)
        yield made


def test_others_have_their_turns_while_a_query_runs(agent: Interpreter) -> None:
    agent.eval("(or-parallel (endless) (dotimes (number 3) (push number *log*) (sleep 0.01)))")
    assert agent.eval("*log*") == [2, 1, 0]


@pytest.mark.parametrize(
    "query",
    [
        "(endless)",
        "(with-query-bindings '(and (node ?a) (node ?b) (node ?c) (node ?d) (not (node ?d))) #?a)",
        "(db-query '(and (node ?a) (node ?b) (node ?c) (node ?d) (< ?d 0)))",
    ],
)
def test_a_deadline_ends_a_query(agent: Interpreter, query: str) -> None:
    with pytest.raises(Failure) as caught:
        agent.eval(f"(with-deadline (0.05) {query})")
    assert caught.value.cause.name == "DEADLINE-EXPIRED"
    assert not any(relation.views for relation in agent.database.relations.values())


def test_a_task_is_aborted_in_its_query_and_cleans_up(agent: Interpreter) -> None:
    agent.eval("""
      (let ((task (spawn (with-cleanup-procedure (push 1 *log*) (endless)))))
        (sleep 0.01)
        (abort-task task)
        (wait-for-task task))
    """)
    assert agent.eval("*log*") == [1]
    assert not agent.database.pauses.left


def test_what_others_change_meanwhile_is_not_in_the_answer(agent: Interpreter) -> None:
    agent.eval("""
      (task-net (asks (push (length (db-query '(and (node ?a) (node ?b)))) *log*))
                (changes (dotimes (number 5)
                           (retract `(node ,(* 10 number)))
                           (push number *log*)
                           (sleep 0.001))))
    """)
    log = agent.eval("*log*")
    assert 10_000 in log and log.index(10_000) < 4  # others changed facts before it was done
    assert len(agent.eval("(db-query '(node ?x))")) == 95


def test_nobody_has_a_turn_within_without_interrupts(agent: Interpreter) -> None:
    agent.eval("""
      (task-net (asks (without-interrupts (db-query '(and (node ?a) (node ?b))) (push 1 *log*)))
                (other (push 2 *log*)))
    """)
    assert agent.eval("*log*") == [2, 1]


def test_a_change_while_a_condition_is_asked_is_not_lost(agent: Interpreter) -> None:
    agent.eval("(defrelation marked)")
    agent.eval("""
      (task-net (waits (wait-until (and (node ?a) (node ?b) (marked ?a ?b)) :timeout 10) (push 1 *log*))
                (marks (assert '(marked 3 4)) (push 2 *log*)))
    """)
    assert agent.eval("*log*") == [1, 2]


def test_a_deadline_ends_a_condition_that_takes_years_to_ask(agent: Interpreter) -> None:
    agent.eval("(defrelation marked)")
    with pytest.raises(Failure) as caught:
        agent.eval("""
          (with-deadline (0.1)
            (wait-until (and (node ?a) (node ?b) (node ?c) (node ?d) (node ?e) (marked ?a ?e))))
        """)
    assert caught.value.cause.name == "DEADLINE-EXPIRED"
