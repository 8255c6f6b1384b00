"""Watching: who waits for facts to change is told, and nobody else.

An evaluation notes what it read: for each access the keys that it looked up.
A watch on these notes is called for a change of a row that one of those
look-ups would find, or would have found. What is watched by others costs a
change nothing but a look-up for each way in which its relation is watched.
"""

from __future__ import annotations

from eslang.base.hints import Any, Callable, Iterable
from eslang.base.lists import Cons
from eslang.base.symbols import Symbol
from eslang.facts.relations import Access, Positions, Project, Relation
from eslang.facts.terms import Code, Row, fact_of
from eslang.facts.views import Accesses, View


class Change:
    """A fact came, or went."""

    __slots__ = ("added", "name", "row")

    def __init__(self, added: bool, name: Symbol, row: Row) -> None:
        self.added = added
        self.name = name
        self.row = row

    @property
    def fact(self) -> Cons:
        """The fact, as a list."""
        return fact_of(self.name, self.row)

    def __repr__(self) -> str:
        return f"{'+' if self.added else '-'}{self.fact!r}"


class Reads:
    """What an evaluation read: keys by access; whether it asked Lisp, and facts changed before its end."""

    __slots__ = ("asked_lisp", "keys", "overtaken")

    def __init__(self) -> None:
        self.keys: dict[tuple[Relation, Positions], dict[Code, None]] = {}
        self.asked_lisp = False
        self.overtaken = False

    def through(self, accesses: Accesses, readers: list[Callable[..., Any]]) -> list[Callable[..., Any]]:
        """What reads as READERS do, for these accesses, and notes it."""
        for relation in accesses.relations:
            self.keys.setdefault((relation, RULES), {})[None] = None  # a rule may still come
        return [
            self._reader(access, reader) for access, reader in zip(accesses.accesses, readers, strict=True)
        ]

    def compare(self, view: View) -> None:
        """Note whether something that was read has changed since VIEW was opened."""
        for access, key in view.changes():
            if key in self.keys.get((access.relation, access.positions), ()):
                self.overtaken = True

    def _reader(self, access: Access, now: Callable[..., Any]) -> Callable[..., Any]:
        noted = self.keys.setdefault((access.relation, access.positions), {})

        def look(key: Code = None, *default: Any) -> Any:
            noted[key] = None
            return now(key, *default)

        def everything() -> Any:
            noted[None] = None
            return now()

        return look if access.positions or access.is_ground else everything

    def relations(self) -> list[tuple[Symbol, int]]:
        """The names and arities of what was read, without repetition."""
        return list({(relation.name, relation.arity): None for relation, _ in self.keys})


RULES: Positions = (-1,)  # stands for "the rules of this relation"


class Watch:
    """Somebody who waits for a change of what was read."""

    __slots__ = ("callback", "keys")

    def __init__(self, reads: Reads, callback: Callable[[Change | None], object]) -> None:
        self.keys = [(relation, positions, tuple(keys)) for (relation, positions), keys in reads.keys.items()]
        self.callback = callback

    def wake(self, change: Change | None) -> None:
        """Tell of CHANGE, unless nobody wants to know any more."""
        if self.keys:
            self.callback(change)


class Watched:
    """The watches on one relation by one way to read it."""

    __slots__ = ("by_key", "project")

    def __init__(self, project: Project | None) -> None:
        self.project = project
        self.by_key: dict[Code, dict[Watch, None]] = {}


def watch(reads: Reads, callback: Callable[[Change | None], object]) -> Watch:
    """Call CALLBACK with every change of what READS holds; with None where the rules changed."""
    made = Watch(reads, callback)
    for relation, positions, keys in made.keys:
        watched = relation.watched.get(positions)
        if watched is None:
            project = None if positions == RULES else Access(relation, positions).project()
            watched = relation.watched[positions] = Watched(project)
        for key in keys:
            watched.by_key.setdefault(key, {})[made] = None
    return made


def unwatch(old: Watch) -> None:
    """OLD is not called any more; harmless if it is not anyway."""
    for relation, positions, keys in old.keys:
        watched = relation.watched.get(positions)
        if watched is None:
            continue
        for key in keys:
            watches = watched.by_key.get(key, {})
            watches.pop(old, None)
            if not watches:
                watched.by_key.pop(key, None)
        if not watched.by_key:
            del relation.watched[positions]
    old.keys = []


def woken_by(relation: Relation, row: Row) -> Iterable[Watch]:
    """Who watches for ROW of RELATION to come or go."""
    found: dict[Watch, None] = {}
    for watched in relation.watched.values():
        if watched.project is not None:
            found.update(watched.by_key.get(watched.project(row), {}))
    return found


def woken_by_rules(relation: Relation) -> Iterable[Watch]:
    """Who watches for the rules of RELATION to change."""
    watched = relation.watched.get(RULES)
    return {} if watched is None else dict(watched.by_key.get(None, {}))
