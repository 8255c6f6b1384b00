"""Scenarios: what happens when, what is drawn, and what is refused."""

from __future__ import annotations

import pytest
from unit.devices.world import LAMP, craft, state

from eslang import EslError, Failure, Interpreter
from eslang.base.spans import Source
from eslang.devices.scenario import begin_scenario, scenario_of


def begin(agent: Interpreter, text: str) -> None:
    """Let the scenario TEXT happen."""
    begin_scenario(agent, scenario_of(agent, Source("test.scenario", text)))


def refused(text: str) -> str:
    """What is said of the scenario TEXT, which is wrong."""
    with craft() as agent:
        try:
            scenario_of(agent, Source("test.scenario", text))
        except EslError as error:
            return str(error)
    raise AssertionError(f"{text} is taken")


def moments(seed: int, text: str) -> list[float]:
    """When the sensors of the lamp tell something new, in a run of 100 seconds."""
    found: list[float] = []
    with craft() as agent:
        agent.seed = seed
        begin(agent, text)
        agent.eval("(turn-device-on :lamp)")
        agent.hooks.listeners.append(lambda event: found.append(event.time) if event.kind == "fact" else None)
        agent.eval("(dotimes (i 100) (random 5) (sleep 1) (break-device :lamp :ok))")
    return found


def test_what_is_to_happen_happens_at_its_moment_whatever_the_order_in_the_file() -> None:
    with craft() as agent:
        begin(agent, "(at 20 (break-device :lamp :ok)) (at 12.5 (break-device :lamp :single-event-upset))")
        agent.eval("(turn-device-on :lamp)")
        agent.eval("(wait-until (health-state :lamp :single-event-upset))")
        assert agent.clock.now() == pytest.approx(12.6)
        agent.eval("(wait-until (health-state :lamp :ok))")
        assert agent.clock.now() == pytest.approx(20.1)


def test_of_what_happens_at_the_same_moment_the_first_is_first() -> None:
    with craft() as agent:
        begin(agent, "(at 5 (break-widget :b1)) (at 5 (break-widget :b2) (break-widget :b3))")
        assert str(agent.eval("(progn (sleep 6) *widget-status*)")) == ":B3"


def test_an_action_may_take_time() -> None:
    with craft() as agent:
        begin(agent, "(at 5 (turn-device-on :lamp))")
        agent.eval("(sleep 6)")
        assert state(agent, ":lamp") == ":on"


def test_an_action_may_change_facts() -> None:
    with craft() as agent:
        begin(agent, "(at 5 (assert '(door :open)))")
        agent.eval("(wait-until (door :open))")
        assert agent.clock.now() == 5.0


def test_a_scenario_keeps_no_run_alive() -> None:
    with craft() as agent:
        begin(agent, "(at 1000 (break-device :lamp :single-event-upset))")
        agent.eval("(spawn (sleep 2))")
        agent.finish()
        assert agent.clock.now() == 2.0


def test_a_deadlock_is_told_when_nothing_is_left_to_happen() -> None:
    with craft() as agent:
        begin(agent, "(at 1000 (break-device :lamp :ok))")
        with pytest.raises(Failure, match="DEADLOCK"):
            agent.eval("(wait-until (door :open))")
        assert agent.clock.now() >= 1000


def test_an_action_that_fails_is_a_failure_of_the_run() -> None:
    with craft() as agent:
        begin(agent, "(devices :fan) (at 1 (break-device :fan :ok))")
        agent.eval("(sleep 2)")
        with pytest.raises(Failure, match="UNKNOWN-DEVICE"):
            agent.finish()


RANDOM = "(randomly :every 5 :probability 1/2 :until 100 (break-device :lamp :single-event-upset))"


def test_the_same_seed_gives_the_same_faults() -> None:
    assert moments(1, RANDOM) == moments(1, RANDOM) != moments(2, RANDOM)


def test_what_the_plan_draws_does_not_change_the_faults() -> None:
    with craft() as agent, craft() as other:
        for each in (agent, other):
            begin(each, RANDOM)
        agent.eval("(dotimes (i 10) (random 5))")
        heard: list[list[float]] = [[], []]
        for each, told in zip((agent, other), heard, strict=True):
            each.eval("(turn-device-on :lamp)")
            each.hooks.listeners.append(lambda event, told=told: told.append(event.time))
            each.eval("(sleep 100)")
        assert heard[0] == heard[1]


