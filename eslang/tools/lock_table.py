"""Property locks for people at the prompt: who owns, who waits, for which value, since when."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from eslang.tools.columns import table
from eslang.tools.fact_tables import written

if TYPE_CHECKING:
    from eslang.runtime.claims import Holding

HEADER = ("property", "task", "", "state", "since")
NOTHING = "No property is locked.\n"


def lock_table(holdings: Iterable[Holding], columns: int) -> str:
    """HOLDINGS, one a line, for a terminal with so many COLUMNS."""
    rows = [
        (written(each.lock), each.task.name, role(each), each.standing, f"{each.since:.1f} s")
        for each in holdings
    ]
    if not rows:
        return NOTHING
    return "".join(f"{line}\n" for line in table(HEADER, rows, [False, False, False, False, True], columns))


def role(holding: Holding) -> str:
    """What the task of HOLDING is to the lock: its owner; one that waits."""
    words = [*(["owner"] if holding.is_owner else []), *(["waits"] if holding.waits else [])]
    return ", ".join(words)
