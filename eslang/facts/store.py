"""The store: what is asserted, and who hears of it.

A fact is held once. A change is whole before anybody is told: an UPDATE takes
away and adds, a property's new value takes the place of the old, and only then
do those who subscribed hear of each fact that came or went, in order, and
those who watch are woken, once.
"""

from __future__ import annotations

from eslang.base.failure import type_error
from eslang.base.hints import Any, Callable, Iterable, Iterator, Sequence
from eslang.base.lists import Cons
from eslang.base.symbols import Symbol, Value
from eslang.facts.goals import (
    CONNECTIVES,
    FACT,
    RELATION,
    Atom,
    Constants,
    read_query,
    shape_of,
    unbound,
    variable_in,
)
from eslang.facts.journal import Journal
from eslang.facts.patterns import Pattern
from eslang.facts.properties import overruled, unique_positions
from eslang.facts.relations import Relation
from eslang.facts.shapes import END, Shapes, behind
from eslang.facts.terms import DIRECT, Code, Row, code_of, fact_of
from eslang.facts.unify import is_variable
from eslang.facts.watching import Change, Watch, woken_by

LONGEST = 1000  # arguments of a fact
MANY = 2000  # shapes of queries that are remembered
Subscriber = Callable[[Change], object]


class Store:
    """Facts by relation."""

    def __init__(self) -> None:
        self.relations: dict[tuple[Symbol, int], Relation] = {}
        self.reserved = CONNECTIVES  # names that mean something else in every query
        self.properties: dict[Symbol, None] = {}
        self.known: dict[Symbol, None] = {}  # names that have, or had, facts
        self.subscribers: list[Subscriber] = []
        self.audience: Sequence[object] = ()  # while there is one, TELL is called with each change, too
        self.tell: Subscriber = lambda change: None
        self.journal: Journal | None = None
        self._patterns = Shapes()  # that were asked for by RETRACT and UPDATE
        self._changes: list[tuple[Relation, Change]] = []  # parts of a change that is not whole yet
        self._calls: list[tuple[Callable[[Any], object], Change | None]] = []  # that are due
        self.is_telling = False

    def relation(self, name: Symbol, arity: int) -> Relation:
        """The relation of that name and arity; an empty one if nobody spoke of it yet."""
        relation = self.relations.get((name, arity))
        if relation is None:
            self.check_name(name)
            relation = self.relations[name, arity] = Relation(name, arity, self.rows_moved)
            if name in self.properties:
                relation.unique = unique_positions(arity)
        return relation

    def check_name(self, name: Value) -> None:
        """Fail if no relation can be called NAME."""
        if not isinstance(name, Symbol) or is_variable(name) or name in self.reserved:
            raise type_error(name, RELATION)

    def named(self, name: Symbol) -> list[Relation]:
        """The relations of that name, whatever their arity."""
        return [relation for relation in self.relations.values() if relation.name is name]

    def __len__(self) -> int:
        return sum(len(relation.rows) for relation in self.relations.values())

    def __contains__(self, fact: Value) -> bool:
        relation, row = self.read_fact(fact)
        return row in relation.rows

    def facts(self, name: Symbol | None = None) -> Iterator[Cons]:
        """All facts, or those of one name, as lists, relation by relation in the order of assertion."""
        for relation in list(self.relations.values()):
            if name is None or relation.name is name:
                for row in tuple(relation.rows):
                    yield fact_of(relation.name, row)

    def read_fact(self, fact: Value) -> tuple[Relation, Row]:
        """The relation and the row of a fact; fails if a variable stands in it."""
        if fact.__class__ is not Cons:
            raise type_error(fact, "LIST")
        name = fact.car
        row: list[Code] = []
        rest = fact.cdr
        is_plain = True
        while rest.__class__ is Cons:
            if len(row) == LONGEST:
                raise type_error(fact, FACT)
            term = rest.car
            rest = rest.cdr
            kind = term.__class__
            if kind not in DIRECT or (kind is Symbol and (word := term.name) < "@" and word >= "?"):
                term = code_of(term)
                variable = variable_in(term)
                if variable is not None:
                    raise unbound(variable, fact)
                is_plain = is_plain and kind is Symbol
            row.append(term)
        if rest is not None:
            raise type_error(fact, "LIST")
        relation = self.relations.get((name, len(row)))
        if relation is None:
            relation = self.relation(name, len(row))
        if relation.is_plain and not is_plain:
            self.became_coded(relation)
        return relation, tuple(row)

    def check(self, fact: Value) -> tuple[Relation, Row]:
        """The same for a fact that is to be held; fails if it cannot be."""
        relation, row = self.read_fact(fact)
        if self.journal is not None:
            self.journal.admit(relation, row)
        return relation, row

    def add(self, fact: Value) -> bool:
        """Hold FACT; false if it is held already."""
        relation, row = self.read_fact(fact)
        if self.journal is not None:
            self.journal.admit(relation, row)
        added = self._add(relation, row)
        self._tell()
        return added

    def add_all(self, facts: Iterable[Value]) -> int:
        """Hold all FACTS, as one change; how many were not held already. All are read before any is taken."""
        read = self.read_fact if self.journal is None else self.check
        relations: list[Relation] = []  # two lists: pairs would take more room than the facts
        rows: list[Row] = []
        for fact in facts:
            relation, row = read(fact)
            relations.append(relation)
            rows.append(row)
        count = 0
        for relation, row in zip(relations, rows, strict=True):
            count += self._add(relation, row)
        self._tell()
        return count

    def restore(self, fact: Value, note: object) -> None:
        """Hold FACT, which a journal has written down with NOTE; nobody is told."""
        relation, row = self.read_fact(fact)
        self.known[relation.name] = None
        relation.add(row)
        relation.rows[row] = note

    def retract(self, pattern: Value) -> int:
        """Give up all facts that match PATTERN; how many there were."""
        relation, rows = self.matching(pattern)
        for row in rows:
            self._remove(relation, row)
        self._tell()
        return len(rows)

    def update(self, pattern: Value, fact: Value) -> bool:
        """Let FACT take the place of all facts that match PATTERN; false if nothing changed by that."""
        relation, row = self.check(fact)
        old, rows = self.matching(pattern)
        gone = [each for each in rows if old is not relation or each != row]
        for each in gone:
            self._remove(old, each)
        added = self._add(relation, row)
        self._tell()
        return added or bool(gone)

    def clear(self) -> int:
        """Give up all facts; how many there were."""
        count = len(self)
        for relation in list(self.relations.values()):
            for row in tuple(relation.rows):
                self._remove(relation, row)
        self._tell()
        return count

    def matching(self, pattern: Value) -> tuple[Relation, list[Row]]:
        """The relation that PATTERN is about, and its rows that match, in order."""
        constants: Constants = []
        found: Pattern | None = behind(self._patterns.root, pattern, constants).get(END)
        if found is None:
            tokens, constants = read_query(pattern)
            atom = shape_of(tokens).goal
            if not isinstance(atom, Atom):
                raise type_error(pattern, FACT)
            relation = self.relation(atom.name, len(atom.terms))
            if len(self._patterns) >= MANY:
                self._patterns.clear()
            found = Pattern(relation, atom.terms)
            self._patterns.put(tokens, found)
        return found.relation, found.rows(constants)

    def declare_property(self, name: Symbol) -> None:
        """Let the last argument of NAME be unique for the others; of facts that clash the last stays."""
        self.properties[name] = None
        for relation in self.named(name):
            relation.unique = unique_positions(relation.arity)
            for row in overruled(relation) if relation.arity else ():
                self._remove(relation, row)
        self._tell()

    def subscribe(self, subscriber: Subscriber) -> Callable[[], None]:
        """Tell SUBSCRIBER of every change from now on; what is returned ends that."""

        def hear(change: Change) -> None:
            if hear in self.subscribers:
                subscriber(change)

        def unsubscribe() -> None:
            if hear in self.subscribers:
                self.subscribers.remove(hear)

        self.subscribers.append(hear)

        return unsubscribe

    def _add(self, relation: Relation, row: Row) -> bool:
        if row in relation.rows:
            return False
        if relation.unique is not None:
            for rival in relation.rivals(row):
                self._remove(relation, rival)
        if not relation.rows and relation.name not in self.known:
            self.known[relation.name] = None
            self.became_relation(relation.name)
        relation.add(row)
        if self.journal is not None:
            self.journal.note_added(relation, row)
        if relation.watched or self.subscribers or self.audience:
            self._changes.append((relation, Change(True, relation.name, row)))
        return True

    def _remove(self, relation: Relation, row: Row) -> None:
        if self.journal is not None:
            self.journal.note_removed(relation, row)
        relation.remove(row)
        if relation.watched or self.subscribers or self.audience:
            self._changes.append((relation, Change(False, relation.name, row)))

    def became_relation(self, name: Symbol) -> None:
        """NAME is a relation from now on."""

    def rows_moved(self) -> None:
        """The rows of some relation are another dict from now on."""

    def became_coded(self, relation: Relation) -> None:
        """Rows of RELATION may hold codes from now on."""
        relation.is_plain = False

    def _tell(self) -> None:
        """A change is whole: tell of it whoever listens now, after what is being told."""
        try:
            if self._changes:
                told, self._changes = self._changes, []
                woken: dict[Watch, Change] = {}
                for relation, change in told:
                    if self.audience:
                        self._calls.append((self.tell, change))
                    self._calls += [(subscriber, change) for subscriber in self.subscribers]
                    for watch in woken_by(relation, change.row):
                        woken.setdefault(watch, change)
                self._calls += [(watch.wake, change) for watch, change in woken.items()]
                self._deliver()
        finally:
            if self.journal is not None:
                self.journal.end_change()

    def _deliver(self) -> None:
        """Make the calls that are due, and those that come to be due by that."""
        if self.is_telling:
            return
        self.is_telling = True
        trouble: list[BaseException] = []  # one who fails does not keep the others from hearing
        for call, change in self._calls:
            try:
                call(change)
            except BaseException as error:
                trouble.append(error)
        self._calls.clear()
        self.is_telling = False
        if trouble:
            raise trouble[0]
