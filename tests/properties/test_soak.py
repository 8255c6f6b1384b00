"""The soak, for a minute at most: `python -m tests.soak` runs the whole of it."""

from __future__ import annotations

import pytest

from soak.workload import Soak


@pytest.mark.slow
def test_tasks_of_all_kinds_leave_no_memory_behind() -> None:
    soak = Soak()
    first = soak.run(10_000)
    last = soak.run(100_000)
    assert last.objects <= first.objects + 50
    assert last.megabytes <= first.megabytes * 1.02 + 1


@pytest.mark.slow
def test_the_soak_does_all_that_it_says() -> None:
    soak = Soak()
    told: dict[str, int] = {}
    soak.interp.hooks.listeners.append(lambda event: told.update({event.kind: told.get(event.kind, 0) + 1}))
    soak.interp.call("all")
    kinds = {
        "abort",
        "checkpoint",
        "deadlock",
        "failure",
        "interrupt",
        "recovery",
        "signal",
        "task-ended",
        "wait",
    }
    assert kinds <= set(told)
