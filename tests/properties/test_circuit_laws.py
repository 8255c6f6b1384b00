"""The laws of SCS (Appendix C), on programs and worlds made by chance (tests/circuits).

Each run is one that the reference allows (tests/naive/circuits.py), and of
small programs each run that it allows is one that some choices lead to. What
must be true of every run, whatever the reference says, is looked at apart.
"""

from __future__ import annotations

from typing import Any

import pytest
from circuits.monitor import Monitor
from circuits.running import Stage, every_choice
from circuits.strategies import CHANGES, SMALL_WORLDS, WORLDS, programs, tiny_programs
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from naive.circuit_runs import Effects, every_run, trouble
from naive.steps import World

LAW = settings(
    max_examples=120,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)
SEEDS = st.integers(0, 2**16)


@pytest.fixture(scope="module")
def stage() -> Stage:
    """One interpreter for all programs: each leaves nothing behind."""
    return Stage()


@pytest.mark.slow
@pytest.mark.parametrize("depth", [2, 3])
@given(data=st.data(), world=WORLDS, changes=CHANGES, seed=SEEDS)
@LAW
def test_a_run_is_one_that_the_reference_allows(
    stage: Stage, depth: int, data: Any, world: World, changes: tuple[Effects, ...], seed: int
) -> None:
    program = data.draw(programs(depth))
    plan = stage.prepare(program)
    for number in range(4):
        run = stage.run(world, changes, seed + number)
        assert not trouble(run, program, world, changes), plan


@pytest.mark.slow
@given(program=programs(3, waits=True), world=WORLDS, changes=CHANGES, seed=SEEDS)
@LAW
def test_a_step_that_waits_is_left_as_others_are(
    stage: Stage, program: Any, world: World, changes: tuple[Effects, ...], seed: int
) -> None:
    plan = stage.prepare(program)
    for number in range(4):
        run = stage.run(world, changes, seed + number)
        assert not trouble(run, program, world, changes), plan
        assert not Monitor(program, world, changes).troubles(run), (plan, run)


@pytest.mark.slow
@given(program=programs(3), world=WORLDS, changes=CHANGES, seed=SEEDS)
@LAW
def test_no_action_begins_where_it_must_not(
    stage: Stage, program: Any, world: World, changes: tuple[Effects, ...], seed: int
) -> None:
    """Not under a false condition, in an atomic group, or in a step that was left; that cleans up once."""
    plan = stage.prepare(program)
    for number in range(4):
        run = stage.run(world, changes, seed + number)
        assert not Monitor(program, world, changes).troubles(run), (plan, run)


@pytest.mark.slow
@given(program=programs(3), world=WORLDS, changes=CHANGES, seed=SEEDS)
@settings(LAW, max_examples=50)
def test_the_same_seed_gives_the_same_run(
    program: Any, world: World, changes: tuple[Effects, ...], seed: int
) -> None:
    first, second = Stage(), Stage()
    for stage in (first, second):
        stage.prepare(program)
    assert first.run(world, changes, seed) == second.run(world, changes, seed)
    assert first.told == second.told


@pytest.mark.slow
@given(program=tiny_programs(), world=SMALL_WORLDS, changes=CHANGES)
@settings(LAW, max_examples=60)
def test_every_run_that_the_reference_allows_is_the_work_of_some_choices(
    stage: Stage, program: Any, world: World, changes: tuple[Effects, ...]
) -> None:
    plan = stage.prepare(program)
    runs = every_choice(lambda: stage.run(world, changes), stage.interp.chance, most=200)
    assume(runs is not None)
    assert runs == every_run(program, world, changes), plan
