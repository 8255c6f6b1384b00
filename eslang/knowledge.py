"""Knowledge: the facts of an interpreter, for Python code.

`Interpreter.facts` is one of these. How facts are written in Python is
wording.py; which thread may do what when is runtime/visits.py. Whatever is
done here is done to the one database that plans use, under the same rules.
"""

from __future__ import annotations

from eslang.base.border import Text, enter, to_python
from eslang.base.calls import spread
from eslang.base.diagnostics import EslError
from eslang.base.errors import python_failure
from eslang.base.failure import Failure, simple_error
from eslang.base.failure_text import message_of
from eslang.base.hints import TYPE_CHECKING, Any, Callable, Iterable, Iterator, NamedTuple, Sequence
from eslang.base.resolve import resolve_in
from eslang.base.symbols import Symbol, Value
from eslang.constructs.queries import in_force
from eslang.facts.goals import ANYTHING, read_query
from eslang.facts.query import Facts
from eslang.facts.store import Store
from eslang.facts.unify import is_variable
from eslang.posts import post_call, raise_again
from eslang.runtime.failures import run_apart
from eslang.runtime.visits import NOT_NOW, Errand, leave_errand, send, visit
from eslang.wording import Wording, copied, key_of, resolve_unmade

if TYPE_CHECKING:
    from eslang.facts.plans import Solution
    from eslang.facts.watching import Change as Told
    from eslang.interpreter import Interpreter

Solutions = list[dict[str, Any]]
Form = str | Symbol | Sequence[Any]  # a whole fact, pattern or query; or what one begins with
Work = Callable[..., Any]  # of a Wording, the database, and what was given
Answer = Callable[[Facts, Value, dict[Symbol, Value]], Any]  # of a query and the values of its variables
LONG = 200  # characters of a row that are shown
LATER = object()  # a query calls Lisp, which is to be done in a task


class Change(NamedTuple):
    """A fact came (`added`), or went: its relation, and its terms as Python has them."""

    added: bool
    relation: Symbol
    terms: tuple[Any, ...]

    @property
    def fact(self) -> list[Any]:
        """The fact as a list."""
        return [self.relation, *self.terms]


