"""How the benchmarks measure: contenders take turns, medians are compared.

The machine is shared and changes its speed, so a time means nothing by itself.
In each round every contender of a work runs once, for about as long as the
others; what is told is the median of the rounds' ratios.
"""

from __future__ import annotations

import gc
from collections.abc import Callable, Sequence
from statistics import median
from time import process_time
from typing import NamedTuple

LEAST = 0.005  # seconds that one sample takes, at least

Run = Callable[[], object]


class Peer(NamedTuple):
    """What eslang is compared with: how it does the work, and the greatest ratio that is accepted."""

    name: str
    run: Run | None  # None: not installed here
    limit: float | None  # None: measured for interest
    per: int = 1  # how often one call of `run` does the work


class Work(NamedTuple):
    """One piece of work, how eslang does it, and how its peers do."""

    name: str
    ours: Run
    peers: Sequence[Peer]
    per: int = 1  # how often one call of `ours` does the work
    clock: Callable[[], float] = process_time  # what other processes take does not count
    most: int = 1000  # rounds, where each takes long


class Row(NamedTuple):
    """One line of the table: medians over the rounds, the times in seconds for the work done once."""

    work: str
    peer: str
    ours: float
    theirs: float | None
    ratio: float | None  # how many times as long as the peer eslang takes, within one round
    limit: float | None
    unit: str = "s"  # or "B", where memory is compared instead of time

    @property
    def verdict(self) -> str:
        """Whether the limit was met."""
        if self.ratio is None:
            return "not installed, skipped"
        if self.limit is None:
            return "no limit"
        if self.ratio <= self.limit:
            return "met"
        return f"missed by {self.ratio / self.limit - 1:.0%}"


def measure(work: Work, rounds: int) -> list[Row]:
    """Let eslang and its peers do WORK in turn; a row for each peer."""
    present = [peer for peer in work.peers if peer.run is not None]
    runs = [(work.ours, work.per), *((peer.run, peer.per) for peer in present if peer.run is not None)]
    results = [run() for run, _ in runs]
    if any(result != results[0] for result in results):
        raise AssertionError(f"{work.name}: the contenders disagree: {results}")
    counts = [repetitions(run, work.clock) for run, _ in runs]
    samples: list[list[float]] = [[] for _ in runs]
    for _ in range(min(rounds, work.most)):
        for number, (run, per) in enumerate(runs):
            samples[number].append(sample(run, counts[number], work.clock) / per)
    ours = samples[0]
    times = dict(zip((peer.name for peer in present), samples[1:], strict=True))
    return [row(work.name, peer, ours, times.get(peer.name)) for peer in work.peers]


def row(work: str, peer: Peer, ours: list[float], theirs: list[float] | None) -> Row:
    """What the samples of one pair of contenders come to."""
    if theirs is None:
        return Row(work, peer.name, median(ours), None, None, peer.limit)
    ratio = median([one / other for one, other in zip(ours, theirs, strict=True)])
    return Row(work, peer.name, median(ours), median(theirs), ratio, peer.limit)


def row_of_bytes(work: str, peer: str, ours: float, theirs: float | None, limit: float | None) -> Row:
    """A row that compares memory."""
    return Row(work, peer, ours, theirs, None if theirs is None else ours / theirs, limit, "B")


def repetitions(run: Run, clock: Callable[[], float]) -> int:
    """How often RUN is to be called for a sample that is long enough."""
    count = 1
    while sample(run, count, clock) * count < LEAST and count < 1 << 20:
        count *= 2
    return count


def sample(run: Run, count: int, clock: Callable[[], float]) -> float:
    """The seconds that one of COUNT calls of RUN takes; who runs elsewhere tells it himself."""
    elsewhere = getattr(run, "sample", None)
    if elsewhere is not None:
        return float(elsewhere(count))
    gc.collect()
    gc.disable()
    try:
        begin = clock()
        for _ in range(count):
            run()
        return (clock() - begin) / count
    finally:
        gc.enable()
