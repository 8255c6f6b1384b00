"""Programs of SCS as terms, and their worlds: what a condition means, and what an action does.

This is written from the text of SCS (Appendix C) and the language reference
alone; how the interpreter does it is of no concern here.
"""

from __future__ import annotations

from itertools import product
from typing import Any, NamedTuple

PLACES = ("a", "b")  # what a variable can stand for
Notes = tuple[str, ...]
Condition = Any  # ("t",), ("fact", name, place...), ("x", number), ("not", c), ("and", c, c), ("or", c, c)


class World(NamedTuple):
    """All that conditions and utilities ask."""

    facts: frozenset[tuple[str, ...]] = frozenset()
    x: int = 0
    left: int = 1000  # how many actions are allowed; then (over) is a fact


class Act(NamedTuple):
    """An action: what it changes, and under which condition it fails then."""

    name: str
    effects: tuple[tuple[Any, ...], ...] = ()
    fails: Condition = ("not", ("t",))
    about: str = ""  # a variable, or what it stands for
    is_plain: bool = False  # a call of a function that is no action


class Group(NamedTuple):
    """Actions that are one."""

    acts: tuple[Act, ...]


class Await(NamedTuple):
    """A step that notes when it begins, waits until (lit) is a fact, and notes that it ends."""

    name: str


class Steps(NamedTuple):
    """DO, REPEAT, DO-ALL or DO-ANY, of steps."""

    kind: str
    starred: bool
    modifiers: tuple[tuple[str, Condition], ...]
    steps: tuple[Any, ...]
    name: str = ""  # of the step that it defines, if it does


class Clause(NamedTuple):
    """A clause of DO-FIRST or DO-BEST."""

    condition: Condition
    utility: Any  # a number, or "x", or "-x"
    steps: tuple[Any, ...]


class Clauses(NamedTuple):
    """DO-FIRST or DO-BEST, of clauses."""

    kind: str
    starred: bool
    modifiers: tuple[tuple[str, Condition], ...]
    steps: tuple[Clause, ...]


class Guarded(NamedTuple):
    """A step that notes when it begins, and when it ends or is cleaned up."""

    name: str
    step: Any


class Done(NamedTuple):
    """A step that has ended: "ok" with its value, "failed" with its failure, or "off"."""

    how: str
    what: Any = None


# --- conditions ----------------------------------------------------------------------


def filled(term: Any, bindings: dict[str, str]) -> Any:
    """TERM with what its variables stand for."""
    if isinstance(term, str):
        return bindings.get(term, term)
    if isinstance(term, tuple):
        parts = [filled(part, bindings) for part in term]
        return term._make(parts) if hasattr(term, "_make") else tuple(parts)
    return term


def variables(term: Any) -> set[str]:
    """The variables in TERM."""
    if isinstance(term, str):
        return {term} if term.startswith("?") else set()
    return {name for part in term for name in variables(part)} if isinstance(term, tuple) else set()


def is_true(condition: Condition, world: World) -> bool:
    """Whether CONDITION, which has no variables, is true."""
    word, *parts = condition
    if word == "fact":
        return tuple(parts) in world.facts
    if word == "x":
        return bool(world.x == parts[0])
    if word in ("and", "or"):
        return (all if word == "and" else any)(is_true(part, world) for part in parts)
    return not is_true(parts[0], world) if word == "not" else True


def solutions(condition: Condition, world: World) -> list[dict[str, str]]:
    """For what its variables can stand, so that CONDITION is true."""
    names = sorted(variables(condition))
    tried = [dict(zip(names, places, strict=True)) for places in product(PLACES, repeat=len(names))]
    return [bindings for bindings in tried if is_true(filled(condition, bindings), world)]


def lasts(term: Any, world: World) -> bool:
    """Whether what must hold all the time that TERM is active does."""
    return all(
        bool(solutions(condition, world)) == (word == "while")
        for word, condition in getattr(term, "modifiers", ())
        if word in ("while", "until")
    )


def entries(term: Any, world: World) -> list[Any]:
    """TERM, as its modifiers bind the variables in its steps; nothing, if they do not let it begin."""
    found: list[dict[str, str]] = [{}]
    for word, condition in getattr(term, "modifiers", ()):
        if word in ("while", "when"):
            found = [{**before, **now} for before in found for now in solutions(condition, world)]
        elif solutions(condition, world):
            return []
    return [term._replace(steps=filled(term.steps, bindings)) if bindings else term for bindings in found]


# --- one action ----------------------------------------------------------------------


def changed(world: World, effects: Any) -> World:
    """WORLD after EFFECTS."""
    for word, *what in effects:
        if word == "assert":
            world = world._replace(facts=world.facts | {tuple(what)})
        elif word == "retract":
            world = world._replace(facts=world.facts - {tuple(what)})
        else:
            world = world._replace(x=what[0])
    return world


def acted(acts: tuple[Act, ...], world: World) -> tuple[Notes, Done, World]:
    """What comes of ACTS, which are one action: the first that fails ends it."""
    notes: list[str] = []
    for act in acts:
        notes.append(f"{act.name}{act.about}")
        world = changed(world, act.effects)
        world = world._replace(left=world.left - 1)
        if world.left <= 0:
            world = changed(world, [("assert", "over")])
        if is_true(act.fails, world):
            return tuple(notes), Done("failed", ("bad", act.name)), world
    return tuple(notes), Done("ok", acts[-1].name), world
