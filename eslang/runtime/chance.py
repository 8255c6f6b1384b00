"""The one source of chance, seeded: same seed, same run.

Python's random is imported when chance is first wanted; few plans want it.
"""

from __future__ import annotations

from eslang.base.hints import TYPE_CHECKING

if TYPE_CHECKING:
    from random import Random


def make_chance(seed: int) -> Random:
    """A source of its own for one interpreter."""
    from random import Random

    return Random(seed)


def draw_seed() -> int:
    """A seed that nobody chose, for those who ask for one."""
    from random import SystemRandom

    return SystemRandom().randrange(2**31)
