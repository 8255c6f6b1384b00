"""The hardware of a simulated spacecraft: what is true of it, and what plans get to know.

The facts describe it (description.py). What is true of a device, its health
and whether it is stuck, only the simulation knows; sensors report power and
health into the facts, after their latency. A device without power reports no
health, and a switch reports no power: if it is stuck, that is seen as power
that does not come.
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import TYPE_CHECKING, Any, Callable
from eslang.base.suggest import nearest
from eslang.base.symbols import Keyword, Symbol
from eslang.devices.commands import COMMANDS, Sent
from eslang.devices.description import (
    DESCRIBING,
    HEALTH_STATE,
    POWER_STATE,
    known_state,
    read_description,
    tell,
)
from eslang.devices.device import HEALTHS, OFF, OK, ON, STUCK, TRIPPED, Device
from eslang.devices.power import settle

if TYPE_CHECKING:
    from eslang.interpreter import Interpreter
    from eslang.knowledge import Change

Readings = list[tuple[Symbol, Any]]


class Hardware:
    """All devices that the facts of one interpreter describe."""

    def __init__(self, agent: Interpreter) -> None:
        self.facts = agent.facts
        self.now = agent.clock.now
        self.after: Callable[[float, Callable[[], None]], None] = agent.after
        self.devices: dict[Any, Device] = {}
        self.is_stale = True  # the description has changed since it was read
        agent.call("esl::%declare-states")
        self.facts.subscribe(self.hear)

    # --- the description ---------------------------------------------------------

    def hear(self, change: Change) -> None:
        """A fact has come or gone."""
        if change.relation in DESCRIBING:
            self.is_stale = True

    def refresh(self) -> None:
        """Be as described, if the description has changed."""
        if not self.is_stale:
            return
        new = read_description(self.facts, self.devices)
        self.is_stale = False
        self.settle()
        for device in new:
            seen = readings(device)
            known = [pair for pair in ((HEALTH_STATE, device.health), *seen) if device.told[pair[0]] is None]
            self.report(device, known)
            if any(device.told[relation] is not value for relation, value in seen):
                self.observe(device)

    def is_device(self, name: Any) -> bool:
        """True if NAME is that of a device."""
        self.refresh()
        return isinstance(name, Symbol) and name in self.devices

    def find(self, name: Any) -> Device:
        """The device of that name. Raises Failure(:unknown-device) with the nearest name."""
        if not self.is_device(name):
            raise Failure("unknown-device", name, nearest_of(name, self.devices))
        return self.devices[name]

    # --- commands ----------------------------------------------------------------

    def send(self, name: Any, command: Any) -> Sent:
        """Send COMMAND to the device of that NAME. Raises Failure if there is no such device, or command."""
        device = self.find(name)
        known = COMMANDS.get(command.name) if isinstance(command, Keyword) else None
        if known is None:
            raise Failure("unknown-command", command, nearest_of(command, map(Keyword, COMMANDS)))
        return Sent(self, device, known)

    def transmit(self, device: Device) -> float:
        """How long a message to DEVICE is under way: each part of the way passes one at a time."""
        moment = self.now()
        for via in reversed(device.way()):
            moment = via.free_at = max(moment, via.free_at) + via.wiring.message_time
        return moment - self.now()

    # --- what becomes true ---------------------------------------------------------

    def change_health(self, name: Any, health: Any) -> None:
        """Let the device of that NAME be broken as HEALTH says, or well."""
        device = self.find(name)
        known = HEALTHS if device.is_bus else HEALTHS[:-1]  # only a bus trips
        if health not in known:
            raise Failure("unknown-health", health, nearest_of(health, known))
        if health is STUCK:
            device.is_stuck = True
        elif health is not TRIPPED:
            device.health = health
            if health is OK:
                device.is_stuck = device.is_tripped = False
        self.settle(device if health is TRIPPED else None)
        self.observe(device)

    def settle(self, tripping: Device | None = None) -> list[Device]:
        """Let power go where it can, after the bus TRIPPING has tripped; what sensors see change by that."""
        changed = settle(self.devices.values(), self.now(), tripping)
        for device in changed:
            self.observe(device)
        return changed

    # --- what is seen --------------------------------------------------------------

    def observe(self, device: Device) -> None:
        """Let the sensors of DEVICE speak of what they see now."""
        seen = readings(device)
        self.after(device.wiring.sensor_latency, lambda: self.report(device, seen))

    def report(self, device: Device, seen: Readings) -> None:
        """Let the facts say of DEVICE what was SEEN."""
        for relation, value in seen:
            device.told[relation] = value
            tell(self.facts, device, relation, value)

    def state(self, name: Any, relation: Symbol) -> Any:
        """What the facts say of the device of that NAME; None if nothing."""
        return known_state(self.facts, relation, self.find(name))


def readings(device: Device) -> Readings:
    """What the sensors of DEVICE see now."""
    seen: Readings = []
    if not device.is_switch:
        seen.append((POWER_STATE, ON if device.has_power else OFF))
    if device.has_power or device.is_bus or device.is_switch:
        seen.append((HEALTH_STATE, TRIPPED if device.is_tripped else device.health))
    return seen


def nearest_of(name: Any, names: Any) -> Any:
    """The one of NAMES that is nearest to NAME; None if all are far."""
    known = {each.name: each for each in names}
    return known.get(nearest(name.name, known) or "") if isinstance(name, Symbol) else None
