"""The description: facts that say which devices there are, and how they are connected.

Whatever is wired, has a number of ours, or a power state or health, is a
device; what IS-A says of it is for plans. [R] prints two relations in two
spellings, POWER-STATE and :POWER_STATE. Ours are with a hyphen; facts in the
others are taken over into these (decision 28).
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import TYPE_CHECKING, Any, Iterable
from eslang.base.symbols import Keyword, Symbol
from eslang.devices.device import HEALTHS, OK, ON, TRIPPED, Device, Wiring

if TYPE_CHECKING:
    from eslang.knowledge import Change, Knowledge

WIRES = {"TALKS-THRU": "paths", "POWERED-THRU": "sources", "SWITCHED-THRU": "switches"}
NUMBERS = {
    "BUS-CAPACITY": "capacity",
    "POWER-DRAW": "draw",
    "TRANSIENT-DRAW": "transient_draw",
    "TRANSIENT-TIME": "transient_time",
    "COMMAND-LATENCY": "command_latency",
    "SENSOR-LATENCY": "sensor_latency",
    "MESSAGE-TIME": "message_time",
}
RELATIONS = {word: Symbol.intern(word, "ESL") for word in (*WIRES, *NUMBERS, "POWER-STATE", "HEALTH-STATE")}
DESCRIBING = frozenset(RELATIONS[word] for word in (*WIRES, *NUMBERS))
POWER_STATE, HEALTH_STATE = RELATIONS["POWER-STATE"], RELATIONS["HEALTH-STATE"]
SPELLINGS: tuple[tuple[Any, Symbol], ...] = (
    (Keyword("POWER_STATE"), POWER_STATE),
    (Keyword("POWER-STATE"), POWER_STATE),
    ("power_state", POWER_STATE),
    (Keyword("HEALTH_STATE"), HEALTH_STATE),
    (Keyword("HEALTH-STATE"), HEALTH_STATE),
    ("health_state", HEALTH_STATE),
)


def take_over(facts: Knowledge) -> None:
    """Spell as we do what facts there are in the other spellings."""
    for spelling, ours in SPELLINGS:
        gone: list[Change] = []
        stop = facts.subscribe(gone.append, spelling)
        facts.remove([spelling, "?_", "?_"])
        stop()
        facts.add_all([change.terms for change in gone], ours)


def pairs(facts: Knowledge, relation: Symbol) -> list[tuple[Any, Any]]:
    """What stands in the facts of two arguments of RELATION, if the first can name a device."""
    found = facts.query([relation, "?name", "?value"])
    return [(each["name"], each["value"]) for each in found if isinstance(each["name"], Symbol)]


def read_description(facts: Knowledge, devices: dict[Any, Device]) -> list[Device]:
    """Let DEVICES be wired as the facts say; those that are new, in the state that the facts tell."""
    take_over(facts)
    wires, numbers = wires_in(facts), numbers_in(facts)
    known = len(devices)
    for device in devices.values():
        device.wiring, device.is_bus, device.is_switch = Wiring(), False, False
    for relation in (POWER_STATE, HEALTH_STATE):
        for name, _ in pairs(facts, relation):
            named(devices, name)
    for name, slot, other in wires:
        getattr(named(devices, name).wiring, slot).append(named(devices, other))
    for name, slot, number in numbers:
        setattr(named(devices, name).wiring, slot, number)
    mark_parts(devices)
    new = list(devices.values())[known:]
    for device in new:
        begin(facts, device)
    return new


def wires_in(facts: Knowledge) -> list[tuple[Any, str, Any]]:
    """What is connected with what, and how. Raises Failure(:wrong-description)."""
    found = []
    for word, slot in WIRES.items():
        for name, other in pairs(facts, RELATIONS[word]):
            if not isinstance(other, Symbol):
                raise Failure("wrong-description", [RELATIONS[word], name, other])
            found.append((name, slot, other))
    return found


def numbers_in(facts: Knowledge) -> list[tuple[Any, str, float]]:
    """The numbers of devices, none below 0. Raises Failure(:wrong-description) with a fact that has none."""
    found = []
    for word, slot in NUMBERS.items():
        for name, value in pairs(facts, RELATIONS[word]):
            number = amount_of(value)
            if number is None:
                raise Failure("wrong-description", [RELATIONS[word], name, value])
            found.append((name, slot, number))
    return found


def amount_of(value: Any) -> float | None:
    """VALUE as watts or seconds; None if it is no number, or below 0, or more than a float can be."""
    is_number = value.__class__ in (int, float) or value.__class__.__name__ == "Fraction"
    try:
        return float(value) if is_number and value >= 0 else None
    except OverflowError:
        return None


def names_in(facts: Knowledge) -> dict[Any, None]:
    """The names of the devices that FACTS describe."""
    return names_of([relation, *pair] for relation in RELATIONS.values() for pair in pairs(facts, relation))


def names_of(listing: Iterable[list[Any]]) -> dict[Any, None]:
    """The names of the devices that a list of facts describes."""
    found: dict[Any, None] = {}
    for relation, *arguments in listing:
        if relation in RELATIONS.values():
            named_there = arguments if relation.name in WIRES else arguments[:1]
            found.update((name, None) for name in named_there if isinstance(name, Symbol))
    return found


def named(devices: dict[Any, Device], name: Any) -> Device:
    """The device of that name, made if there is none."""
    device = devices.get(name)
    if device is None:
        device = devices[name] = Device(name)
    return device


def mark_parts(devices: dict[Any, Device]) -> None:
    """Note which devices are buses, and which are switches."""
    for device in devices.values():
        for source in device.wiring.sources:
            source.is_bus = True
        for switch in device.wiring.switches:
            switch.is_switch = True


def begin(facts: Knowledge, device: Device) -> None:
    """Let DEVICE, which is new, be as the facts tell; if they do not, a bus is on, and all else off."""
    state = known_state(facts, POWER_STATE, device)
    health = known_state(facts, HEALTH_STATE, device)
    device.health = health if health in HEALTHS[:3] else OK
    device.is_tripped = device.is_bus and health is TRIPPED
    if state is ON or (state is None and device.is_bus):
        device.relays()[0].is_closed = True
    device.told = {POWER_STATE: state, HEALTH_STATE: health}


def known_state(facts: Knowledge, relation: Symbol, device: Device) -> Any:
    """What the facts say of the state of DEVICE; None if nothing."""
    found = facts.first([relation, device.name, "?state"])
    return None if found is None else found["state"]


def tell(facts: Knowledge, device: Device, relation: Symbol, value: Any) -> None:
    """Let the facts say that the state of DEVICE is VALUE."""
    facts.add(relation, device.name, value)