class Knowledge:
    """What an interpreter knows: its facts.

    A fact, pattern or query is ESL text, "(is-a w1 widget)"; or its parts, "is-a",
    "w1", "widget"; or a list of these. A str among the parts is an atom as a plan
    would write it: a name, ":ok", "12.5", "?x"; Text("Left arm") is a string.
    What comes back has Python's values; strings are Text, which is a str.

    All may be called in any thread. While the interpreter is at work in another
    one, a change is left to be done between two steps, and gives None; a question
    waits for its answer until then.
    """

    __slots__ = ("_session",)

    def __init__(self, session: Interpreter) -> None:
        self._session = session

    # --- changes -----------------------------------------------------------------

    def add(self, fact: Form, /, *terms: Any) -> bool | None:
        """Hold a fact; whether that is new."""
        found: bool | None = self._change(add_fact, fact, terms)
        return found

    def add_all(self, rows: Iterable[Any], relation: str | Symbol | None = None) -> int | None:
        """Hold a fact for each of ROWS, all as one change, or none if one is wrong; how many are new.

        A row is a fact; if RELATION is told, its terms in a list or tuple, or its only term.
        """
        if isinstance(rows, str):
            raise TypeError("`add_all` takes many facts; for a single one there is `add`")
        found: int | None = self._change(add_rows, list(rows), relation)
        return found

    def remove(self, pattern: Form, /, *terms: Any) -> int | None:
        """Give up all facts that match a pattern, where "?_" is anything; how many there were."""
        found: int | None = self._change(remove_facts, pattern, terms)
        return found

    def update(self, pattern: Form, fact: Form, /) -> bool | None:
        """Let FACT take the place of all that match PATTERN, as one change; whether that changed anything."""
        found: bool | None = self._change(update_facts, pattern, fact)
        return found

    def clear(self) -> int | None:
        """Give up all facts; how many there were. Rules and declarations stay."""
        found: int | None = self._change(lambda wording, facts: facts.clear())
        return found

    def subscribe(
        self, subscriber: Callable[[Change], object], relation: str | Symbol | None = None
    ) -> Callable[[], None]:
        """Call SUBSCRIBER with each change (of RELATION) from now on; what is returned ends that.

        It is called when a change has been made, in the thread that made it, and is not to wait.
        What it raises is a failure of what made the change, after all others have heard of that.
        """
        if not callable(subscriber):
            raise TypeError(f"a subscriber is called with each change, and {subscriber!r} cannot be")
        subscription = Subscription(subscriber)
        self._change(subscription.begin, relation)

        def unsubscribe() -> None:
            subscription.is_over = True
            if not self._session.closed:
                self._change(subscription.end)

        return unsubscribe

    def _change(self, work: Work, *given: Any) -> Any:
        """What WORK gives, done now; or None, and it is left to be done, unless it is seen to be wrong."""
        runs = self._session.runs
        done = visit(runs, lambda: self._done(work, given))
        if done is not NOT_NOW:
            return done
        kept = copied(given)
        with self._session.door():
            work(Wording(resolve_unmade(self._session.image)), Store(), *kept)  # on nothing
        leave_errand(runs, lambda: self._done(work, kept), self._report)
        return None

    def _done(self, work: Work, given: Sequence[Any]) -> Any:
        """What WORK gives, done to the database."""
        session = self._session
        with session.door():
            return work(Wording(resolve_in(session.image)), session.database, *given)

    def _report(self, errand: Errand) -> None:
        """A change that was left has been made; what went wrong is a failure of the run."""
        error = errand.error
        if isinstance(error, Exception) and not self._session.closed:
            post_call(self._session, lambda: raise_again(error))

    # --- questions ---------------------------------------------------------------

    def query(self, query: Form, /, *terms: Any, **given: Any) -> Solutions:
        """All solutions of a query, each a dict: what ?x is bound to stands under "x".

        Variables that are GIVEN have that value: query("(is-a ?x ?type)", x="w1").
        A query without variables that holds has one solution, {}.
        """
        found: list[Solution] = self._ask(Facts.all, query, terms, given)
        return [solution_dict(each) for each in found]

    def first(self, query: Form, /, *terms: Any, **given: Any) -> dict[str, Any] | None:
        """The first solution of a query; None if there is none."""
        found: Solution | None = self._ask(Facts.first, query, terms, given)
        return None if found is None else solution_dict(found)

    def holds(self, query: Form, /, *terms: Any, **given: Any) -> bool:
        """Whether a query has a solution."""
        return self._ask(Facts.first, query, terms, given) is not None

    def __contains__(self, fact: Form) -> bool:
        """Whether FACT is held; what rules derive is not, and `holds` tells of it."""
        found: bool = self._look(lambda wording, facts: form_of(wording, fact) in facts)
        return found

    def __iter__(self) -> Iterator[list[Any]]:
        """The facts that are held now, as lists, relation by relation in the order of assertion."""
        found: list[Value] = self._look(lambda wording, facts: list(facts.facts()))
        return iter([to_python(fact, Text) for fact in found])

    def __len__(self) -> int:
        found: int = self._look(lambda wording, facts: len(facts))
        return found

    def _look(self, work: Work) -> Any:
        """What WORK gives, now or between two steps."""
        runs = self._session.runs

        def done() -> Any:
            return self._done(work, ())

        found = visit(runs, done)
        return send(runs, done) if found is NOT_NOW else found

    def _ask(self, answer: Answer, query: Form, terms: Sequence[Any], given: dict[str, Any]) -> Any:
        """What ANSWER gives for a query. A call of Lisp in it is run as any call, where tasks can be."""
        runs = self._session.runs
        at_home = runs.gate.is_here() and not runs.gate.is_ours()

        def work(wording: Wording, facts: Facts, may_wait: bool) -> Any:
            form = form_of(wording, query, terms)
            bound = bindings_of(wording, form, given)
            if not facts.plan(form, bound)[0].tests:
                return answer(facts, form, bound)
            return LATER if may_wait else run_apart(lambda: answer(facts, form, bound))

        found = visit(runs, lambda: self._done(work, (at_home,)))
        if found is LATER:
            with self._session.door():
                return runs.enter(lambda: self._done(work, (False,)))
        return send(runs, lambda: self._done(work, (False,))) if found is NOT_NOW else found


