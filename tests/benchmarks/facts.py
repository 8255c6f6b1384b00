"""The logical database: look-ups, joins, changes that others wait for, what follows from rules.

Beside it stands SQLite in memory, with the indexes that it needs, and what one
would write by hand. Symbols are text there. Run by itself, this module tells
what facts cost to load and to keep: python -m tests.benchmarks.facts [COUNT...]
"""

from __future__ import annotations

import gc
import sqlite3
import sys
import tracemalloc
from collections.abc import Iterator
from itertools import pairwise
from time import process_time
from typing import Any

from eslang.base.lists import lisp_list
from eslang.base.symbols import Symbol
from eslang.facts.query import Facts
from eslang.facts.watching import watch
from tests.benchmarks.measure import Peer, Work

FACTS = 100_000
ASKED = 1000
EDGES = 10_000
PARENT, EDGE, REACH, SWITCH = (Symbol(name) for name in ("parent", "edge", "reach", "switch"))
X, Y, Z = (Symbol(name) for name in ("?x", "?y", "?z"))
AND = Symbol.intern("AND", "COMMON-LISP")


def works() -> Iterator[Work]:
    """What is measured."""
    facts, rows = family(FACTS)
    base = sqlite(rows)
    yield look_up(facts, base, rows)
    yield join(facts, base)
    yield change()
    yield closure()


def new() -> Facts:
    """An empty database that knows no Lisp."""
    return Facts(lambda name: False, lambda name, arguments: False)


def family(count: int) -> tuple[Facts, list[tuple[str, str]]]:
    """A database of COUNT facts, and the same as rows of text."""
    facts = new()
    names = [Symbol(f"node-{number}") for number in range(count + 1)]
    facts.add_all(lisp_list(PARENT, *pair) for pair in pairwise(names))
    return facts, [(str(one), str(other)) for one, other in pairwise(names)]


def sqlite(rows: list[tuple[str, str]]) -> sqlite3.Connection:
    """ROWS in a table with an index."""
    base = sqlite3.connect(":memory:")
    base.execute("create table parent (a text, b text)")
    base.executemany("insert into parent values (?, ?)", rows)
    base.execute("create index by_a on parent (a)")
    return base


def look_up(facts: Facts, base: sqlite3.Connection, rows: list[tuple[str, str]]) -> Work:
    """One answer among many facts, over and over."""
    asked = [rows[number][0] for number in range(0, FACTS, FACTS // ASKED)]
    queries = [lisp_list(PARENT, Symbol(name), X) for name in asked]
    text = "select b from parent where a = ?"

    def ours() -> int:
        return sum([len(facts.all(query)) for query in queries])

    def theirs() -> int:
        return sum([len(base.execute(text, (name,)).fetchall()) for name in asked])

    return Work("one-answer look-up, 100,000 facts", ours, [Peer("sqlite3", theirs, 0.5, ASKED)], ASKED)


def join(facts: Facts, base: sqlite3.Connection) -> Work:
    """Who is a grandparent of whom."""
    query = lisp_list(AND, lisp_list(PARENT, X, Y), lisp_list(PARENT, Y, Z))
    text = "select x.a, x.b, y.b from parent x, parent y where x.b = y.a"
    peers = [Peer("sqlite3", lambda: len(base.execute(text).fetchall()), 0.5, FACTS - 1)]
    return Work("two-way join, per answer", lambda: len(facts.all(query)), peers, FACTS - 1)


def change() -> Work:
    """One property changes while conditions wait for others."""
    queries = [lisp_list(SWITCH, number, Keywords.ON) for number in range(10_000)]

    def waiting(count: int) -> Any:
        facts = new()
        facts.declare_property(SWITCH)
        woken: list[object] = []
        for query in queries[:count]:
            watch(facts.ask(query)[1], woken.append)
        states = [lisp_list(SWITCH, -1, state) for state in (Keywords.ON, Keywords.OFF)]

        def flip() -> int:
            for _ in range(ASKED):
                facts.add(states[0])
                facts.add(states[1])
            return len(woken)

        return flip

    peers = [Peer("with 10 waiting", waiting(10), 1.2, 2 * ASKED)]
    return Work("change of one fact, 10,000 waiting for others", waiting(10_000), peers, 2 * ASKED)


class Keywords:
    """What a switch may be."""

    ON, OFF = Symbol.intern("ON", "KEYWORD"), Symbol.intern("OFF", "KEYWORD")


def edges() -> list[tuple[int, int]]:
    """Ten thousand edges between five thousand nodes, in many circles."""
    nodes, seed, found = EDGES // 2, 1, {}
    while len(found) < EDGES:
        seed = (seed * 1_103_515_245 + 12_345) % (1 << 31)
        found[(seed >> 8) % nodes, (seed >> 3) % nodes] = None
    return list(found)


def closure() -> Work:
    """What can be reached from one node."""
    facts = new()
    pairs = edges()
    facts.add_all(lisp_list(EDGE, *pair) for pair in pairs)
    facts.define_rule(lisp_list(REACH, X, Y), lisp_list(lisp_list(EDGE, X, Y)))
    facts.define_rule(lisp_list(REACH, X, Y), lisp_list(lisp_list(EDGE, X, Z), lisp_list(REACH, Z, Y)))
    query = lisp_list(REACH, pairs[0][0], Y)
    onward: dict[int, list[int]] = {}
    for one, other in pairs:
        onward.setdefault(one, []).append(other)

    def by_hand() -> int:
        found: dict[int, None] = {}
        agenda = [pairs[0][0]]
        for node in agenda:
            for other in onward.get(node, ()):
                if other not in found:
                    found[other] = None
                    agenda.append(other)
        return len(found)

    peers = [Peer("a walk in Python", by_hand, None)]
    return Work("all that a node reaches, 10,000 edges", lambda: len(facts.all(query)), peers)


def main(counts: list[int]) -> None:
    """Tell what facts cost."""
    for count in counts:
        names = [Symbol(f"node-{number}") for number in range(count + 1)]
        forms = [lisp_list(PARENT, *pair) for pair in pairwise(names)]
        gc.collect()
        begin = process_time()
        facts = new()
        facts.add_all(forms)
        loaded = process_time() - begin
        facts.first(lisp_list(PARENT, names[0], X))
        indexed = process_time() - begin - loaded
        del facts
        gc.collect()
        tracemalloc.start()
        facts = new()
        for form in forms:
            facts.add(form)
        plain = tracemalloc.get_traced_memory()[0] / count
        facts.first(lisp_list(PARENT, names[0], X))
        whole = tracemalloc.get_traced_memory()[0] / count
        tracemalloc.stop()
        sys.stdout.write(
            f"{count:,} facts of two symbols: {loaded / count * 1e6:.2f} µs and {plain:.0f} bytes each; "
            f"an index: {indexed / count * 1e6:.2f} µs and {whole - plain:.0f} bytes each\n"
        )


if __name__ == "__main__":
    main([int(word) for word in sys.argv[1:]] or [100_000, 1_000_000])
