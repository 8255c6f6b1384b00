"""Starting: from the command to the end of a one-line plan, with compiled code at hand."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from tests.benchmarks.measure import Peer, Work

ROOT = Path(__file__).resolve().parents[2]


def time_of_children() -> float:
    """The processor time that the commands started here have taken."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def works() -> Iterator[Work]:
    """The one work of this file."""
    with tempfile.TemporaryDirectory() as folder:
        plan = Path(folder) / "one.esl"
        plan.write_text('(format t "hello~%")\n', encoding="utf-8")
        environment = {**os.environ, "PYTHONPATH": str(ROOT), "ESLANG_CACHE": str(Path(folder) / "cache")}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)  # an installed eslang has its bytecode

        def run(*words: str) -> int:
            return subprocess.run(
                [sys.executable, *words], env=environment, stdout=subprocess.DEVNULL
            ).returncode

        run("-m", "eslang", "run", str(plan))  # fills the cache
        yield Work(
            "`esl run` of a one-line plan, warm",
            lambda: run("-m", "eslang", "run", str(plan)),
            [Peer("python -c pass", lambda: run("-c", "pass"), 4.0)],
            clock=time_of_children,
        )