class Subscription:
    """Somebody who wants to hear of changes."""

    __slots__ = ("is_over", "relation", "stop", "subscriber")

    def __init__(self, subscriber: Callable[[Change], object]) -> None:
        self.subscriber = subscriber
        self.is_over = False
        self.relation: Symbol | None = None
        self.stop: Callable[[], None] = lambda: None

    def begin(self, wording: Wording, facts: Facts, relation: str | Symbol | None) -> None:
        """Hear of the changes of FACTS."""
        if relation is not None:
            self.relation = wording.relation(relation)
        if not self.is_over:
            self.stop = facts.subscribe(self.tell)

    def end(self, wording: Wording, facts: Facts) -> None:
        """Hear no more."""
        self.stop()

    def tell(self, told: Told) -> None:
        """Pass on what was told, if it matters here."""
        if self.is_over or self.relation not in (None, told.name):
            return
        change = Change(told.added, told.name, tuple(to_python(told.fact, Text)[1:]))
        try:
            spread(self.subscriber, (change,))
        except Failure as failure:
            enter(failure)
            raise
        except Exception as error:
            raise python_failure(error) from error


# --- what is done to the database, and what is asked of it -----------------------------


def add_fact(wording: Wording, facts: Facts, fact: Form, terms: Sequence[Any]) -> bool:
    """Hold a fact."""
    return facts.add(form_of(wording, fact, terms))


def remove_facts(wording: Wording, facts: Facts, pattern: Form, terms: Sequence[Any]) -> int:
    """Give up what matches."""
    return facts.retract(form_of(wording, pattern, terms))


def update_facts(wording: Wording, facts: Facts, pattern: Form, fact: Form) -> bool:
    """Let FACT take the place of what matches."""
    return facts.update(form_of(wording, pattern), form_of(wording, fact))


def add_rows(wording: Wording, facts: Facts, rows: Sequence[Any], relation: str | Symbol | None) -> int:
    """Hold the facts in ROWS, all or none; a failure tells the number of the row that is wrong."""
    name = None if relation is None else wording.relation(relation)
    number = 0  # of the row that is being read

    def forms() -> Iterator[Value]:
        nonlocal number
        for row in rows:
            number += 1
            yield wording.row(row, name)
        number = 0

    try:
        return facts.add_all(forms())
    except (Failure, EslError) as error:
        if not number:
            raise
        why = error.diagnostic.message if isinstance(error, EslError) else message_of(error)
        raise simple_error(f"row {number}, {shortened(rows[number - 1])}: {why}") from error


def shortened(row: Any) -> str:
    """ROW as Python shows it, if that is not too long."""
    text = repr(row)
    return text if len(text) <= LONG else f"{text[:LONG]}..."


def form_of(wording: Wording, first: Form, terms: Sequence[Any] = ()) -> Value:
    """A fact, pattern or query, with the values of the #?x in it."""
    return in_force(wording.form(first, terms))


def bindings_of(wording: Wording, query: Value, given: dict[str, Any]) -> dict[Symbol, Value]:
    """The values of the variables of QUERY that are GIVEN by what Python calls them."""
    if not given:
        return {}
    tokens = [token for token in read_query(query)[0] if is_variable(token) and token.name != ANYTHING]
    variables = {key_of(token): token for token in tokens}
    named = {key.replace("-", "_"): variable for key, variable in variables.items()} | variables
    unknown = [key for key in given if key not in named]
    if unknown:
        raise TypeError(f"this query has no variable ?{unknown[0].replace('_', '-')}")
    return {named[key]: wording.term(value) for key, value in given.items()}


def solution_dict(solution: Solution) -> dict[str, Any]:
    """A solution as Python has it."""
    return {key_of(variable): to_python(value, Text) for variable, value in solution.items()}
