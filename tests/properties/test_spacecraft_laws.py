"""Laws of the spacecraft, whatever is commanded and whatever breaks."""

from __future__ import annotations

from io import StringIO
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from eslang import Failure, Interpreter
from eslang.base.symbols import Keyword
from eslang.devices.device import Device
from eslang.devices.power import load
from eslang.devices.spacecraft import install

NAMES = [
    ":neb1",
    ":ega_x",
    ":ega_x_spare",
    ":gde",
    ":camera",
    ":heater",
    ":valve",
    ":bus_1553",
    ":gde_sw",
    ":camera_sw",
]
COMMANDS = [":turn-on", ":turn-off", ":reset", ":operate"]
HEALTHS = [":ok", ":single-event-upset", ":permanent-failure", ":stuck", ":tripped"]
CAUSES = {"NO-POWER", "POWER-STAYS", "BUS-TRIPPED", "NO-PATH", "NO-ANSWER"}

names = st.sampled_from(NAMES)
steps = st.one_of(
    st.tuples(st.just("command"), names, st.sampled_from(COMMANDS)),
    st.tuples(st.just("break"), names, st.sampled_from(HEALTHS)),
    st.tuples(st.just("pause"), st.sampled_from([0.05, 0.3, 2.0]), st.none()),
)


@pytest.fixture(scope="module", autouse=True)
def room() -> None:
    """The first interpreter raises Python's limit of recursion, which no law may find changed."""
    Interpreter().close()


class Flight:
    """A spacecraft under commands, with its hidden hardware."""

    def __init__(self) -> None:
        self.agent = Interpreter(clock="virtual", output=StringIO())
        craft = install(self.agent)
        self.agent.eval("(progn (load-spacecraft) (device-power-state :neb1))")
        self.hardware = craft.hardware
        self.overload = 0
        self.agent.hooks.listeners.append(lambda event: self.look())

    def look(self) -> None:
        """Note whether a bus carries too much."""
        devices = list(self.hardware.devices.values())
        now = self.agent.clock.now()
        for bus in devices:
            if bus.is_bus and bus.has_power and load(bus, devices, now) > bus.wiring.capacity:
                self.overload += 1

    def do(self, kind: str, what: Any, how: Any) -> None:
        """One step; a command that fails does so with a cause of its own."""
        if kind == "pause":
            self.agent.eval(f"(sleep {what})")
        elif kind == "break":
            how = ":stuck" if how == ":tripped" and what != ":neb1" else how  # only a bus trips
            self.agent.eval(f"(break-device {what} {how})")
        else:
            sent = self.hardware.now()
            try:
                self.agent.eval(f"(send-command {what} {how})")
            except Failure as failure:
                assert failure.cause.name in CAUSES
                assert failure.arguments[0] is Keyword(what[1:].upper())
            assert self.hardware.now() - sent <= 0.5 + 0.3 + 0.1 + 0.02 * 3 + 1e-6

    def seen(self, device: Device, relation: str) -> str:
        """What the facts say of DEVICE."""
        return str(self.agent.eval(f"(cdaar (db-query '({relation} {device.name} ?state)))"))


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(st.lists(steps, max_size=25))
def test_no_bus_carries_more_than_its_capacity_and_every_command_ends_in_time(
    run: list[tuple[str, Any, Any]],
) -> None:
    flight = Flight()
    for step in run:
        flight.do(*step)
        flight.look()
    assert flight.overload == 0


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(st.lists(steps, max_size=25))
def test_once_all_is_quiet_the_facts_say_what_is_true(run: list[tuple[str, Any, Any]]) -> None:
    flight = Flight()
    for step in run:
        flight.do(*step)
    flight.agent.eval("(sleep 10)")
    for device in flight.hardware.devices.values():
        if not device.is_switch:
            assert flight.seen(device, "power-state") == (":ON" if device.has_power else ":OFF")
        if device.has_power and not device.is_tripped:
            assert flight.seen(device, "health-state") == str(device.health)


@pytest.mark.slow
@settings(deadline=None, max_examples=30)
@given(st.lists(steps, max_size=15))
def test_what_is_mended_can_be_turned_on_and_operated(run: list[tuple[str, Any, Any]]) -> None:
    flight = Flight()
    for step in run:
        flight.do(*step)
    devices = list(flight.hardware.devices.values())
    for device in devices:
        flight.agent.eval(f"(break-device {device.name} :ok)")
    for device in devices:
        flight.agent.eval(f"(send-command {device.name} :turn-off)")
    for name in (":neb1", ":bus_1553", ":gde", ":ega_x"):
        flight.agent.eval(f"(turn-device-on {name})")
    assert flight.agent.eval("(operate-device :ega_x)") is True


@pytest.mark.slow
@settings(deadline=None, max_examples=40)
@given(st.lists(steps, max_size=12), st.sampled_from([":ega_x", ":camera", ":valve", ":gde", ":neb1"]))
def test_what_is_made_ready_is_ready_or_else_that_fails(run: list[tuple[str, Any, Any]], name: str) -> None:
    flight = Flight()
    for step in run:
        flight.do(*step)
    flight.agent.eval("(sleep 1)")
    try:
        ready = flight.agent.eval(f"(make-ready {name})")
    except Failure as failure:
        assert failure.cause is Keyword("NOT-READY")
    else:
        assert flight.agent.eval(f"(device-ready-p {ready})") is True
        assert flight.hardware.devices[ready].has_power
    assert flight.hardware.now() < 12 * 2 + 60
