"""The one source of chance, seeded: same seed, same run."""

from __future__ import annotations

from random import Random


def make_chance(seed: int) -> Random:
    """A source of its own for one interpreter."""
    return Random(seed)


def draw_seed() -> int:
    """A seed that nobody chose, for those who ask for one."""
    from random import SystemRandom

    return SystemRandom().randrange(2**31)
