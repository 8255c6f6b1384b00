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


def strata(rules: Iterable[Rule]) -> dict[str, int] | None:
    """How many NOTs stand below each derived relation; None if there is no end of them."""
    rules = list(rules)
    found = dict.fromkeys((rule.head[0] for rule in rules), 0)
    for _ in range(len(found) * len(found) + 1):
        before = dict(found)
        for rule in rules:
            for atom, negated in atoms(("and", *rule.body)):
                if atom[0] in found:
                    found[rule.head[0]] = max(found[rule.head[0]], found[atom[0]] + negated)
        if found == before:
            return found
    return None


class World:
    """Facts, and all that rules make of them."""

    def __init__(self, facts: Iterable[Goal], rules: Iterable[Rule], queries: Iterable[Goal] = ()) -> None:
        self.facts = {key(fact): fact for fact in facts}
        self.rules = list(rules)
        said = [*self.facts.values(), *(rule.head for rule in self.rules), *queries]
        said += [goal for rule in self.rules for goal in rule.body]
        terms = [
            term for goal in said for atom, _ in atoms(goal) for part in atom[1:] for term in subterms(part)
        ]
        self.universe = list({key(term): term for term in terms}.values())
        found = strata(self.rules)
        assert found is not None, "no such rules mean anything"
        for stratum in range(len(found) + 1):
            self._derive([rule for rule in self.rules if found[rule.head[0]] == stratum])

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

    def solutions(self, goal: Goal) -> set[frozenset[tuple[str, Any]]]:
        """The distinct solutions of GOAL, with keys for terms."""
        return {
            frozenset((name, key(term)) for name, term in bindings.items())
            for bindings in self._solutions(goal)
        }


def ways(goal: Goal) -> list[Goal]:
    """The conjunctions, one of which is true where GOAL is."""
    if goal[0] == "or":
        return [way for part in goal[1:] for way in ways(part)]
    if goal[0] != "and":
        return [("and", goal)]
    choices = product(*map(ways, goal[1:]))
    return [("and", *(part for way in choice for part in way[1:])) for choice in choices]


def check_safe(conjunction: Goal) -> None:
    """Fail if a test or a NOT needs a variable that no pattern binds."""
    bound = {name for goal in conjunction[1:] if goal[0] not in ("not", *TESTS) for name in variables(goal)}
    if any(name not in bound for name in variables(conjunction)):
        raise Unsafe
    for goal in conjunction[1:]:
        if goal[0] in TESTS and any("?_" in str(term) for term in goal[1:]):
            raise Unsafe
