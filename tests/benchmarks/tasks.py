"""Tasks: a signal and a switch, an interrupt, a start and an end.

Beside ESL stand bare greenlets, which switch and know nothing else, asyncio,
trio and threads. "At the kernel" is the same that ESL does, in Python on the
scheduler's own interface: what is left when the Lisp around it is taken away.
"""

from __future__ import annotations

import asyncio
import importlib.util
import threading
from collections.abc import Callable, Coroutine, Iterator
from pathlib import Path
from typing import Any

from greenlet import getcurrent, greenlet

from eslang import Interpreter
from eslang.runtime.events import Event
from tests.benchmarks.measure import Peer, Run, Work

PROGRAM = Path(__file__).with_name("programs") / "tasks.esl"
ROUNDS = 2000


def works() -> Iterator[Work]:
    """The rows of single tasks."""
    agent = Interpreter(clock="virtual")
    agent.load(PROGRAM)
    yield from switches(agent)
    yield from interrupts(agent)
    yield Work(
        "start and end a task",
        lisp(agent, "lives"),
        [
            Peer("asyncio", in_asyncio(asyncio_lives), 1.3, ROUNDS),
            Peer("trio", in_trio("lives"), None, ROUNDS),
            Peer("threading", thread_lives, None, ROUNDS),
        ],
        ROUNDS,
    )


def switches(agent: Interpreter) -> Iterator[Work]:
    """A signal, the waiter's turn, and the signaller's again."""
    peers = [
        Peer("bare greenlets, there and back", bare_switches, 3.5, ROUNDS),
        Peer("asyncio.Event, set and sleep(0)", in_asyncio(asyncio_set_and_sleep), 0.5, ROUNDS),
        Peer("trio channel, one way", in_trio("send"), 0.5, ROUNDS),
    ]
    yield Work("signal, waiter runs, waits again: at the kernel", lambda: at_kernel(agent), peers, ROUNDS)
    yield Work("signal, waiter runs, waits again: in ESL", lisp(agent, "signals"), peers, ROUNDS)
    yield Work(
        "ping-pong: two events, two tasks",
        lisp(agent, "ping-pong"),
        [
            Peer("asyncio.Event ping-pong", in_asyncio(asyncio_ping_pong), 0.5, ROUNDS),
            Peer("trio channels ping-pong", in_trio("ping_pong"), 0.5, ROUNDS),
        ],
        ROUNDS,
    )


def interrupts(agent: Interpreter) -> Iterator[Work]:
    """What reaches a task where it is blocked."""
    yield Work(
        "interrupt a blocked task with a cause; it recovers, waits again",
        lisp(agent, "nudges"),
        [
            Peer("asyncio: cancel, caught, waits again", in_asyncio(asyncio_nudges), None, ROUNDS),
            Peer("asyncio: cancel and join, a new task each time", in_asyncio(asyncio_stops), 0.3, ROUNDS),
        ],
        ROUNDS,
    )
    yield Work(
        "start a task, interrupt it with a cause, which ends it, join",
        lisp(agent, "stops"),
        [Peer("asyncio: the same with cancel", in_asyncio(asyncio_stops), None, ROUNDS)],
        ROUNDS,
    )


def lisp(agent: Interpreter, name: str, count: int = ROUNDS) -> Run:
    """A call of one of the program's functions."""
    return lambda: agent.call(name, count)


def at_kernel(agent: Interpreter) -> int:
    """What SIGNALS does, in Python."""
    scheduler, event = agent.scheduler, Event()

    def waiter() -> None:
        for _ in range(ROUNDS):
            scheduler.wait_for(event)

    def signaller() -> None:
        task = scheduler.at_work()
        for _ in range(ROUNDS):
            scheduler.signal(event, ())
            scheduler.yield_turn(task)

    def main() -> None:
        lives, root = scheduler.lives, scheduler.at_work()
        tasks = [lives.create(body.__name__, body, root) for body in (waiter, signaller)]
        for task in tasks:
            lives.start(task, "member")
        for task in tasks:
            lives.await_end(root, task)

    with agent.door():
        agent.runs.run(main)
    return ROUNDS


def bare_switches() -> int:
    """Two greenlets that switch to each other."""
    main = getcurrent()

    def there() -> None:
        for _ in range(ROUNDS):
            back.switch()
        main.switch()

    def and_back() -> None:
        for _ in range(ROUNDS):
            waiter.switch()

    waiter, back = greenlet(there), greenlet(and_back)
    back.switch()
    return ROUNDS


# --- asyncio -------------------------------------------------------------------------


def in_asyncio(main: Callable[[], Coroutine[Any, Any, int]]) -> Run:
    """Run MAIN in an event loop that is kept."""
    loop = asyncio.new_event_loop()
    return lambda: loop.run_until_complete(main())


async def asyncio_set_and_sleep() -> int:
    """One task sets an event, and lets the other run."""
    event = asyncio.Event()

    async def waiter() -> None:
        for _ in range(ROUNDS):
            await event.wait()
            event.clear()

    task = asyncio.create_task(waiter())
    await asyncio.sleep(0)
    for _ in range(ROUNDS):
        event.set()
        await asyncio.sleep(0)
    await task
    return ROUNDS


async def asyncio_ping_pong() -> int:
    """Two tasks wait for one another's events."""
    ping, pong = asyncio.Event(), asyncio.Event()

    async def left() -> None:
        for _ in range(ROUNDS):
            await ping.wait()
            ping.clear()
            pong.set()

    task = asyncio.create_task(left())
    for _ in range(ROUNDS):
        ping.set()
        await pong.wait()
        pong.clear()
    await task
    return ROUNDS


async def asyncio_nudges() -> int:
    """A task is cancelled again and again, and goes on waiting."""
    never, answered = asyncio.Event(), 0

    async def sleeper() -> None:
        nonlocal answered
        while answered < ROUNDS:
            try:
                await never.wait()
            except asyncio.CancelledError:
                answered += 1

    task = asyncio.create_task(sleeper())
    await asyncio.sleep(0)
    for _ in range(ROUNDS):
        task.cancel("nudged")
        await asyncio.sleep(0)
    await task
    return answered


async def asyncio_stops() -> int:
    """A task is started, cancelled where it waits, and joined."""
    never, stopped = asyncio.Event(), 0
    for _ in range(ROUNDS):
        task = asyncio.create_task(never.wait())
        await asyncio.sleep(0)
        task.cancel("enough")
        try:
            await task
        except asyncio.CancelledError:
            stopped += 1
    return stopped


async def asyncio_lives() -> int:
    """Tasks that do nothing, one after the other."""

    async def nothing() -> None:
        pass

    for _ in range(ROUNDS):
        await asyncio.create_task(nothing())
    return ROUNDS


# --- threads and trio ----------------------------------------------------------------


def thread_lives() -> int:
    """Threads that do nothing, one after the other."""

    def nothing() -> None:
        pass

    for _ in range(ROUNDS):
        thread = threading.Thread(target=nothing)
        thread.start()
        thread.join()
    return ROUNDS


def in_trio(name: str, count: int = ROUNDS) -> Run | None:
    """Run what trio_tasks.py calls NAME, where trio is installed."""
    if importlib.util.find_spec("trio") is None:
        return None
    from tests.benchmarks import trio_tasks

    return trio_tasks.runner(name, count)
