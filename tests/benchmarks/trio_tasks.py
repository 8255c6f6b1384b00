"""What the benchmarks of tasks let trio do; imported only where it is installed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import trio


def runner(name: str, count: int) -> Callable[[], int]:
    """A run of the function called NAME."""
    main: Any = globals()[name]
    return lambda: int(trio.run(main, count))


async def send(rounds: int) -> int:
    """One task sends the other something, which takes it, and waits again."""
    to_waiter, at_waiter = trio.open_memory_channel[None](0)

    async def waiter() -> None:
        for _ in range(rounds):
            await at_waiter.receive()

    async with trio.open_nursery() as nursery:
        nursery.start_soon(waiter)
        for _ in range(rounds):
            await to_waiter.send(None)
    return rounds


async def ping_pong(rounds: int) -> int:
    """Two tasks that send one another something."""
    to_left, at_left = trio.open_memory_channel[None](0)
    to_right, at_right = trio.open_memory_channel[None](0)

    async def left() -> None:
        for _ in range(rounds):
            await at_left.receive()
            await to_right.send(None)

    async with trio.open_nursery() as nursery:
        nursery.start_soon(left)
        for _ in range(rounds):
            await to_left.send(None)
            await at_right.receive()
    return rounds


async def lives(rounds: int) -> int:
    """Tasks that do nothing, one after the other."""

    async def nothing() -> None:
        pass

    for _ in range(rounds):
        async with trio.open_nursery() as nursery:
            nursery.start_soon(nothing)
    return rounds


async def crowd(count: int) -> int:
    """Tasks that wait for one event."""
    go, woken = trio.Event(), 0

    async def member() -> None:
        nonlocal woken
        await go.wait()
        woken += 1

    async with trio.open_nursery() as nursery:
        for _ in range(count):
            nursery.start_soon(member)
        await trio.lowlevel.checkpoint()
        go.set()
    return woken
