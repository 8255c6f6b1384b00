"""Maintained properties (ARM §4, Automatic Recoveries): violations, recoveries, and the daemon."""

from __future__ import annotations

import pytest
from locking.bodies import spoiling, tolerant
from locking.world import World


@pytest.fixture
def world() -> World:
    """A world of its own."""
    return World()


# --- violations ------------------------------------------------------------------------


def test_a_violation_fails_all_subscribers_where_they_stand(world: World) -> None:
    lines = world.run(a=world.hold("p=1", 9), b=world.hold("p=1", 9), c=spoiling(world, 2))
    assert lines[3:] == [
        "2 c: p=0",
        "2 a: :MAINTAINED-PROPERTY-VIOLATION p=1",
        "2 b: :MAINTAINED-PROPERTY-VIOLATION p=1",
    ]


def test_a_property_cannot_be_violated_before_it_was_achieved(world: World) -> None:
    lines = world.run(a=world.hold("p=1", 1), c=spoiling(world, 0.5))
    assert lines == ["0 a: switch p=1", "0.5 c: p=0", "1 a: in", "2 a: done"]


def test_nobody_hears_of_a_violation_after_leaving(world: World) -> None:
    lines = world.run(a=lambda: (world.hold("p=1")(), world.sleep(5)), c=spoiling(world, 2))
    assert lines == ["0 a: switch p=1", "1 a: in", "1 a: done", "2 c: p=0"]


def test_a_change_that_leaves_the_property_true_is_no_violation(world: World) -> None:
    lines = world.run(a=world.hold("p=?", 4), c=spoiling(world, 2, "p", "other"))
    assert lines[-1] == "5 a: done"
    assert not [line for line in world.changes if line.startswith("violated")]


def test_what_is_undone_within_one_step_is_no_violation(world: World) -> None:
    def flicker() -> None:
        world.sleep(2)
        world.set("p", "0")
        world.set("p", "1")

    assert world.run(a=world.hold("p=1", 4), c=flicker)[-1] == "5 a: done"


def test_a_procedure_that_runs_off_its_end_lets_the_body_go_on(world: World) -> None:
    lines = world.run(
        a=lambda: world.answering(
            "MAINTAINED-PROPERTY-VIOLATION",
            lambda: world.maintain("p=1", lambda: (world.sleep(4), world.note("done"))),
            lambda: world.note("so what"),
        ),
        c=spoiling(world, 2),
    )
    assert lines == ["0 a: switch p=1", "2 c: p=0", "2 a: so what", "2 recovery: switch p=1", "5 a: done"]


def test_a_violation_while_another_property_is_achieved_is_not_that_ones_failure(world: World) -> None:
    world.methods["q"] = lambda one: world.sleep(9)
    lines = world.run(a=world.hold("p=1 q=1"), c=spoiling(world, 2))
    assert lines == ["0 a: switch p=1", "2 c: p=0", "2 a: :MAINTAINED-PROPERTY-VIOLATION p=1"]


def test_one_violation_is_told_once_to_a_task_that_waits_for_its_end(world: World) -> None:
    def inside() -> None:
        world.maintain("p=1", lambda: (world.sleep(4), world.note("done")))

    lines = world.run(a=lambda: world.tolerating("p=1", inside), c=spoiling(world, 2))
    assert lines == [
        "0 a: switch p=1",
        "2 c: p=0",
        "2 a: waits for p=1",
        "2 recovery: switch p=1",
        "3 a: goes on",
        "5 a: done",
    ]


def test_who_leaves_the_inner_form_hears_in_the_outer_one_if_the_violation_lasts(world: World) -> None:
    def outer() -> None:
        world.hold("p=1", 9)()
        world.give_way()

    lines = world.run(a=lambda: world.noting(lambda: world.maintain("p=1", outer)), c=spoiling(world, 2))
    assert lines[2:] == [
        "2 c: p=0",
        "2 a: :MAINTAINED-PROPERTY-VIOLATION p=1",
        "2 a: :MAINTAINED-PROPERTY-VIOLATION p=1",
    ]


# --- the daemon ------------------------------------------------------------------------


