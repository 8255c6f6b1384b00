"""SCS: what asking the conditions after each action costs, beside behaviour trees that ask them all.

What is timed lies inside the circuits: a plan enters them, says that it
begins, does its actions, and says that it has ended. Where the entrance or
the choices themselves are the work, all is timed.
"""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator
from pathlib import Path
from time import process_time

from eslang import Interpreter
from tests.benchmarks.measure import Peer, Run, Work
from tests.benchmarks.trees import Trees, trees

PROGRAM = Path(__file__).with_name("programs") / "circuits.esl"
ROUNDS = 200
TICKS = 10  # of a large tree
NODES = 1000
ELSEWHERE = -1  # a gate that no condition reads


class Plans:
    """An interpreter that knows the plans, and the time that the actions of one took."""

    def __init__(self, gates: int) -> None:
        self.begin = self.end = 0.0
        self.agent = Interpreter(clock="virtual")
        for name, note in (("begin-timing", self.note_begin), ("end-timing", self.note_end)):
            self.agent.primitive(name=name, outside=False)(note)
        self.agent.load(PROGRAM)
        self.agent.call("open-gates", 0, gates + 1)

    def note_begin(self) -> None:
        """It is about to begin."""
        self.begin = process_time()

    def note_end(self) -> None:
        """It has ended."""
        self.end = process_time()

    def timed(self, name: str, *arguments: int) -> Timed:
        """What does ROUNDS actions in a plan."""
        return Timed(self, name, *arguments)

    def whole(self, name: str) -> Run:
        """ROUNDS rounds of a plan, all of which is timed."""
        return lambda: self.agent.call(name, ROUNDS)


class Timed:
    """A plan in which the actions are timed, and not what is around them."""

    def __init__(self, plans: Plans, name: str, *arguments: int) -> None:
        self.plans = plans
        self.words = (name, *arguments)

    def __call__(self) -> object:
        return self.plans.agent.call(*self.words, ROUNDS)

    def sample(self, count: int) -> float:
        """The seconds that ROUNDS actions take, where COUNT times as many are done."""
        gc.collect()
        gc.disable()
        try:
            self.plans.agent.call(*self.words, ROUNDS * count)
        finally:
            gc.enable()
        return (self.plans.end - self.plans.begin) / count


class Difference:
    """What a plan takes longer than another."""

    def __init__(self, longer: Timed, shorter: Timed) -> None:
        self.longer, self.shorter = longer, shorter

    def __call__(self) -> object:
        return self.longer()

    def sample(self, count: int) -> float:
        """The seconds."""
        return self.longer.sample(count) - self.shorter.sample(count)


def works() -> Iterator[Work]:
    """The rows of circuits."""
    open_gates, shut_gates, peers = Plans(10_000), Plans(0), trees()
    for depth in (1, 10, 100):
        yield from at_depth(open_gates, depth, peers)
    yield from unchanged(open_gates, shut_gates, peers)
    yield from changed(open_gates, shut_gates, peers)
    yield from ticks(shut_gates, peers)
    yield from others(shut_gates, peers)


def tree_ticks(peers: Trees | None, make: Callable[[Trees], object], count: int) -> Run | None:
    """COUNT ticks of a tree, if there are trees."""
    return None if peers is None else peers.ticks(make(peers), count)


def at_depth(plans: Plans, depth: int, peers: Trees | None) -> Iterator[Work]:
    """One action under conditions that are nested."""
    conditions = "1 condition" if depth == 1 else f"{depth} conditions"
    tree = tree_ticks(peers, lambda made: made.nested(depth), ROUNDS)
    for kind, spelling in (("facts", "facts"), ("lisp", "Lisp")):
        yield Work(
            f"an action under {conditions} over {spelling}",
            plans.timed(f"{kind}-around", depth),
            [
                Peer("an action under none", plans.timed("acts"), None, ROUNDS),
                Peer("py_trees: a tick of the same tree", tree, None, ROUNDS),
            ],
            ROUNDS,
        )


