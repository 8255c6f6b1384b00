"""Plans: queries as they run.

A plan is made once for all queries that differ in their constants only. It
runs on the facts as they are where nothing can change them meanwhile, else on
a view, which is what a snapshot is.
"""

from __future__ import annotations

from functools import partial

from eslang.base.calls import depth
from eslang.base.hints import Any, Callable, Iterator
from eslang.base.symbols import Symbol, Value
from eslang.facts.answers import ALISTS, ALL, FIRST, LAZY
from eslang.facts.explain import Explanation, explain
from eslang.facts.functions import Compiled, Question, compile_query
from eslang.facts.goals import Atom, Constants, Tokens, shape_of
from eslang.facts.procs import Planner, reached_from, tests
from eslang.facts.relations import Relation
from eslang.facts.rules import Name, Rule
from eslang.facts.steps import Steps, may_repeat
from eslang.facts.views import Accesses, Pace, Pauses, View
from eslang.facts.watching import Reads

Solution = dict[Symbol, Value]
DEEPEST = 1000  # queries that ask Lisp inside one another: generators use the C stack
Call = Callable[[Symbol, list[Value]], bool]
Searcher = tuple[View, Callable[..., Iterator[Solution]]]


class Plan:
    """How all queries of one shape are answered."""

    __slots__ = (
        "call",
        "compiled",
        "guessed",
        "is_fresh",
        "pauses",
        "question",
        "run_alists",
        "run_all",
        "run_first",
        "spare",
        "tests",
    )

    def __init__(self, planner: Planner, tokens: Tokens, call: Call, pauses: Pauses) -> None:
        count = len(planner.constants)
        shape = shape_of(tokens)
        steps = planner.plan(shape)
        given = {variable: f"c{place.number}" for variable, place in shape.given.items()}
        distinct = may_repeat(shape.goal)
        self.question = Question(steps, shape.variables, given, count, planner.constants, distinct)
        procs = reached_from(steps)
        bodies: list[Steps] = [steps, *(clause.steps for proc in procs for clause in proc.clauses)]
        self.tests = [name for body in bodies for name in tests(body)]
        self.is_fresh = any(proc.circle for proc in procs)  # what it remembers is for one run only
        self.guessed: tuple[Symbol, ...] = ()  # names that nobody had defined when it was made
        self.call = call
        self.pauses = pauses
        self.compiled: dict[str, Compiled] = {}
        self.run_all: Callable[..., Any] | None = None  # what runs on the facts as they are, if it is kept
        self.run_alists: Callable[..., Any] | None = None
        self.run_first: Callable[..., Any] | None = None
        self.spare: Searcher | None = None  # that nobody uses

    def functions(self, kind: str) -> Compiled:
        """The functions that answer in this way."""
        found = self.compiled.get(kind)
        if found is None:
            found = self.compiled[kind] = compile_query(self.question, kind)
        return found

    def runner(self, kind: str) -> Callable[..., Any]:
        """What answers from the facts as they are, for one query after another, until it pauses."""
        compiled = self.functions(kind)
        view = View(compiled.accesses)

        def pause() -> None:
            self.forget_runs()  # what paused is for the query that it answers
            self.pauses.leave(view)

        return compiled.make(view, self.call, Pace(self.pauses, pause))

    def forget_runs(self) -> None:
        """What was kept to run again is not to be."""
        self.run_all = self.run_alists = self.run_first = self.spare = None

    def all(self, constants: Constants) -> list[Solution]:
        """All solutions."""
        if self.tests:
            return self._on_view(ALL, constants)  # type: ignore[no-any-return]
        run = self.runner(ALL)
        self.run_all = None if self.is_fresh else run
        return run(*constants)  # type: ignore[no-any-return]

    def alists(self, constants: Constants) -> Value:
        """All solutions, as a list of alists."""
        if self.tests:
            return self._on_view(ALISTS, constants)
        run = self.runner(ALISTS)
        self.run_alists = None if self.is_fresh else run
        return run(*constants)

    def first(self, constants: Constants) -> Solution | None:
        """The first solution; None if there is none."""
        if self.tests:
            return self._on_view(FIRST, constants)  # type: ignore[no-any-return]
        run = self.runner(FIRST)
        self.run_first = None if self.is_fresh else run
        return run(*constants)  # type: ignore[no-any-return]

    def explain(self, constants: Constants) -> Explanation:
        """How this plan finds its answers."""
        self.runner(ALL)  # the indexes that it needs are there
        return explain(self.question, constants)

    def _on_view(self, kind: str, constants: Constants, reads: Reads | None = None) -> Any:
        """The answer of what asks Lisp, too, which may change the facts; or of what notes its READS."""
        compiled = self.functions(kind)
        if depth[0] > DEEPEST:
            raise RecursionError("too many queries that ask Lisp inside one another")
        noted = None if reads is None else partial(reads.through, compiled.accesses)
        view = View(compiled.accesses, noted)
        pace = Pace(self.pauses, self.pauses.between)
        view.open()
        depth[0] += 1
        try:
            return compiled.make(view, self.call, pace)(*constants)
        finally:
            depth[0] -= 1
            if reads is not None:
                reads.compare(view)
            view.close()

    def solutions(self, constants: Constants) -> Solutions:
        """The solutions of this moment, one at a time."""
        return Solutions(self, constants)

    def searcher(self) -> Searcher:
        """What finds one solution after another, and the view that it reads."""
        if self.spare is not None:
            spare, self.spare = self.spare, None
            return spare
        compiled = self.functions(LAZY)
        view, pace = View(compiled.accesses), Pace(self.pauses, self.pauses.between)
        if self.is_fresh:
            return view, lambda *constants: compiled.make(view, self.call, pace)(*constants)
        return view, compiled.make(view, self.call, pace)

    def noting(self, constants: Constants, reads: Reads) -> Solution | None:
        """The first solution, and in READS what was read to find it."""
        reads.asked_lisp = reads.asked_lisp or bool(self.tests)
        return self._on_view(FIRST, constants, reads)  # type: ignore[no-any-return]

    def noting_all(self, constants: Constants, reads: Reads) -> list[Solution]:
        """All solutions, and in READS what was read to find them."""
        reads.asked_lisp = reads.asked_lisp or bool(self.tests)
        return self._on_view(ALL, constants, reads)  # type: ignore[no-any-return]


