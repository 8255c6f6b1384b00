"""Transitive rules, as in (path ?x ?y) ← (path ?x ?z) (path ?z ?y).

Asked for the paths from one place, such a rule would first find the paths
between any two places on the way. What it derives is what the same rule
derives that goes one step by what is asserted, or by the other rules, and the
rest of the way by itself: and that is a walk from place to place.
"""

from __future__ import annotations

from eslang.base.hints import NamedTuple
from eslang.base.symbols import Symbol
from eslang.facts.goals import ANYTHING, Atom, Both
from eslang.facts.relations import Positions
from eslang.facts.rules import Rule


class Ends(NamedTuple):
    """Where in a head the beginning of the way stands, and where its end."""

    source: int
    target: int


def ends_of(rule: Rule) -> Ends | None:
    """The ends of the way that RULE goes on; None if it is no transitive rule."""
    head, goals = rule.head, rule.body.goals
    if len(goals) != 2 or not _is_open(head):
        return None
    for first, second in (goals, goals[::-1]):
        if not all(isinstance(goal, Atom) and _is_open(goal) and goal.name is head.name for goal in goals):
            return None
        assert isinstance(first, Atom) and isinstance(second, Atom)
        target, source = _only_difference(head, first), _only_difference(head, second)
        if target is None or source is None or target == source:
            continue
        middle = first.terms[target]
        if middle is second.terms[source] and middle not in head.terms:
            return Ends(source, target)
    return None


def walking(rule: Rule, ends: Ends, known: Positions) -> Rule:
    """RULE, so that it goes on from the end that is KNOWN."""
    goals = rule.body.goals
    if _only_difference(rule.head, goals[0]) != ends.target:  # type: ignore[arg-type]
        goals = goals[::-1]
    first, second = goals
    assert isinstance(first, Atom) and isinstance(second, Atom)
    if ends.target in known and ends.source not in known:
        second = second._replace(is_direct=True)
    else:
        first = first._replace(is_direct=True)
    return rule._replace(body=Both((first, second)))


def _is_open(atom: Atom) -> bool:
    """Whether all terms of ATOM are variables, each another one."""
    names = [term for term in atom.terms if isinstance(term, Symbol) and term.name != ANYTHING]
    return len(set(names)) == len(atom.terms)


def _only_difference(one: Atom, other: Atom) -> int | None:
    """The only place in which the two differ; None if there is none, or another one."""
    if len(one.terms) != len(other.terms):
        return None
    pairs = zip(one.terms, other.terms, strict=True)
    places = [place for place, (left, right) in enumerate(pairs) if left is not right]
    return places[0] if len(places) == 1 else None
