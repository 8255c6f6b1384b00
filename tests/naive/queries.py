"""What a query means, said as simply as can be: try every substitution.

Terms are Python values: a string is a symbol, one that begins with ? a
variable, a tuple is a list, Text a string; numbers are numbers. A goal is a
tuple: ("and", goal...), ("or", goal...), ("not", goal), or a name and terms.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import product
from typing import Any, NamedTuple

Term = Any
Goal = tuple[Any, ...]
Relation = tuple[str, int]
Bindings = dict[str, Term]

TESTS: dict[str, Callable[..., bool]] = {
    "smaller": lambda left, right: str(key(left)) < str(key(right)),
    "same": lambda left, right: bool(key(left) == key(right)),
    "is-number": lambda term: term.__class__ in (int, float),
}


class Text(NamedTuple):
    """A string."""

    text: str


class Unsafe(Exception):
    """A variable would have to be guessed."""


def key(term: Term) -> Any:
    """What two terms have in common if they are EQUAL, and only then."""
    if term.__class__ is tuple:
        return ("list", *map(key, term))
    return (term.__class__.__name__, term)


def is_variable(term: Term) -> bool:
    """Whether TERM is a variable."""
    return term.__class__ is str and term.startswith("?")


def variables(part: Any) -> list[str]:
    """The variables in a goal or term, ?_ left out, each once, in order."""
    if is_variable(part):
        return [] if part == "?_" else [part]
    if part.__class__ is not tuple:
        return []
    return list(dict.fromkeys(found for each in part for found in variables(each)))


def subterms(term: Term) -> Iterator[Term]:
    """TERM and all that stands in it."""
    if not is_variable(term):
        yield term
    if term.__class__ is tuple:
        for part in term:
            yield from subterms(part)


def filled(term: Term, bindings: Bindings) -> Term:
    """TERM with values for variables."""
    if term.__class__ is tuple:
        return tuple(filled(part, bindings) for part in term)
    return bindings.get(term, term) if is_variable(term) else term


def fits(pattern: Term, term: Term) -> bool:
    """Whether PATTERN, which has no variables but ?_, is TERM."""
    if pattern == "?_":
        return True
    if pattern.__class__ is tuple and term.__class__ is tuple:
        return len(pattern) == len(term) and all(map(fits, pattern, term))
    return bool(key(pattern) == key(term))


def atoms(goal: Goal) -> Iterator[tuple[Goal, bool]]:
    """The atoms of GOAL, and whether they stand under NOT."""
    if goal[0] in ("and", "or"):
        for part in goal[1:]:
            yield from atoms(part)
    elif goal[0] == "not":
        yield from ((atom, True) for atom, _ in atoms(goal[1]))
    else:
        yield goal, False


class Rule(NamedTuple):
    """HEAD follows from BODY."""

    head: Goal
    body: tuple[Goal, ...]


def strata(rules: Iterable[Rule]) -> dict[Relation, int] | None:
    """How many NOTs stand below each derived relation; None if there is no end of them."""
    rules = list(rules)
    found = dict.fromkeys((relation(rule.head) for rule in rules), 0)
    for _ in range(len(found) * len(found) + 1):
        before = dict(found)
        for rule in rules:
            for atom, negated in atoms(("and", *rule.body)):
                if relation(atom) in found:
                    least = found[relation(atom)] + negated
                    found[relation(rule.head)] = max(found[relation(rule.head)], least)
        if found == before:
            return found
    return None


def relation(atom: Goal) -> Relation:
    """The name and the arity that ATOM is about."""
    return atom[0], len(atom) - 1


class World:
    """Facts, and all that rules make of them."""

    def __init__(self, facts: Iterable[Goal], rules: Iterable[Rule]) -> None:
        self.facts = {key(fact): fact for fact in facts}
        self.rules = list(rules)
        self.universe = self._terms()
        found = strata(self.rules)
        assert found is not None, "no such rules mean anything"
        for stratum in range(len(found) + 1):
            self._derive([rule for rule in self.rules if found[relation(rule.head)] == stratum])
        self.universe = self._terms()

    def _terms(self) -> list[Term]:
        """What a variable may be: what stands in a fact, or in a head."""
        said = [*self.facts.values(), *(rule.head for rule in self.rules)]
        terms = [term for fact in said for part in fact[1:] for term in subterms(part)]
        return list({key(term): term for term in terms if not variables(term)}.values())

    def _derive(self, rules: list[Rule]) -> None:
        """Add what follows, until nothing new does."""
        before = -1
        while before != len(self.facts):
            before = len(self.facts)
            for rule in rules:
                for bindings in list(self._solutions(("and", *rule.body))):
                    fact = filled(rule.head, bindings)
                    self.facts[key(fact)] = fact

    def holds(self, goal: Goal) -> bool:
        """Whether GOAL, which has no variables but ?_, is true."""
        if goal[0] == "and":
            return all(map(self.holds, goal[1:]))
        if goal[0] == "or":
            return any(map(self.holds, goal[1:]))
        if goal[0] == "not":
            return not self.holds(goal[1])
        if goal[0] in TESTS:
            return TESTS[goal[0]](*goal[1:])
        return any(fits(goal, fact) for fact in self.facts.values())

    def _solutions(self, goal: Goal) -> Iterator[Bindings]:
        """Every substitution that makes GOAL true, for each choice among its alternatives."""
        for conjunction in ways(goal):
            check_safe(conjunction)
            names = variables(conjunction)
            for values in product(self.universe, repeat=len(names)):
                bindings = dict(zip(names, values, strict=True))
                if self.holds(filled(conjunction, bindings)):
                    yield bindings

    def solutions(self, goal: Goal, given: Bindings | None = None) -> set[frozenset[tuple[str, Any]]]:
        """The distinct solutions of GOAL where some variables are GIVEN values, with keys for terms."""
        given = {name: term for name, term in (given or {}).items() if name in variables(goal)}
        return {
            frozenset((name, key(term)) for name, term in {**given, **bindings}.items())
            for bindings in self._solutions(filled(goal, given))
        }


def ways(goal: Goal) -> list[Goal]:
    """The conjunctions, one of which is true where GOAL is."""
    if goal[0] == "or":
        return [way for part in goal[1:] for way in ways(part)] or [("and", goal)]
    if goal[0] != "and":
        return [("and", goal)]
    choices = product(*map(ways, goal[1:]))
    return [("and", *(part for way in choice for part in way[1:])) for choice in choices]


def check_safe(conjunction: Goal) -> None:
    """Fail if a test or a NOT needs a variable that no pattern binds."""
    bound = {name for goal in conjunction[1:] if goal[0] not in ("not", *TESTS) for name in variables(goal)}
    if any(name not in bound for name in variables(conjunction)):
        raise Unsafe
    if any(atom[0] in TESTS and "?_" in list(flat(atom)) for atom, _ in atoms(conjunction)):
        raise Unsafe


def flat(term: Term) -> Iterator[Term]:
    """The atoms in TERM."""
    if term.__class__ is not tuple:
        yield term
    else:
        for part in term:
            yield from flat(part)
