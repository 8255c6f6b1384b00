"""The engines that the database is measured beside, with the same facts; who is not here is None.

SQLite runs in memory, with the index that is needed, and hands its rows to
Python. SWI-Prolog runs as a process of its own, with the loop in Prolog, and
tells itself how much of the processor's time that took. pyDatalog and kanren
are asked as their documentation asks them.
"""

from __future__ import annotations

import shutil
import sqlite3
import subprocess
from collections.abc import Callable, Iterable
from importlib.util import find_spec
from itertools import pairwise
from pathlib import Path
from typing import Any

Rows = list[tuple[str, str]]
PROGRAM = Path(__file__).with_name("programs") / "facts.pl"


def family_rows(count: int) -> Rows:
    """A chain of COUNT pairs of names."""
    return list(pairwise(f"node-{number}" for number in range(count + 1)))


def sqlite(rows: Iterable[tuple[Any, Any]], kind: str = "text") -> sqlite3.Connection:
    """ROWS in a table with an index."""
    base = sqlite3.connect(":memory:")
    base.execute(f"create table parent (a {kind}, b {kind})")
    base.executemany("insert into parent values (?, ?)", rows)
    base.execute("create index by_a on parent (a)")
    return base


class Prolog:
    """A SWI-Prolog that answers goals; it ends with this process."""

    def __init__(self) -> None:
        command = ["swipl", "-q", "-f", str(PROGRAM), "-g", "serve"]
        self.running = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def tell(self, goal: str) -> None:
        """Let it do GOAL, which answers nothing."""
        assert self.running.stdin is not None
        self.running.stdin.write(goal + ".\n")
        self.running.stdin.flush()

    def ask(self, goal: str) -> str:
        """What it writes for GOAL."""
        assert self.running.stdout is not None
        self.tell(goal)
        return self.running.stdout.readline()

    def edges(self, pairs: Iterable[tuple[int, int]]) -> None:
        """Let there be these edges, and no others."""
        self.tell("edges")
        self.tell("[" + ", ".join(f"{one}-{other}" for one, other in pairs) + "]")

    def work(self, name: str) -> PrologWork:
        """One of the works of the program."""
        return PrologWork(self, name)


class PrologWork:
    """One piece of work that SWI-Prolog does, and takes the time of."""

    def __init__(self, prolog: Prolog, name: str) -> None:
        self.prolog = prolog
        self.name = name

    def __call__(self) -> int:
        return int(self.prolog.ask(f"answer({self.name})"))

    def sample(self, count: int) -> float:
        """The seconds that doing it once takes, COUNT times over."""
        return float(self.prolog.ask(f"sample({self.name}, {count})")) / count


def prolog() -> Prolog | None:
    """A SWI-Prolog, if there is one here."""
    return Prolog() if shutil.which("swipl") else None


class Asked:
    """What another engine of Python answers: how many there are for each name, and for the whole join."""

    def __init__(self, look_up: Callable[[str], int], join: Callable[[], int]) -> None:
        self.look_up = look_up
        self.join = join


def pydatalog(rows: Rows) -> Asked | None:
    """pyDatalog with ROWS, and no others, if it is here."""
    if find_spec("pyDatalog") is None:
        return None
    from pyDatalog import pyDatalog, pyParser

    pyDatalog.clear()
    for row in rows:
        pyDatalog.assert_fact("parent", *row)
    parent = pyParser.Term("parent")
    x, y, z = (pyDatalog.Variable() for _ in range(3))
    return Asked(
        lambda name: len(parent(name, x).data),
        lambda: len((parent(x, y) & parent(y, z)).data),
    )


def kanren(rows: Rows) -> Asked | None:
    """kanren with ROWS, if it is here."""
    if find_spec("kanren") is None:
        return None
    from kanren import Relation, facts, run, var

    parent = Relation()
    facts(parent, *rows)
    x, y, z = var(), var(), var()
    return Asked(
        lambda name: len(run(0, x, parent(name, x))),
        lambda: len(run(0, (x, y, z), parent(x, y), parent(y, z))),
    )
