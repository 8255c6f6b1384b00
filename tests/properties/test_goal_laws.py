"""Laws of top-level goals: whatever they are, their pursuit keeps its promises (decision 37)."""

from __future__ import annotations

import sys
from io import StringIO
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from eslang import Failure, Interpreter

pytestmark = pytest.mark.slow
LAW = settings(max_examples=25, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])

WORLD = """
(defrelation f (n)) (defrelation g (n)) (defproperty p (v))
(to-achieve (f ?n) ((< (random 10) 8) (if (< (random 10) 7) (assert '(f #?n)) (fail :lost))))
(to-achieve (p ?v) (t (sleep 0.3) (assert '(p #?v))))
(defaction act (name) (note name))
(defvar *heat* 0)
(defun cool? () (< *heat* 2))
(to-achieve (cool?) (t (setq *heat* 0)))
(defun want () (let ((n (+ 10 (random 9)))) (add-goal (achieve `(g ,n)) :by (assert `(g ,n)))))
"""
PURSUE = "(with-recovery-procedures (((:impossible-goals goals) (abort goals))) (pursue-goals))"
NUMBERS = st.integers(0, 3)
ACTIONS = st.one_of(
    st.sampled_from(
        [
            "(act :a)",
            "(incf *heat*)",
            "(sleep 1)",
            "(sleep 0.5)",
            "(want)",
            "(if (< (random 10) 4) (fail :slip))",
        ]
    ),
    NUMBERS.map(lambda n: f"(assert '(f {n}))"),
    NUMBERS.map(lambda n: f"(retract '(f {n}))"),
    NUMBERS.map(lambda n: f"(drop-goal (achieve (g {n})))"),
    NUMBERS.map(lambda n: f"(with-maintained-properties ((p {n % 2})) (sleep 1))"),
)
STEPS = st.recursive(
    ACTIONS,
    lambda inner: st.one_of(
        st.lists(inner, min_size=1, max_size=3).map(lambda steps: f"(scs:do {' '.join(steps)})"),
        st.lists(inner, min_size=1, max_size=3).map(lambda steps: f"(do-all {' '.join(steps)})"),
        inner.map(lambda step: f"(with-cleanup-procedure (sleep 0.2) {step})"),
    ),
    max_leaves=5,
)
UTILITIES = st.sampled_from(["", "", ":utility 1", ":utility 2", ":utility (random 3)"])


@st.composite
def goals(draw: Any) -> str:
    """A form that gives a goal."""
    kind, number, utility = draw(st.integers(0, 4)), draw(NUMBERS), draw(UTILITIES)
    if kind == 0:
        return f"(add-goal (maintain (f {number})) {utility} :retries 30)"
    if kind == 1:
        return f"(add-goal (achieve (f {number})) {utility} :retries 30)"
    if kind == 2:
        return f"(add-goal (maintain (cool?)) {utility})"
    steps = " ".join(draw(st.lists(STEPS, max_size=3)))
    return (
        f"(add-goal (achieve (g {number})) :by (scs:do {steps} (assert '(g {number}))) {utility} :retries 30)"
    )


class World:
    """An agent with goals, and what became of them."""

    def __init__(self, text: str, seed: int, shuffle: bool = False) -> None:
        self.trace: list[str] = []
        self.notes: list[str] = []
        limit = sys.getrecursionlimit()
        self.agent = Interpreter(
            clock="virtual", seed=seed, shuffle=shuffle, output=StringIO(), listeners=[self.hear]
        )
        sys.setrecursionlimit(limit)  # Hypothesis wants it as it was
        self.agent.primitive(name="note")(lambda name: self.notes.append(name.name))
        self.agent.eval(WORLD + text)

    def hear(self, event: Any) -> None:
        """Write down what happens; a goal that is achieved holds then."""
        self.trace.append(f"{event.time} {event.task} {event.kind} {list(event.data.values())[:2]}")
        if event.kind == "goal-changed" and event.data["change"] == "achieved":
            assert self.agent.facts.holds(event.data["goal"].cdr.car)

    def check_the_end(self, ended: bool) -> None:
        """Nothing is left of a pursuit but goals, which hold if it ENDED by itself."""
        agent = self.agent
        for goal in agent.goals:
            assert str(goal.status) == ":PENDING"
            assert not ended or (goal.is_maintained and agent.facts.holds(goal.condition)), goal
        assert agent.agenda is None or agent.agenda.pursuit is None
        assert (agent.runs.lives.count, len(agent.scheduler.timers)) == (0, 0)
        assert (agent.scheduler.polls.waits, agent.database.subscribers) == ([], [])


@LAW
@given(st.lists(goals(), min_size=1, max_size=5), st.integers(0, 99), st.booleans())
def test_nothing_is_left_of_a_pursuit_but_goals_that_hold(
    given_goals: list[str], seed: int, shuffle: bool
) -> None:
    world = World("\n".join(given_goals), seed, shuffle)
    with world.agent as agent:
        agent.eval(PURSUE)
        world.check_the_end(ended=True)


@LAW
@given(st.lists(goals(), min_size=1, max_size=4), st.floats(0, 4), st.integers(0, 99), st.booleans())
def test_it_can_be_left_at_any_time(given_goals: list[str], moment: float, seed: int, shuffle: bool) -> None:
    world = World("\n".join(given_goals), seed, shuffle)
    with world.agent as agent:
        agent.eval(f"(spawn (progn (sleep {moment}) (assert '(evening))))")
        found = agent.eval(f"(scs:do :until (evening) {PURSUE})")
        agent.finish()
        world.check_the_end(ended=str(found) != ":DEACTIVATED")


@LAW
@given(st.lists(goals(), min_size=1, max_size=4), st.integers(0, 99))
def test_the_same_seed_gives_the_same_trace(given_goals: list[str], seed: int) -> None:
    traces = []
    for _ in range(2):
        world = World("\n".join(given_goals), seed)
        with world.agent as agent:
            agent.eval(PURSUE)
        traces.append(world.trace)
    assert traces[0] == traces[1]


@LAW
@given(st.lists(st.tuples(st.integers(0, 3), st.integers(1, 4)), min_size=1, max_size=5), st.integers(0, 99))
def test_without_waits_goals_are_done_in_the_order_of_their_utilities(
    worths: list[tuple[int, int]], seed: int
) -> None:
    forms = [
        f"(add-goal (achieve (g {number})) :utility {worth} :by"
        f" (scs:do {f'(act :u{worth}) ' * actions} (assert '(g {number}))))"
        for number, (worth, actions) in enumerate(worths)
    ]
    world = World("\n".join(forms), seed)
    with world.agent as agent:
        assert agent.eval("(pursue-goals)") is True
    assert world.notes == sorted(world.notes, reverse=True)


@LAW
@given(
    st.lists(st.sampled_from(["(fail :impossible 3)", "(car 5)", "(assert '(f 1))"]), min_size=1, max_size=4)
)
def test_every_goal_that_is_impossible_is_told_at_the_end(steps: list[str]) -> None:
    forms = [
        f"(add-goal (achieve (g {number})) :by (scs:do {step} (assert '(g {number}))))"
        for number, step in enumerate(steps)
    ]
    world = World("\n".join(forms), 0)
    bad = {str(number) for number, step in enumerate(steps) if "f 1" not in step}
    with world.agent as agent:
        try:
            agent.eval("(pursue-goals)")
            told: set[str] = set()
        except Failure as failure:
            told = {str(each[0][1][1]) for each in failure.arguments[0]}
        assert told == bad
