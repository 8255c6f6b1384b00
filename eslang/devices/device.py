"""One piece of hardware: how it is wired, and what is true of it.

What is true is hidden from plans; they see what sensors report (hardware.py),
and that later. A power bus and a switch are devices too: whatever others are
powered or switched through. Its numbers are facts, as its wiring is
(description.py).
"""

from __future__ import annotations

from eslang.base.hints import Any
from eslang.base.symbols import Keyword

ON, OFF = Keyword("ON"), Keyword("OFF")
OK, UPSET, BROKEN = (Keyword(name) for name in ("OK", "SINGLE-EVENT-UPSET", "PERMANENT-FAILURE"))
STUCK, TRIPPED = Keyword("STUCK"), Keyword("TRIPPED")
HEALTHS = (OK, UPSET, BROKEN, STUCK, TRIPPED)
UNLIMITED = float("inf")


class Wiring:
    """How a device is connected, and its numbers: watts and seconds."""

    __slots__ = (
        "capacity",
        "command_latency",
        "draw",
        "message_time",
        "paths",
        "sensor_latency",
        "sources",
        "switches",
        "transient_draw",
        "transient_time",
    )

    def __init__(self) -> None:
        self.sources: list[Device] = []  # it is powered through any of them
        self.switches: list[Device] = []  # any of them lets power through
        self.paths: list[Device] = []  # it talks through any of them
        self.capacity = UNLIMITED
        self.draw = 0.0
        self.transient_draw = 0.0
        self.transient_time = 0.1
        self.command_latency = 0.5
        self.sensor_latency = 0.1
        self.message_time = 0.0


class Device:
    """What is true of one device now."""

    __slots__ = (
        "free_at",
        "has_power",
        "health",
        "is_bus",
        "is_closed",
        "is_stuck",
        "is_switch",
        "is_tripped",
        "name",
        "source",
        "told",
        "transient_until",
        "wiring",
    )

    def __init__(self, name: Any) -> None:
        self.name = name
        self.wiring = Wiring()
        self.is_bus = self.is_switch = False
        self.health = OK
        self.is_closed = False  # a switch, or the relay of what has no switch, lets power through
        self.is_stuck = False  # and stays as it is, whatever it is told
        self.is_tripped = False
        self.has_power = False
        self.source: Device | None = None  # what it draws its power from now
        self.transient_until = 0.0  # it draws more than usual until then
        self.free_at = 0.0  # when it can pass on the next message
        self.told: dict[Any, Any] = {}  # what its sensors reported last, by relation

    def relays(self) -> list[Device]:
        """What lets power through to it: its switches, or else itself."""
        return self.wiring.switches or [self]

    def is_connected(self) -> bool:
        """True if power that there is comes through to it."""
        if self.is_tripped or (self.is_bus and self.health is BROKEN):
            return False
        return any(relay.is_closed for relay in self.relays())

    def switch(self, *, closed: bool) -> None:
        """Let power through, or not, if it obeys: what is stuck does not, nor a switch that is not well."""
        if not self.is_stuck and not (self.is_switch and self.health is not OK):
            self.is_closed = closed

    def drawn(self, now: float) -> float:
        """The watts that it draws itself, while it has power."""
        wiring = self.wiring
        if now < self.transient_until:
            return max(wiring.draw, wiring.transient_draw)
        return wiring.draw

    def begin_transient(self, now: float) -> None:
        """Draw more than usual for a moment."""
        self.transient_until = now + self.wiring.transient_time

    def obstacle(self) -> Device | None:
        """What on the way to it passes no messages on, the nearest to it; None if some way is open."""
        return self._obstacle(frozenset())

    def _obstacle(self, behind: frozenset[Device]) -> Device | None:
        found: Device | None = None
        for via in self.wiring.paths:
            if via in behind:
                continue
            blocked = via if not via.passes_messages() else via._obstacle(behind | {self})
            if blocked is None:
                return None
            found = found or blocked
        return found

    def passes_messages(self) -> bool:
        """True if it has power and is well."""
        return self.has_power and self.health is OK

    def way(self) -> list[Device]:
        """What a message to it passes: the first open way, or else the first described."""
        found: list[Device] = []
        device = self
        while device.wiring.paths:
            paths = device.wiring.paths
            open_ones = [via for via in paths if via.passes_messages() and via.obstacle() is None]
            device = (open_ones or paths)[0]
            if device in found or device is self:
                break
            found.append(device)
        return found
