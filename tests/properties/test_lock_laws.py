"""Laws of property locks (ARM §4), on plans by chance, whoever has the turn."""

from __future__ import annotations

import random
from io import StringIO
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from locking.plans import KEYS, bodies, body_of, method_of, methods
from locking.schedules import judged
from locking.world import World

from eslang import Interpreter
from eslang.base.control import Stop

pytestmark = pytest.mark.slow
RELAXED = settings(
    max_examples=400, deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large]
)


@pytest.fixture(scope="module")
def interp() -> Interpreter:
    """One interpreter for all plans: each leaves nothing behind."""
    return Interpreter(clock="virtual", output=StringIO())


@RELAXED
@given(
    doings=bodies,
    ways=methods,
    recoveries=methods,
    unsteady=st.sets(st.sampled_from(KEYS), max_size=1),
    seed=st.integers(0, 2**32),
)
def test_no_plan_leaves_or_misses_anything(
    interp: Interpreter, doings: Any, ways: Any, recoveries: Any, unsteady: set[str], seed: int
) -> None:
    """No contradiction, no dead subscriber, no violation unnoticed, nothing left; nobody waits in vain."""
    chance = random.Random(seed)
    interp.hooks.listeners.clear()
    world = judged(World(interp), lambda ready: chance.randrange(len(ready)) if seed else 0)
    world.unsteady = unsteady
    for key, kind in ways.items():
        world.methods[key] = method_of(world, kind)
    for key, kind in recoveries.items():
        world.recoveries[key] = method_of(world, kind)
    try:
        world.run(**{name: body_of(world, actions) for name, actions in doings.items()})
    except Stop as stop:
        raise AssertionError(stop.reason) from None
