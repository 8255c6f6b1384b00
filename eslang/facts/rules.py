"""Rules: what follows from facts.

A rule has a head, a pattern that is derived, and a body, the goals it is
derived from. A relation that depends on its own negation has no meaning: the
rule that closes such a circle is refused, and the failure names the circle.
"""

from __future__ import annotations

from eslang.base.failure import Failure, type_error
from eslang.base.hints import Callable, Iterator, NamedTuple
from eslang.base.lists import Cons, from_items
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.facts.goals import (
    AND,
    NOT,
    OR,
    Atom,
    Both,
    Constants,
    Either,
    Goal,
    Never,
    read_query,
    shape_of,
)
from eslang.facts.unify import is_same_pattern

UNSTRATIFIED = Keyword("UNSTRATIFIED-RULES")

Name = tuple[Symbol, int]  # of a relation: with its arity


class Rule(NamedTuple):
    """HEAD follows from BODY."""

    form: Value  # (head body...)
    head: Atom
    body: Both
    constants: Constants

    @property
    def name(self) -> Name:
        """The relation that this derives facts of."""
        return self.head.name, len(self.head.terms)


class Uses(NamedTuple):
    """One relation is derived from another."""

    name: Name
    negated: bool


class Rules:
    """The rules of one store, in the order of their definition."""

    def __init__(self, is_test: Callable[[Symbol], bool]) -> None:
        self.is_test = is_test  # whether a name is Lisp's
        self.by_name: dict[Name, list[Rule]] = {}

    def define(self, head: Value, body: Value) -> Rule | None:
        """Take the rule that HEAD follows from the goals in the list BODY; None if it is there already."""
        rule = read_rule(head, body)
        known = self.by_name.get(rule.name, [])
        if any(is_same_pattern(rule.form, other.form) for other in known):
            return None
        self.by_name[rule.name] = [*known, rule]
        try:
            self._check(rule)
        except Failure:
            self._restore(rule.name, known)
            raise
        return rule

    def forget(self, name: Symbol) -> list[Name]:
        """Take back the rules of all relations called NAME; which ones had some."""
        found = [each for each in self.by_name if each[0] is name]
        for each in found:
            del self.by_name[each]
        return found

    def _restore(self, name: Name, rules: list[Rule]) -> None:
        if rules:
            self.by_name[name] = rules
        else:
            del self.by_name[name]

    def _check(self, rule: Rule) -> None:
        """Fail if RULE closes a circle through NOT."""
        uses = {
            name: [use for each in rules for use in self._uses(each)] for name, rules in self.by_name.items()
        }
        for name, found in uses.items():
            for use in found:
                path = _path(uses, use.name, name) if use.negated else None
                if path is not None:
                    raise Failure(UNSTRATIFIED, from_items([each for each, _ in (name, *path)]), rule.form)

    def _uses(self, rule: Rule) -> Iterator[Uses]:
        """The relations that RULE needs."""
        for atom, negated in _atoms(rule.body, False):
            if not self.is_test(atom.name):
                yield Uses((atom.name, len(atom.terms)), negated)


def read_rule(head: Value, body: Value) -> Rule:
    """The rule that these forms say."""
    if head.__class__ is not Cons:
        raise type_error(head, "LIST")
    if head.car in (AND, OR, NOT):
        raise type_error(head.car, "RELATION")
    tokens, constants = read_query(Cons(AND, Cons(head, body)))
    goal = shape_of(tokens).goal
    assert isinstance(goal, Both) and isinstance(goal.goals[0], Atom)
    return Rule(Cons(head, body), goal.goals[0], Both(goal.goals[1:]), constants)


def _atoms(goal: Goal, negated: bool) -> Iterator[tuple[Atom, bool]]:
    """The atoms in GOAL, and whether they stand under NOT."""
    if isinstance(goal, Atom):
        yield goal, negated
    elif isinstance(goal, Never):
        yield from _atoms(goal.goal, True)
    else:
        assert isinstance(goal, Both | Either)
        for each in goal.goals:
            yield from _atoms(each, negated)


def _path(uses: dict[Name, list[Uses]], start: Name, end: Name) -> list[Name] | None:
    """How START comes to need END: the shortest way, both included; None if it does not."""
    before: dict[Name, Name | None] = {start: None}
    pending = [start]
    for name in pending:
        if name == end:
            path = [name]
            while (earlier := before[path[-1]]) is not None:
                path.append(earlier)
            return path[::-1]
        for use in uses.get(name, ()):
            if use.name not in before:
                before[use.name] = name
                pending.append(use.name)
    return None
