"""The logical database: look-ups, joins, changes that others wait for, what follows from rules.

The other engines are in engines.py, what facts take to load and to keep in
storing.py, the transitive closures in closures.py.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from eslang.base.lists import lisp_list
from eslang.base.symbols import Keyword, Symbol
from eslang.facts.query import Facts
from eslang.facts.watching import watch
from tests.benchmarks import closures, engines, facts_in_esl, storing
from tests.benchmarks.engines import Asked, Prolog, Rows
from tests.benchmarks.measure import Peer, Row, Work

FACTS = 100_000
FEW = 10_000  # for who takes long
FEWEST = 300  # for who takes the square of it
ASKED = 1000
PARENT, SWITCH = Symbol("parent"), Symbol("switch")
X, Y, Z = (Symbol(name) for name in ("?x", "?y", "?z"))
ON, OFF = Keyword("on"), Keyword("off")
AND = Symbol.intern("AND", "COMMON-LISP")
JOIN = lisp_list(AND, lisp_list(PARENT, X, Y), lisp_list(PARENT, Y, Z))


def works() -> Iterator[Work | Row]:
    """What is measured."""
    prolog = engines.prolog()
    facts, rows = family(FACTS)
    yield look_up(facts, rows, prolog)
    yield join(facts, rows, prolog)
    for count, name, engine in ((FEW, "pyDatalog", engines.pydatalog), (FEWEST, "kanren", engines.kanren)):
        yield short_join(count, name, engine(engines.family_rows(count)))
    yield change()
    yield from facts_in_esl.works(prolog)
    yield from closures.works(prolog)
    yield from storing.works()


def new() -> Facts:
    """An empty database that knows no Lisp."""
    return Facts(lambda name: False, lambda name, arguments: False)


def family(count: int) -> tuple[Facts, Rows]:
    """A database of COUNT facts, and the same as rows of text."""
    facts = new()
    rows = engines.family_rows(count)
    facts.add_all(lisp_list(PARENT, Symbol(one), Symbol(other)) for one, other in rows)
    return facts, rows


def look_up(facts: Facts, rows: Rows, prolog: Prolog | None) -> Work:
    """One answer among many facts, over and over."""
    asked = [rows[number][0] for number in range(0, FACTS, FACTS // ASKED)]
    queries = [lisp_list(PARENT, Symbol(name), X) for name in asked]
    base = engines.sqlite(rows)
    text = "select b from parent where a = ?"

    def ours() -> int:
        return sum([len(facts.all(query)) for query in queries])

    def theirs() -> int:
        return sum([len(base.execute(text, (name,)).fetchall()) for name in asked])

    def of(engine: Asked | None) -> Any:
        return engine and (lambda: sum([engine.look_up(name) for name in asked]))

    if prolog is not None:
        prolog.tell(f"fill({FACTS})")
    peers = [
        Peer("SWI-Prolog, looping", prolog and prolog.work("look_up"), 5.0, ASKED),
        Peer("SWI-Prolog, findall", prolog and prolog.work("look_up_list"), None, ASKED),
        Peer("sqlite3", theirs, 0.5, ASKED),
        Peer("pyDatalog", of(engines.pydatalog(rows)), 0.02, ASKED),
        Peer("kanren", of(engines.kanren(rows)), 0.02, ASKED),
    ]
    return Work("one-answer look-up, 100,000 facts", ours, peers, ASKED)


def join(facts: Facts, rows: Rows, prolog: Prolog | None) -> Work:
    """Who is a grandparent of whom."""
    text = "select x.a, x.b, y.b from parent x, parent y where x.b = y.a"
    base = engines.sqlite(rows)
    peers = [
        Peer("SWI-Prolog, looping", prolog and prolog.work("join"), 5.0, FACTS - 1),
        Peer("SWI-Prolog, findall", prolog and prolog.work("join_list"), None, FACTS - 1),
        Peer("sqlite3", lambda: len(base.execute(text).fetchall()), 0.5, FACTS - 1),
    ]
    return Work("two-way join, 100,000 facts, per answer", lambda: len(facts.all(JOIN)), peers, FACTS - 1)


def short_join(count: int, name: str, engine: Asked | None) -> Work:
    """The same with as few facts as a slow engine can do with."""
    facts, _ = family(count)
    peers = [Peer(name, engine and engine.join, 0.02, count - 1)]
    work = f"two-way join, {count:,} facts, per answer"
    return Work(work, lambda: len(facts.all(JOIN)), peers, count - 1, most=7)


def change() -> Work:
    """One property changes while conditions wait for others."""
    queries = [lisp_list(SWITCH, number, ON) for number in range(10_000)]

    def waiting(count: int) -> Any:
        facts = new()
        facts.declare_property(SWITCH)
        woken: list[object] = []
        for query in queries[:count]:
            watch(facts.ask(query)[1], woken.append)
        states = [lisp_list(SWITCH, -1, state) for state in (ON, OFF)]

        def flip() -> int:
            for _ in range(ASKED):
                facts.add(states[0])
                facts.add(states[1])
            return len(woken)

        return flip

    peers = [Peer("with 10 waiting", waiting(10), 1.2, 2 * ASKED)]
    return Work("change of one fact, 10,000 waiting for others", waiting(10_000), peers, 2 * ASKED)
