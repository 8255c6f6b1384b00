"""Tables: the answers of rules that need their own answers.

A question to recursive rules (a relation with something known of it) has a
table. Whoever meets the question again while the table is being filled is
noted as a consumer, and goes on with each answer once, those that are there
and those to come; so every recursion ends when nothing new turns up. What is
complete is kept as long as the query that asked.
"""

from __future__ import annotations

from eslang.base.hints import Any, Callable, Iterable
from eslang.facts.terms import Code, Row

Key = tuple[Code, ...]
Environment = tuple[Code, ...]
Segment = Callable[["Table", Any, list[Row]], object]  # the rest of a rule behind a question


class Table:
    """The answers to one question."""

    __slots__ = ("consumers", "fresh", "rows", "shared")

    def __init__(self) -> None:
        self.rows: dict[Row, None] = {}
        self.shared: list[Row] = []  # what all consumers have got, or are about to get
        self.fresh: list[Row] = []  # what they have not
        self.consumers: list[tuple[Segment, Table, Environment]] = []


class Tables:
    """The tables of one query."""

    def __init__(self, paced: Callable[[list[Any]], Iterable[Any]]) -> None:
        self.paced = paced  # goes through a list that grows, with pauses
        self.starts: dict[int, Segment] = {}  # how a table's filling begins, by the number of its rules
        self.tables: dict[tuple[int, Key], Table] = {}
        self.agenda: list[tuple[Segment, Table, Any, list[Row]]] = []

    def complete(self, number: int, key: Key) -> dict[Row, None]:
        """All answers to a question."""
        table = self.tables.get((number, key))
        if table is None:
            outer, self.agenda = self.agenda, []
            table = self._begin(number, key)
            for segment, target, environment, rows in self.paced(self.agenda):
                segment(target, environment, rows)
                if target.fresh:
                    self._share(target)
            self.agenda = outer
        return table.rows

    def demand(self, number: int, key: Key, rest: Segment, target: Table, environment: Environment) -> None:
        """Go on with REST, for TARGET, for each answer to a question of the same circle."""
        table = self.tables.get((number, key)) or self._begin(number, key)
        table.consumers.append((rest, target, environment))
        if table.shared:
            self.agenda.append((rest, target, environment, list(table.shared)))

    def clear(self) -> None:
        """Nothing is asked any more."""
        for table in self.tables.values():
            table.consumers.clear()
        self.tables.clear()
        self.starts.clear()

    def _begin(self, number: int, key: Key) -> Table:
        table = self.tables[number, key] = Table()
        self.agenda.append((self.starts[number], table, key, []))
        return table

    def _share(self, table: Table) -> None:
        """Hand the new answers of TABLE to all its consumers."""
        fresh, table.fresh = table.fresh, []
        table.shared += fresh
        for segment, target, environment in table.consumers:
            self.agenda.append((segment, target, environment, fresh))
