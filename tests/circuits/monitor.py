"""What must be true of any run of a program of SCS, told from its notes alone.

This knows nothing of how constructs go on: it plays the actions that were
noted again, and looks at what stands above each of them.
"""

from __future__ import annotations

from typing import Any

from naive.circuit_runs import TICK, Effects, Run
from naive.steps import Act, Await, Clause, Condition, Group, Guarded, World, changed, is_true, solutions


class Place:
    """An action, and what stands above it in the program."""

    def __init__(self, act: Act, above: tuple[tuple[Condition, bool], ...], guards: tuple[str, ...]) -> None:
        self.act = act
        self.above = above  # conditions, each with whether it must hold or must not
        self.guards = guards
        self.group: tuple[str, ...] = (act.name,)  # the actions that are one with it


def places_of(term: Any, above: Any = (), guards: Any = ()) -> dict[str, Place]:
    """Where each action of TERM stands."""
    if isinstance(term, Act | Await):
        return {term.name: Place(Act(term.name) if isinstance(term, Await) else term, above, guards)}
    if isinstance(term, Group):
        found = {act.name: Place(act, above, guards) for act in term.acts}
        for place in found.values():
            place.group = tuple(found)
        return found
    if isinstance(term, Guarded):
        return places_of(term.step, above, (*guards, term.name))
    if isinstance(term, Clause):
        above = (*above, (term.condition, True))
    for word, condition in getattr(term, "modifiers", ()):
        if word in ("while", "until"):
            above = (*above, (condition, word == "while"))
    found = {}
    for step in term.steps:
        found.update(places_of(step, above, guards))
    return found


class Monitor:
    """Plays one run again."""

    def __init__(self, program: Any, world: World, changes: tuple[Effects, ...]) -> None:
        self.places = places_of(program)
        self.world = world
        self.script = iter(changes)
        self.entered: set[str] = set()  # the guarded steps that are under way
        self.owed: tuple[str, ...] = ()  # the actions of a group that are to come now

    def troubles(self, run: Run) -> list[str]:
        """What RUN does that it must not, and where."""
        found = []
        for number, note in enumerate(run.notes):
            found += [f"{number}, {note}: {what}" for what in self.wrong(note)]
        return found + [f"{what} is never left" for what in (*self.entered, *self.owed)]

    def wrong(self, note: str) -> list[str]:
        """What is wrong if NOTE comes now."""
        word, _, name = note.partition(" ")
        found = [] if not self.owed or word.rstrip("ab") == self.owed[0] else [f"{self.owed} is cut off"]
        if word == TICK:
            self.world = changed(self.world, next(self.script))
        elif word in ("begin", "end"):
            found += self.wrong_at(self.places[name], begins=word == "begin")
        elif name:
            found += ["this cannot be"] if (name in self.entered) == (word == "in") else []
            self.entered ^= {name}
        else:
            place = self.places[word.rstrip("ab")]
            found += self.wrong_at(place)
            self.act(place)
        return found

    def wrong_at(self, place: Place, begins: bool = True) -> list[str]:
        """What is wrong if the action at PLACE is done now, or begins."""
        found = [f"{guard} is not under way" for guard in place.guards if guard not in self.entered]
        if self.owed or not begins:
            return found
        found += [] if place.act.name == place.group[0] else [f"it begins in the middle of {place.group}"]
        return found + [
            f"{condition} is {'false' if wanted else 'true'}"
            for condition, wanted in place.above
            if bool(solutions(condition, self.world)) != wanted
        ]

    def act(self, place: Place) -> None:
        """Do what the action at PLACE does."""
        act = place.act
        self.world = changed(self.world, act.effects)
        self.world = self.world._replace(left=self.world.left - 1)
        if self.world.left <= 0:
            self.world = changed(self.world, [("assert", "over")])
        rest = place.group[place.group.index(act.name) + 1 :]
        self.owed = () if is_true(act.fails, self.world) else rest
