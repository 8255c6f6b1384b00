"""Memory: what a hundred thousand blocked tasks take, each contender in a process of its own.

`python -m tests.benchmarks.memory CONTENDER COUNT` prints the bytes for each.
"""

from __future__ import annotations

import asyncio
import gc
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from statistics import median

from tests.benchmarks.measure import Row, row_of_bytes

COUNT = 100_000
ROOT = Path(__file__).resolve().parents[2]


def works() -> Iterator[Row]:
    """The rows of memory."""
    work = f"a blocked task, resident, of {COUNT:,}"
    ours = measured("eslang")
    yield row_of_bytes(work, "a bare greenlet", ours, measured("greenlet"), 1.3)
    yield row_of_bytes(work, "an asyncio task", ours, measured("asyncio"), None)


def measured(name: str) -> float:
    """The bytes that one task of a contender takes, in a process that does nothing else."""
    command = [sys.executable, "-m", "tests.benchmarks.memory", name, str(COUNT)]
    runs = [subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True) for _ in range(3)]
    return median([float(run.stdout) for run in runs])


def resident() -> int:
    """The bytes of this process that are in memory."""
    gc.collect()
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    return next(int(line.split()[1]) * 1024 for line in lines if line.startswith("VmRSS"))


def of_eslang(count: int) -> float:
    """Tasks that wait for an event."""
    from eslang import Interpreter
    from tests.benchmarks.tasks import PROGRAM

    with Interpreter(clock="virtual") as agent:
        agent.load(PROGRAM)
        agent.call("wait-in-vain", 100)
        before = resident()
        agent.call("wait-in-vain", count)
        return (resident() - before) / count


def of_greenlet(count: int) -> float:
    """Greenlets that have switched away."""
    from greenlet import getcurrent, greenlet

    main = getcurrent()
    before = resident()
    members = [greenlet(lambda: main.switch()) for _ in range(count)]
    for each in members:
        each.switch()
    return (resident() - before) / count


def of_asyncio(count: int) -> float:
    """Tasks that wait for an event."""

    async def main() -> float:
        never = asyncio.Event()
        before = resident()
        tasks = [asyncio.create_task(never.wait()) for _ in range(count)]
        await asyncio.sleep(0)
        taken = (resident() - before) / count
        for task in tasks:
            task.cancel()
        return taken

    return asyncio.run(main())


if __name__ == "__main__":
    contenders = {"eslang": of_eslang, "greenlet": of_greenlet, "asyncio": of_asyncio}
    sys.stdout.write(f"{contenders[sys.argv[1]](int(sys.argv[2]))}\n")
