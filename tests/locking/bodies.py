"""What tasks do in tests of property locks."""

from __future__ import annotations

from collections.abc import Callable

from locking.world import World


def spoiling(world: World, moment: float, key: str = "p", value: str | None = "0") -> Callable[[], None]:
    """The body of a task that changes the world at MOMENT."""

    def spoil() -> None:
        world.sleep(moment)
        world.note(f"{key}={value}")
        world.set(key, value)

    return spoil


def tolerant(world: World, properties: str, seconds: float) -> Callable[[], None]:
    """The body of a task that waits for recoveries."""

    def inside() -> None:
        world.note("in")
        world.sleep(seconds)
        world.note("done")

    return lambda: world.noting(lambda: world.tolerating(properties, inside))
