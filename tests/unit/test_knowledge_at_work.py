"""`agent.facts` inside plans and coroutines, and its subscribers."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from typing import Any

import pytest

from around import Worker, in_thread, run, turns, whole_agent
from eslang import Failure, Interpreter, Keyword, Symbol, Text
from eslang.knowledge import Change

PLANS = "(defvar *told* nil) (defun note (it) (push it *told*))"
W2 = Symbol("w2")


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter on virtual time."""
    with whole_agent(PLANS, clock="virtual") as made:
        yield made


def cause_of(work: Any) -> Any:
    """The cause of the failure that WORK raises."""
    with pytest.raises(Failure) as caught:
        work()
    return caught.value.cause


# --- inside a plan ------------------------------------------------------------------------


def test_primitives_use_facts_at_once(agent: Interpreter) -> None:
    @agent.primitive
    def look() -> int:
        agent.facts.add("seen", "cup")
        return len(agent.facts.query("(seen ?x)"))

    assert agent.eval("(list (look) (db-query '(seen cup)))") == [1, [None]]


def test_a_wrong_fact_in_a_primitive_is_a_failure_of_the_plan(agent: Interpreter) -> None:
    agent.primitive(name="look")(lambda: agent.facts.add("seen", "?x"))
    text = "(with-recovery-procedures (((:unbound-logic-variable v) (abort v))) (look))"
    assert agent.eval(text) is Symbol("?x")


def test_a_query_sees_the_bindings_around_the_primitive(agent: Interpreter) -> None:
    agent.facts.add_all(["(is-a w1 widget)", "(is-a w2 widget)", "(health w2 :ok)"])
    agent.primitive(name="ok-p")(lambda: agent.facts.holds("(health #?w :ok)"))
    assert agent.eval("(with-query-bindings '(is-a ?w widget) (if (ok-p) #?w (next-bindings)))") is W2
    assert cause_of(lambda: agent.facts.holds("(health #?w :ok)")) is Keyword("unbound-variable")


def test_a_change_wakes_who_waits_for_it(agent: Interpreter) -> None:
    agent.primitive(name="switch-on")(lambda: agent.facts.add("power", "radio", ":on"))
    text = (
        "(multiple-value-list (task-net (a (wait-until (power radio :on)) :woken) (b (sleep 1) (switch-on))))"
    )
    assert agent.eval(text) == [Keyword("woken"), True]


def test_a_change_between_two_calls_wakes_who_waits_for_it(agent: Interpreter) -> None:
    agent.eval(
        "(defvar *told* nil) (spawn (progn (wait-until (power radio :on)) (push :woken *told*))) (yield)"
    )
    agent.facts.add("power", "radio", ":on")
    agent.facts.remove("power", "radio", ":on")
    agent.facts.add("power", "radio", ":on")
    agent.finish()
    assert agent.value("*told*") == [Keyword("woken")]


def test_a_name_is_of_the_package_that_is_current(agent: Interpreter) -> None:
    agent.eval("(make-package :robot)")
    agent.facts.add("robot::is-a", "robot::w1")
    agent.eval("(in-package :robot)")
    assert agent.facts.query("(is-a ?what)")[0]["what"] is Symbol("w1", "robot")


# --- coroutines -----------------------------------------------------------------------------


def test_a_coroutine_changes_facts_between_the_steps_of_a_guest(agent: Interpreter) -> None:
    agent.eval("(defun watch-for (it) (wait-until `(seen ,it)) (list :saw it))")

    async def main() -> Any:
        calls = [asyncio.ensure_future(agent.call_async("watch-for", Symbol(it))) for it in ("cup", "jug")]
        await turns()
        assert agent.facts.add("seen", "cup") is True
        assert agent.facts.query("(seen ?x)") == [{"x": Symbol("cup")}]
        first = await calls[0]
        assert not calls[1].done()
        worker = Worker(lambda: agent.facts.add("seen", "jug"))
        second = await calls[1]
        assert worker.end() in (True, None)
        return [first, second]

    saw = Keyword("saw")
    assert run(main) == [[saw, Symbol("cup")], [saw, Symbol("jug")]]


def test_coroutines_of_a_plain_call_change_facts_while_the_plan_rests(agent: Interpreter) -> None:
    @agent.primitive
    async def look() -> bool:
        await asyncio.sleep(0)
        agent.facts.add("seen", "cup")
        await asyncio.get_running_loop().run_in_executor(None, lambda: agent.facts.add("seen", "jug"))
        while not agent.facts.holds("(noticed)"):
            await asyncio.sleep(0)
        return agent.facts.holds("(seen jug)")

    text = "(multiple-value-list (task-net (a (look)) (b (wait-until (seen cup)) (assert '(noticed)) :saw)))"
    assert agent.eval(text) == [True, Keyword("saw")]


