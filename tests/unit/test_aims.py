"""`agent.add_goal`, `agent.drop_goal`, `agent.goals`: from Python, in any thread."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from around import Worker, in_thread, whole_agent
from eslang import Failure, Interpreter, Keyword

PLANS = """
(defproperty lamp (where state)) (defevent go) (defevent done)
(to-achieve (lamp ?where ?state) (t (assert '(lamp #?where #?state))))
"""


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter that waits for the outside."""
    with whole_agent(PLANS, outside=True) as made:
        yield made


def when_waiting(agent: Interpreter, work: Callable[[], Any], on: str = "goals") -> Worker:
    """A worker that begins when a task of AGENT begins to wait for goals."""
    begun = threading.Event()

    def listen(event: Any) -> None:
        if event.kind == "wait" and event.data["on"] == on:
            begun.set()

    agent.hooks.listeners.append(listen)
    return Worker(lambda: work() if begun.wait(10) else "nobody waits")


# --- where nothing is at work ---------------------------------------------------------------


def test_goals_are_given_as_text_or_lists_and_come_back(agent: Interpreter) -> None:
    goal = agent.add_goal("(achieve (lamp hall :on))")
    assert goal is not None and agent.goals == [goal]
    assert (str(goal), repr(goal)) == ("(achieve (lamp hall :on))", "#<GOAL (ACHIEVE (LAMP HALL :ON))>")
    assert agent.add_goal(["achieve", ["lamp", "hall", ":on"]]) is goal
    assert agent.eval("(goals)") == [goal]
    assert agent.eval("(pursue-goals :wait nil)") is True
    assert (goal.status, agent.goals) == (Keyword("achieved"), [])
    assert agent.facts.holds("(lamp hall :on)")


def test_goals_are_dropped_by_themselves_or_by_what_they_say(agent: Interpreter) -> None:
    goal = agent.add_goal("(maintain (lamp hall ?_))")
    assert goal is not None
    assert agent.drop_goal(goal) is True
    assert agent.drop_goal(goal) is False
    agent.add_goal("(maintain (lamp attic :off))")
    assert agent.drop_goal("(maintain (lamp attic :off))") is True
    assert agent.drop_goal("(achieve (lamp attic :off))") is False
    assert agent.goals == []


def test_a_condition_may_ask_functions(agent: Interpreter) -> None:
    agent.eval(
        "(defvar *level* 0) (defun full? (n) (>= *level* n)) (to-achieve (full? ?n) (t (incf *level*)))"
    )
    agent.add_goal("(achieve (full? 3))")
    agent.eval("(pursue-goals :wait nil)")
    assert agent.value("*level*") == 3


@pytest.mark.parametrize("utility", [9, 9.5, lambda: 9])
def test_a_utility_is_a_number_or_a_function(agent: Interpreter, utility: Any) -> None:
    told: list[str] = []
    agent.primitive(name="tell")(told.append)
    agent.eval(
        "(defstep tell-twice (x) (tell (symbol-name x)) (tell (symbol-name x)) (assert (list 'done x)))"
        "(to-achieve (done ?x) (t (tell-twice #?x)))"
    )
    agent.add_goal("(achieve (done low))")
    agent.add_goal("(achieve (done high))", utility=utility)
    agent.eval("(pursue-goals :wait nil)")
    assert told == ["HIGH", "HIGH", "LOW", "LOW"]


def test_retries_limit_the_attempts(agent: Interpreter) -> None:
    tries: list[int] = []

    @agent.primitive
    def grip() -> None:
        tries.append(1)
        raise Failure("slipped")

    agent.eval("(to-achieve (held cup) (t (grip)))")
    goal = agent.add_goal("(achieve (held cup))", retries=2)
    with pytest.raises(Failure, match="IMPOSSIBLE-GOALS"):
        agent.eval("(pursue-goals :wait nil)")
    assert goal is not None
    assert (len(tries), goal.status, str(goal.failure)) == (3, Keyword("impossible"), "failure :SLIPPED")


def test_what_is_no_goal_is_refused(agent: Interpreter) -> None:
    for wrong in ("(lamp hall :on)", "(achieve)", ["maintain", "a", "b"], "achieve"):
        with pytest.raises(Failure, match="TYPE-ERROR"):
            agent.add_goal(wrong)
    with pytest.raises(Failure, match="TYPE-ERROR"):
        agent.add_goal("(achieve (lamp hall :on))", utility="high")  # type: ignore[arg-type]
    with pytest.raises(Failure, match="TYPE-ERROR"):
        agent.add_goal("(achieve (lamp hall :on))", retries=-1)
    with pytest.raises(Failure, match="TYPE-ERROR"):
        agent.drop_goal("lamp")
    assert agent.goals == []


# --- while goals are pursued ----------------------------------------------------------------


def test_goals_from_another_thread_are_taken_up_while_goals_are_awaited(agent: Interpreter) -> None:
    ended: list[str] = []

    def listen(event: Any) -> None:
        if event.kind == "goal-changed" and event.data["change"] == "achieved":
            ended.append(str(event.data["goal"]))
            agent.signal("done")

    agent.hooks.listeners.append(listen)
    worker = when_waiting(agent, lambda: [agent.add_goal("(achieve (lamp hall :on))"), len(agent.goals) <= 1])
    agent.eval("(or-parallel (pursue-goals) (wait-for-events done))")
    assert worker.end() == [None, True]
    assert ended == ["(ACHIEVE (LAMP HALL :ON))"]


def test_goals_are_dropped_from_another_thread(agent: Interpreter) -> None:
    agent.primitive(name="note")(lambda: left.append("cleaned"))
    left: list[str] = []
    agent.eval("(to-achieve (never) (t (with-cleanup-procedure (note) (wait-for-events go))))")
    agent.add_goal("(achieve (never))")
    worker = when_waiting(agent, lambda: agent.drop_goal("(achieve (never))"), "events")
    assert agent.eval("(pursue-goals :wait nil)") is True
    assert (worker.end(), left, agent.goals) == (None, ["cleaned"], [])


def test_a_goal_that_is_maintained_is_woken_by_a_fact_from_another_thread(agent: Interpreter) -> None:
    agent.eval(
        "(defproperty battery) (to-achieve (battery :full) (t (assert '(battery :full)) (signal done)))"
    )
    agent.facts.add("battery", ":full")
    agent.add_goal("(maintain (battery :full))")
    worker = when_waiting(agent, lambda: agent.facts.update("(battery ?_)", "(battery :low)"))
    agent.eval("(or-parallel (pursue-goals) (wait-for-events done))")
    assert worker.end() is None
    assert agent.facts.holds("(battery :full)")
    assert len(agent.goals) == 1


def test_a_mistake_from_another_thread_is_found_where_it_is_made(agent: Interpreter) -> None:
    def mistake() -> str:
        with pytest.raises(Failure) as caught:
            agent.add_goal("(attain (lamp hall :on))")
        agent.signal("go")
        return str(caught.value.cause)

    worker = when_waiting(agent, mistake, "events")
    agent.eval("(wait-for-events go)")
    assert (worker.end(), agent.goals) == (":TYPE-ERROR", [])


def test_a_primitive_gives_goals(agent: Interpreter) -> None:
    agent.primitive(name="plan-ahead")(lambda: agent.add_goal("(achieve (lamp attic :on))"))
    agent.eval("(add-goal (achieve (lamp hall :on)) :by (progn (plan-ahead) (assert '(lamp hall :on))))")
    agent.eval("(pursue-goals :wait nil)")
    assert len(agent.facts.query("(lamp ?x :on)")) == 2


def test_who_leaves_a_goal_does_not_wait_even_if_the_step_waits_for_it(agent: Interpreter) -> None:
    agent.primitive(name="ask-around")(lambda: in_thread(lambda: agent.add_goal("(achieve (lamp hall :on))")))
    assert agent.eval("(list (ask-around) (goals))") == [None, None]
    assert [str(goal) for goal in agent.goals] == ["(achieve (lamp hall :on))"]
