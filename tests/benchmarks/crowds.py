"""Crowds: what many tasks cost, from ten to a hundred thousand; and what they cost while they wait."""

from __future__ import annotations

import asyncio
import importlib.util
from collections.abc import Iterator
from typing import Any

from greenlet import getcurrent, greenlet

from eslang import Interpreter
from tests.benchmarks.measure import Peer, Run, Work
from tests.benchmarks.tasks import PROGRAM, ROUNDS, in_asyncio, in_trio, lisp

SIZES = (10, 100, 1000, 10_000, 100_000)
MOST = SIZES[-1]
LEAVES = 1000  # of the behaviour tree
IDLE = 10_000


def works() -> Iterator[Work]:
    """The rows of crowds."""
    agent = Interpreter(clock="virtual")
    agent.load(PROGRAM)
    for count in SIZES:
        yield crowd_of(agent, count)
    for count in SIZES:
        yield waves_of(agent, count)
    yield from timers_of(agent, MOST)
    yield from idle(agent)


def crowd_of(agent: Interpreter, count: int) -> Work:
    """So many tasks at once: started, blocked, woken by one signal, ended."""
    peers = [
        Peer("asyncio", in_asyncio(lambda: asyncio_waves(count, 1)), None, count),
        Peer("bare greenlets", lambda: bare_crowd(count), None, count),
    ]
    if count == MOST:
        peers.append(Peer("trio", in_trio("crowd", count), None, count))
    return Work(
        f"{count:,} tasks at once, for each", lisp(agent, "crowd", count), peers, count, most=most(count)
    )


def waves_of(agent: Interpreter, count: int) -> Work:
    """One signal wakes so many, which wait again; ten times."""
    peer = Peer("asyncio.Event", in_asyncio(lambda: asyncio_waves(count, 10)), None, 10 * count)
    return Work(
        f"one signal wakes {count:,} waiters, for each",
        lambda: agent.call("waves", count, 10),
        [peer],
        10 * count,
        most=most(count),
    )


def most(count: int) -> int:
    """How many rounds, at most, of what takes so long."""
    return max(3, min(1000, 200_000 // count))


def timers_of(agent: Interpreter, count: int) -> Iterator[Work]:
    """So many timers, and so many tasks that sleep."""
    yield Work(
        f"{count:,} timers set and fired, for each: at the kernel",
        lambda: kernel_timers(agent, count),
        [Peer("asyncio call_at", in_asyncio(lambda: asyncio_timers(count)), 1.0, count)],
        count,
        most=5,
    )
    yield Work(
        f"{count:,} tasks that sleep, for each",
        lisp(agent, "sleepers", count),
        [Peer("asyncio", in_asyncio(lambda: asyncio_sleepers(count)), None, count)],
        count,
        most=3,
    )


def idle(agent: Interpreter) -> Iterator[Work]:
    """What tasks that wait, and nothing else, cost those that run."""
    busy = Interpreter(clock="virtual")
    busy.load(PROGRAM)
    busy.call("wait-in-vain", IDLE)
    yield Work(
        f"a signal and its wait while {IDLE:,} tasks wait idle",
        lisp(busy, "signals"),
        [
            Peer("the same with none", lisp(agent, "signals"), 1.2, ROUNDS),
            Peer(f"py_trees: a tick of {LEAVES:,} leaves that run", tree_ticks(), 0.01, 10),
        ],
        ROUNDS,
    )


# --- the peers -----------------------------------------------------------------------


async def asyncio_waves(count: int, waves: int) -> int:
    """Tasks that wait for one event, WAVES times."""
    events, woken = [asyncio.Event() for _ in range(waves)], 0

    async def member() -> None:
        nonlocal woken
        for event in events:
            await event.wait()
            woken += 1

    tasks = [asyncio.create_task(member()) for _ in range(count)]
    await asyncio.sleep(0)
    for event in events:
        event.set()
        await asyncio.sleep(0)
        await asyncio.sleep(0)
    for task in tasks:
        await task
    return woken


def bare_crowd(count: int) -> int:
    """Greenlets that all wait, and then end."""
    main, woken = getcurrent(), 0

    def member() -> None:
        nonlocal woken
        main.switch()
        woken += 1

    members = [greenlet(member) for _ in range(count)]
    for _ in range(2):
        for each in members:
            each.switch()
    return woken


async def asyncio_timers(count: int) -> int:
    """Timers of the event loop, all of them short."""
    loop, fired, done = asyncio.get_running_loop(), 0, asyncio.Event()

    def fire() -> None:
        nonlocal fired
        fired += 1
        if fired == count:
            done.set()

    begin = loop.time()
    for each in range(count):
        loop.call_at(begin + each * 7919 % count / count / 10, fire)
    await done.wait()
    return fired


def kernel_timers(agent: Interpreter, count: int) -> int:
    """Timers of the scheduler."""
    scheduler, fired = agent.scheduler, 0

    def fire() -> None:
        nonlocal fired
        fired += 1

    def main() -> None:
        for each in range(count):
            scheduler.set_timer(each * 7919 % count / count, fire)
        scheduler.sleep(1.0)

    with agent.door():
        agent.runs.run(main)
    return fired


async def asyncio_sleepers(count: int) -> int:
    """Tasks that sleep, none of them long."""
    woken = 0

    async def sleeper(seconds: float) -> None:
        nonlocal woken
        await asyncio.sleep(seconds)
        woken += 1

    tasks = [asyncio.create_task(sleeper(each * 7919 % count / count / 10)) for each in range(count)]
    for task in tasks:
        await task
    return woken


def tree_ticks() -> Run | None:
    """Ticks of a behaviour tree all of whose leaves are running."""
    if importlib.util.find_spec("py_trees") is None:
        return None
    import py_trees

    leaves: list[Any] = [py_trees.behaviours.Running(name=f"leaf {each}") for each in range(LEAVES)]
    policy = py_trees.common.ParallelPolicy.SuccessOnAll(synchronise=False)
    tree = py_trees.composites.Parallel("all", policy=policy, children=leaves)

    def ticks() -> int:
        for _ in range(10):
            tree.tick_once()
        return ROUNDS

    return ticks
