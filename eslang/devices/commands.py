"""Commands to devices: what each does when it arrives, and how it is known whether it worked.

A command is sent, and arrives some time later; whoever has sent it may be
gone by then. It works or not as things are at that moment. The reply comes
when the sensors have spoken of what it did, and says what they say.
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import TYPE_CHECKING, Any, Callable, NamedTuple
from eslang.devices.description import HEALTH_STATE, POWER_STATE
from eslang.devices.device import OFF, OK, ON, TRIPPED, UPSET, Device

if TYPE_CHECKING:
    from eslang.devices.hardware import Hardware

Trouble = tuple[Any, ...] | None  # the cause and the arguments of the failure that it is


class Command(NamedTuple):
    """What a command does when it arrives, what the reply looks at, and what it gives if all is well."""

    act: Callable[[Hardware, Device], Trouble]
    check: Callable[[Device], Trouble]
    result: Any
    lasts: bool = False  # as long as the transient that it begins


class Sent:
    """A command that was sent."""

    __slots__ = ("command", "device", "hardware", "pauses", "trouble")

    def __init__(self, hardware: Hardware, device: Device, command: Command) -> None:
        self.hardware = hardware
        self.device = device
        self.command = command
        self.trouble: Trouble = None
        latency = hardware.transmit(device) + device.wiring.command_latency
        self.pauses = [latency]  # of who waits for the reply; the next is the last
        if command.lasts:
            self.pauses.insert(0, device.wiring.transient_time)
        hardware.after(latency, self.arrive)

    def arrive(self) -> None:
        """It takes effect; sensors will tell what that is."""
        self.trouble = self.command.act(self.hardware, self.device)
        changed = self.hardware.settle()
        self.hardware.observe(self.device)
        self.pauses.insert(0, max([each.wiring.sensor_latency for each in (self.device, *changed)]))

    def next_pause(self) -> float | None:
        """How long to wait now, before asking again; None when the reply is there."""
        return self.pauses.pop() if self.pauses else None

    def reply(self) -> Any:
        """What the command gives. Raises Failure if it did not do what it is for."""
        trouble = self.trouble or self.command.check(self.device)
        if trouble is not None:
            raise Failure(*trouble)
        return self.command.result


# --- what they do ----------------------------------------------------------------------


def turn_on(hardware: Hardware, device: Device) -> Trouble:
    """Close the first switch of DEVICE, or its own relay."""
    return switch(device, device.relays()[:1], closed=True)


def turn_off(hardware: Hardware, device: Device) -> Trouble:
    """Open all switches of DEVICE, or its own relay."""
    return switch(device, device.relays(), closed=False)


def switch(device: Device, relays: list[Device], *, closed: bool) -> Trouble:
    """Close or open RELAYS, which let power through to DEVICE, as far as they can be told to."""
    trouble: Trouble = None
    for relay in relays:
        via = relay.obstacle() if relay.is_switch else None
        if via is None:
            relay.switch(closed=closed)
        else:
            trouble = ("no-path", device.name, via.name)
    return trouble


def reset(hardware: Hardware, device: Device) -> Trouble:
    """Let DEVICE begin anew: that helps after an upset, and after a trip."""
    trouble = no_way(device) if device.is_bus or device.is_switch else unreachable(device)
    if trouble is None:
        device.is_tripped = False
        if device.health is UPSET:
            device.health = OK
    return trouble


def operate(hardware: Hardware, device: Device) -> Trouble:
    """Let DEVICE do its work, for which it draws more than usual."""
    trouble = unreachable(device)
    if trouble is None and device.health is not OK:
        trouble = ("no-answer", device.name, device.told.get(HEALTH_STATE))
    if trouble is None:
        device.begin_transient(hardware.now())
    return trouble


def unreachable(device: Device) -> Trouble:
    """Why no message reaches DEVICE; None if one does."""
    return no_way(device) if device.has_power else no_power(device)


def no_way(device: Device) -> Trouble:
    """The trouble if something on the way to DEVICE passes no messages on."""
    via = device.obstacle()
    return None if via is None else ("no-path", device.name, via.name)


# --- how it is known -------------------------------------------------------------------


def is_on(device: Device) -> Trouble:
    """The trouble if DEVICE has no power. A switch tells nothing of itself."""
    return None if device.is_switch or device.told.get(POWER_STATE) is ON else no_power(device)


def is_off(device: Device) -> Trouble:
    """The trouble if DEVICE has power all the same."""
    if device.is_switch or device.told.get(POWER_STATE) is OFF:
        return None
    return ("power-stays", device.name, device.relays()[0].name)


def is_well(device: Device) -> Trouble:
    """The trouble if DEVICE is not well."""
    health = device.told.get(HEALTH_STATE)
    if health is TRIPPED:
        return ("bus-tripped", device.name, device.name)
    return None if health is OK else ("no-answer", device.name, health)


def no_power(device: Device) -> Trouble:
    """The trouble that DEVICE has no power, and why, as far as that is seen: a bus, or else a switch."""
    sources = device.wiring.sources
    for source in sources:
        if source.told.get(HEALTH_STATE) is TRIPPED:
            return ("bus-tripped", device.name, source.name)
    if sources and all(source.told.get(POWER_STATE) is OFF for source in sources):
        return ("no-power", device.name, sources[0].name)
    return ("no-power", device.name, device.relays()[0].name)


COMMANDS = {
    "TURN-ON": Command(turn_on, is_on, ON),
    "TURN-OFF": Command(turn_off, is_off, OFF),
    "RESET": Command(reset, is_well, OK),
    "OPERATE": Command(operate, is_on, True, lasts=True),
}
