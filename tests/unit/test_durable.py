"""The durable store: what is kept, when it is written, and what cannot be kept."""

from __future__ import annotations

import asyncio
import os
import sqlite3
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from eslang import Failure, Interpreter
from eslang.base.symbols import Symbol
from eslang.store_file import StoreFile

Make = Callable[..., Interpreter]


@pytest.fixture
def make(tmp_path: Path) -> Iterator[Make]:
    """Makes interpreters whose facts are kept in one file; they are closed at the end."""
    made: list[Interpreter] = []

    def new(**given: Any) -> Interpreter:
        made.append(Interpreter(clock="virtual", facts=tmp_path / "agent.db", **given))
        return made[-1]

    yield new
    for each in made:
        each.close()


def written(agent: Interpreter) -> list[str]:
    """What stands in the file of AGENT, which goes on holding it."""
    journal: Any = agent.database.journal
    return [text for _, text in journal.file.facts()]


def held(agent: Interpreter) -> list[str]:
    """What AGENT knows."""
    return [str(fact).lower() for fact in agent.database.facts()]


# --- what is kept ------------------------------------------------------------------------


def test_the_next_interpreter_begins_with_the_facts_of_the_last_in_their_order(make: Make) -> None:
    with make() as agent:
        agent.eval("""(assert '(b 1)) (assert '(b 2)) (assert '(a "x" (1.5 . #\\a)))
                      (retract '(b 1)) (assert '(b 1)) (update '(a ?x ?y) '(a "x" |odd|))""")
        before = held(agent)
    assert before == ["(b 2)", "(b 1)", '(a "x" |odd|)']
    assert held(make()) == before


def test_facts_may_be_of_packages_that_are_not_there_yet(make: Make) -> None:
    program = "(defpackage :robot (:use :cl :esl) (:shadow :list) (:export :arm)) (in-package :robot)"
    with make() as agent:
        agent.eval(program)
        agent.eval("(esl:assert '(list arm cl:list nil t esl-user::x :k))")
    agent = make()
    agent.eval(program)
    assert agent.eval("(esl:db-query '(robot::list robot:arm cl:list nil t esl-user::x :k))")


def test_a_name_of_esl_user_that_the_library_takes_over_is_that_of_the_library(make: Make) -> None:
    with make() as agent:
        agent.database.add(agent.to_lisp([Symbol("CAR"), Symbol.intern("CAR", "COMMON-LISP")]))
        assert written(agent) == ["(esl-user::car car)"]
    relation = next(iter(make().database.relations.values()))
    assert relation.name is Symbol("CAR") and next(iter(relation.rows)) == (Symbol("CAR", "COMMON-LISP"),)


def test_rules_and_declarations_belong_to_the_program(make: Make) -> None:
    with make() as agent:
        agent.eval("(defproperty power) (defrule (on ?x) (power ?x :on)) (assert '(power w1 :on))")
        assert agent.eval("(db-query '(on ?x))")
    again = make()
    assert again.eval("(db-query '(on w1))") is None
    again.eval("(defproperty power) (defrule (on ?x) (power ?x :on)) (assert '(power w1 :off))")
    assert held(again) == ["(power w1 :off)"]


def test_a_property_that_is_declared_later_keeps_the_last_value_in_the_file_too(make: Make) -> None:
    agent = make()
    agent.eval("(assert '(power w1 :on)) (assert '(power w1 :off))")
    agent.eval("(defproperty power)")
    assert written(agent) == ["(power w1 :off)"]


def test_listeners_do_not_hear_of_facts_that_were_there(make: Make) -> None:
    with make() as agent:
        agent.eval("(assert '(a b))")
    heard: list[str] = []
    make(listeners=[lambda event: heard.append(event.kind)]).eval("(assert '(c d))")
    assert heard.count("fact") == 1


# --- when it is written --------------------------------------------------------------------


def transactions(agent: Interpreter) -> list[list[str]]:
    """What the file holds after each transaction, from now on."""
    journal: Any = agent.database.journal
    write, found = journal.file.write, []

    def note(*given: Any) -> None:
        write(*given)
        found.append(written(agent))

    journal.file.write = note
    return found


