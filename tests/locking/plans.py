"""Plans of tasks that lock properties, written by chance, and run."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from hypothesis import strategies as st

from eslang.runtime.claims import Property
from locking.world import World

KEYS, VALUES = "pqr", "12?"
NAMES = "abcd"
Action = tuple[Any, ...]

properties = st.lists(
    st.builds("{}={}".format, st.sampled_from(KEYS), st.sampled_from(VALUES)), min_size=1, max_size=2
)
moments = st.sampled_from([0.5, 1.0, 2.0])
actions: st.SearchStrategy[Action] = st.deferred(
    lambda: st.one_of(
        st.tuples(st.sampled_from(["hold", "tolerate", "ignore"]), properties, st.lists(actions, max_size=3)),
        st.tuples(st.just("clean"), st.lists(actions, max_size=2)),
        st.tuples(st.just("set"), st.sampled_from(KEYS), st.sampled_from(["1", "2", None])),
        st.tuples(st.just("sleep"), moments),
        st.tuples(st.just("yield")),
        st.tuples(st.just("fail")),
        st.tuples(st.just("abort"), st.sampled_from(NAMES)),
    )
)
bodies = st.dictionaries(st.sampled_from(NAMES), st.lists(actions, min_size=1, max_size=4), min_size=2)
methods = st.dictionaries(
    st.sampled_from(KEYS), st.sampled_from(["slow", "yielding", "failing", "flickering", "needing"])
)


def body_of(world: World, doings: list[Action]) -> Callable[[], None]:
    """What a task does that is to do DOINGS, one after the other."""
    return lambda: [act(world, each) for each in doings] and None


def act(world: World, action: Action) -> None:
    """Do ACTION."""
    match action:
        case ("sleep", seconds):
            world.sleep(seconds)
        case ("yield",):
            world.give_way()
        case ("set", key, value):
            world.set(key, value)
        case ("abort", name):
            if name in world.tasks:
                world.abort(name)
        case ("fail",):
            world.noting(lambda: world.fail("OOPS"))
        case ("clean", doings):
            clean(world, doings)
        case (how, wanted, doings):
            hold(world, how, " ".join(wanted), body_of(world, doings))


def clean(world: World, doings: list[Action]) -> None:
    """Sleep a little; if that is left by a failure or an abort, do DOINGS on the way out."""
    from eslang.runtime.failures import run_with_cleanup

    run_with_cleanup(lambda: world.sleep(1), body_of(world, doings))


def hold(world: World, how: str, wanted: str, inside: Callable[[], None]) -> None:
    """Do what is INSIDE while what is WANTED is maintained; of a violation think as HOW says."""
    if how == "tolerate":
        world.noting(lambda: world.tolerating(wanted, inside))
    elif how == "ignore":
        world.noting(
            lambda: world.answering(
                "MAINTAINED-PROPERTY-VIOLATION", lambda: world.maintain(wanted, inside), lambda: None
            )
        )
    else:
        world.noting(lambda: world.maintain(wanted, inside))


def method_of(world: World, kind: str) -> Callable[[Property], None]:
    """How a property is achieved."""

    def method(one: Property) -> None:
        value = "1" if one.value == "?" else one.value
        if kind == "failing":
            world.give_way()
            world.fail("STUCK")
        elif kind == "needing":
            world.maintain("r=1" if one.key != "r" else "q=1", world.give_way)
            world.set(one.key, value)
        elif kind == "flickering":
            world.set(one.key, value)
            world.give_way()
            world.set(one.key, None)
            world.give_way()
            world.set(one.key, value)
        else:
            world.sleep(1) if kind == "slow" else world.give_way()
            world.set(one.key, value)

    return method
