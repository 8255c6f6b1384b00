"""`python -m tests.benchmarks [ROUNDS] [NAME...]`: measure, and print one table.

NAME is one of ROOMS; without one, all are measured.
"""

from __future__ import annotations

import platform
import sys

from tests.benchmarks import (
    circuits,
    compute,
    crowds,
    facts,
    locks,
    memory,
    reading,
    recovery,
    starting,
    tasks,
)
from tests.benchmarks.measure import Row, measure

ROOMS = {
    "compute": compute,
    "recovery": recovery,
    "tasks": tasks,
    "crowds": crowds,
    "locks": locks,
    "memory": memory,
    "facts": facts,
    "circuits": circuits,
    "starting": starting,
    "reading": reading,
}
HEAD = ("work", "against", "eslang", "the other", "ratio", "at most", "")


def main(words: list[str]) -> int:
    """Measure what WORDS ask for; 1 if a limit was missed."""
    rounds = int(words.pop(0)) if words and words[0].isdigit() else 61
    sys.setrecursionlimit(500_000)  # for hand-written Python that recurses deeply, too
    rows: list[Row] = []
    for name in words or ROOMS:
        for work in ROOMS[name].works():
            rows += [work] if isinstance(work, Row) else measure(work, rounds)
    sys.stdout.write(f"Python {platform.python_version()}, medians of {rounds} interleaved rounds\n\n")
    sys.stdout.write(table(rows) + "\n")
    return 1 if any(row.verdict.startswith("missed") for row in rows) else 0


def table(rows: list[Row]) -> str:
    """ROWS as a Markdown table."""
    cells = [HEAD, *map(cells_of, rows)]
    widths = [max(len(line[column]) for line in cells) for column in range(len(HEAD))]
    lines = [
        "| " + " | ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)) + " |"
        for line in cells
    ]
    lines.insert(1, "|" + "|".join("-" * (width + 2) for width in widths) + "|")
    return "\n".join(lines)


def cells_of(row: Row) -> tuple[str, ...]:
    """The cells of one line."""
    return (
        row.work,
        row.peer,
        amount(row.ours, row.unit),
        "" if row.theirs is None else amount(row.theirs, row.unit),
        "" if row.ratio is None else f"{row.ratio:.2f} ×",
        "" if row.limit is None else f"{row.limit} ×",
        row.verdict,
    )


def amount(number: float, unit: str) -> str:
    """NUMBER of seconds, or of bytes, for people."""
    return duration(number) if unit == "s" else f"{number / 1000:.3g} kB"


def duration(seconds: float) -> str:
    """SECONDS for people."""
    for factor, unit in ((1, "s"), (1e3, "ms"), (1e6, "µs")):
        if seconds * factor >= 1:
            return f"{seconds * factor:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
