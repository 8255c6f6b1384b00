"""The description: facts that say which devices there are, and how they are connected.

Whatever is wired, has a number of ours, or a power state or health, is a
device; what IS-A says of it is for plans.

[R] prints relation names in two spellings, some with a hyphen, some as
keywords with an underscore. Ours are with a hyphen; facts in the others are
taken over into these (decision 28).
"""

from __future__ import annotations

from eslang.base.hints import TYPE_CHECKING, Any
from eslang.base.lists import Cons, from_items, items, lisp_list
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.devices.device import HEALTHS, OK, ON, Device, Wiring

if TYPE_CHECKING:
    from eslang.facts.query import Facts

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
POWER_STATE, HEALTH_STATE = (Symbol.intern(name, "ESL") for name in ("POWER-STATE", "HEALTH-STATE"))
DESCRIBING = frozenset((*WIRES, *NUMBERS))
WORDS = DESCRIBING | {"IS-A", POWER_STATE.name, HEALTH_STATE.name}
NAME, VALUE = Symbol.intern("?NAME", "ESL"), Symbol.intern("?VALUE", "ESL")


def describes(name: Symbol) -> bool:
    """True if facts of the relation NAME say which devices there are, in any spelling."""
    return (name.package == "ESL" or is_other_spelling(name)) and respelled(name) in DESCRIBING


def respelled(name: Symbol) -> str:
    """NAME as we spell it."""
    return name.name.replace("_", "-")


def is_other_spelling(name: Symbol) -> bool:
    """True if NAME is one of our words in a spelling of [R] that is not ours."""
    return (isinstance(name, Keyword) or "_" in name.name) and respelled(name) in WORDS


def take_over(facts: Facts) -> None:
    """Spell as we do what facts there are in the other spellings of [R]."""
    for name, _ in list(facts.relations):
        if is_other_spelling(name):
            ours = Symbol.intern(respelled(name), "ESL")
            for fact in list(facts.facts(name)):
                facts.add(Cons(ours, fact.cdr))
                facts.retract(fact)


def pairs(facts: Facts, word: str) -> list[tuple[Any, Any]]:
    """What stands in the facts of two arguments of the relation WORD, if the first can name a device."""
    found = facts.all(lisp_list(Symbol.intern(word, "ESL"), NAME, VALUE))
    return [(each[NAME], each[VALUE]) for each in found if isinstance(each[NAME], Symbol)]


def read_description(facts: Facts, devices: dict[Any, Device]) -> list[Device]:
    """Let DEVICES be wired as the facts say; those that are new, in the state that the facts tell."""
    take_over(facts)
    known = len(devices)
    for device in devices.values():
        device.wiring, device.is_bus, device.is_switch = Wiring(), False, False
    for relation in (POWER_STATE, HEALTH_STATE):
        for name, _ in pairs(facts, relation.name):
            named(devices, name)
    for word, slot in WIRES.items():
        for name, other in pairs(facts, word):
            if isinstance(other, Symbol):
                getattr(named(devices, name).wiring, slot).append(named(devices, other))
    for word, slot in NUMBERS.items():
        for name, number in pairs(facts, word):
            if isinstance(number, (int, float)) or number.__class__.__name__ == "Ratio":
                setattr(named(devices, name).wiring, slot, max(0.0, float(number)))
    mark_parts(devices)
    new = list(devices.values())[known:]
    for device in new:
        begin(facts, device)
    return new


def names_in(facts: Facts) -> dict[Any, None]:
    """The names of the devices that FACTS describe."""
    told = [name for name, _ in facts.relations if respelled(name) in WORDS]
    return names_of(from_items([fact for name in dict.fromkeys(told) for fact in facts.facts(name)]))


def names_of(listing: Value) -> dict[Any, None]:
    """The names of the devices that a list of facts describes."""
    found: dict[Any, None] = {}
    for fact in items(listing):
        word, arguments = respelled(fact.car), list(items(fact.cdr))
        if word in WORDS and word != "IS-A":
            found.update(dict.fromkeys(arguments[: 2 if word in WIRES else 1]))
    return {name: None for name in found if isinstance(name, Symbol)}


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


def begin(facts: Facts, device: Device) -> None:
    """Let DEVICE, which is new, be as the facts tell; if they do not, a bus is on, and all else off."""
    state = known_state(facts, POWER_STATE, device)
    health = known_state(facts, HEALTH_STATE, device)
    device.health = health if health in HEALTHS[:3] else OK
    if state is ON or (state is None and device.is_bus):
        device.relays()[0].is_closed = True
    for relation, value in ((POWER_STATE, state), (HEALTH_STATE, health)):
        device.told[relation] = value


def known_state(facts: Facts, relation: Symbol, device: Device) -> Value:
    """What the facts say of the state of DEVICE; NIL if nothing."""
    found = facts.first(lisp_list(relation, device.name, VALUE))
    return None if found is None else found[VALUE]


def tell(facts: Facts, device: Device, relation: Symbol, value: Value) -> None:
    """Let the facts say that the state of DEVICE is VALUE."""
    facts.add(lisp_list(relation, device.name, value))
