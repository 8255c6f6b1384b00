"""Kills runs at random moments, and tells what they have left.

usage: python -m killing FOLDER KILLS SEED

Half of the KILLS end runs that begin anew: a line tells for each how many
steps its file holds, "none" if it holds what was true at no step's end. The
others end one run that goes on from its own file: a line tells each time how
far it had come, "broken" if that cannot be. All runs are children made by fork
of this process, which has everything in memory, so that they begin at once.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from collections.abc import Callable
from random import Random

from eslang.durable import keep_facts
from killing.plans import begun, held, progress, states

MANY = 60  # rounds of the plan
FAR = 1_000_000  # steps of the march, which does not come so far
AGENT = begun()
AGENT.call("march", 3)  # now all is loaded that a run needs
AGENT.database.clear()


def child(work: Callable[[], object]) -> int:
    """Do WORK in a process of its own; its number."""
    number = os.fork()
    if number == 0:
        code = 1
        try:
            work()
            code = 0
        finally:
            os._exit(code)
    return number


def finished(work: Callable[[], object]) -> float:
    """Do WORK in a process of its own, to its end; the seconds that it took."""
    begin = time.perf_counter()
    _, status = os.waitpid(child(work), 0)
    assert status == 0, "what was done in a child has failed"
    return time.perf_counter() - begin


def kill(run: Callable[[Callable[[], object]], object], longest: float, chance: Random) -> None:
    """RUN in a process of its own, and kill that at some moment of the next LONGEST seconds.

    Mostly these begin when the run says that it has opened its file; now and then at once.
    """
    ready, readiness = os.pipe()
    number = child(lambda: run(lambda: os.write(readiness, b".")))
    if chance.random() < 0.8:
        os.read(ready, 1)
    time.sleep(chance.uniform(0, longest))
    os.kill(number, signal.SIGKILL)
    os.waitpid(number, 0)
    os.close(ready)
    os.close(readiness)


def tell(word: object) -> None:
    """Write a line, from whichever process."""
    os.write(1, f"{word}\n".encode())


def anew(folder: str, kills: int, chance: Random) -> None:
    """Kill runs that begin anew."""
    known: dict[str, int] = {}
    whole = os.path.join(folder, "whole")

    def learn() -> None:
        with open(whole, "w", encoding="ascii") as stream:
            stream.write("\n".join(states(AGENT, os.path.join(folder, "whole.db"), MANY)))

    finished(learn)
    with open(whole, encoding="ascii") as stream:
        known.update((state, number) for number, state in enumerate(stream.read().split("\n")))
    for number in range(kills + 1):
        path = os.path.join(folder, f"{number}.db")

        def run(begin: Callable[[], object], path: str = path) -> None:
            keep_facts(AGENT, path)
            begin()
            AGENT.call("go-on", MANY)

        def look(path: str = path) -> None:
            keep_facts(AGENT, path)
            tell(known.get(held(AGENT), "none"))

        if number == 0:
            longest = finished(lambda: run(lambda: None)) - finished(look)
        else:
            kill(run, longest, chance)
            finished(look)
    tell(f"of {len(known) - 1}")


def onward(path: str, kills: int, chance: Random) -> None:
    """Kill a run that goes on from its file, again and again."""

    def look() -> None:
        keep_facts(AGENT, path)
        tell(progress(AGENT))

    def run(begin: Callable[[], object]) -> None:
        look()
        begin()
        AGENT.call("march", FAR)

    for _ in range(kills):
        kill(run, 0.03, chance)
    finished(look)


def main(folder: str, kills: int, seed: int) -> None:
    """Kill so many runs."""
    chance = Random(seed)
    anew(folder, kills // 2, chance)
    onward(os.path.join(folder, "on.db"), kills - kills // 2, chance)


main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
