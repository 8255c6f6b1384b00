"""Generated facts, rules and queries, as the oracle (naive/queries.py) and as the database have them."""

from __future__ import annotations

from itertools import combinations
from typing import Any

from hypothesis import strategies as st

from eslang.base.failure import Failure
from eslang.base.lists import Cons, from_items, items
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.base.text import String
from eslang.facts.nested import Written
from eslang.facts.nested import filled as written_out
from eslang.facts.query import Facts
from eslang.facts.rules import UNSTRATIFIED
from eslang.facts.watching import Change, Reads
from naive.queries import TESTS, Bindings, Goal, Rule, Term, Text, key, strata, variables

CONNECTIVES = ("and", "or", "not")
Relations = tuple[tuple[str, int], ...]

# --- between the oracle and the database ---------------------------------------------


def lisp(term: Term) -> Value:
    """A term of the oracle, as a Lisp value."""
    if term.__class__ is tuple:
        return from_items([lisp(part) for part in term])
    if term.__class__ is Text:
        return String(term.text)
    if term.__class__ is str:
        if term[0] == ":":
            return Keyword(term[1:].upper())
        return Symbol.intern(term.upper(), "COMMON-LISP" if term in CONNECTIVES else "ESL-USER")
    return term


def plain(value: Value) -> Term:
    """A Lisp value as a term of the oracle."""
    if value is None or value.__class__ is Cons:
        return tuple(plain(part) for part in items(value))
    if value.__class__ is String:
        return Text(value.text)
    assert not isinstance(value, str | tuple), "a code has got out"
    if isinstance(value, Keyword):
        return f":{value.name.lower()}"
    return value.name.lower() if isinstance(value, Symbol) else value


def call(name: Symbol, arguments: list[Value]) -> bool:
    """Ask one of the oracle's tests."""
    said = [written_out(*each) if each.__class__ is Written else each for each in arguments]
    return TESTS[name.name.lower()](*map(plain, said))


def database(facts: list[Goal]) -> Facts:
    """A database that holds FACTS."""
    made = Facts(lambda name: name.name.lower() in TESTS, call)
    for fact in facts:
        made.add(lisp(fact))
    return made


def given_as(bindings: Bindings) -> dict[Symbol, Value]:
    """BINDINGS as the database takes them."""
    return {lisp(variable): lisp(term) for variable, term in bindings.items()}


def solved(solutions: Any) -> list[frozenset[tuple[str, Any]]]:
    """Solutions as the oracle tells them."""
    return [
        frozenset((variable.name.lower(), key(plain(value))) for variable, value in solution.items())
        for solution in solutions
    ]


def taken(facts: Facts, candidates: list[Rule]) -> list[Rule]:
    """The rules that mean something; FACTS takes these and refuses the others."""
    found: list[Rule] = []
    for rule in candidates:
        means_something = strata([*found, rule]) is not None
        try:
            facts.define_rule(lisp(rule.head), lisp(rule.body))
        except Failure as failure:
            assert failure.cause is UNSTRATIFIED and not means_something
            continue
        assert means_something
        found.append(rule)
    return found


def change(facts: Facts, what: tuple[Any, ...]) -> None:
    """Do one of CHANGES, or define a rule if it has a meaning."""
    if what[0] == "rule":
        taken_or_not(facts, what[1])
    elif what[0] == "forget":
        facts.forget_rules(lisp(what[1]))
    elif what[0] == "update":
        facts.update(lisp(what[1]), lisp(what[2]))
    else:
        (facts.add if what[0] == "add" else facts.retract)(lisp(what[1]))


def taken_or_not(facts: Facts, rule: Rule) -> None:
    """Define RULE, unless it closes a circle through NOT."""
    try:
        facts.define_rule(lisp(rule.head), lisp(rule.body))
    except Failure as failure:
        assert failure.cause is UNSTRATIFIED


def looked_up(reads: Reads) -> set[Any]:
    """What READS holds, in words that can be compared."""
    return {
        (relation.name, relation.arity, positions, repr(each))
        for (relation, positions), keys in reads.keys.items()
        for each in keys
    }


def was_read(told: Change, read: set[Any]) -> bool:
    """Whether a look-up that is in READ finds what TOLD tells of."""
    arity = len(told.row)
    for size in range(arity + 1):
        for positions in combinations(range(arity), size):
            parts = tuple(told.row[place] for place in positions)
            looked = None if not positions and arity else parts[0] if size == 1 and arity > 1 else parts
            if (told.name, arity, positions, repr(looked)) in read:
                return True
    return False


# --- what is generated ---------------------------------------------------------------

STORED: Relations = (("p", 1), ("q", 2), ("q", 1), ("r", 2), (":s", 2), ("rain", 0))
DERIVED: Relations = (("d", 1), ("e", 2), ("g", 2))
WRAPPED: Relations = (("w", 2),)  # derived, with lists that rules make; no rule asks for it
RELATIONS = (*STORED, *DERIVED)