def unchanged(open_gates: Plans, shut_gates: Plans, peers: Trees | None) -> Iterator[Work]:
    """One action among many conditions over facts, none of which changes."""
    ways = (
        ("nested", open_gates, "facts-around"),
        ("of `do-first`", shut_gates, "first-of"),
        ("of `do-best`", shut_gates, "best-of"),
    )
    for way, plans, name in ways:
        for count in (1000, 10_000):
            found = [Peer("with 10", plans.timed(name, 10), 1.2, ROUNDS)]
            if name == "first-of" and count == NODES:
                tree = tree_ticks(peers, lambda made: made.first(list(range(1, NODES)), made.act()), ROUNDS)
                found.append(Peer("py_trees: a tick of the same tree", tree, None, ROUNDS))
            yield Work(
                f"an action with {count:,} conditions {way} that do not change",
                plans.timed(name, count),
                found,
                ROUNDS,
                most=3,
            )


def changed(open_gates: Plans, shut_gates: Plans, peers: Trees | None) -> Iterator[Work]:
    """A condition that is asked again, since what it reads has changed; it holds still."""
    again = Difference(
        open_gates.timed("changes-around", 1, 1), open_gates.timed("changes-around", 1, ELSEWHERE)
    )
    nodes = (
        NODES * 2 + 1
    )  # for each clause a sequence and its condition, the action, less what is the selector
    tree = tree_ticks(peers, lambda made: made.first(list(range(1, NODES)), made.act()), ROUNDS)
    yield Work(
        "re-check of a changed condition at the end of an action",
        again,
        [Peer("py_trees: a tick, for each node", tree, 0.1, ROUNDS * nodes)],
        ROUNDS,
    )
    yield Work(
        f"an action that changes 1 of {NODES:,} conditions of `do-first`, for each condition",
        shut_gates.timed("changing-first-of", NODES),
        [Peer("py_trees: a tick, for each node", tree, 0.1, ROUNDS * nodes)],
        ROUNDS * NODES,
    )


def ticks(plans: Plans, peers: Trees | None) -> Iterator[Work]:
    """A turn of a circuit, and a tick of an equal tree."""

    def twice(made: Trees) -> object:
        return made.first(list(range(11, 20)), made.first(list(range(1, 10)), made.act()))

    unmoved = Peer("py_trees", tree_ticks(peers, twice, ROUNDS), None, ROUNDS)
    name = "a tick of a tree of 20 conditions, 2 deep"
    yield Work(f"{name}: facts, none changes", plans.timed("tree"), [unmoved], ROUNDS)
    yield Work(f"{name}: over Lisp", plans.timed("lisp-tree"), [unmoved], ROUNDS)
    turning = Peer("py_trees", tree_ticks(peers, Trees.turning, ROUNDS), None, ROUNDS)
    yield Work(
        "a tick of a tree of 10 conditions: another alternative each time",
        plans.timed("turns"),
        [turning],
        ROUNDS,
    )


def others(plans: Plans, peers: Trees | None) -> Iterator[Work]:
    """Branches that take turns, cycles on the virtual clock, entrances."""
    side_by_side = tree_ticks(peers, lambda made: made.side_by_side(10), ROUNDS)
    yield Work(
        "an action in one of 10 branches of `do-all`, and the next one's turn",
        plans.timed("branches"),
        [
            Peer("10 tasks that yield, in ESL", plans.whole("yielding"), None, 10 * ROUNDS),
            Peer("py_trees Parallel, a tick, for each of 10", side_by_side, None, 10 * ROUNDS),
        ],
        10 * ROUNDS,
    )
    yield Work(
        "a cycle of `with-cycle`, virtual clock",
        plans.whole("cycles"),
        [Peer("a loop with SLEEP, in ESL", plans.whole("sleeps"), None, ROUNDS)],
        ROUNDS,
    )
    for name, what in (
        ("sequences", "`scs:do`"),
        ("conditional-sequences", "`scs:do :while`, over facts"),
        ("choices", "`do-first`, 3 clauses over facts"),
    ):
        yield Work(
            f"enter {what}, do an action, leave",
            plans.whole(name),
            [Peer("the action alone", plans.timed("acts"), None, ROUNDS)],
            ROUNDS,
        )
