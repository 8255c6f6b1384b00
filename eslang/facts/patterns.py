"""Patterns: which stored facts RETRACT and UPDATE are about."""

from __future__ import annotations

from eslang.base.hints import Iterable
from eslang.base.lists import from_items
from eslang.base.symbols import Symbol
from eslang.facts.goals import ANYTHING, Constant, Constants, Nested, Term
from eslang.facts.nested import leaves_of, matcher
from eslang.facts.relations import EMPTY, Relation
from eslang.facts.terms import Row, code_of, value_of


class Pattern:
    """All patterns of one shape."""

    __slots__ = ("known", "numbers", "relation", "whole")

    def __init__(self, relation: Relation, terms: tuple[Term, ...]) -> None:
        self.relation = relation
        self.known = tuple(place for place, term in enumerate(terms) if isinstance(term, Constant))
        self.numbers = [term.number for term in terms if isinstance(term, Constant)]
        names = [term for term in terms if isinstance(term, Symbol) and term.name != ANYTHING]
        is_flat = not any(isinstance(term, Nested) for term in terms)
        self.whole = None if is_flat and len(set(names)) == len(names) else Nested(terms, None)

    def rows(self, constants: Constants) -> list[Row]:
        """The rows that the pattern with these CONSTANTS matches, in order."""
        codes = tuple([constants[number] for number in self.numbers])
        relation = self.relation
        if len(codes) == relation.arity:
            return [codes] if codes in relation.rows else []
        rows: Iterable[Row] = relation.rows
        if codes:
            rows = relation.index(self.known).get(codes[0] if len(codes) == 1 else codes, EMPTY)
        return list(rows) if self.whole is None else _matching(self.whole, constants, rows)


def _matching(whole: Nested, constants: Constants, rows: Iterable[Row]) -> list[Row]:
    """The ROWS that are as WHOLE says."""
    known = [leaf for leaf in leaves_of(whole) if isinstance(leaf, Constant)]
    codes = [constants[leaf.number] for leaf in known]
    match = matcher(whole, list(known), [])
    return [
        row
        for row in rows
        if match(code_of(from_items([value_of(code) for code in row])), *codes) is not None
    ]
