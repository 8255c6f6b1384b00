"""Buses: what they carry, when they trip, and what a trip leaves behind."""

from __future__ import annotations

from unit.devices.world import LAMP, craft, failure_of, state

from eslang.base.symbols import Keyword

TWO = """
    (powered-thru :a :bus) (powered-thru :b :bus) (bus-capacity :bus 100)
    (power-draw :a 60) (power-draw :b 30) (transient-draw :b 50) (transient-time :b 2)
"""


def test_a_load_that_is_within_the_capacity_trips_nothing() -> None:
    with craft(LAMP + "(bus-capacity :bus 30)") as agent:
        agent.eval("(turn-device-on :lamp)")
        assert [state(agent, ":lamp"), state(agent, ":bus")] == [":on", ":on"]


def test_a_transient_overload_trips_the_bus_and_all_on_it_loses_power() -> None:
    with craft(TWO) as agent:
        agent.eval("(turn-device-on :a)")
        assert failure_of(agent, "(turn-device-on :b)") == (":BUS-TRIPPED", ":B", ":BUS")
        assert [state(agent, name) for name in (":a", ":b", ":bus")] == [":off", ":off", ":off"]
        assert state(agent, ":bus", "health-state") == ":tripped"


def test_what_is_turned_on_one_after_the_other_may_fit_together() -> None:
    with craft(TWO) as agent:
        agent.eval("(progn (turn-device-on :b) (sleep 3) (turn-device-on :a))")
        assert [state(agent, name) for name in (":a", ":b", ":bus")] == [":on", ":on", ":on"]


def test_a_transient_counts_as_long_as_it_lasts() -> None:
    with craft(TWO) as agent:
        agent.eval("(turn-device-on :b)")
        assert failure_of(agent, "(turn-device-on :a)")[0] == ":BUS-TRIPPED"


def test_a_bus_that_was_reset_feeds_what_is_turned_on_again() -> None:
    with craft(TWO) as agent:
        agent.eval("(turn-device-on :a)")
        failure_of(agent, "(turn-device-on :b)")
        assert agent.eval("(reset-device :bus)") is Keyword("OK")
        assert [state(agent, name) for name in (":a", ":b", ":bus")] == [":off", ":off", ":on"]
        agent.eval("(turn-device-on :a)")
        assert state(agent, ":a") == ":on"


def test_what_a_stuck_switch_keeps_on_comes_back_with_the_bus() -> None:
    with craft() as agent:
        agent.eval("(progn (turn-device-on :lamp) (break-device :sw1 :stuck) (break-device :bus :tripped))")
        agent.eval("(reset-device :bus)")
        assert state(agent, ":lamp") == ":on"


def test_a_bus_that_was_turned_off_brings_its_devices_back() -> None:
    with craft(TWO) as agent:
        agent.eval("(progn (turn-device-on :a) (turn-device-off :bus))")
        assert state(agent, ":a") == ":off"
        agent.eval("(turn-device-on :bus)")
        assert state(agent, ":a") == ":on"


def test_operating_a_device_may_be_too_much() -> None:
    with craft(TWO) as agent:
        agent.eval("(progn (turn-device-on :b) (sleep 3) (turn-device-on :a))")
        assert failure_of(agent, "(operate-device :b)") == (":BUS-TRIPPED", ":B", ":BUS")


def test_a_bus_behind_a_bus_burdens_both_and_the_one_behind_trips_first() -> None:
    with craft("(powered-thru :a :inner) (powered-thru :inner :outer) (power-draw :a 10)") as agent:
        agent.eval("(progn (assert '(bus-capacity :inner 5)) (assert '(bus-capacity :outer 5)))")
        assert failure_of(agent, "(turn-device-on :a)") == (":BUS-TRIPPED", ":A", ":INNER")
        assert [state(agent, ":inner"), state(agent, ":outer")] == [":off", ":on"]


def test_either_of_two_buses_feeds_a_device() -> None:
    with craft("(powered-thru :a :first) (powered-thru :a :second)") as agent:
        agent.eval("(progn (turn-device-on :a) (break-device :first :tripped) (sleep 1))")
        assert [state(agent, ":first"), state(agent, ":a")] == [":off", ":on"]


def test_what_feeds_itself_has_no_power() -> None:
    with craft("(powered-thru :a :b) (powered-thru :b :a) (power-state :a :on)") as agent:
        agent.eval("(progn (device-power-state :a) (sleep 1))")
        assert [state(agent, ":a"), state(agent, ":b")] == [":off", ":off"]


def test_a_smaller_capacity_trips_what_carries_more() -> None:
    with craft(TWO) as agent:
        agent.eval("(turn-device-on :a)")
        agent.eval("(update '(bus-capacity :bus ?_) '(bus-capacity :bus 10))")
        agent.eval("(progn (device-power-state :a) (sleep 1))")
        assert state(agent, ":a") == ":off"