def test_a_call_that_never_waits_is_one_transaction(make: Make) -> None:
    agent = make()
    found = transactions(agent)
    agent.eval("(progn (assert '(a 1)) (assert '(a 2)) (retract '(a 1)) (assert '(a 3)))")
    assert found == [["(a 2)", "(a 3)"]]


def test_each_step_of_each_task_is_one_transaction(make: Make) -> None:
    agent = make()
    agent.eval("""(defun go-on ()
                    (task-net (one (assert '(a 1)) (assert '(a 2)) (yield) (retract '(a 1)) (assert '(a 3)))
                              (two (assert '(b 1)) (sleep 1) (update '(b ?x) '(b 2)))))""")
    found = transactions(agent)
    agent.call("go-on")
    assert found == [
        ["(a 1)", "(a 2)"],
        ["(a 1)", "(a 2)", "(b 1)"],
        ["(a 2)", "(b 1)", "(a 3)"],
        ["(a 2)", "(a 3)", "(b 2)"],
    ]


def test_steps_that_change_nothing_cost_no_transaction_and_no_turn_of_the_driver(make: Make) -> None:
    form = "(task-net (a (dotimes (i 100) (yield))) (b (dotimes (i 100) (yield))))"
    agent = make()
    agent.eval(f"(defun go-on () {form})")
    found, rounds = transactions(agent), []
    agent.scheduler.between = lambda: rounds.append(1)
    agent.call("go-on")
    assert not found and len(rounds) < 50


def test_the_end_of_a_time_slice_is_the_end_of_a_step(make: Make) -> None:
    agent = make()
    agent.eval("(defun go-on () (dotimes (i 2500) (assert (list 'n i))))")
    found = transactions(agent)
    agent.call("go-on")
    assert [len(each) for each in found][-1] == 2500 and len(found) == 3


def test_without_interrupts_is_one_step(make: Make) -> None:
    agent = make()
    agent.eval("(defun go-on () (without-interrupts (dotimes (i 2500) (assert (list 'n i)))))")
    found = transactions(agent)
    agent.call("go-on")
    assert [len(each) for each in found] == [2500]


def test_what_cleanups_of_a_failed_call_change_is_written_when_the_call_has_ended(make: Make) -> None:
    agent = make()
    with pytest.raises(Failure):
        agent.eval("(with-cleanup-procedure (assert '(cleaned up)) (assert '(a b)) (fail :oops))")
    assert written(agent) == ["(a b)", "(cleaned up)"]


def test_what_python_changes_between_two_calls_is_written_at_once(make: Make) -> None:
    agent = make()
    found = transactions(agent)
    agent.database.add_all([agent.to_lisp([Symbol("A"), number]) for number in range(3)])
    agent.facts.add("a", 7)
    agent.database.retract(agent.to_lisp([Symbol("A"), 1]))
    assert found == [
        ["(a 0)", "(a 1)", "(a 2)"],
        ["(a 0)", "(a 1)", "(a 2)", "(a 7)"],
        ["(a 0)", "(a 2)", "(a 7)"],
    ]


def test_a_call_within_an_asyncio_loop_is_written_when_it_has_ended(make: Make) -> None:
    agent = make()

    async def go_on() -> list[str]:
        await agent.call_async("assert", [Symbol("A"), 1])
        return written(agent)

    assert asyncio.run(go_on()) == ["(a 1)"]


def test_what_other_threads_change_is_written_too(make: Make) -> None:
    agent = make()
    other = threading.Thread(target=agent.facts.add, args=("a", 1))
    other.start()
    other.join()
    assert written(agent) == ["(a 1)"]
    agent.primitive(name="learn", blocking=True)(lambda: agent.facts.add("a", 2))
    agent.eval("(task-net (b (learn)) (c (assert '(c 1))))")
    assert sorted(written(agent)) == ["(a 1)", "(a 2)", "(c 1)"]


def test_an_update_is_whole_even_if_a_listener_waits_in_its_midst(make: Make) -> None:
    agent = make()
    agent.eval("(assert '(n 0)) (defun linger () (dotimes (i 3000)))")
    found = transactions(agent)
    agent.database.subscribe(lambda change: agent.call("linger"))
    agent.eval("(update '(n ?x) '(n 1))")
    assert all(each == ["(n 1)"] for each in found) and found


# --- what cannot be kept ----------------------------------------------------------------------


