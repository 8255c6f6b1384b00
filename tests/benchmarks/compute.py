"""Compute: the same algorithms in ESL, in hand-written Python, and in Hy."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

from eslang import Interpreter
from tests.benchmarks.measure import Peer, Work

PROGRAMS = Path(__file__).with_name("programs")
TEXT = "The quick brown fox jumps over the lazy dog, and nobody minds. " * 8
CALLS: list[tuple[str, str, tuple[Any, ...]]] = [
    ("fib 25", "fib", (25,)),
    ("tak 14 8 3", "tak", (14, 8, 3)),
    ("6 queens", "queens", (6, [], 6)),
    ("string work", "string-work", (TEXT, 10)),
    ("list work", "list-work", (1000, 10)),
]
ON_PAIRS = ("queens", "list-work")  # hand-written once more with the data structure that Lisp uses
DEEP = 100_000


def works() -> Iterator[Work]:
    """The compute rows, and deep recursion."""
    agent = Interpreter()
    agent.load(PROGRAMS / "compute.esl")
    python, hy = python_programs(), hy_programs()
    for name, function, arguments in CALLS:
        peers = [
            Peer("hand-written Python", theirs(python, function, arguments), 1.5),
            Peer("Hy", theirs(hy, function, arguments) if hy else None, 1.3),
        ]
        if function in ON_PAIRS:
            on_pairs = [None if argument == [] else argument for argument in arguments]
            run = theirs(python, f"{function}_on_pairs", on_pairs)
            peers.append(Peer("hand-written Python, linked lists", run, None))
        yield Work(name, ours(agent, function, arguments), peers)
    yield Work(
        f"recursion {DEEP:,} deep",
        ours(agent, "deep", (DEEP,)),
        [Peer("hand-written Python", theirs(python, "deep", (DEEP,)), None)],
    )


def ours(agent: Interpreter, function: str, arguments: tuple[Any, ...]) -> Any:
    """A call of the Lisp FUNCTION."""
    return lambda: agent.call(function, *arguments)


def theirs(module: Any, function: str, arguments: Sequence[Any]) -> Any:
    """A call of the same in a Python module."""
    made = getattr(module, function.replace("-", "_"))
    return lambda: made(*arguments)


def python_programs() -> ModuleType:
    """The programs in Python."""
    spec = importlib.util.spec_from_file_location("compute_in_python", PROGRAMS / "compute.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def hy_programs() -> ModuleType | None:
    """The programs in Hy, where it is installed."""
    try:
        import hy
    except ImportError:
        return None
    module = ModuleType("compute_in_hy")
    text = (PROGRAMS / "compute.hy").read_text(encoding="utf-8")
    hy.eval(hy.read_many(text), module.__dict__, module=module)
    return module
