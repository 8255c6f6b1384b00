"""Scenarios: what the world does to a plan, and when.

    (at 12.5 (break-device :ega_x :single-event-upset))
    (at 20 (with-probability 1/4 (break-device :neb1 :tripped)))
    (randomly :every 10 :probability 0.05 :until 600 (break-device :camera :single-event-upset))
    (devices :lamp)

A scenario is read and checked whole before the run; what is wrong in it is a
diagnostic with its place. All its chance is drawn when the run begins, so a
seed gives the same faults whatever the plan does. Its moments lie on the
interpreter's clock, and no run waits for them (decision 28).
"""

from __future__ import annotations

from eslang.base.decoding import decode, file_bytes
from eslang.base.hints import TYPE_CHECKING, Any, Callable, NamedTuple
from eslang.base.lists import Cons, items
from eslang.base.shown import shown
from eslang.base.spans import Source
from eslang.base.symbols import Symbol, Value
from eslang.devices.description import names_in, names_of
from eslang.devices.doings import Call, Doing, Maybe, Page, near_name, read_doings

if TYPE_CHECKING:
    from random import Random

    from eslang.interpreter import Interpreter

MOST = 100_000  # moments of one form
SHAPES = {
    "AT": "(at seconds action...)",
    "RANDOMLY": "(randomly :every seconds :probability p :until seconds action...)",
    "DEVICES": "(devices name...)",
}


class Entry(NamedTuple):
    """What is to happen at each of some moments, with a probability."""

    moments: list[float]
    probability: float
    doings: list[Doing]


Scenario = list[Entry]


# --- reading -----------------------------------------------------------------------------


def read_scenario(agent: Interpreter, path: str) -> Scenario:
    """The scenario in the file PATH, for AGENT. Raises EslError, OSError."""
    return scenario_of(agent, decode(file_bytes(path), path))


def scenario_of(agent: Interpreter, source: Source) -> Scenario:
    """The scenario that a text is. Raises EslError."""
    with agent.at_work():
        known = names_in(agent.facts) | names_of(agent.call("esl::%spacecraft-facts"))
        forms = [
            (Page(agent, reading.spans, reading.span, known), reading.form)
            for reading in agent.readings(source)
        ]
        for page, form in forms:  # a name may be told behind the forms that speak of it
            if word_of(page, form) == "DEVICES":
                known.update(devices_of(page, form))
        return [ENTRIES[form.car.name](page, form) for page, form in forms if form.car.name in ENTRIES]


def word_of(page: Page, form: Value) -> str:
    """What the top-level FORM is."""
    word = form.car if form.__class__ is Cons else None
    if isinstance(word, Symbol) and word.name in SHAPES:
        return word.name
    near = near_name(word, [Symbol(name) for name in SHAPES])
    hint = f"write `{SHAPES[near.upper()] if near else SHAPES['AT']}`"
    raise page.malformed(f"`{shown(form)}` is nothing that a scenario can say", form, hint)


def devices_of(page: Page, form: Cons) -> dict[Any, None]:
    """The names in (devices name...)."""
    names = list(items(form.cdr))
    if not names or not all(isinstance(name, Symbol) for name in names):
        raise page.malformed("`devices` needs the names of devices", form, f"write `{SHAPES['DEVICES']}`")
    return dict.fromkeys(names)


def read_at(page: Page, form: Cons) -> Entry:
    """(at seconds action...)"""
    if form.cdr.__class__ is not Cons:
        raise page.malformed("`at` needs a time and what happens then", form, f"write `{SHAPES['AT']}`")
    return Entry([page.seconds(form.cdr, "a time")], 1.0, actions_of(page, form, form.cdr.cdr))


def read_randomly(page: Page, form: Cons) -> Entry:
    """(randomly :every seconds :probability p :until seconds [:from seconds] action...)"""
    options, rest = page.options(form.cdr, ("EVERY", "PROBABILITY", "UNTIL", "FROM"))
    for name in ("EVERY", "PROBABILITY", "UNTIL"):
        if name not in options:
            raise page.malformed(
                f"`randomly` needs `:{name.lower()}`",
                form,
                f"write `{SHAPES['RANDOMLY']}`",
            )
    every = page.seconds(options["EVERY"], "a period", above_zero=True)
    until = page.seconds(options["UNTIL"], "a time")
    begin = page.seconds(options["FROM"], "a time") if "FROM" in options else 0.0
    count = int(max(0.0, until - begin) / every + 1e-9)
    if count > MOST:
        raise page.malformed(f"these are {count} moments", form, f"let there be {MOST} at most")
    moments = [begin + every * number for number in range(1, count + 1)]
    return Entry(moments, page.probability(options["PROBABILITY"]), actions_of(page, form, rest))


def actions_of(page: Page, form: Cons, rest: Value) -> list[Doing]:
    """The actions in the list REST of FORM, one at least."""
    doings = read_doings(page, rest)
    if not doings:
        raise page.malformed("nothing is to happen here", form, f"write `{SHAPES[form.car.name]}`")
    return doings


ENTRIES: dict[str, Callable[[Page, Any], Entry]] = {"AT": read_at, "RANDOMLY": read_randomly}


# --- running -----------------------------------------------------------------------------


def begin_scenario(agent: Interpreter, scenario: Scenario) -> None:
    """Let what SCENARIO says happen from now on, each thing in a task of its own at its moment."""
    now, chance = agent.clock.now(), agent.chance
    for entry in scenario:
        for moment in entry.moments:
            if entry.probability >= 1.0 or chance.random() < entry.probability:
                for call in drawn(entry.doings, chance):
                    agent.after(max(0.0, moment - now), poster(agent, call))


def drawn(doings: list[Doing], chance: Random) -> list[Call]:
    """The calls that DOINGS come to, this time."""
    found: list[Call] = []
    for doing in doings:
        if not isinstance(doing, Maybe):
            found.append(doing)
        elif chance.random() < doing.probability:
            found += drawn(doing.doings, chance)
    return found


def poster(agent: Interpreter, call: Call) -> Callable[[], None]:
    """What lets a task make CALL."""
    return lambda: agent.post(call.function, *call.arguments)