@pytest.mark.parametrize("term", ["#'car", '(make-symbol "X")', "(vector 1)", "(make-hash-table)", "(cup)"])
def test_what_has_no_text_is_refused_when_it_is_asserted_and_not_held(make: Make, term: str) -> None:
    agent = make()
    agent.primitive(name="cup")(lambda: object())
    agent.eval("(assert '(holds me :nothing))")
    for form in (
        f"(assert (list 'holds 'me {term}))",
        f"(update '(holds me ?x) (list 'holds 'me {term}))",
        f"(assert (list 'holds 'me (list 1 {term})))",
    ):
        with pytest.raises(Failure, match="this fact cannot be kept in"):
            agent.eval(form)
    assert held(agent) == ["(holds me :nothing)"]


def test_a_plan_can_recover_from_that(make: Make) -> None:
    form = "(with-recovery-procedures ((:error (abort :refused))) (assert (list 'f #'car)))"
    assert str(make().eval(form)) == ":REFUSED"


def test_a_closed_interpreter_lets_go_of_the_file(make: Make) -> None:
    agent = make()
    agent.close()
    with pytest.raises(Failure, match="CLOSED"):
        agent.database.add(agent.to_lisp([Symbol("A")]))
    assert held(make()) == []


# --- when the disk is full --------------------------------------------------------------------


class Full:
    """Lets the file of an interpreter take nothing while it is `full`."""

    def __init__(self, agent: Interpreter) -> None:
        journal: Any = agent.database.journal
        self.full = True
        self.file: StoreFile = journal.file
        self.write, journal.file.write = journal.file.write, self

    def __call__(self, *given: Any) -> None:
        if self.full:
            raise self.file.trouble("the disk is full")
        self.write(*given)


def test_a_call_whose_changes_cannot_be_written_fails(make: Make) -> None:
    agent = make()
    disk = Full(agent)
    with pytest.raises(Failure, match="the disk is full"):
        agent.eval("(assert '(a 1))")
    disk.full = False
    agent.eval("(assert '(a 2))")
    assert written(agent) == ["(a 1)", "(a 2)"]


def test_the_task_that_the_run_waits_for_is_told_once_and_can_go_on(make: Make) -> None:
    agent = make()
    disk = Full(agent)
    agent.primitive(name="make-room")(lambda: setattr(disk, "full", False))
    found = agent.eval("""
        (let ((told 0))
          (with-recovery-procedures ((:error :retries 9 (incf told) (sleep 10) (make-room)))
            (spawn (dotimes (i 5) (assert (list 'n i)) (sleep 1)))
            (sleep 30)
            told))""")
    assert found == 1
    assert len(written(agent)) == 5


def test_what_could_not_be_written_to_the_end_is_told_when_the_interpreter_closes(make: Make) -> None:
    agent = make()
    Full(agent)
    with pytest.raises(Failure):
        agent.eval("(assert '(a 1))")
    with pytest.raises(Failure, match="the disk is full"):
        agent.close()
    assert held(make()) == []


def test_a_call_in_an_asyncio_loop_whose_changes_cannot_be_written_fails(make: Make) -> None:
    agent = make()
    disk = Full(agent)
    with pytest.raises(Failure, match="the disk is full"):
        asyncio.run(agent.call_async("assert", [Symbol("A"), 1]))
    disk.full = False


def test_a_change_from_python_that_cannot_be_written_fails(make: Make) -> None:
    agent = make()
    Full(agent)
    with pytest.raises(Failure, match="the disk is full"):
        agent.database.add(agent.to_lisp([Symbol("A")]))
    with pytest.raises(Failure):
        agent.close()


def test_a_process_made_by_fork_neither_writes_nor_closes_the_file(make: Make, tmp_path: Path) -> None:
    agent = make()
    agent.eval("(assert '(a 1))")
    journal: Any = agent.database.journal
    journal.file._process += 1  # as if this were another process
    with pytest.raises(Failure, match="it belongs to the process that has opened it"):
        agent.eval("(assert '(a 2))")
    journal.file._process -= 1
    agent.eval("(assert '(a 3))")
    agent.close()
    with sqlite3.connect(tmp_path / "agent.db") as raw:
        assert raw.execute("SELECT count(*) FROM fact").fetchone() == (3,)
    raw.close()
    assert os.listdir(tmp_path) == ["agent.db"]
