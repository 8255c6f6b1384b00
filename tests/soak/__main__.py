"""The whole soak: `python -m tests.soak [STEPS]`, ten million unless given; it takes some minutes.

Prints what is taken up at ten moments, and fails if it grows.
"""

from __future__ import annotations

import sys
import time

from tests.soak.workload import Soak

STEPS = 10_000_000
MOST = 1.02  # how much of what there was after the first part there may be at the end


def main() -> int:
    """Run the soak; 0 if memory did not grow."""
    steps = int(sys.argv[1]) if len(sys.argv) > 1 else STEPS
    soak, begun, all_taken = Soak(), time.monotonic(), []
    for taken in soak.series(steps, 10):
        all_taken.append(taken)
        sys.stdout.write(
            f"{taken.steps:>12,} steps  {taken.rounds:>8,} rounds  {taken.objects:>9,} objects"
            f"  {taken.megabytes:7.1f} MB  {time.monotonic() - begun:6.0f} s\n"
        )
        sys.stdout.flush()
    first, last = all_taken[0], all_taken[-1]
    grown = last.objects > first.objects * MOST or last.megabytes > first.megabytes * MOST + 1
    sys.stdout.write("memory grew\n" if grown else "memory did not grow\n")
    return 1 if grown else 0


if __name__ == "__main__":
    sys.exit(main())
