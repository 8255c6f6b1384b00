"""Why a query takes the time it takes: its plan, as data."""

from __future__ import annotations

from eslang.base.hints import NamedTuple
from eslang.base.symbols import Symbol, Value
from eslang.facts.functions import Question
from eslang.facts.goals import Constants, form_of
from eslang.facts.procs import Proc, reached_from
from eslang.facts.relations import Positions, Relation
from eslang.facts.steps import Absent, Branch, Join, Look, Present, Steps, Test

CHECK, LOOK_UP, SCAN, TEST, NOT, OR = "check", "look-up", "scan", "test", "not", "or"
RULES, OTHER_RULES = "rules", "other rules"  # those that are not transitive
PLAIN, WALKED, TABLED = "plain", "walked", "tabled"


class Explained(NamedTuple):
    """One step: what it does for which goal."""

    kind: str  # one of the words above
    goal: Value
    positions: Positions  # of the arguments that are known, counted from 0
    facts: int  # that the relation holds now
    inner: tuple[tuple[Explained, ...], ...]  # the ways of NOT and OR


class ExplainedRules(NamedTuple):
    """The rules of one relation, when some of its arguments are known."""

    name: Symbol
    arity: int
    positions: Positions
    is_direct: bool  # these are the rules that are not transitive
    kind: str  # plain: they do not need themselves; walked: only as their tail; tabled
    rules: tuple[tuple[Value, tuple[Explained, ...]], ...]  # the head and the steps of each


class Explanation(NamedTuple):
    """The steps of a query in the order in which they are taken, the rules it asks, and the indexes."""

    steps: tuple[Explained, ...]
    rules: tuple[ExplainedRules, ...]
    indexes: tuple[tuple[Symbol, int, Positions], ...]  # all that the relations in question have


def explain(question: Question, constants: Constants) -> Explanation:
    """How QUESTION is answered for these CONSTANTS."""
    known = [*constants, *question.constants[question.places :]]
    procs = reached_from(question.steps)
    relations: dict[Relation, None] = {}
    steps = _all(question.steps, known, relations)
    rules = tuple(_rules(proc, known, relations) for proc in procs)
    indexes = tuple(
        (relation.name, relation.arity, index.positions)
        for relation in relations
        for index in relation.indexes
    )
    return Explanation(steps, rules, indexes)


def _rules(proc: Proc, constants: Constants, relations: dict[Relation, None]) -> ExplainedRules:
    kind = WALKED if proc.is_linear() else TABLED if proc.circle else PLAIN
    relations[proc.relation] = None
    rules = tuple(
        (form_of(clause.head, constants), _all(clause.steps, constants, relations)) for clause in proc.clauses
    )
    relation = proc.relation
    return ExplainedRules(relation.name, relation.arity, proc.positions, proc.is_direct, kind, rules)


def _all(steps: Steps, constants: Constants, relations: dict[Relation, None]) -> tuple[Explained, ...]:
    explained: list[Explained] = []
    for step in steps:
        if isinstance(step, Join):
            continue
        explained.append(_one(step, constants, relations))
        if isinstance(step, Branch) and step.rests:
            ways = tuple(_all(rest.steps, constants, relations) for rest in step.rests)
            explained += ways[0] if len(ways) == 1 else [explained[-1]._replace(inner=ways)]
    return tuple(explained)


def _one(
    step: Look | Test | Absent | Present | Branch, constants: Constants, relations: dict[Relation, None]
) -> Explained:
    if isinstance(step, Look):
        relation = step.relation
        relations[relation] = None
        whole = len(step.positions) == relation.arity
        rules = OTHER_RULES if step.atom.is_direct else RULES
        kind = rules if step.proc else CHECK if whole else LOOK_UP if step.positions else SCAN
        return Explained(kind, form_of(step.atom, constants), step.positions, len(relation.rows), ())
    if isinstance(step, Test):
        return Explained(TEST, form_of(step.atom, constants), (), 0, ())
    inner = (step.steps,) if isinstance(step, Absent) else step.ways
    ways = tuple(_all(way, constants, relations) for way in inner)
    return Explained(NOT if isinstance(step, Absent) else OR, form_of(step.goal, constants), (), 0, ways)
