"""The static structure of a plan, as it is drawn: boxes in boxes' care, and what joins them.

A definition is a tree of boxes. Keys join boxes across the trees: who calls a
definition, who waits for a checkpoint, an event, or the end of a task. Nothing
here knows a form, nor how anything is drawn.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

EMPTY = "nothing here is defined, or done, that could be drawn"


class Key(NamedTuple):
    """What boxes have in common: a definition, a checkpoint, an event, the end of a task."""

    kind: str  # call, achieve, checkpoint, event, end
    of: Hashable


@dataclass(slots=True, eq=False)
class Box:
    """One construct, step or definition: its kind (see graph_looks.py), and its lines of text."""

    kind: str
    lines: list[str]
    tag: str = ""  # a word above the lines
    edge: str = ""  # what stands on the line that leads to it
    under: str = ""  # what stands below that line
    title: str = ""  # more words, where there is room for them
    parts: list[Box] = field(default_factory=list)
    gives: list[Key] = field(default_factory=list)  # lines go out from it
    takes: list[Key] = field(default_factory=list)  # lines come to it
    label: str = ""  # the name that it has in the drawing
    place: str = ""  # file:line

    def all(self) -> Iterator[Box]:
        """This box and all in its care, as they stand in the text."""
        pending = [self]
        while pending:
            box = pending.pop()
            yield box
            pending.extend(reversed(box.parts))

    def joins(self) -> bool:
        """Whether a line goes out from it, or comes to it, besides those of its tree."""
        return bool(self.gives or self.takes)


class Definition(NamedTuple):
    """A definition of the plan: its name, as people would ask for it, and its tree."""

    name: str
    box: Box


class Join(NamedTuple):
    """Boxes that a key joins: lines go from each of the one kind to each of the other."""

    key: Key
    sources: list[Box]
    sinks: list[Box]


class Graph:
    """What is drawn: definitions in the order of the text, and what joins their boxes."""

    def __init__(self, title: str, definitions: Iterable[Definition]) -> None:
        self.title = title
        self.definitions = list(definitions)
        for number, box in enumerate(self.boxes(), 1):
            box.label = f"n{number}"

    def boxes(self) -> Iterator[Box]:
        """All boxes."""
        for definition in self.definitions:
            yield from definition.box.all()

    def joins(self) -> list[Join]:
        """What joins boxes that are drawn."""
        found: dict[Key, Join] = {}
        for box in self.boxes():
            for key in box.gives:
                found.setdefault(key, Join(key, [], [])).sources.append(box)
            for key in box.takes:
                found.setdefault(key, Join(key, [], [])).sinks.append(box)
        return [join for join in found.values() if join.sources and join.sinks]

    def only(self, names: Iterable[str]) -> Graph:
        """The same with those definitions alone that are called one of NAMES."""
        wanted = set(names)
        return Graph(self.title, [each for each in self.definitions if each.name in wanted])