@pytest.mark.parametrize(("probability", "expected"), [("0", 0), ("1", 4)])
def test_what_is_certain_happens_each_time_and_what_is_impossible_never(
    probability: str, expected: int
) -> None:
    with craft() as agent:
        agent.eval("(defvar *count* 0)")
        agent.primitive(name="bump")(lambda: agent.set_value("*count*", agent.value("*count*") + 1))
        begin(agent, f"(randomly :every 2.5 :probability {probability} :until 10 (bump))")
        agent.eval("(sleep 20)")
        assert agent.value("*count*") == expected


def test_a_part_of_what_happens_may_have_a_probability_of_its_own() -> None:
    with craft() as agent:
        begin(agent, "(at 1 (with-probability 0 (break-widget :a)) (with-probability 1 (break-widget :b)))")
        assert str(agent.eval("(progn (sleep 2) *widget-status*)")) == ":B"


def test_random_moments_may_begin_later() -> None:
    with craft() as agent:
        begin(agent, "(randomly :every 5 :probability 1 :from 10 :until 20 (assert '(rain)))")
        agent.eval("(wait-until (rain))")
        assert agent.clock.now() == 15.0


def test_devices_that_the_plan_describes_are_declared_anywhere_in_the_file() -> None:
    with Interpreter() as agent:
        text = "(at 1 (break-device :fan :stuck)) (devices :fan)"
        assert len(scenario_of(agent, Source("test.scenario", text))) == 1


def test_the_devices_of_the_small_spacecraft_are_known() -> None:
    with Interpreter() as agent:
        assert scenario_of(agent, Source("test.scenario", "(at 1 (break-device :ega_x :stuck))"))


@pytest.mark.parametrize(
    ("text", "place", "said"),
    [
        ("(at -1 (break-device :lamp :ok))", "1:5", "a time is a number of seconds, not below 0"),
        ("(at soon (break-device :lamp :ok))", "1:5", "and not `soon`"),
        ("(at)", "1:1", "`at` needs a time"),
        ("(at 3)", "1:1", "nothing is to happen here"),
        ("\n  (att 3 (break-device :lamp :ok))", "2:3", "write `(at seconds action...)`"),
        ("bang", "1:1", "is nothing that a scenario can say"),
        ("(at 1 (brake-device :lamp :ok))", "1:8", "write `break-device`"),
        ("(at 1 (break-device :lmap :ok))", "1:21", "write `:lamp`"),
        ("(at 1 (break-device :fan :ok))", "1:21", "write `(devices :fan)`"),
        ("(at 1 (break-device :lamp :upset))", "1:27", "`:upset` is no health"),
        ("(at 1 (break-device :lamp))", "1:7", "`break-device` takes 2 arguments, found 1"),
        ("(at 1 (send-command :lamp :opperate))", "1:27", "write `:operate`"),
        ("(at 1 (break-device lamp :ok))", "1:21", "is not known before the run"),
        ("(at 1 :go)", "1:7", "is no action"),
        ("(at 1 (with-probability 2 (rain)))", "1:25", "a probability is a number from 0 to 1"),
        ("(at 1 (with-probability 1/2))", "1:7", "needs a probability and actions"),
        ("(randomly :every 1 :probability 1 (break-widget))", "1:1", "`randomly` needs `:until`"),
        ("(randomly :every 0 :probability 1 :until 9 (break-widget))", "1:18", "above 0"),
        ("(randomly :evry 1 :probability 1 :until 9 (break-widget))", "1:11", "write `:every`"),
        ("(randomly :every 1 :every 1 (break-widget))", "1:20", "given twice"),
        ("(randomly :every)", "1:11", "has no value"),
        (
            "(randomly :every 0.001 :probability 1 :until 9999 (break-widget))",
            "1:1",
            "these are 9999000 moments",
        ),
        ("(devices)", "1:1", "needs the names of devices"),
        ("(at 1 (break-widget)", "1:1", "never closed"),
    ],
)
def test_a_mistake_is_told_with_its_place(text: str, place: str, said: str) -> None:
    report = refused(text)
    assert report.startswith(f"test.scenario:{place}: error: ")
    assert said in report


def test_nothing_happens_of_a_scenario_that_is_wrong() -> None:
    with craft(LAMP) as agent:
        with pytest.raises(EslError):
            begin(agent, "(at 0 (break-widget)) (at -1 (break-widget))")
        assert len(agent.scheduler.timers) == 0