def test_the_daemon_takes_no_step_while_nothing_changes() -> None:
    world = World()
    names = [f"p{number}=1" for number in range(1000)]
    for name in names:
        world.set(name.partition("=")[0], "1")
    steps: list[int] = []

    def wait() -> None:
        steps.append(world.scheduler.steps)
        for _ in range(10):
            world.sleep(1)
        world.set("unrelated", "1")
        steps.append(world.scheduler.steps)

    world.run(a=lambda: world.maintain(" ".join(names), wait))
    assert steps[1] - steps[0] == 10
    assert world.looks == 1000


def test_the_daemon_checks_once_per_wake_up(world: World) -> None:
    def flicker() -> None:
        world.sleep(2)
        for value in ("0", "1", "0", "1"):
            world.set("p", value)

    world.run(a=world.hold("p=1", 4), c=flicker)
    assert world.looks == 2


def test_an_aborted_daemon_is_followed_by_another(world: World) -> None:
    def spoil() -> None:
        world.sleep(2)
        world.set("p", "0")
        world.scheduler.lives.abort(world.keeper.daemon, "abort-task")

    lines = world.run(a=world.hold("p=1", 9), c=spoil)
    assert lines[-1] == "2 a: :MAINTAINED-PROPERTY-VIOLATION p=1"


def test_a_property_that_cannot_be_looked_at_counts_as_violated(world: World) -> None:
    look = world.observe

    def spoil() -> None:
        world.sleep(2)
        world.keeper.observe = lambda one, changed: world.fail("BLIND")
        world.set("p", "1")

    world.keeper.observe = look
    lines = world.run(a=world.hold("p=1", 9), c=spoil)
    assert lines[-1] == "2 a: :MAINTAINED-PROPERTY-VIOLATION p=1"


def test_a_change_from_outside_of_any_task_is_noticed(world: World) -> None:
    world.interp.scheduler.set_timer(2, lambda: world.set("p", "0"))
    assert world.run(a=world.hold("p=1", 9))[-1] == "2 a: :MAINTAINED-PROPERTY-VIOLATION p=1"


def test_the_end_of_the_run_releases_everything(world: World) -> None:
    world.recoveries["p"] = lambda one: world.sleep(99)
    with world.interp.door():
        world.interp.runs.enter(
            lambda: [
                world.spawn("a", tolerant(world, "p=1", 99)),
                world.spawn("c", spoiling(world, 2)),
                world.sleep(3),
            ]
        )
        world.interp.runs.abort_all()
    assert world.remains() == []


# --- what cannot be watched ------------------------------------------------------------


def test_what_changes_without_a_word_is_looked_at_after_each_step(world: World) -> None:
    world.unsteady.add("p")
    lines = world.run(a=tolerant(world, "p=1", 4), b=world.hold("p=1", 9), c=spoiling(world, 2))
    assert lines[3:] == [
        "2 c: p=0",
        "2 a: waits for p=1",
        "2 b: :MAINTAINED-PROPERTY-VIOLATION p=1",
        "2 recovery: switch p=1",
        "3 a: goes on",
        "5 a: done",
    ]


def test_what_restores_itself_without_a_word_is_restored(world: World) -> None:
    world.unsteady.add("p")
    world.recoveries["p"] = lambda one: (world.sleep(1), world.set("p", "1"), world.sleep(1))
    lines = world.run(a=tolerant(world, "p=1", 9), c=spoiling(world, 2), d=world.hold("q=1", 20))
    assert "4 a: goes on" in lines
    assert lines[-1] == "21 d: done"


def test_steady_and_unsteady_properties_are_maintained_side_by_side(world: World) -> None:
    world.unsteady.add("p")
    lines = world.run(
        a=tolerant(world, "p=1", 9),
        b=tolerant(world, "q=1", 9),
        c=spoiling(world, 2),
        d=spoiling(world, 3, "q"),
    )
    assert [line for line in lines if "goes on" in line] == ["3 a: goes on", "4 b: goes on"]


def test_a_deadlock_is_found_though_something_is_looked_at_all_the_time(world: World) -> None:
    from eslang.runtime.events import Event

    world.unsteady.add("p")
    event = Event("never")
    lines = world.run(
        a=lambda: world.noting(lambda: world.maintain("p=1", lambda: world.scheduler.wait_for(event)))
    )
    assert lines[1].startswith("1 a: :DEADLOCK")