def test_a_foreign_loop_does_not_take_the_tasks_of_an_interpreter_at_home_elsewhere(
    agent: Interpreter,
) -> None:
    agent.eval("(spawn (progn (wait-until (seen cup)) (note :woken))) (yield)")

    async def elsewhere() -> Any:
        found = agent.facts.add("seen", "cup")
        with pytest.raises(Failure, match="live in another thread"):
            agent.eval("1")
        await turns()
        return found

    assert in_thread(lambda: asyncio.run(elsewhere())) is True
    assert agent.outside.guest.loop is None
    agent.finish()
    assert agent.value("*told*") == [Keyword("woken")]


# --- subscribers --------------------------------------------------------------------------


def test_a_subscriber_hears_of_each_change_until_it_unsubscribes(agent: Interpreter) -> None:
    told: list[Change] = []
    unsubscribe = agent.facts.subscribe(told.append)
    agent.facts.add("at", "cup", ["point", Text("x")])
    agent.facts.add("at", "cup", ["point", Text("x")])
    agent.eval("(retract '(at cup ?_))")
    unsubscribe()
    unsubscribe()
    agent.facts.add("at", "cup", 3)
    assert [(change.added, change.relation) for change in told] == [
        (True, Symbol("at")),
        (False, Symbol("at")),
    ]
    assert told[0].terms == (Symbol("cup"), [Symbol("point"), "x"])
    assert agent.facts.add(told[0].fact) and told[0].fact in agent.facts


def test_a_subscriber_may_hear_of_one_relation_only(agent: Interpreter) -> None:
    told: list[Change] = []
    agent.facts.subscribe(told.append, "at")
    agent.facts.add_all(["(at cup)", "(is-a cup thing)", "(at cup tray)"])
    assert [change.terms for change in told] == [(Symbol("cup"),), (Symbol("cup"), Symbol("tray"))]


def test_the_same_subscriber_may_come_twice(agent: Interpreter) -> None:
    told: list[Change] = []
    first, second = agent.facts.subscribe(told.append), agent.facts.subscribe(told.append)
    agent.facts.add("raining")
    assert len(told) == 2
    first()
    agent.facts.add("snowing")
    assert len(told) == 3
    second()


def test_a_subscriber_may_change_facts_and_unsubscribe(agent: Interpreter) -> None:
    facts, told = agent.facts, []

    def note(change: Change) -> None:
        told.append(str(change.relation))
        if not change.terms:
            facts.add("seen", "it")
            unsubscribe()

    other: list[Any] = []
    unsubscribe = facts.subscribe(note)
    facts.subscribe(other.append)
    facts.add("raining")
    assert told == ["RAINING"]
    assert [str(change.relation) for change in other] == ["RAINING", "SEEN"]


def test_what_a_subscriber_raises_is_a_failure_of_the_change_when_all_have_heard(agent: Interpreter) -> None:
    told: list[Change] = []

    def broken(change: Change) -> None:
        raise OSError("no display")

    agent.facts.subscribe(broken)
    agent.facts.subscribe(told.append)
    with pytest.raises(Failure) as caught:
        agent.facts.add("raining")
    assert caught.value.cause is Keyword("python-error")
    assert isinstance(caught.value.__cause__, OSError)
    assert "(raining)" in agent.facts and len(told) == 1
    text = "(with-recovery-procedures (((:python-error type why) (abort why))) (assert '(snowing)))"
    assert agent.eval(text) == "no display"
    assert agent.facts.holds("(snowing)") and len(told) == 2


def test_a_failure_of_a_subscriber_is_that_failure(agent: Interpreter) -> None:
    def refuse(change: Change) -> None:
        raise Failure("not-now", "really", [1])

    agent.facts.subscribe(refuse)
    with pytest.raises(Failure) as caught:
        agent.facts.add("raining")
    assert (caught.value.cause, caught.value.arguments) == (Keyword("not-now"), ("really", [1]))


def test_a_relation_to_hear_of_is_a_name(agent: Interpreter) -> None:
    assert cause_of(lambda: agent.facts.subscribe(print, 3)) is Keyword("type-error")  # type: ignore[arg-type]


def test_a_subscriber_cannot_call_the_interpreter_that_is_at_rest(agent: Interpreter) -> None:
    told: list[str] = []

    def call(change: Change) -> None:
        told.append(str(cause_of(lambda: agent.eval("1"))))

    agent.facts.subscribe(call)
    agent.facts.add("raining")
    assert told == [":CONTROL-ERROR"]


# --- ends ---------------------------------------------------------------------------------


def test_an_interpreter_that_is_closed_refuses_all() -> None:
    with Interpreter() as agent:
        agent.facts.add("raining")
        unsubscribe = agent.facts.subscribe(print)
    closed = Keyword("interpreter-closed")
    facts = agent.facts
    assert cause_of(lambda: facts.add("snowing")) is closed
    assert cause_of(lambda: facts.query("(raining)")) is closed
    assert cause_of(lambda: facts.subscribe(print)) is closed
    assert cause_of(lambda: list(facts)) is closed
    assert cause_of(lambda: len(facts)) is closed
    assert cause_of(lambda: "(raining)" in facts) is closed
    unsubscribe()
