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
    RELATION,
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


class Need(NamedTuple):
    """What a rule asks for: a relation, unless Lisp is asked; and whether under NOT."""

    name: Name
    negated: bool


class Rule(NamedTuple):
    """HEAD follows from BODY."""

    form: Value  # (head body...)
    head: Atom
    body: Both
    constants: Constants
    needs: tuple[Need, ...]

    @property
    def name(self) -> Name:
        """The relation that this derives facts of."""
        return self.head.name, len(self.head.terms)


class Rules:
    """The rules of one store, in the order of their definition."""

    def __init__(self, is_test: Callable[[Symbol], bool]) -> None:
        self.is_test = is_test  # whether a name is Lisp's
        self.by_name: dict[Name, list[Rule]] = {}
        self.arities: dict[Symbol, list[int]] = {}  # of what is derived

    def define(self, rule: Rule) -> bool:
        """Take RULE; false if it is there already. Fails if it has no meaning."""
        known = self.by_name.get(rule.name, [])
        if any(is_same_pattern(rule.form, other.form) for other in known):
            return False
        self._hold(rule.name, [*known, rule])
        circle = self._circle(rule.name)
        if circle is not None:
            self._hold(rule.name, known)
            raise Failure(UNSTRATIFIED, from_items([name for name, _ in circle]), rule.form)
        return True

    def forget(self, name: Symbol) -> list[Name]:
        """Take back the rules of all relations called NAME; which ones had some."""
        found = [(name, arity) for arity in self.arities.get(name, ())]
        for each in found:
            self._hold(each, [])
        return found

    def _hold(self, name: Name, rules: list[Rule]) -> None:
        """Let RULES be all that derive NAME."""
        symbol, arity = name
        arities = self.arities.setdefault(symbol, [])
        if arity not in arities:
            arities.append(arity)
        self.by_name[name] = rules
        if not rules:
            del self.by_name[name]
            arities.remove(arity)
        if not arities:
            del self.arities[symbol]

    def _circle(self, start: Name) -> list[Name] | None:
        """The shortest circle in which START needs its own negation, from a NOT on; None if there is none."""
        first = Need(start, False)
        before: dict[Need, Need] = {}  # how one came there; NEGATED where that was through NOT
        pending = [first]
        for need in pending:
            for rule in self.by_name.get(need.name, ()):
                for name, negated in rule.needs:
                    following = Need(name, negated or need.negated)
                    if following not in before and not self.is_test(name[0]):
                        before[following] = need
                        pending.append(following)
        last = Need(start, True)
        if last not in before:
            return None
        path = [before[last]]
        while path[-1] != first:
            path.append(before[path[-1]])
        names = [name for name, _ in path[::-1]]
        turn = sum(not negated for _, negated in path) - 1
        return [*names[turn:], *names[: turn + 1]]


def read_rule(head: Value, body: Value) -> Rule:
    """The rule that these forms say."""
    if head.__class__ is not Cons:
        raise type_error(head, "LIST")
    if head.car in (AND, OR, NOT):
        raise type_error(head.car, RELATION)
    tokens, constants = read_query(Cons(AND, Cons(head, body)))
    goal = shape_of(tokens).goal
    assert isinstance(goal, Both) and isinstance(goal.goals[0], Atom)
    parts = Both(goal.goals[1:])
    needs = dict.fromkeys(_needs(parts, False))
    return Rule(Cons(head, body), goal.goals[0], parts, constants, tuple(needs))


def _needs(goal: Goal, negated: bool) -> Iterator[Need]:
    """What GOAL asks for."""
    if isinstance(goal, Atom):
        yield Need((goal.name, len(goal.terms)), negated)
    elif isinstance(goal, Never):
        yield from _needs(goal.goal, True)
    else:
        assert isinstance(goal, Both | Either)
        for each in goal.goals:
            yield from _needs(each, negated)
