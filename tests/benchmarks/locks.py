"""Property locks: what they cost, alone and in a crowd; beside what one would write by hand."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from pathlib import Path

from eslang import Interpreter
from tests.benchmarks.measure import Peer, Work
from tests.benchmarks.tasks import in_asyncio

PROGRAM = Path(__file__).with_name("programs") / "locks.esl"
TASKS, LOCKS, HELD, ROUNDS = 1000, 200, 1000, 500


def works() -> Iterator[Work]:
    """The rows of locks."""
    agent = Interpreter(clock="virtual")
    agent.load(PROGRAM)
    peer = Peer("asyncio.Event, by hand", in_asyncio(by_hand), None, TASKS)
    yield Work(
        f"{TASKS:,} tasks on {LOCKS} property locks, for each",
        lambda: agent.call("crowd", TASKS, LOCKS),
        [peer],
        TASKS,
    )
    busy = Interpreter(clock="virtual")
    busy.load(PROGRAM)
    busy.eval(f"(spawn (hold-all {HELD} (lambda () (wait-for-events (make-event)))))")
    yield Work(
        f"a property lock is taken and left while {HELD:,} are held",
        lambda: busy.call("takes", "spare", ROUNDS),
        [
            Peer("the same with none", lambda: agent.call("takes", "spare", ROUNDS), 1.2, ROUNDS),
            Peer("a query of the property", lambda: agent.call("asks", "spare", ROUNDS), None, ROUNDS),
        ],
        ROUNDS,
    )


async def by_hand() -> None:
    """The same crowd: the first achieves, the others wait; nobody watches over what was achieved."""
    achieved: dict[int, asyncio.Event] = {}
    holders: dict[int, int] = {}

    async def use(device: int) -> None:
        first = device not in achieved
        event = achieved.setdefault(device, asyncio.Event())
        holders[device] = holders.get(device, 0) + 1
        try:
            if first:
                await asyncio.sleep(0)
                event.set()
            else:
                await event.wait()
            await asyncio.sleep(0)
        finally:
            holders[device] -= 1
            if not holders[device]:
                del achieved[device]

    await asyncio.gather(*(asyncio.create_task(use(i % LOCKS)) for i in range(TASKS)))
