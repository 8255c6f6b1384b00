"""What facts and waiting conditions take: the time to make them, and memory.

Each count is taken in a process of its own, from the memory that is resident:
`python -m tests.benchmarks.storing CONTENDER COUNT` prints the seconds of
processor time and the bytes for each, when it is made and when it is indexed.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from statistics import median
from time import process_time
from typing import Any

from eslang import Interpreter
from eslang.base.lists import lisp_list
from eslang.base.symbols import Keyword, Symbol
from eslang.facts.query import Facts
from eslang.facts.watching import watch
from tests.benchmarks.measure import Row, row_of_bytes
from tests.benchmarks.memory import resident

COUNTS = (100_000, 1_000_000)
ROOT = Path(__file__).resolve().parents[2]
PARENT, SWITCH = Symbol("parent"), Symbol("switch")
X = Symbol("?x")
Taken = tuple[float, float, float, float]  # seconds and bytes to make it, and the same to index it


def works() -> Iterator[Row]:
    """The rows of what facts take."""
    for count in COUNTS:
        facts, table, plain = (measured(name, count) for name in ("facts", "sqlite", "dict"))
        made, whole = f"{count:,} facts, for each", f"{count:,} facts and an index, for each"
        for name, other in (("sqlite3", table), ("a dict of tuples", plain)):
            yield Row(f"load {made}", name, facts[0], other[0], facts[0] / other[0], None)
            yield row_of_bytes(f"resident, {made}", name, facts[1], other[1], None)
        both = facts[1] + facts[3], table[1] + table[3]
        yield row_of_bytes(f"resident, {whole}", "sqlite3", *both, None)
    few, many = (measured("conditions", count) for count in (1000, 10_000))
    work = "10,000 conditions, for each"
    yield Row(f"ask and wait, {work}", "with 1,000", many[0], few[0], many[0] / few[0], 1.2)
    yield row_of_bytes(f"resident, {work}", "with 1,000", many[1], few[1], None)
    facts, events = measured("waiters", 10_000), measured("tasks", 10_000)
    work = "10,000 tasks that wait for facts, for each"
    other = "tasks that wait for an event"
    yield Row(f"start, ask and wait, {work}", other, facts[0], events[0], facts[0] / events[0], None)
    yield row_of_bytes(f"resident, {work}", other, facts[1], events[1], None)


def measured(name: str, count: int) -> Taken:
    """What COUNT of a contender's things take, in a process that does nothing else."""
    command = [sys.executable, "-m", "tests.benchmarks.storing", name, str(count)]
    runs = [subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True) for _ in range(3)]
    found = [tuple(map(float, run.stdout.split())) for run in runs]
    seconds, size, indexed, more = (median(column) for column in zip(*found, strict=True))
    return seconds, size, indexed, more


def taken(count: int, make: Callable[[], object], index: Callable[[], object]) -> Taken:
    """What MAKE, and then INDEX, take for each of COUNT things."""
    found = []
    for work in (make, index):
        before, begin = resident(), process_time()
        work()
        found += [(process_time() - begin) / count, (resident() - before) / count]
    return found[0], found[1], found[2], found[3]


def of_facts(count: int) -> Taken:
    """Facts of two symbols each."""
    names = [Symbol(f"node-{number}") for number in range(count + 1)]
    facts = Facts(lambda name: False, lambda name, arguments: False)
    load = lambda: facts.add_all(lisp_list(PARENT, *pair) for pair in pairwise(names))  # noqa: E731
    return taken(count, load, lambda: facts.first(lisp_list(PARENT, names[0], X)))


def of_sqlite(count: int) -> Taken:
    """Rows of two texts each."""
    import sqlite3

    names = [f"node-{number}" for number in range(count + 1)]
    base = sqlite3.connect(":memory:")
    base.execute("create table parent (a text, b text)")
    load = lambda: base.executemany("insert into parent values (?, ?)", pairwise(names))  # noqa: E731
    return taken(count, load, lambda: base.execute("create index by_a on parent (a)"))


def of_dict(count: int) -> Taken:
    """What one would write by hand: the tuples in order, and each but once."""
    names = [Symbol(f"node-{number}") for number in range(count + 1)]
    held: dict[Any, None] = {}
    return taken(count, lambda: held.update(dict.fromkeys(pairwise(names))), lambda: None)


def of_conditions(count: int) -> Taken:
    """Conditions that wait, each for a fact of its own."""
    facts = Facts(lambda name: False, lambda name, arguments: False)
    facts.declare_property(SWITCH)
    queries = [lisp_list(SWITCH, number, Keyword("on")) for number in range(count)]
    kept: list[Any] = [facts.ask(lisp_list(SWITCH, 0, Keyword("off")))]  # and now there is a plan

    def wait() -> None:
        for query in queries:
            kept.append(watch(facts.ask(query)[1], kept.append))

    return taken(count, wait, lambda: None)


def of_waiters(count: int) -> Taken:
    """Tasks in ESL that wait, each for a fact of its own."""
    return of_program("facts.esl", count)


def of_tasks(count: int) -> Taken:
    """Tasks in ESL that wait for an event."""
    return of_program("tasks.esl", count)


def of_program(name: str, count: int) -> Taken:
    """Tasks that wait in vain, after some others of the kind."""
    with Interpreter(clock="virtual") as agent:
        agent.load(Path(__file__).with_name("programs") / name)
        agent.call("wait-in-vain", 100)
        return taken(count, lambda: agent.call("wait-in-vain", count), lambda: None)


if __name__ == "__main__":
    contenders = {
        "facts": of_facts,
        "sqlite": of_sqlite,
        "dict": of_dict,
        "conditions": of_conditions,
        "waiters": of_waiters,
        "tasks": of_tasks,
    }
    sys.stdout.write(" ".join(map(str, contenders[sys.argv[1]](int(sys.argv[2])))) + "\n")
