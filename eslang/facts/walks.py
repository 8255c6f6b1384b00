"""Walks: what is gone by from place to place, where rules need themselves only as their tail.

Of (reach ?x ?y) ← (edge ?x ?y) and (reach ?x ?y) ← (edge ?x ?z) (reach ?z ?y)
the one finds an answer where the other finds where to go on: one look does for
both.
"""

from __future__ import annotations

from eslang.base.hints import NamedTuple
from eslang.base.symbols import Symbol
from eslang.facts.goals import ANYTHING, Atom, Term
from eslang.facts.procs import Clause, Proc
from eslang.facts.steps import Look


class Stride(NamedTuple):
    """What is done at each place for one rule, or for two at once."""

    clause: Clause  # how to find something
    answer: Atom | None  # the answer that was found, if it is one
    onward: Look | None  # the question to go on with, if there is one


def strides(proc: Proc) -> list[Stride]:
    """What is done at each place for all rules of PROC; the facts themselves are looked up besides."""
    last = [clause for clause in proc.clauses if not proc.is_tail(clause)]
    found = []
    for clause in proc.clauses:
        if proc.is_tail(clause):
            onward, shortened = clause.steps[-1], clause._replace(steps=clause.steps[:-1])
            assert isinstance(onward, Look)
            answer = _direct_answer(shortened, proc)
            if answer is not None:
                return [Stride(shortened, answer, onward)]
            for number, other in enumerate(last):
                answer = _answer(other, shortened, proc)
                if answer is not None:
                    del last[number]
                    break
            found.append(Stride(shortened, answer, onward))
    return [*(Stride(clause, clause.head, None) for clause in last), *found]


def _direct_answer(clause: Clause, proc: Proc) -> Atom | None:
    """The answer that a transitive CLAUSE finds where it goes on: one of those that all other rules find."""
    first = clause.steps[0] if len(clause.steps) == 1 else None
    if not isinstance(first, Look) or not first.atom.is_direct or first.positions != proc.positions:
        return None
    return first.atom


def _answer(one: Clause, other: Clause, proc: Proc) -> Atom | None:
    """What ONE derives, in the variables of OTHER, if both do the same; None if they do not."""
    if len(one.steps) != len(other.steps):
        return None
    pairs = [(one.head.terms[place], other.head.terms[place]) for place in proc.positions]
    for left, right in zip(one.steps, other.steps, strict=True):
        if not isinstance(left, Look) or not isinstance(right, Look):
            return None
        if (left.relation, left.positions, left.proc) != (right.relation, right.positions, right.proc):
            return None
        pairs += zip(left.atom.terms, right.atom.terms, strict=True)
    names = _renaming(pairs)
    free = [place for place in range(len(one.head.terms)) if place not in proc.positions]
    if names is None or any(one.head.terms[place] not in names for place in free):
        return None
    terms = [names[term] if place in free else term for place, term in enumerate(one.head.terms)]
    return one.head._replace(terms=tuple(terms))


def _renaming(pairs: list[tuple[Term, Term]]) -> dict[Term, Symbol] | None:
    """What each variable on the left is called on the right; None if that is not all that differs."""
    forth: dict[Term, Symbol] = {}
    back: dict[Symbol, Term] = {}
    for left, right in pairs:
        if not isinstance(left, Symbol) or not isinstance(right, Symbol):
            return None
        if ANYTHING in (left.name, right.name) and left is not right:
            return None
        if forth.setdefault(left, right) is not right or back.setdefault(right, left) is not left:
            return None
    return forth
