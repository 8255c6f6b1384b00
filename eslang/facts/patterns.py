"""Patterns: which stored facts RETRACT and UPDATE are about."""

from __future__ import annotations

from eslang.base.hints import Iterable
from eslang.base.symbols import Symbol
from eslang.facts.goals import ANYTHING, Constant, Constants, Nested, Term
from eslang.facts.nested import leaves_of, matcher
from eslang.facts.relations import EMPTY, Relation
from eslang.facts.terms import Row


class Pattern:
    """All patterns of one shape."""

    __slots__ = ("known", "leaves", "match", "numbers", "relation")

    def __init__(self, relation: Relation, terms: tuple[Term, ...]) -> None:
        self.relation = relation
        self.known = tuple(place for place, term in enumerate(terms) if isinstance(term, Constant))
        self.numbers = [term.number for term in terms if isinstance(term, Constant)]
        names = [term for term in terms if isinstance(term, Symbol) and term.name != ANYTHING]
        is_flat = not any(isinstance(term, Nested) for term in terms)
        leaves = leaves_of(Nested(terms, None))
        self.leaves = [leaf for leaf in leaves if isinstance(leaf, Constant)]
        is_enough = is_flat and len(set(names)) == len(names)  # to compare what is known
        self.match = None if is_enough else matcher(terms, self.leaves, ())

    def rows(self, constants: Constants) -> list[Row]:
        """The rows that the pattern with these CONSTANTS matches, in order."""
        codes = tuple([constants[number] for number in self.numbers])
        relation = self.relation
        if len(codes) == relation.arity:
            return [codes] if codes in relation.rows else []
        rows: Iterable[Row] = relation.rows
        if codes:
            rows = relation.index(self.known).get(codes[0] if len(codes) == 1 else codes, EMPTY)
        if self.match is None:
            return list(rows)
        given = [constants[leaf.number] for leaf in self.leaves]
        return [row for row in rows if self.match(row, *given) is not None]
