"""Relations: the rows of one name and arity, and the indexes on them.

Rows stand in the order of their assertion. An index on some positions is made
when it is first asked for, and kept right ever after; what it holds under one
key is a bucket: a tuple while it is small, else a dict used as an ordered set.
Whoever goes on reading while rows may change reads through a View, which sees
the rows as they were: it is handed each bucket just before that changes.
"""

from __future__ import annotations

from operator import itemgetter

from eslang.base.hints import Any, Callable, Iterable, NamedTuple
from eslang.base.symbols import Symbol
from eslang.facts.terms import Code, Row

Positions = tuple[int, ...]
Bucket = Any  # a tuple of rows, or a dict whose keys are rows
Project = Callable[[Row], Code]  # the key of a row

SMALL = 8  # rows in a bucket that is still a tuple
EMPTY: tuple[Row, ...] = ()


class Index(NamedTuple):
    """The buckets of a relation's rows, by what stands at some positions."""

    positions: Positions
    project: Project
    buckets: dict[Code, Bucket]


class Relation:
    """All facts of one name and arity."""

    __slots__ = ("arity", "indexes", "is_plain", "name", "rows", "unique", "views", "watched")

    def __init__(self, name: Symbol, arity: int) -> None:
        self.name = name
        self.arity = arity
        self.rows: dict[Row, Any] = {}  # in their order; the values are a journal's
        self.is_plain = True  # every code in the rows is a value
        self.indexes: list[Index] = []
        self.unique: Positions | None = None  # of a property: the positions that determine the last one
        self.views: list[View] = []
        self.watched: dict[Positions, Any] = {}  # who waits for a change (watching.py)

    def index(self, positions: Positions) -> dict[Code, Bucket]:
        """The buckets by what stands at POSITIONS (some, not all); made if nobody asked before."""
        for index in self.indexes:
            if index.positions == positions:
                return index.buckets
        made = Index(positions, itemgetter(*positions), {})
        for row in self.rows:
            _put(made, row)
        self.indexes.append(made)
        return made.buckets

    def add(self, row: Row) -> None:
        """Take ROW, which is not there yet, as the last one."""
        for view in self.views:
            view.keep(self, row)
        self.rows[row] = None
        for index in self.indexes:
            _put(index, row)

    def remove(self, row: Row) -> None:
        """Give up ROW, which is there."""
        for view in self.views:
            view.keep(self, row)
        del self.rows[row]
        for index in self.indexes:
            _take(index, row)

    def rivals(self, row: Row) -> list[Row]:
        """The rows that cannot stand beside ROW, since this is a property."""
        if not self.unique:
            return [] if self.unique is None else [other for other in self.rows if other != row]
        bucket = self.index(self.unique).get(itemgetter(*self.unique)(row), EMPTY)
        return [other for other in bucket if other != row]

    def scan(self) -> Iterable[Row]:
        """All rows."""
        return self.rows


def _put(index: Index, row: Row) -> None:
    """Enter ROW into INDEX."""
    buckets = index.buckets
    key = index.project(row)
    bucket = buckets.get(key)
    if bucket is None:
        buckets[key] = (row,)
    elif bucket.__class__ is dict:
        bucket[row] = None
    elif len(bucket) < SMALL:
        buckets[key] = (*bucket, row)
    else:
        buckets[key] = dict.fromkeys((*bucket, row))


def _take(index: Index, row: Row) -> None:
    """Strike ROW from INDEX."""
    buckets = index.buckets
    key = index.project(row)
    bucket = buckets[key]
    if len(bucket) == 1:
        del buckets[key]
    elif bucket.__class__ is dict:
        del bucket[row]
    else:
        buckets[key] = tuple(other for other in bucket if other != row)


class Access(NamedTuple):
    """One way in which a query looks into a relation: what it knows when it looks."""

    relation: Relation
    positions: Positions

    @property
    def is_ground(self) -> bool:
        """Whether a whole row is asked for."""
        return len(self.positions) == self.relation.arity

    def project(self) -> Project:
        """What makes a row the key that this access would find it under."""
        if self.is_ground:
            return _itself
        return itemgetter(*self.positions) if self.positions else _nothing

    def reader(self) -> Callable[..., Any]:
        """What reads the facts as they are: has(row), all(), or bucket(key, default)."""
        if self.is_ground:
            return self.relation.rows.__contains__
        return self.relation.index(self.positions).get if self.positions else self.relation.scan


def _itself(row: Row) -> Code:
    return row


def _nothing(row: Row) -> Code:
    return None


class Accesses:
    """The accesses of one query, and what its views need of them."""

    __slots__ = ("accesses", "projects", "relations")

    def __init__(self, accesses: Iterable[Access]) -> None:
        self.accesses = list(accesses)
        self.projects = [access.project() for access in self.accesses]
        self.relations = list({id(access.relation): access.relation for access in self.accesses}.values())

    def readers(self) -> list[Callable[..., Any]]:
        """What reads the facts as they are."""
        return [access.reader() for access in self.accesses]


class View:
    """Some relations as they were when the view was opened, for the accesses of one query."""

    __slots__ = ("accesses", "kept", "readers")

    def __init__(self, accesses: Accesses) -> None:
        self.accesses = accesses
        self.kept: list[dict[Code, Any]] = []
        self.readers: list[
            Callable[..., Any]
        ] = []  # what reads through this view, in the order of the accesses
        for access in accesses.accesses:
            kept: dict[Code, Any] = {}
            self.kept.append(kept)
            self.readers.append(_keeping_reader(access, kept))  # and now its index exists, before any change
        for relation in accesses.relations:
            relation.views.append(self)

    def close(self) -> None:
        """Nobody reads here any more."""
        for relation in self.accesses.relations:
            if self in relation.views:
                relation.views.remove(self)

    def keep(self, relation: Relation, row: Row) -> None:
        """Note what every access would find ROW among, before ROW comes or goes."""
        for number, access in enumerate(self.accesses.accesses):
            if access.relation is relation:
                key = self.accesses.projects[number](row)
                if key not in self.kept[number]:
                    self.kept[number][key] = _present(access, key)


def _present(access: Access, key: Code) -> Any:
    """What ACCESS finds under KEY now."""
    if access.is_ground:
        return key in access.relation.rows
    if not access.positions:
        return tuple(access.relation.rows)
    return tuple(access.relation.index(access.positions).get(key, EMPTY))


def _keeping_reader(access: Access, kept: dict[Code, Any]) -> Callable[..., Any]:
    """What reads what is KEPT, and where nothing is, the facts as they are."""
    now = access.reader()

    def has(row: Row) -> bool:
        found = kept.get(row)
        return bool(now(row) if found is None else found)

    def everything() -> Iterable[Row]:
        rows = kept.get(None)
        if rows is None:
            rows = kept[None] = tuple(now())
        return rows

    def bucket(key: Code, default: Bucket) -> Bucket:
        rows = kept.get(key)
        if rows is None:
            rows = now(key, default)
            if rows.__class__ is dict:
                rows = kept[key] = tuple(rows)
        return rows

    if access.is_ground:
        return has
    return bucket if access.positions else everything
