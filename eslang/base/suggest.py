"""Nearest names: what a mistyped word may have meant.

A name is near when it can be had from the word by changing, adding, leaving
out or swapping at most a third of its letters; anything farther is a guess and
is not offered. How the offer is worded is the business of whoever reports.
"""

from __future__ import annotations

from eslang.base.hints import Iterable


def nearest(word: str, names: Iterable[str]) -> str | None:
    """The one of NAMES nearest to WORD, the alphabetically first of equals; None if all are far."""
    wanted = word.lower()
    best: tuple[int, str] | None = None
    for name in names:
        reach = max(len(word), len(name)) // 3
        if best is not None:
            reach = min(reach, best[0])
        if abs(len(word) - len(name)) > reach:
            continue
        steps = distance(wanted, name.lower(), reach)
        if steps <= reach and name != word and (best is None or (steps, name) < best):
            best = (steps, name)
    return best[1] if best is not None else None


def distance(left: str, right: str, reach: int) -> int:
    """How many letters to change, add, leave out or swap with a neighbour; past REACH, just more."""
    before: list[int] = []
    above = list(range(len(right) + 1))
    for i, a in enumerate(left, 1):
        row = [i]
        for j, b in enumerate(right, 1):
            cost = min(above[j] + 1, row[j - 1] + 1, above[j - 1] + (a != b))
            if i > 1 and j > 1 and a == right[j - 2] and left[i - 2] == b:
                cost = min(cost, before[j - 2] + 1)
            row.append(cost)
        if min(row) > reach and min(above) > reach:
            return reach + 1
        before, above = above, row
    return above[-1]
