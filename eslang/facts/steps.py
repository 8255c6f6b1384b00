"""Steps: in which order a query's goals are asked, and what each looks up.

A goal is asked as soon as what it needs is bound: tests and NOT when all
their variables are; of patterns first those that one look-up answers, then
those that what is bound joins, and at last those of which nothing is known.
Where that leaves a choice, goals are asked in the order in which they stand.
"""

from __future__ import annotations

from eslang.base.failure import Failure, simple_error
from eslang.base.hints import Any, Callable, NamedTuple
from eslang.base.symbols import Symbol, Value
from eslang.facts.goals import (
    ANYTHING,
    UNBOUND,
    Atom,
    Both,
    Constants,
    Either,
    Goal,
    Nested,
    Never,
    Term,
    form_of,
    has_anything,
    unbound,
    variables_of,
)
from eslang.facts.relations import Positions, Relation

Bound = frozenset[Symbol]
ANYTHING_AT_ALL = Symbol.intern(ANYTHING, "ESL-USER")  # for messages


class Look(NamedTuple):
    """Look into a relation, with what stands at some positions known."""

    atom: Atom
    relation: Relation
    positions: Positions
    proc: Any  # the rules that answer, too (procs.py); None if there are none


class Test(NamedTuple):
    """Ask Lisp."""

    atom: Atom


class Absent(NamedTuple):
    """Go on if the steps lead nowhere."""

    goal: Never
    steps: Steps


class Present(NamedTuple):
    """Go on, once, if one of these ways leads somewhere."""

    goal: Either
    ways: tuple[Steps, ...]


class Branch(NamedTuple):
    """Go each of these ways; each holds all that is still to be done, or leads to one of the rests."""

    goal: Either
    ways: tuple[Steps, ...]
    rests: list[Rest]


class Rest(NamedTuple):
    """What is still to be done behind an OR, for all ways that bind the same variables."""

    number: int
    bound: Bound
    steps: Steps


class Join(NamedTuple):
    """The end of a way: go on with the rest of this number, unless that was done with the same values."""

    number: int


Step = Look | Test | Absent | Present | Branch | Join
Steps = list[Step]
End = Callable[[Bound], Join]  # where a way goes on that binds these variables

MANY = 8  # ways through the ORs of a body, one after the other: if there are more, the ways are joined
MOST = 5000  # ways of one body, all in all: they multiply if they bind different variables
GROUND, DECIDED, DETERMINED, JOINED, KNOWN, ITSELF, UNKNOWN = range(7)  # how promising a goal is


