"""Procs: how the rules of one relation answer when some of its arguments are known.

Everything that a query may ask is planned before it runs: from its goals to
the procs of the rules that it needs, and from these to others. Procs that need
their own answers form a circle; those whose circle is but a tail, as in
(reach ?x ?y) ← (edge ?x ?z) (reach ?z ?y), are walked without tables.
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import Any, Callable, Iterator, NamedTuple
from eslang.base.lists import Cons, from_items
from eslang.base.symbols import Keyword, Symbol
from eslang.facts.goals import Atom, Constant, Constants, Nested, Shape, unbound, variables_of
from eslang.facts.relations import Positions, Relation
from eslang.facts.rules import Name, Rule
from eslang.facts.steps import ANYTHING_AT_ALL, Arranger, Bound, Branch, Look, Steps, Test, is_known, ways_of
from eslang.facts.transitive import ends_of, walking

UNBOUNDED = Keyword("UNBOUNDED-RULES")


class Clause(NamedTuple):
    """One rule of a proc: its head, its steps."""

    head: Atom
    steps: Steps


class Proc:
    """How to answer for RELATION when the terms at POSITIONS are known."""

    __slots__ = ("circle", "clauses", "failure", "is_direct", "number", "positions", "relation")

    def __init__(self, number: int, relation: Relation, positions: Positions, is_direct: bool) -> None:
        self.number = number
        self.relation = relation
        self.positions = positions
        self.is_direct = is_direct  # whether it leaves transitive rules to those that ask
        self.clauses: list[Clause] = []
        self.circle: frozenset[Proc] = frozenset()  # those that need this one and are needed by it
        self.failure: Failure | None = None  # why the rules cannot run like this

    def is_linear(self) -> bool:
        """Whether the proc needs itself only as the tail of its clauses."""
        return self.circle == {self} and all(
            self not in needed(clause.steps) or self.is_tail(clause) for clause in self.clauses
        )

    def is_tail(self, clause: Clause) -> bool:
        """Whether the proc is needed just in the last step of CLAUSE, and answers what that answers."""
        steps = clause.steps
        last = steps[-1] if steps else None
        if not isinstance(last, Look) or last.proc is not self or self in needed(steps[:-1]):
            return False
        free = [place for place in range(self.relation.arity) if place not in self.positions]
        passed = [clause.head.terms[place] for place in free]
        return (
            passed == [last.atom.terms[place] for place in free]
            and all(isinstance(term, Symbol) for term in passed)
            and len(set(passed)) == len(passed)
        )


class Planner:
    """Plans what one query may ask."""

    def __init__(
        self,
        resolve: Callable[[Atom], Relation | None],
        rules_of: Callable[[Name], list[Rule]],
        constants: Constants,
    ) -> None:
        self.resolve = resolve
        self.rules_of = rules_of
        self.constants = list(constants)  # the query's, and then those of the rules
        self.procs: dict[tuple[Relation, Positions, bool], Proc] = {}
        self.needs: dict[Relation, set[Name]] = {}

    def plan(self, shape: Shape) -> Steps:
        """The steps for a query."""
        steps = self._arranger().arrange((shape.goal,), frozenset(shape.given))
        self._find_circles()
        return steps

    def proc(self, relation: Relation, positions: Positions, is_direct: bool = False) -> Proc | None:
        """The proc for RELATION at POSITIONS; None if no rules are to be asked."""
        rules = self._rules(relation, positions, is_direct)
        if not rules:
            return None
        proc = self.procs.get((relation, positions, is_direct))
        if proc is None:
            proc = Proc(len(self.procs), relation, positions, is_direct)
            self.procs[relation, positions, is_direct] = proc
            try:
                proc.clauses = [self._clause(rule, positions) for rule in rules]
            except Failure as failure:
                proc.failure = failure
        if proc.failure is not None:
            raise proc.failure
        return proc

    def _rules(self, relation: Relation, positions: Positions, is_direct: bool) -> list[Rule]:
        """The rules of RELATION, a transitive one as it is walked, or without it."""
        rules = self.rules_of((relation.name, relation.arity))
        for number, rule in enumerate(rules):
            ends = ends_of(rule)
            if ends is not None:
                walked = [] if is_direct else [walking(rule, ends, positions)]
                return [*rules[:number], *walked, *rules[number + 1 :]]
        return rules

    def _arranger(self, about: Relation | None = None) -> Arranger:
        def returns(relation: Relation) -> bool:
            return about is not None and (about.name, about.arity) in self._needs(relation)

        return Arranger(self.resolve, self.proc, self.constants, about, returns)

    def _needs(self, relation: Relation) -> set[Name]:
        """RELATION, and what its rules need, directly or not."""
        found = self.needs.get(relation)
        if found is None:
            pending = [(relation.name, relation.arity)]
            found = self.needs[relation] = set(pending)
            for name in pending:
                asked = dict.fromkeys(need.name for rule in self.rules_of(name) for need in rule.needs)
                pending += [each for each in asked if each not in found]
                found.update(asked)
        return found

    def _clause(self, rule: Rule, positions: Positions) -> Clause:
        """How RULE answers when what stands at POSITIONS of its head is known."""
        offset = len(self.constants)
        self.constants += rule.constants
        head: Atom = _shifted(rule.head, offset)
        body = tuple(_shifted(goal, offset) for goal in rule.body.goals)
        bound: Bound = frozenset().union(*(variables_of(head.terms[place]) for place in positions))
        arranger = self._arranger(self.resolve(head))
        steps = arranger.arrange(body, bound)
        self._check_head(head, positions, _always_bound(steps, bound), arranger)
        return Clause(head, steps)

    def _check_head(self, head: Atom, positions: Positions, bound: Bound, arranger: Arranger) -> None:
        """Fail if an answer would not be known whole."""
        for place, term in enumerate(head.terms):
            if place not in positions and not is_known(term, bound):
                missing = [each for each in variables_of(term) if each not in bound]
                if not missing:
                    missing = [term if isinstance(term, Symbol) else ANYTHING_AT_ALL]
                raise unbound(missing[0], arranger.form(head))

    def _find_circles(self) -> None:
        """Note which procs need one another; fails where terms would grow without end."""
        needs = {proc: _reached(proc) for proc in self.procs.values() if proc.failure is None}
        for proc, reached in needs.items():
            if proc in reached:
                proc.circle = frozenset(other for other in reached if proc in needs.get(other, ()))
        for proc in needs:
            for clause in proc.clauses:
                if proc.circle and _grows(proc, clause):
                    raise Failure(
                        UNBOUNDED,
                        from_items([each.relation.name for each in sorted(proc.circle, key=_number)]),
                        Cons(proc.relation.name, self._arranger().form(clause.head).cdr),
                    )


def _number(proc: Proc) -> int:
    return proc.number


def _grows(proc: Proc, clause: Clause) -> bool:
    """Whether CLAUSE makes larger terms of what its own circle answers."""
    made = [place for place, term in enumerate(clause.head.terms) if isinstance(term, Nested)]
    needs_itself = any(other in proc.circle for other in needed(clause.steps))
    return needs_itself and any(place not in proc.positions for place in made)


def looks(steps: Steps) -> Iterator[Look]:
    """Every look in STEPS, and in the steps inside them."""
    for step in steps:
        if isinstance(step, Look):
            yield step
        else:
            for way in ways_of(step):
                yield from looks(way)


def needed(steps: Steps) -> dict[Proc, None]:
    """The procs that STEPS ask."""
    return {look.proc: None for look in looks(steps) if look.proc is not None}


def tests(steps: Steps) -> Iterator[Symbol]:
    """The names of all tests in STEPS, and in the steps inside them."""
    for step in steps:
        if isinstance(step, Test):
            yield step.atom.name
        else:
            for way in ways_of(step):
                yield from tests(way)


def reached_from(steps: Steps) -> list[Proc]:
    """All procs that STEPS ask, directly or through others; fails if one of them cannot run."""
    found = dict(needed(steps))
    pending = list(found)
    for proc in pending:
        if proc.failure is not None:
            raise proc.failure
        for clause in proc.clauses:
            for other in needed(clause.steps):
                if other not in found:
                    found[other] = None
                    pending.append(other)
    return pending


def _reached(proc: Proc) -> set[Proc]:
    """The procs that PROC needs, directly or not."""
    found: set[Proc] = set()
    pending = [proc]
    while pending:
        for clause in pending.pop().clauses:
            fresh = needed(clause.steps).keys() - found
            found |= fresh
            pending += fresh
    return found


def _always_bound(steps: Steps, bound: Bound) -> Bound:
    """The variables that are bound when STEPS have led somewhere, whichever way."""
    for step in steps:
        if isinstance(step, Look):
            bound |= variables_of(step.atom).keys()
        elif isinstance(step, Branch):
            ways = [_always_bound(rest.steps, rest.bound) for rest in step.rests]
            ways = ways or [_always_bound(way, bound) for way in step.ways]
            bound = ways[0].intersection(*ways) if ways else bound
    return bound


def _shifted(part: Any, offset: int) -> Any:
    """PART, with its constants counted from OFFSET."""
    if part is None or isinstance(part, Symbol | bool):
        return part
    if isinstance(part, Constant):
        return Constant(part.number + offset)
    parts = tuple(
        tuple(_shifted(each, offset) for each in field)
        if field.__class__ is tuple
        else _shifted(field, offset)
        for field in part
    )
    return part.__class__(*parts)
