"""Views: what a query reads, as it was when the query was asked.

A query reads the facts as they are until one of them changes. Just before
that, the open views are handed what is about to change, the relation goes on
with a copy, and the query reads through its view from then on. So nothing is
copied that does not change, and nobody who reads sees a change.
"""

from __future__ import annotations

from itertools import chain, compress, repeat

from eslang.base.hints import Any, Callable, Iterable, Iterator
from eslang.facts.relations import Access, Bucket, Relation
from eslang.facts.terms import Code, Row

Readers = list[Callable[..., Any]]
SLICE = 500  # rows, of those that stand in large buckets, between two pauses of a query


class Accesses:
    """The accesses of one query, and what its views need of them."""

    __slots__ = ("accesses", "projects", "relations")

    def __init__(self, accesses: Iterable[Access]) -> None:
        self.accesses = list(accesses)
        self.projects = [access.project() for access in self.accesses]
        self.relations = list({id(access.relation): access.relation for access in self.accesses}.values())

    def readers(self) -> Readers:
        """What reads the facts as they are."""
        return [access.reader() for access in self.accesses]


class View:
    """What one run of a query reads: the facts as they are, and once it is open, as they were then."""

    __slots__ = ("accesses", "is_open", "kept", "noted", "use")

    def __init__(self, accesses: Accesses, noted: Callable[[Readers], Readers] | None = None) -> None:
        self.accesses = accesses
        self.noted = noted  # what makes readers that note what they read
        self.is_open = False
        self.kept: list[dict[Code, Any]] | None = None  # by access and key, since the first change
        self.use: Callable[[Readers], None] = lambda readers: None  # lets the functions that run read so

    def readers(self) -> Readers:
        """What reads as this view sees the facts."""
        readers = self.accesses.readers()
        if self.kept is not None:
            ways = zip(self.accesses.accesses, readers, self.kept, strict=True)
            readers = [_keeping_reader(access, now, kept) for access, now, kept in ways]
        return readers if self.noted is None else self.noted(readers)

    def open(self) -> None:
        """The facts may change from now on; nobody who reads here is to see that."""
        if not self.is_open:
            self.is_open = True
            for relation in self.accesses.relations:
                relation.views[self] = None

    def close(self) -> None:
        """Nobody reads here any more."""
        if self.is_open:
            self.is_open = False
            for relation in self.accesses.relations:
                del relation.views[self]

    def changes(self) -> Iterable[tuple[Access, Code]]:
        """What has changed since the view was opened, and was kept."""
        for access, kept in zip(self.accesses.accesses, self.kept or (), strict=False):
            yield from ((access, key) for key in kept)

    def keep(self, relation: Relation, row: Row) -> None:
        """Note what every access would find ROW among, before ROW comes or goes."""
        is_first = self.kept is None
        if self.kept is None:
            self.kept = [{} for _ in self.accesses.accesses]
        for number, access in enumerate(self.accesses.accesses):
            if access.relation is relation:
                key = self.accesses.projects[number](row)
                if key not in self.kept[number]:
                    self.kept[number][key] = access.retire(key)
        if is_first:
            self.use(self.readers())


def _keeping_reader(access: Access, now: Callable[..., Any], kept: dict[Code, Any]) -> Callable[..., Any]:
    """What reads what is KEPT, and where nothing is, the facts as they are NOW."""

    def has(row: Row) -> bool:
        found = kept.get(row)
        return bool(now(row) if found is None else found)

    def everything() -> Iterable[Row]:
        rows = kept.get(None)
        return now() if rows is None else rows  # type: ignore[no-any-return]

    def bucket(key: Code, default: Bucket) -> Bucket:
        rows = kept.get(key)
        return now(key, default) if rows is None else rows

    if access.is_ground:
        return has
    return bucket if access.positions else everything


class Pace:
    """The pauses of one run: rows of large buckets are counted, and now and then others have their turn."""

    __slots__ = ("pause", "pauses", "ticks")

    def __init__(self, pauses: Pauses, pause: Callable[[], None]) -> None:
        self.pauses = pauses
        self.pause = pause
        self.ticks: Iterator[bool] | None = None

    def rows(self, rows: Iterable[Any]) -> Iterator[Any]:
        """ROWS, one after another, with pauses."""
        return compress(rows, self.ticks or self._begin())

    def _begin(self) -> Iterator[bool]:
        """The ticks; a jump that leaves a pause must not end them, so it is raised by a part of them."""
        pause = self.pause

        def parts() -> Iterable[Iterator[Any]]:
            return repeat(True, SLICE), iter(pause, None)

        self.ticks = ticks = chain.from_iterable(chain.from_iterable(iter(parts, None)))
        return ticks


class Pauses:
    """What queries do in their pauses, as the database is told."""

    def __init__(self, is_held: Callable[[], bool]) -> None:
        self.is_held = is_held  # whether others are to wait in any case
        self.give_way: Callable[[], None] = lambda: None  # lets others have their turn
        self.look: Callable[[], None] = lambda: None  # sees only whether the run is to end
        self.left: dict[View, None] = {}  # of runs that began on the facts as they are, and paused

    def between(self) -> None:
        """A pause of a query that only reads."""
        (self.look if self.is_held() else self.give_way)()

    def leave(self, view: View) -> None:
        """A pause of a run that had the facts as they are to itself, and reads VIEW from now on."""
        if not view.is_open:
            view.open()
            self.left[view] = None
        self.between()

    def end(self, view: View) -> None:
        """The run that reads VIEW is over."""
        if view in self.left:
            del self.left[view]
            view.close()