class Arranger:
    """Puts the goals of one body in order."""

    def __init__(
        self,
        resolve: Callable[[Atom], Relation | None],
        rules: Callable[[Relation, Positions, bool], Any],
        constants: Constants,
        about: Relation | None = None,
        returns: Callable[[Relation], bool] = lambda relation: False,
    ) -> None:
        self.about = about  # what the rule derives, if these are the goals of a rule
        self.returns = returns  # whether a question for a relation may lead back to what the rule derives
        self.resolve = resolve  # the relation that an atom is about; None: it is a test
        self.rules = rules  # what answers by rules, or None (procs.py); fails where they cannot run
        self.constants = constants
        self._room: int | None = None  # for ways through further ORs, after the first one
        self._rests = 0
        self._ways: dict[tuple[int, Bound], Steps] = {}  # for goals that stand alone, by their identity

    def _way(self, goal: Goal, bound: Bound) -> Steps:
        """The steps for GOAL alone: who wants to know whether it can be asked has them made already."""
        found = self._ways.get((id(goal), bound))
        if found is None:
            found = self._ways[id(goal), bound] = self.arrange((goal,), bound)
        return found

    def arrange(self, goals: tuple[Goal, ...], bound: Bound, end: End | None = None) -> Steps:
        """The steps for GOALS, when BOUND variables have values; what comes at the END of every way."""
        steps: Steps = []
        left = _flat(goals)
        while left:
            number = self._next(left, bound)
            goal = left.pop(number)
            if isinstance(goal, Either) and not self._is_decided(goal, bound):
                return [*steps, self._branch(goal, tuple(left), bound, end)]
            steps.append(self._step(goal, bound))
            if isinstance(goal, Atom):
                bound = bound.union(variables_of(goal))
        return steps if end is None else [*steps, end(bound)]

    def _branch(self, goal: Either, left: tuple[Goal, ...], bound: Bound, end: End | None) -> Branch:
        """The step for GOAL, which has several ways, with all that is LEFT behind it."""
        self._room = MOST if self._room is None else self._room - len(goal.goals)
        if self._room < 0:
            raise simple_error("there are too many ways through the ORs of this query: make one a rule")
        if left and self._count_ways((goal, *left), bound) > MANY:
            rests: list[Rest] = []
            join = self._joining(rests, left, end)
            return Branch(goal, tuple(self.arrange((each,), bound, join) for each in goal.goals), rests)
        if left or end is not None:
            return Branch(goal, tuple(self.arrange((each, *left), bound, end) for each in goal.goals), [])
        return Branch(goal, tuple(self._way(each, bound) for each in goal.goals), [])

    def _count_ways(self, goals: tuple[Goal, ...], bound: Bound) -> int:
        """How many ways lead through the ORs among GOALS."""
        count = 1
        for goal in goals:
            if isinstance(goal, Either) and not self._is_decided(goal, bound):
                count *= max(len(goal.goals), 1)
        return count

    def _joining(self, rests: list[Rest], left: tuple[Goal, ...], end: End | None) -> End:
        """What ends ways that are joined: what is LEFT is arranged once for all, as one of RESTS."""

        def join(bound: Bound) -> Join:
            for rest in rests:
                if rest.bound == bound:
                    return Join(rest.number)
            self._rests += 1
            number = self._rests
            rests.append(Rest(number, bound, self.arrange(left, bound, end)))
            return Join(number)

        return join

    def _step(self, goal: Goal, bound: Bound) -> Step:
        """The step for a GOAL that is ready."""
        if isinstance(goal, Never):
            return Absent(goal, self.arrange((goal.goal,), bound))
        if isinstance(goal, Either):
            return Present(goal, tuple(self._way(each, bound) for each in goal.goals))
        assert isinstance(goal, Atom)
        relation = self.resolve(goal)
        if relation is None:
            return Test(goal)
        proc = self._proc(relation, goal, bound)
        return Look(goal, relation, known_positions(goal, bound) if proc is None else proc.positions, proc)

    def _proc(self, relation: Relation, goal: Atom, bound: Bound) -> Any:
        """What answers GOAL by rules; it is not told terms that the question makes, if it might never end."""
        known = known_positions(goal, bound)
        plain = tuple(place for place in known if not isinstance(goal.terms[place], Nested))
        if plain != known and self.returns(relation):
            known = plain
        return self.rules(relation, known, goal.is_direct)

    def _next(self, left: list[Goal], bound: Bound) -> int:
        """Which goal comes next; fails if none is ready."""
        best, score, trouble = -1, UNKNOWN + 1, None
        for number, goal in enumerate(left):
            if score <= DECIDED:
                break
            obstacle = self._obstacle(goal, bound)
            if obstacle is not None:
                trouble = trouble or obstacle
            elif (found := self._score(goal, bound)) < score:
                best, score = number, found
        if best < 0:
            assert trouble is not None
            raise trouble
        return best

    def _obstacle(self, goal: Goal, bound: Bound) -> Failure | None:
        """Why GOAL cannot be asked yet."""
        try:
            if isinstance(goal, Either):
                for each in goal.goals:
                    self._way(each, bound)
                return None
            relation = self.resolve(goal) if isinstance(goal, Atom) else None
            if relation is not None:
                assert isinstance(goal, Atom)
                self._proc(relation, goal, bound)
                return None
        except Failure as failure:
            if failure.cause is not UNBOUND:
                raise
            return failure
        missing = [variable for variable in variables_of(goal) if variable not in bound]
        if isinstance(goal, Atom) and any(map(has_anything, goal.terms)):
            missing.append(ANYTHING_AT_ALL)
        return unbound(missing[0], self.form(goal)) if missing else None

    def _score(self, goal: Goal, bound: Bound) -> int:
        """How promising GOAL, which is ready, is: the less the better."""
        variables = variables_of(goal).keys()
        joined = bool(variables & bound)
        if not isinstance(goal, Atom):
            return DECIDED if variables <= bound else JOINED if joined else UNKNOWN
        relation = self.resolve(goal)
        if relation is None:
            return GROUND
        positions = known_positions(goal, bound)
        if len(positions) == relation.arity:
            return GROUND
        if relation.unique is not None and positions == relation.unique:
            return DETERMINED
        if positions:
            return JOINED if joined else KNOWN
        return ITSELF if relation is self.about and not bound else UNKNOWN

    def _is_decided(self, goal: Either, bound: Bound) -> bool:
        """Whether GOAL binds nothing and asks no rules, so that it is just true or not."""
        return variables_of(goal).keys() <= bound and not self._asks_rules(goal)

    def _asks_rules(self, goal: Goal) -> bool:
        if isinstance(goal, Atom):
            relation = self.resolve(goal)
            everything = tuple(range(len(goal.terms)))
            return relation is not None and self.rules(relation, everything, goal.is_direct) is not None
        inner = (goal.goal,) if isinstance(goal, Never) else goal.goals
        return any(self._asks_rules(each) for each in inner)

    def form(self, goal: Goal) -> Value:
        """GOAL as it was written."""
        return form_of(goal, self.constants)


def ways_of(step: Step) -> tuple[Steps, ...]:
    """The steps inside STEP."""
    if isinstance(step, Absent):
        return (step.steps,)
    if isinstance(step, Branch):
        return (*step.ways, *(rest.steps for rest in step.rests))
    return step.ways if isinstance(step, Present) else ()


def _flat(goals: tuple[Goal, ...]) -> list[Goal]:
    """GOALS, with what stands in an AND in its place."""
    flat: list[Goal] = []
    for goal in goals:
        flat += _flat(goal.goals) if isinstance(goal, Both) else [goal]
    return flat


def known_positions(atom: Atom, bound: Bound) -> Positions:
    """Where terms of ATOM stand that are known when BOUND variables have values."""
    return tuple(place for place, term in enumerate(atom.terms) if is_known(term, bound))


def is_known(term: Term, bound: Bound) -> bool:
    """Whether TERM has one value when BOUND variables have theirs."""
    if isinstance(term, Nested):
        return not has_anything(term) and variables_of(term).keys() <= bound
    return not isinstance(term, Symbol) or term in bound


def may_repeat(goal: Goal) -> bool:
    """Whether GOAL may be true twice under the same bindings."""
    if isinstance(goal, Atom):
        return any(has_anything(term) for term in goal.terms)
    return isinstance(goal, Either) or (isinstance(goal, Both) and any(map(may_repeat, goal.goals)))
