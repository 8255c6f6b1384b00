"""Power: who has it, what each bus carries, and when a bus trips.

A device has power if a switch of it is closed and something that it is
powered through has power. A bus that carries more than its capacity, be it
for a moment, trips: everything on it loses power, and is switched off, as far
as its switches obey. So no bus ever carries more than its capacity.
"""

from __future__ import annotations

from eslang.base.hints import Iterable
from eslang.devices.device import Device


def settle(devices: Iterable[Device], now: float, tripping: Device | None = None) -> list[Device]:
    """Let power go where it can, until no bus carries too much; the devices that got or lost it, or tripped.

    TRIPPING is a bus that trips before that, whatever it carries.
    """
    everything = list(devices)
    before = {device: (device.has_power, device.is_tripped) for device in everything}
    if tripping is not None:
        trip(tripping, everything, now)
    distribute(everything, now)
    while (bus := overloaded(everything, now)) is not None:
        trip(bus, everything, now)
    return [device for device in everything if before[device] != (device.has_power, device.is_tripped)]


def distribute(devices: list[Device], now: float) -> None:
    """Find out who has power, and from where; who gets it draws more for a moment."""
    had = {device for device in devices if device.has_power}
    for device in devices:
        device.has_power, device.source = False, None
    changed = True
    while changed:
        changed = False
        for device in devices:
            if device.has_power or not device.is_connected():
                continue
            sources = device.wiring.sources
            device.source = next((source for source in sources if source.has_power), None)
            if device.source is not None or not sources:
                device.has_power = changed = True
    for device in devices:
        if device.has_power and device not in had:
            device.begin_transient(now)


def load(bus: Device, devices: Iterable[Device], now: float) -> float:
    """The watts that are drawn from BUS: by what it feeds, and through the buses behind it."""
    everything = list(devices)
    return sum(
        [
            device.drawn(now) + load(device, everything, now)
            for device in everything
            if device.has_power and device.source is bus
        ]
    )


def overloaded(devices: list[Device], now: float) -> Device | None:
    """A bus that carries too much: the farthest from the source, of several."""
    found = [device for device in devices if device.is_bus and device.has_power]
    heavy = [bus for bus in found if load(bus, devices, now) > bus.wiring.capacity]
    return max(heavy, key=depth) if heavy else None


def depth(device: Device) -> int:
    """How many stand between DEVICE and where its power comes from."""
    steps = 0
    while device.source is not None:
        device, steps = device.source, steps + 1
    return steps


def trip(bus: Device, devices: list[Device], now: float) -> None:
    """Let BUS trip; what loses power by that is switched off."""
    had = [device for device in devices if device.has_power and not device.is_bus and not device.is_switch]
    bus.is_tripped = True
    distribute(devices, now)
    for device in had:
        if not device.has_power:
            for relay in device.relays():
                relay.switch(closed=False)
