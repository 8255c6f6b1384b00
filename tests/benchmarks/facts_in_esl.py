"""The questions of facts.py, asked in ESL: loops in Lisp, queries that are made there, alists.

The figures of facts.py are of the database as such; these are what a plan sees.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from eslang import Interpreter
from eslang.base.lists import from_items, lisp_list
from eslang.base.symbols import Symbol
from tests.benchmarks import engines
from tests.benchmarks.engines import Prolog
from tests.benchmarks.measure import Peer, Work

PROGRAM = Path(__file__).with_name("programs") / "facts.esl"
FACTS, ASKED = 100_000, 1000
PARENT = Symbol("parent")


def works(prolog: Prolog | None) -> Iterator[Work]:
    """What is measured."""
    rows = engines.family_rows(FACTS)
    with Interpreter(clock="virtual", listeners=[]) as agent:
        agent.load(PROGRAM)
        agent.database.add_all(lisp_list(PARENT, Symbol(one), Symbol(other)) for one, other in rows)
        yield from look_up(agent, rows, prolog)
        yield from join(agent, rows, prolog)
        yield changes(agent)
    yield waiting()


def look_up(agent: Interpreter, rows: engines.Rows, prolog: Prolog | None) -> Iterator[Work]:
    """One answer among many facts."""
    asked = [rows[number][0] for number in range(0, FACTS, FACTS // ASKED)]
    names = from_items([Symbol(name) for name in asked])
    base = engines.sqlite(rows)
    text = "select b from parent where a = ?"
    for name, work in (("db-query", "look-up-all"), ("with-query-bindings", "bind-all")):
        peers = [
            Peer("SWI-Prolog, looping", prolog and prolog.work("look_up"), 5.0, ASKED),
            Peer("SWI-Prolog, findall", prolog and prolog.work("look_up_list"), None, ASKED),
            Peer(
                "sqlite3",
                lambda: sum([len(base.execute(text, (name,)).fetchall()) for name in asked]),
                0.5,
                ASKED,
            ),
        ]
        yield Work(f"one-answer look-up in ESL, {name}", called(agent, work, names), peers, ASKED)


def join(agent: Interpreter, rows: engines.Rows, prolog: Prolog | None) -> Iterator[Work]:
    """Who is a grandparent of whom."""
    base = engines.sqlite(rows)
    text = "select x.a, x.b, y.b from parent x, parent y where x.b = y.a"
    for name, work in (("db-query", "join-all"), ("next-bindings", "go-through-all")):
        peers = [
            Peer("SWI-Prolog, looping", prolog and prolog.work("join"), 5.0, FACTS - 1),
            Peer("SWI-Prolog, findall", prolog and prolog.work("join_list"), None, FACTS - 1),
            Peer("sqlite3", lambda: len(base.execute(text).fetchall()), 0.5, FACTS - 1),
        ]
        yield Work(f"two-way join in ESL, {name}, per answer", called(agent, work), peers, FACTS - 1)


def changes(agent: Interpreter) -> Work:
    """Facts that come, and go again all at once."""
    base = engines.sqlite([])

    def theirs() -> int:
        for number in range(ASKED):
            base.execute("insert into parent values (?, ?)", (number, number))
        return base.execute("delete from parent").rowcount

    ours = called(agent, "assert-and-retract", ASKED)
    return Work("assert a fact, and retract it, in ESL", ours, [Peer("sqlite3", theirs, None, ASKED)], ASKED)


def waiting() -> Work:
    """One property changes while tasks wait for others."""

    def beside(count: int) -> Any:
        agent = Interpreter(clock="virtual")
        agent.load(PROGRAM)
        agent.call("wait-in-vain", count)
        return called(agent, "flip", ASKED)

    peers = [Peer("with 10 waiting", beside(10), 1.2, 2 * ASKED)]
    return Work("change of one fact in ESL, 10,000 tasks wait for others", beside(10_000), peers, 2 * ASKED)


def called(agent: Interpreter, name: str, *arguments: Any) -> Any:
    """What calls a function of the program."""
    return lambda: agent.call(name, *arguments)
