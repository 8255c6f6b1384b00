"""The laws of tasks, on plans made by chance (tests/trees).

Every run ends. Afterwards nothing of it is left: no task, wait, timer,
interrupt, binding, or other state; and every cleanup that was entered ran
exactly once. The same plan with the same seed is told the same way, to the
last character.
"""

from __future__ import annotations

import os
import subprocess
import sys
from random import Random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from strategies import task_plans
from support import ROOT
from trees.remains import forgotten, remains
from trees.running import Run, abort, fail, interrupt, nothing, stop
from trees.writer import task_plan

LAW = settings(
    max_examples=40,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example],
)
SEEDS = st.integers(0, 2**16)


def fresh() -> Run:
    """A run to come, in a new interpreter that does not change the limit of the stack."""
    limit = sys.getrecursionlimit()
    try:
        return Run()
    finally:
        sys.setrecursionlimit(limit)


def ran(plan: str, *, shuffle: bool = False, seed: int = 0, run: Run | None = None) -> Run:
    """PLAN, run in a new interpreter, or in that of RUN; with the stack that plans have."""
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(100_000)
    try:
        run = run or Run(shuffle=shuffle, seed=seed)
        return run.evaluate(plan)
    finally:
        sys.setrecursionlimit(limit)


@pytest.mark.slow
@given(task_plans(), st.booleans(), SEEDS)
@LAW
def test_every_run_ends_and_leaves_nothing(plan: str, shuffle: bool, seed: int) -> None:
    assert remains(ran(plan, shuffle=shuffle, seed=seed)) == []


@pytest.mark.slow
@given(task_plans(jumps=False), st.booleans(), SEEDS)
@LAW
def test_every_cleanup_procedure_runs_whose_body_does_not_end(plan: str, shuffle: bool, seed: int) -> None:
    run = ran(plan, shuffle=shuffle, seed=seed)
    assert remains(run) + forgotten(run.notes) == []


@pytest.mark.slow
@given(st.lists(task_plans(), min_size=2, max_size=4))
@LAW
def test_an_interpreter_is_as_good_as_new_after_a_run(plans: list[str]) -> None:
    run = None
    for plan in plans:
        if run is not None:
            run.begin()
        run = ran(plan, run=run)
        assert remains(run) == []


FAULTS = {
    "an abort": abort,
    "a failure": lambda task: interrupt(task, fail),
    "an interrupt": lambda task: interrupt(task, nothing),
    "a stop": lambda task: stop,
}
WHAT_COMES_BETWEEN = st.tuples(st.sampled_from(sorted(FAULTS)), st.integers(0, 500), st.integers(0, 50))


@pytest.mark.slow
@given(task_plans(jumps=False), st.lists(WHAT_COMES_BETWEEN, min_size=1, max_size=3), st.booleans())
@LAW
def test_faults_leave_nothing(plan: str, faults: list[tuple[str, int, int]], by_tasks: bool) -> None:
    run, again = ran(plan), fresh()
    for kind, point, task in faults:
        injection = FAULTS[kind](task % len(run.tasks))
        if by_tasks and run.notes:
            again.at_note[1 + point % len(run.notes)] = injection
        else:
            again.at[1 + point % len(run.told)] = injection
    ran(plan, run=again)
    assert remains(again) + forgotten(again.notes) == []


@pytest.mark.slow
@given(task_plans(), st.booleans(), SEEDS)
@LAW
def test_the_same_seed_gives_the_same_trace(plan: str, shuffle: bool, seed: int) -> None:
    first, second = (ran(plan, shuffle=shuffle, seed=seed) for _ in range(2))
    assert first.told == second.told
    assert (first.notes, first.outcome) == (second.notes, second.outcome)
    assert first.output.getvalue() == second.output.getvalue()


TRACES = """
import sys
from random import Random
from trees.running import Run
from trees.writer import task_plan
for seed in range(40):
    run = Run(shuffle=seed % 2 == 1, seed=seed).evaluate(task_plan(Random(seed), 4))
    print("\\n".join(run.told), run.notes, run.outcome, run.output.getvalue())
"""


@pytest.mark.slow
def test_the_trace_does_not_depend_on_hashes() -> None:
    traces = [traces_with(seed) for seed in ("0", "4711")]
    assert traces[0].count("\n") > 400
    assert traces[0] == traces[1]


def traces_with(hash_seed: str) -> str:
    """The traces of some plans in a process of their own."""
    environment = {**os.environ, "PYTHONPATH": f"{ROOT}:{ROOT / 'tests'}", "PYTHONHASHSEED": hash_seed}
    done = subprocess.run(
        [sys.executable, "-c", TRACES], cwd=ROOT, env=environment, capture_output=True, text=True, check=True
    )
    return done.stdout


def test_chance_writes_the_same_plan_again() -> None:
    assert task_plan(Random(7)) == task_plan(Random(7))
