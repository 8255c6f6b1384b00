"""Programs of SCS, and the worlds in which they run, by chance."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

from circuits.running import END, LIMIT, limited
from naive.circuit_runs import Effects
from naive.steps import Act, Await, Clause, Clauses, Condition, Group, Guarded, Steps, World

FACTS = (("p",), ("q",), ("at", "a"), ("at", "b"))
FACT = st.sampled_from([("fact", *fact) for fact in FACTS])
X = st.integers(0, 2).map(lambda number: ("x", number))
PLACE = st.just(("fact", "at", "?"))  # binds a variable
GROUND: st.SearchStrategy[Condition] = st.recursive(
    st.one_of(FACT, FACT, X, st.just(("t",))),
    lambda parts: st.one_of(
        parts.map(lambda part: ("not", part)),
        st.tuples(st.sampled_from(["and", "or"]), parts, parts),
    ),
    max_leaves=2,
)
BINDING = st.one_of(GROUND, GROUND, PLACE, st.tuples(st.just("and"), PLACE, GROUND))
EFFECT: st.SearchStrategy[tuple[Any, ...]] = st.one_of(
    st.sampled_from(
        [*((word, *fact) for word in ("assert", "retract") for fact in FACTS), ("assert", "lit")]
    ),
    st.integers(0, 2).map(lambda number: ("set", number)),
)
EFFECTS = st.lists(EFFECT, max_size=2).map(tuple)
NEVER, ALWAYS = ("not", ("t",)), ("t",)
FAILS = st.one_of(st.just(NEVER), st.just(NEVER), st.just(NEVER), st.just(ALWAYS), FACT, X)
PLAIN = st.sampled_from([False, False, False, True])
ACT = st.builds(Act, st.just(""), EFFECTS, FAILS, about=st.sampled_from(["", "?"]), is_plain=PLAIN)
GROUP = st.lists(ACT, min_size=1, max_size=3).map(lambda acts: Group(tuple(acts)))
MODIFIER = st.one_of(
    st.tuples(st.sampled_from(["while", "when"]), BINDING),
    st.tuples(st.sampled_from(["until", "unless"]), GROUND),
)
MODIFIERS = st.one_of(st.just(()), st.lists(MODIFIER, max_size=2).map(tuple))
ALLS = ["all", "all"]
STARRED = st.sampled_from([False, False, True])
UTILITY = st.sampled_from([0, 1, 1, 2, "x", "-x"])
WORLDS = st.builds(World, st.frozensets(st.sampled_from(FACTS)), st.integers(0, 2), st.just(LIMIT))
CHANGES: st.SearchStrategy[tuple[Effects, ...]] = st.lists(EFFECTS, max_size=3).map(
    lambda changes: (*changes, END)
)


@st.composite
def steps(draw: Any, depth: int, waits: bool) -> Any:
    """A step, of at most DEPTH levels; not yet named. Steps that wait are among them if WAITS."""
    kinds = ["act", "act", "group", *["await"] * waits]
    if depth > 0:
        kinds += ["guarded", "do", "do", "repeat", *ALLS, "any", "first", "first", "best"]
    kind = draw(st.sampled_from(kinds))
    if kind in ("act", "group"):
        return draw(ACT if kind == "act" else GROUP)
    if kind == "await":
        return Await("")
    if kind == "guarded":
        return Guarded("", draw(steps(depth - 1, waits)))
    starred, modifiers = draw(STARRED), draw(MODIFIERS)
    if kind in ("first", "best"):
        inside = st.lists(steps(depth - 1, waits), min_size=1, max_size=2).map(tuple)
        clause = st.builds(Clause, BINDING, UTILITY, inside)
        return Clauses(kind, starred, modifiers, tuple(draw(st.lists(clause, min_size=1, max_size=3))))
    listed = draw(st.lists(steps(depth - 1, waits), min_size=1, max_size=3))
    if kind == "repeat":
        listed.insert(draw(st.integers(0, len(listed))), draw(ACT))  # it gets somewhere
    is_named = kind == "do" and not starred and draw(st.booleans())
    return Steps(kind, starred, modifiers, tuple(listed), "?" if is_named else "")


class Namer:
    """Gives names to all that has none: actions, variables, steps."""

    def __init__(self, asks_lisp: bool = True) -> None:
        self.count = 0
        self.asks_lisp = asks_lisp

    def name(self, letter: str) -> str:
        """Another name."""
        self.count += 1
        return f"{letter}{self.count}"

    def named(self, term: Any, scope: str = "") -> Any:
        """TERM with names, where SCOPE is the variable that is bound around it."""
        if isinstance(term, Act):
            return term._replace(name=self.name("a"), about=scope if term.about else "")
        if isinstance(term, Await):
            return Await(self.name("w"))
        if isinstance(term, Group):
            return Group(tuple(self.named(act, scope) for act in term.acts))
        if isinstance(term, Guarded):
            return Guarded(self.name("g"), self.named(term.step, scope))
        if isinstance(term, Clause):
            condition, inner = self.condition(term.condition, scope)
            return Clause(condition, term.utility, tuple(self.named(step, inner) for step in term.steps))
        modifiers = []
        for word, condition in term.modifiers:
            condition, scope = self.condition(condition, scope)
            modifiers.append((word, condition))
        inside = tuple(self.named(step, scope) for step in term.steps)
        term = term._replace(modifiers=tuple(modifiers), steps=inside)
        return term._replace(name=self.name("s")) if getattr(term, "name", "") else term

    def condition(self, condition: Condition, scope: str) -> tuple[Condition, str]:
        """CONDITION, with a name for its variable, and the variable that is bound then."""
        if not self.asks_lisp:
            condition = without_lisp(condition)
        if "?" not in condition and ("fact", "at", "?") not in condition:
            return condition, scope
        variable = self.name("?v")
        if condition[0] == "and":
            return ("and", ("fact", "at", variable), condition[2]), variable
        return ("fact", "at", variable), variable


def without_lisp(condition: Condition) -> Condition:
    """CONDITION, which asks facts instead of Lisp."""
    word, *parts = condition
    if word == "x":
        return ("fact", *FACTS[parts[0]])
    return condition if word == "fact" else (word, *map(without_lisp, parts))


def programs(depth: int, waits: bool = False) -> st.SearchStrategy[Any]:
    """Programs of at most DEPTH levels, which end after some actions.

    If WAITS, they have steps that wait, and no condition over Lisp: nobody asks such a one during a wait.
    """
    return steps(depth, waits).map(lambda term: limited(Namer(asks_lisp=not waits).named(term)))


SMALL_WORLDS = WORLDS.map(lambda world: world._replace(left=5))
DEED = ACT.map(lambda act: act._replace(about=""))  # which solution of a condition is taken, is no chance
TWO = st.tuples(DEED, DEED)
TINY = st.one_of(
    *(DEED, DEED, TWO.map(Group)),
    *(TWO.map(lambda acts, kind=kind: Steps(kind, False, (), acts)) for kind in ("do", "any")),
)


@st.composite
def tiny_programs(draw: Any) -> Any:
    """Programs of which all runs can be told."""
    kind, starred = draw(st.sampled_from(["all", "any"])), draw(STARRED)
    listed = tuple(draw(st.lists(TINY, min_size=1, max_size=3)))
    return limited(Namer().named(Steps(kind, starred, draw(MODIFIERS), listed)))