def make_plan(
    resolve: Callable[[Atom], Relation | None],
    rules_of: Callable[[Name], list[Rule]],
    tokens: Tokens,
    constants: Constants,
    call: Call,
    pauses: Pauses,
) -> Plan:
    """The plan for a query; fails if the query is unsafe."""
    return Plan(Planner(resolve, rules_of, constants), tokens, call, pauses)


class Solutions:
    """The solutions of a query as they were when it was entered; found when they are asked for.

    Where a test fails or is left by a jump, or waits while the next solution is
    wanted again, the search is begun anew, on the same facts; what was told is
    not told again.
    """

    __slots__ = ("_constants", "_plan", "_run", "_search", "_searches", "_told", "_view")

    def __init__(self, plan: Plan, constants: Constants) -> None:
        self._plan = plan
        self._constants = constants
        self._view, self._search = plan.searcher()
        self._view.open()
        self._run: Iterator[Solution] | None = self._search(*constants)  # none while it searches
        self._searches = 0  # that are under way, one inside the other
        self._told = 0

    def __iter__(self) -> Iterator[Solution]:
        return self

    def __next__(self) -> Solution:
        run, self._run = self._run, None
        self._searches += 1
        try:
            if run is None:
                run = self._search(*self._constants)
                for _ in range(self._told):
                    next(run)
            found = next(run)
        except StopIteration:
            if self._searches == 1:
                self._end(True)
            raise
        finally:
            self._searches -= 1
        self._run = run
        self._told += 1
        return found

    def close(self) -> None:
        """No more of them are wanted."""
        self._end(not self._searches)

    def _end(self, is_idle: bool) -> None:
        view, self._view = self._view, NOTHING
        if view.is_open:
            view.close()
            if is_idle and view.kept is None:
                self._plan.spare = view, self._search  # as good as new
        self._run = iter(())

    def __del__(self) -> None:
        self._view.close()


NOTHING = View(Accesses(()))