ATOMS = ["a", "b", "c", ":on", 1, 1.0, Text("a"), Text("A")]
LISTS = [(), ("f", "a"), ("f", "b"), ("f", "a", 1), ("f", ("f", "a")), (Text("a"),), ("a", "a")]
GROUND = st.sampled_from([*ATOMS, *LISTS])
VARIABLE = st.sampled_from(["?x", "?y", "?z"])
PARTIAL = st.one_of(
    VARIABLE.map(lambda name: ("f", name)),
    st.tuples(VARIABLE, VARIABLE),
    st.tuples(st.just("f"), st.just("?_")),
    st.tuples(st.just("f"), VARIABLE, st.just(1)),
    VARIABLE.map(lambda name: ("f", ("f", name))),
)
TERM = st.one_of(*[VARIABLE] * 5, st.sampled_from("ab"), GROUND, st.just("?_"), PARTIAL)
STORABLE = st.one_of(*[st.sampled_from("ab")] * 3, GROUND)


@st.composite
def said(draw: Any, relations: Relations, terms: st.SearchStrategy[Term]) -> Goal:
    """An atom about one of RELATIONS."""
    name, arity = draw(st.sampled_from(relations))
    return (name, *(draw(terms) for _ in range(arity)))


FACTS = st.lists(said(RELATIONS, STORABLE), min_size=4, max_size=16)
TEST = st.one_of(
    st.tuples(st.sampled_from(["smaller", "same"]), VARIABLE, st.one_of(VARIABLE, GROUND)),
    st.tuples(st.just("is-number"), VARIABLE),
    st.tuples(st.just("same"), PARTIAL, st.one_of(VARIABLE, GROUND)),
)
ATOM = said(RELATIONS, TERM)
ASKED = st.one_of(ATOM, ATOM, ATOM, said((*STORED, *DERIVED, *WRAPPED), TERM))
LEAF = st.one_of(ASKED, ASKED, ASKED, TEST)
GOALS = st.recursive(
    LEAF,
    lambda goals: st.one_of(
        st.lists(goals, max_size=3).map(lambda parts: ("and", *parts)),
        st.lists(goals, max_size=2).map(lambda parts: ("or", *parts)),
        goals.map(lambda part: ("not", part)),
    ),
    max_leaves=4,
)
QUERIES = st.one_of(
    GOALS,
    ASKED,
    st.tuples(st.just("and"), ASKED, LEAF),
    st.tuples(st.just("and"), ASKED, GOALS),
    st.tuples(st.just("and"), GOALS, ASKED, ASKED),
)


@st.composite
def any_rule(draw: Any) -> Rule:
    """A rule; it derives what its patterns bind."""
    patterns = draw(st.lists(ATOM, min_size=1, max_size=2))
    bound = sorted({name for goal in patterns for name in variables(goal)})
    names = st.sampled_from(bound) if bound else GROUND
    conditions = st.one_of(
        said(RELATIONS, st.one_of(names, GROUND)).map(lambda atom: ("not", atom)),
        st.tuples(st.sampled_from(["smaller", "same"]), names, st.one_of(names, GROUND)),
        st.tuples(st.just("or"), said(RELATIONS, names), said(RELATIONS, names)),
        st.tuples(said(STORED, names), said(STORED, names)).map(lambda two: ("not", ("not", ("and", *two)))),
    )
    body = draw(st.permutations([*patterns, *draw(st.lists(conditions, max_size=1))]))
    terms = st.one_of(names, names, GROUND)
    made = st.one_of(terms, names.map(lambda name: ("f", name)))
    head = draw(st.one_of(said(DERIVED, terms), said(DERIVED, terms), said(WRAPPED, made)))
    return Rule(head, tuple(body))


def chain(head: tuple[str, ...], *body: tuple[str, ...]) -> Rule:
    """A rule about pairs."""
    return Rule(head, body)


PAIRS = st.sampled_from(["q", "r", ":s", "e", "g"])
RECURSIVE = st.tuples(st.sampled_from("eg"), PAIRS, PAIRS).flatmap(
    lambda names: st.sampled_from(
        [
            chain((names[0], "?x", "?y"), (names[1], "?x", "?y")),
            chain((names[0], "?x", "?y"), (names[0], "?x", "?z"), (names[1], "?z", "?y")),
            chain((names[0], "?x", "?y"), (names[1], "?x", "?z"), (names[0], "?z", "?y")),
            chain((names[0], "?x", "?y"), (names[0], "?x", "?z"), (names[0], "?z", "?y")),
            chain((names[0], "?x", "?y"), (names[0], "?y", "?x")),
            chain(
                (names[0], "?x", "?y"), (names[1], "?x", "?u"), (names[0], "?u", "?v"), (names[2], "?v", "?y")
            ),
            Rule((names[0], "?x", "?y"), ((names[1], "?x", "?y"), ("not", (names[2], "?y", "?x")))),
        ]
    )
)


def rules() -> st.SearchStrategy[Rule]:
    """Rules of all kinds."""
    return st.one_of(any_rule(), any_rule(), RECURSIVE)


CHANGES = st.lists(
    st.one_of(
        st.tuples(st.just("add"), said(RELATIONS, STORABLE)),
        st.tuples(st.just("retract"), ATOM),
        st.tuples(st.just("update"), ATOM, said(RELATIONS, STORABLE)),
    ),
    max_size=12,
)
UPHEAVALS = st.lists(
    st.one_of(
        st.tuples(st.just("add"), said(RELATIONS, STORABLE)),
        st.tuples(st.just("add"), said(RELATIONS, STORABLE)),
        st.tuples(st.just("retract"), ATOM),
        st.tuples(st.just("update"), ATOM, said(RELATIONS, STORABLE)),
        st.tuples(st.just("rule"), rules()),
        st.tuples(st.just("forget"), st.sampled_from("deg")),
    ),
    max_size=10,
)
