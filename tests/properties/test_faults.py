"""Faults at every step: whatever is done to a plan, and whenever, nothing of it is left.

Each plan is run once undisturbed. Then it is run again for each event that
was told, and for each task, with a fault between the two steps around that
event; and for each note that it leaves, with the fault made by the task that
leaves it. A fault is an abort, the end of the run, a failure where a task
stands, or an interrupt that does nothing, which is to change nothing.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import pytest

from eslang.runtime import scheduler
from trees.plans import PLANS
from trees.remains import forgotten, remains
from trees.running import Injection, Run, abort, fail, interrupt, nothing, stop

pytestmark = pytest.mark.slow


@pytest.fixture(autouse=True)
def the_driver_sees_to_each_step(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let no task hand over to another: what was posted is then done between any two steps."""
    monkeypatch.setattr(scheduler, "TURNS", 1)


@pytest.fixture(params=PLANS)
def run(request: pytest.FixtureRequest) -> Run:
    """A run of the plan, undisturbed, whose interpreter can run it again."""
    run = Run()
    run.evaluate(f"(defun plan () {PLANS[request.param]})")
    return again(run)


def again(run: Run) -> Run:
    """RUN, with the plan run once more from time 0."""
    at, at_note = run.at, run.at_note
    run.begin()
    run.at, run.at_note = at, at_note
    run.interp.clock.__init__()
    return run.call("plan")


def points(run: Run) -> list[tuple[int, int]]:
    """For each event of RUN, how many tasks had begun: (event, task), all pairs."""
    begun, found = 0, []
    for event, line in enumerate(run.told, start=1):
        begun += line.split()[2] == "task-started"
        found += [(event, task) for task in range(begun)]
    return found


def disturbed(run: Run, event: int, injection: Injection) -> Run:
    """RUN, once more, with INJECTION behind EVENT."""
    run.at, run.at_note = {event: injection}, {}
    return again(run)


def check(run: Run, where: object) -> None:
    """Fail if anything is left of RUN."""
    assert remains(run) + forgotten(run.notes) == [], where


def test_an_undisturbed_plan_leaves_nothing(run: Run) -> None:
    check(run, None)


def test_an_abort_at_any_step_leaves_nothing(run: Run) -> None:
    for event, task in points(run):
        check(disturbed(run, event, abort(task)), (event, task))


def test_the_end_of_the_run_at_any_step_leaves_nothing(run: Run) -> None:
    for event in range(1, len(run.told) + 1):
        check(disturbed(run, event, stop), event)


def test_a_failure_at_any_step_leaves_nothing(run: Run) -> None:
    for event, task in points(run):
        check(disturbed(run, event, interrupt(task, fail)), (event, task))


def test_an_interrupt_that_does_nothing_changes_nothing(run: Run) -> None:
    outcome, notes = run.outcome, Counter(run.notes)
    for event, task in points(run):
        check(disturbed(run, event, interrupt(task, nothing)), (event, task))
        assert (run.outcome, by_kind(run.notes)) == (outcome, by_kind(notes.elements())), (event, task)


def by_kind(notes: Iterator[tuple[str, ...]]) -> Counter[str]:
    """How many of NOTES there are of each kind; entrances are numbered on from run to run."""
    return Counter(words[0] for words in notes)


def test_a_fault_made_by_the_task_itself_leaves_nothing(run: Run) -> None:
    tasks, notes = len(run.tasks), len(run.notes)
    for note in range(1, notes + 1):
        for task in range(tasks):
            for injection in (abort(task), interrupt(task, fail), interrupt(task, nothing)):
                run.at, run.at_note = {}, {note: injection}
                check(again(run), (note, task, injection))
