"""Facts for people at the prompt: what relations there are, what one holds, what a query finds.

Tables of text; values stand in lower case, as people write them. Of many rows
the first are shown, and the others counted.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from typing import NamedTuple

from eslang.base.lists import Cons, from_items
from eslang.base.printer import WriteSettings, prin1
from eslang.base.suggest import nearest
from eslang.base.symbols import Symbol, Value
from eslang.facts.goals import CONNECTIVES, read_query, shape_of
from eslang.facts.query import Facts
from eslang.facts.terms import value_of
from eslang.tools.columns import fitted, table

ROWS = 20  # of one table
COUNTED = 100_000  # answers of a query; more are not counted
NUMBERS = ("int", "float", "Ratio")
WRITTEN = WriteSettings(case="DOWNCASE", length=40, level=8)
DEFRULE = Symbol.intern("DEFRULE", "ESL")
HEADER = ("relation", "facts", "rules", "declared")
NOTHING = "There are no facts.\n"


class Named(NamedTuple):
    """A relation by its name and arity; without an arity, a name of which nothing else is known."""

    name: Symbol
    arity: int | None

    def __str__(self) -> str:
        return written(self.name) + (f"/{self.arity}" if self.arity is not None else "")


def written(value: Value) -> str:
    """VALUE as people write it, not too long."""
    return prin1(value, WRITTEN)


def counted(number: int, word: str) -> str:
    """NUMBER things called WORD."""
    return f"{number:,} {word}" if number != 1 else f"1 {word.removesuffix('s')}"


class FactTables:
    """The tables of one database, for a terminal with so many columns."""

    def __init__(self, facts: Facts, columns: int) -> None:
        self.facts = facts
        self.columns = columns

    # --- all relations -----------------------------------------------------------

    def overview(self) -> str:
        """What relations there are."""
        names = sorted(self.relations(), key=str)
        if not names:
            return NOTHING
        rows = [self._about(named) for named in names]
        kept = [i for i in range(len(HEADER)) if any(row[i] for row in rows)]
        cells = [[row[i] for i in kept] for row in rows]
        right = [HEADER[i] in ("facts", "rules") for i in kept]
        return self._told(table([HEADER[i] for i in kept], cells, right, self.columns))

    def relations(self) -> list[Named]:
        """All relations that have facts or rules, were declared, or had facts once."""
        facts = self.facts
        found = {Named(*key): None for key, relation in facts.relations.items() if relation.rows}
        found |= {Named(*key): None for key in facts.rules.by_name}
        found |= {Named(name, arity): None for name, many in facts.declared.items() for arity in many}
        known = {named.name for named in found}
        rest = [name for name in (*facts.declared, *facts.known) if name not in known]
        return [*found, *(Named(name, None) for name in dict.fromkeys(rest))]

    def _about(self, named: Named) -> tuple[str, str, str, str]:
        """The row of one relation."""
        words = []
        if named.name in self.facts.properties:
            words.append("property")
        elif named.name in self.facts.declared:
            words.append("relation")
        arguments = self._arguments(named)
        if arguments:
            words.append(written(from_items(arguments)))
        rules = self.facts.rules.by_name.get((named.name, named.arity or 0), [])
        return str(named), f"{self._size(named):,}", f"{len(rules):,}" if rules else "", " ".join(words)

    def _size(self, named: Named) -> int:
        relation = self.facts.relations.get((named.name, named.arity or 0))
        return 0 if relation is None or named.arity is None else len(relation.rows)

    def _arguments(self, named: Named) -> Sequence[Symbol]:
        """The names of the arguments, if they are declared."""
        return () if named.arity is None else self.facts.arguments.get((named.name, named.arity), ())

    # --- one relation ------------------------------------------------------------

    def relation(self, name: Symbol) -> str:
        """All that the relations called NAME hold, or the one that the list of all calls so."""
        relations = self.relations()
        found = [named for named in relations if named.name is name]
        found = found or [named for named in relations if str(named) == written(name)]
        if not found:
            return self.unknown(name)
        return "\n".join([self._relation(named) for named in sorted(found, key=lambda each: each.arity or 0)])

    def _relation(self, named: Named) -> str:
        """The facts of one relation as a table, and its rules."""
        key = named.name, named.arity or 0
        rules = self.facts.rules.by_name.get(key, [])
        size = self._size(named)
        title = [f"{named}" + (", a property" if named.name in self.facts.properties else "")]
        title += [": ", counted(size, "facts") if size else "no facts"]
        title += [", ", counted(len(rules), "rules")] if rules else []
        lines = ["".join(title)]
        if size:
            rows = self.facts.relations[key].rows
            header = [written(each) for each in self._arguments(named)]
            lines += self.rows(header, ([value_of(code) for code in row] for row in rows), named.arity or 0)
        if size > ROWS:
            lines.append(f"… and {size - ROWS:,} more")
        lines += [written(Cons(DEFRULE, rule.form)) for rule in rules]
        if rules:
            lines.append(f"`:facts {self.pattern(named)}` asks what follows.")
        return self._told(lines)

    def pattern(self, named: Named) -> str:
        """A pattern that finds all facts of a relation."""
        names: Iterable[object] = [written(each) for each in self._arguments(named)]
        variables = [f"?{each}" for each in names or range(1, (named.arity or 0) + 1)]
        return f"({' '.join([written(named.name), *variables])})"

    def rows(self, header: Sequence[str], rows: Iterable[Sequence[Value]], count: int) -> list[str]:
        """The first of ROWS as a table of COUNT columns."""
        shown = list(islice(rows, ROWS))
        right = [all(row[i].__class__.__name__ in NUMBERS for row in shown) for i in range(count)]
        cells = [[written(value) for value in row] for row in shown]
        return table(header, cells, right, self.columns) if count else []

    def unknown(self, name: Symbol) -> str:
        """There is no relation called NAME."""
        near = nearest(written(name), {written(named.name) for named in self.relations()})
        hint = f"; the nearest name is `{near}`" if near else ""
        return f"There is no relation `{written(name)}`{hint}.\n"

    # --- a query -----------------------------------------------------------------

    def answers(self, query: Value) -> str:
        """What QUERY finds, a column for each variable."""
        for name in names_in(query):
            if not (self.facts.is_relation(name) or self.facts.is_call(name)):
                return self.unknown(name)
        variables = shape_of(read_query(query)[0]).variables
        if not variables:
            return "It holds.\n" if self.facts.first(query) is not None else "It does not hold.\n"
        found = self.facts.solutions(query)
        try:
            first = list(islice(found, ROWS))
            more = sum(1 for _ in islice(found, COUNTED))
        finally:
            found.close()
        if not first:
            return "Nothing matches.\n"
        rows = ([solution[variable] for variable in variables] for solution in first)
        lines = self.rows([written(each) for each in variables], rows, len(variables))
        if more:
            lines.append(f"… and {'at least ' if more == COUNTED else ''}{more:,} more")
        return self._told(lines)

    def _told(self, lines: Iterable[str]) -> str:
        return "".join([fitted(line, self.columns) + "\n" for line in lines])


def names_in(query: Value) -> Iterator[Symbol]:
    """The names that stand first in the goals of QUERY, which may be wrong."""
    pending = [query]
    while pending:
        goal = pending.pop()
        if goal.__class__ is Cons and isinstance(goal.car, Symbol):
            if goal.car not in CONNECTIVES:
                yield goal.car
            else:
                rest = goal.cdr
                while rest.__class__ is Cons:
                    pending.append(rest.car)
                    rest = rest.cdr
