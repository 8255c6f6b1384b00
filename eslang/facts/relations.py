"""Relations: the rows of one name and arity, and the indexes on them.

Rows stand in the order of their assertion. An index on some positions is made
when it is first asked for, and kept right ever after; what it holds under one
key is a bucket: a tuple while it is small, else a dict used as an ordered set.
Whoever goes on reading while rows may change does so through a view (views.py).
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

    __slots__ = ("arity", "indexes", "is_plain", "moved", "name", "rows", "unique", "views", "watched")

    def __init__(self, name: Symbol, arity: int, moved: Callable[[], None] = lambda: None) -> None:
        self.name = name
        self.arity = arity
        self.rows: dict[Row, Any] = {}  # in their order; the values are a journal's
        self.is_plain = True  # every code in the rows is a value
        self.indexes: list[Index] = []
        self.unique: Positions | None = None  # of a property: the positions that determine the last one
        self.views: dict[Any, None] = {}  # the open ones that read here (views.py)
        self.moved = moved  # is called when `rows` is another dict
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
        if self.views:
            self._keep(row)
        self.rows[row] = None
        for index in self.indexes:
            _put(index, row)

    def remove(self, row: Row) -> None:
        """Give up ROW, which is there."""
        if self.views:
            self._keep(row)
        del self.rows[row]
        for index in self.indexes:
            _take(index, row)

    def _keep(self, row: Row) -> None:
        """Let the views keep what they see where ROW comes or goes; one may close meanwhile, as garbage."""
        for view in tuple(self.views):
            view.keep(self, row)

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

    def retire(self, key: Code) -> Any:
        """What this access finds under KEY now; the relation goes on with a copy of it."""
        relation = self.relation
        if self.is_ground:
            return key in relation.rows
        if not self.positions:
            rows = relation.rows
            relation.rows = rows.copy()
            relation.moved()
            return rows
        buckets = relation.index(self.positions)
        bucket = buckets.get(key, EMPTY)
        if bucket.__class__ is dict:
            buckets[key] = bucket.copy()
        return bucket

    def reader(self) -> Callable[..., Any]:
        """What reads the facts as they are: has(row), all(), or bucket(key, default)."""
        if self.is_ground:
            return self.relation.rows.__contains__
        return self.relation.index(self.positions).get if self.positions else self.relation.scan


def _itself(row: Row) -> Code:
    return row


def _nothing(row: Row) -> Code:
    return None
