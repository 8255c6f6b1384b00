"""What follows from what follows: all that can be reached in a graph, and how that grows.

SWI-Prolog's rules are tabled and left-recursive, which is what it does best.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from eslang.base.lists import lisp_list
from eslang.base.symbols import Symbol
from eslang.facts.query import Facts
from tests.benchmarks.engines import Prolog
from tests.benchmarks.measure import Peer, Work

EDGE, REACH, FOUND, PATH = (Symbol(name) for name in ("edge", "reach", "found", "path"))
X, Y, Z = (Symbol(name) for name in ("?x", "?y", "?z"))
COUNTS = (1000, 10_000, 100_000)
Pairs = list[tuple[int, int]]


def works(prolog: Prolog | None) -> Iterator[Work]:
    """What is measured."""
    for count in COUNTS:
        for name, pairs in (
            ("random", random_edges(count, count // 2)),
            ("chain", chain(count)),
            ("grid", grid(count)),
        ):
            yield from_one(f"{count:,} edges ({name})", pairs, count, prolog)
    for count in COUNTS:
        yield from_all(count, prolog)
    yield doubly(300, prolog)
    yield doubly(10_000, prolog)


def random_edges(count: int, nodes: int) -> Pairs:
    """COUNT edges between NODES, drawn by a congruence."""
    seed, found = 1, {}
    while len(found) < count:
        seed = (seed * 6_364_136_223_846_793_005 + 1_442_695_040_888_963_407) % (1 << 64)
        found[(seed >> 33) % nodes, (seed >> 13) % nodes] = None
    return list(found)


def chain(count: int) -> Pairs:
    """One edge behind the other."""
    return [(number, number + 1) for number in range(count)]


def grid(count: int) -> Pairs:
    """Some COUNT edges to the right and down, in a square."""
    side = int((count / 2) ** 0.5) + 1
    right = [(number, number + 1) for number in range(side * side) if (number + 1) % side]
    return right + [(number, number + side) for number in range(side * (side - 1))]


def graph(pairs: Pairs) -> Facts:
    """A database of these edges, with three ways to say what follows."""
    facts = Facts(lambda name: False, lambda name, arguments: False)
    facts.add_all(lisp_list(EDGE, *pair) for pair in pairs)
    for name in (REACH, FOUND, PATH):
        facts.define_rule(lisp_list(name, X, Y), lisp_list(lisp_list(EDGE, X, Y)))
    rest = {
        REACH: ((EDGE, X, Z), (REACH, Z, Y)),
        FOUND: ((FOUND, X, Z), (EDGE, Z, Y)),
        PATH: ((PATH, X, Z), (PATH, Z, Y)),
    }
    for name, goals in rest.items():
        facts.define_rule(lisp_list(name, X, Y), lisp_list(*(lisp_list(*goal) for goal in goals)))
    return facts


def walk(pairs: Pairs) -> Any:
    """What finds by hand how many nodes can be reached from a node."""
    onward: dict[int, list[int]] = {}
    for one, other in pairs:
        onward.setdefault(one, []).append(other)

    def by_hand(start: int) -> int:
        found: dict[int, None] = {}
        agenda = [start]
        for node in agenda:
            for other in onward.get(node, ()):
                if other not in found:
                    found[other] = None
                    agenda.append(other)
        return len(found)

    return by_hand


def from_one(name: str, pairs: Pairs, count: int, prolog: Prolog | None) -> Work:
    """What can be reached from one node."""
    facts, by_hand, start = graph(pairs), walk(pairs), pairs[0][0]
    query = lisp_list(REACH, start, Y)
    peers = [
        Peer("a walk in Python", lambda: by_hand(start), None),
        Peer("SWI-Prolog, tabled", prolog and Loaded(prolog, pairs, f"reach({start})"), None),
    ]
    most = 200_000 // count
    return Work(f"all that a node reaches, {name}", lambda: len(facts.all(query)), peers, most=most)


def from_all(count: int, prolog: Prolog | None) -> Work:
    """What can be reached from any node, in a graph of many small parts."""
    pairs = random_edges(count, count * 2)
    facts, by_hand = graph(pairs), walk(pairs)
    starts = dict(pairs)
    query = lisp_list(REACH, X, Y)
    peers = [
        Peer("walks in Python", lambda: sum([by_hand(start) for start in starts]), None),
        Peer("SWI-Prolog, tabled", prolog and Loaded(prolog, pairs, "reach"), None),
    ]
    work = f"who reaches whom, {count:,} edges among {count * 2:,} nodes"
    return Work(work, lambda: len(facts.all(query)), peers, most=100_000 // count)


def doubly(count: int, prolog: Prolog | None) -> Work:
    """The same with rules that need themselves twice."""
    pairs = random_edges(count, count // 2)
    facts, start = graph(pairs), pairs[0][0]
    double, single = lisp_list(PATH, start, Y), lisp_list(FOUND, start, Y)
    peers = [Peer("by a rule that needs itself once", lambda: len(facts.all(single)), None)]
    if count < 1000:  # it would take hours
        run = prolog and Loaded(prolog, pairs, f"path({start})")
        peers.append(Peer("SWI-Prolog, tabled", run, None))
    work = f"all that a node reaches, by a path to a path, {count:,} edges"
    return Work(work, lambda: len(facts.all(double)), peers, most=3)


class Loaded:
    """A work of SWI-Prolog on these edges."""

    def __init__(self, prolog: Prolog, pairs: Pairs, name: str) -> None:
        self.prolog = prolog
        self.pairs = pairs
        self.work = prolog.work(name)

    def __call__(self) -> int:
        self.prolog.edges(self.pairs)
        return self.work()

    def sample(self, count: int) -> float:
        """The seconds that doing it once takes, COUNT times over."""
        return self.work.sample(count)
