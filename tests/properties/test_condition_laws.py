"""The laws of waiting for a condition, in plans made by chance.

Some tasks wait for conditions over facts, others change facts and rules, in
whatever order the scheduler chooses. Who was woken waited for something that
is true, or has been; what is still waited for in the end is false; and no
condition is asked again unless something that it read has changed.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from io import StringIO
from typing import Any, NamedTuple

import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from worlds import database, lisp, looked_up, plain, said, taken, was_read

from eslang.base.printer import prin1
from eslang.facts.query import Facts
from eslang.facts.watching import Change
from eslang.interpreter import Interpreter
from naive.queries import Goal, Rule, Term, World, variables

pytestmark = pytest.mark.slow
LAW = settings(max_examples=100, deadline=None, suppress_health_check=[HealthCheck.too_slow])

# --- what is generated: a condition is a query under a quote, or AND, OR, NOT of conditions ----------

HELD = (("p", 1), ("q", 2))
RELATIONS = (*HELD, ("d", 1), ("e", 2))
THING = st.sampled_from(["a", "b"])
VARIABLE = st.sampled_from(["?x", "?y"])
PATTERN = said(RELATIONS, st.one_of(THING, THING, VARIABLE, st.just("?_")))
BARE = said(RELATIONS, st.one_of(THING, THING, st.just("?_")))


@st.composite
def joined(draw: Any) -> Goal:
    """Two patterns, of which the second may stand under NOT."""
    first = draw(PATTERN)
    names = st.sampled_from(variables(first) or ["a"])
    second = draw(said(RELATIONS, st.one_of(names, THING)))
    return ("and", first, draw(st.sampled_from([second, ("not", second)])))


QUERY = st.one_of(
    PATTERN, joined(), st.tuples(st.just("or"), PATTERN, BARE), BARE.map(lambda atom: ("not", atom))
)
CONDITION = st.recursive(
    QUERY.map(lambda query: ("quote", query)),
    lambda parts: st.one_of(
        st.tuples(st.sampled_from(["and", "or"]), parts, parts),
        parts.map(lambda part: ("not", part)),
    ),
    max_leaves=3,
)
DERIVATION = st.sampled_from(
    [
        Rule(("d", "?x"), (("p", "?x"),)),
        Rule(("d", "?x"), (("q", "?x", "?_"),)),
        Rule(("d", "?x"), (("q", "?x", "?y"), ("d", "?y"))),
        Rule(("d", "?x"), (("p", "?x"), ("not", ("q", "?x", "?x")))),
        Rule(("d", "?x"), (("p", "?x"), ("not", ("e", "?x", "b")))),
        Rule(("d", "a"), (("q", "b", "b"),)),
        Rule(("d", "?x"), (("or", ("p", "?x"), ("q", "?_", "?x")),)),
        Rule(("e", "?x", "?y"), (("q", "?x", "?y"),)),
        Rule(("e", "?x", "?y"), (("q", "?y", "?x"),)),
        Rule(("e", "?x", "?y"), (("q", "?x", "?z"), ("e", "?z", "?y"))),
        Rule(("e", "?x", "?y"), (("e", "?x", "?z"), ("q", "?z", "?y"))),
        Rule(("e", "?x", "?y"), (("e", "?x", "?z"), ("e", "?z", "?y"))),
        Rule(("e", "?x", "?x"), (("p", "?x"), ("not", ("d", "?x")))),
        Rule(("e", "?x", "b"), (("p", "?x"), ("p", "b"))),
    ]
)
ASSERT = st.tuples(st.just("assert"), said(HELD, THING))
RETRACT = st.tuples(st.just("retract"), said(HELD, st.one_of(THING, st.just("?_"))))
ACT = st.one_of(
    ASSERT,
    ASSERT,
    RETRACT,
    st.tuples(st.just("update"), said(HELD, st.one_of(THING, VARIABLE)), said(HELD, THING)),
    st.tuples(st.just("assert"), said(RELATIONS, THING)),
    st.tuples(st.just("defrule"), DERIVATION),
    st.tuples(st.just("forget-rules"), st.sampled_from("de")),
)
ACTORS = st.lists(st.lists(ACT, min_size=6, max_size=9), min_size=1, max_size=2)


def text(term: Term) -> str:
    """A term as it is written."""
    return prin1(lisp(term))


def condition_text(condition: Any) -> str:
    """A condition as it is written."""
    if condition[0] == "quote":
        return f"'{text(condition[1])}"
    return f"({condition[0]} {' '.join(map(condition_text, condition[1:]))})"


def act_text(act: tuple[Any, ...]) -> str:
    """A change as it is written."""
    if act[0] == "defrule":
        form = f"(defrule {text(act[1].head)} {' '.join(map(text, act[1].body))})"
        return f"(with-recovery-procedures ((:unstratified-rules (abort nil))) {form})"
    parts = [str(part) if part.__class__ is int else f"'{text(part)}" for part in act[1:]]
    return f"({act[0]} {' '.join(parts)})"


def holds(condition: Any, world: World) -> bool:
    """Whether CONDITION is true there."""
    if condition[0] == "quote":
        return bool(world.solutions(condition[1]))
    parts = [holds(part, world) for part in condition[1:]]
    return not parts[0] if condition[0] == "not" else (all if condition[0] == "and" else any)(parts)


# --- what happened ---------------------------------------------------------------------


class Moment(NamedTuple):
    """What was held and derived at some time."""

    facts: list[Goal]
    rules: list[Rule]


class Asked(NamedTuple):
    """When a condition was asked, and what all its queries read."""

    inquiry: Any
    moment: int
    read: set[Any]


class History:
    """What is known of one run: the moments, who began to wait and who was woken when, who asked in vain."""

    def __init__(self, interp: Interpreter, known: list[Rule], conditions: list[Any]) -> None:
        self.interp, self.known, self.conditions = interp, known, conditions
        self.facts: Facts = interp.database
        self.moments: list[Moment] = []
        self.begun: dict[int, int] = {}  # by the number of the condition: the moment
        self.woken: dict[int, int] = {}
        self.changed: list[Change | None] = []
        self.last: dict[Any, Asked] = {}  # by the task that asked
        self.asked = 0
        self.idle: list[str] = []  # what was asked without a cause
        self.facts.subscribe(self.note)
        self.listen("define_rule", self.note_rules)
        self.listen("forget_rules", self.note_rules)
        self.ask, self.facts.ask = self.facts.ask, self.note_asked  # type: ignore[method-assign]
        self.note(None)

    def listen(self, name: str, after: Callable[..., None]) -> None:
        """Call AFTER when the method of that name has changed something."""
        method = getattr(self.facts, name)

        def called(*given: Any) -> bool:
            self.note(None)  # rules wake while they are defined
            is_change = bool(method(*given))
            after(is_change, *given)
            return is_change

        setattr(self.facts, name, called)

    def note(self, change: Change | None) -> None:
        """A change is whole."""
        held = [plain(fact) for fact in self.facts.facts()]
        self.moments.append(Moment(held, list(self.known)))
        self.changed.append(change)

    def note_rules(self, is_change: bool, head: Any, body: Any = None) -> None:
        """Rules came or went."""
        if is_change and body is not None:
            self.known.append(Rule(plain(head), plain(body)))
        elif is_change:
            self.known[:] = [rule for rule in self.known if rule.head[0] != plain(head)]
        self.note(None)

    def note_asked(self, query: Any, *given: Any) -> Any:
        """A condition is asked; unless it is for the first time, something it read has changed."""
        task, inquiry = self.interp.scheduler.current, self.interp.dynamic.logical.inquiry
        now = len(self.changed)
        found, reads = self.ask(query, *given)
        last = self.last.get(task)
        if last is None or last.inquiry is not inquiry:
            self.asked += 1
            changed = self.changed[last.moment :] if last is not None else [None]
            if last is not None and not any(each is None or was_read(each, last.read) for each in changed):
                self.idle.append(prin1(query))
            last = self.last[task] = Asked(inquiry, now, set())
        last.read.update(looked_up(reads))
        return found, reads

    def check(self) -> None:
        """The laws."""
        assert self.idle == []
        for number, condition in enumerate(self.conditions):
            since = self.moments[self.begun[number] : self.woken.get(number, len(self.moments)) + 1]
            if number in self.woken:
                assert any(holds(condition, World(*moment)) for moment in reversed(since))
            else:
                assert not holds(condition, World(*since[-1]))


@LAW
@given(
    st.lists(said(HELD, THING), max_size=2),
    st.lists(DERIVATION, max_size=3),
    st.lists(CONDITION, min_size=3, max_size=5),
    ACTORS,
    st.one_of(st.none(), st.integers(0, 99)),
    st.sampled_from([1, 500]),
    st.sampled_from(["", "(defproperty q) (defproperty e)"]),
)
def test_a_condition_wakes_who_waits_when_it_comes_to_be_true_and_nobody_asks_in_vain(
    told: list[Goal],
    candidates: list[Rule],
    conditions: list[Any],
    actors: list[list[Any]],
    seed: int | None,
    rows: int,
    declarations: str,
) -> None:
    known = taken(database([]), candidates)
    limit = sys.getrecursionlimit()  # plans have another
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("eslang.facts.views.SLICE", rows)  # between two pauses of a query
        try:
            check_run(told, known, conditions, actors, seed, declarations)
        finally:
            sys.setrecursionlimit(limit)


def check_run(
    told: list[Goal],
    known: list[Rule],
    conditions: list[Any],
    actors: list[list[Any]],
    seed: int | None,
    declarations: str,
) -> None:
    """Run the plan, and see whether the laws hold."""
    interp = Interpreter(clock="virtual", output=StringIO(), shuffle=seed is not None, seed=seed or 0)
    with interp:
        interp.eval(f"(progn {declarations})")
        for rule in known:
            interp.database.define_rule(lisp(rule.head), lisp(rule.body))
        for fact in told:
            interp.database.add(lisp(fact))
        history = History(interp, known, conditions)
        interp.primitive(lambda number: mark(history.begun, number, history), name="begin")
        interp.primitive(lambda number: mark(history.woken, number, history), name="woke")
        waiters = [
            f"(spawn (progn (begin {number}) (wait-until {condition_text(each)}) (woke {number})) :daemon t)"
            for number, each in enumerate(conditions)
        ]
        tasks = [
            f"(actor-{number} {' (sleep 0) '.join(map(act_text, acts))})"
            for number, acts in enumerate(actors)
        ]
        interp.eval(f"(progn {' '.join(waiters)} (sleep 0) (task-net {' '.join(tasks)}) (sleep 100))")
        history.check()
        event(f"woken {len(history.woken)} of {len(conditions)}")
        event(f"asked {min(history.asked // len(conditions), 5)} times")
    assert not any(relation.watched for relation in interp.database.relations.values())


def mark(moments: dict[int, int], number: int, history: History) -> None:
    """It is now that this happens."""
    moments[number] = len(history.moments) - 1
