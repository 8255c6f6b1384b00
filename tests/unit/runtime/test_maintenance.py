"""Maintained properties (ARM §4, Automatic Recoveries): violations, recoveries, and the daemon."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from locking.world import World

from eslang.runtime.claims import Property


@pytest.fixture
def world() -> World:
    """A world of its own."""
    return World()


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


# --- recoveries ------------------------------------------------------------------------


def test_who_waits_goes_on_when_the_property_is_restored(world: World) -> None:
    lines = world.run(a=tolerant(world, "p=1", 4), c=spoiling(world, 2))
    assert lines == [
        "0 a: switch p=1",
        "1 a: in",
        "2 c: p=0",
        "2 a: waits for p=1",
        "2 recovery: switch p=1",
        "3 a: goes on",
        "5 a: done",
    ]


def test_if_nobody_persists_nothing_is_recovered(world: World) -> None:
    lines = world.run(a=world.hold("p=1", 9), b=world.hold("p=1", 9), c=spoiling(world, 2))
    assert [line for line in lines if "switch" in line] == ["0 a: switch p=1"]


def test_all_may_leave_before_the_daemon_recovers_whatever_the_order() -> None:
    for seed in range(40):
        world = World(shuffle=True, seed=seed)
        lines = world.run(
            a=world.hold("p=1", 9), b=world.hold("p=1", 9), c=spoiling(world, 2), d=world.hold("q=1", 9)
        )
        assert len([line for line in lines if "switch p=1" in line]) == 1


def test_a_property_that_cannot_be_restored_fails_who_persists(world: World) -> None:
    world.recoveries["p"] = lambda one: (world.sleep(1), world.fail("STUCK", 3))
    lines = world.run(
        a=tolerant(world, "p=1", 9),
        b=lambda: world.noting(
            lambda: world.answering(
                "MAINTAINED-PROPERTY-VIOLATION",
                lambda: world.maintain("p=1", lambda: world.sleep(9)),
                lambda: world.note("so what"),
            )
        ),
        c=spoiling(world, 2),
    )
    assert lines[-2:] == [
        "3 a: :UNRECOVERABLE-PROPERTY-VIOLATION p=1 :STUCK 3",
        "3 b: :UNRECOVERABLE-PROPERTY-VIOLATION p=1 :STUCK 3",
    ]


def test_a_recovery_that_does_nothing_is_none(world: World) -> None:
    world.recoveries["p"] = lambda one: None
    lines = world.run(a=tolerant(world, "p=1", 9), c=spoiling(world, 2))
    assert lines[-1] == "2 a: :UNRECOVERABLE-PROPERTY-VIOLATION p=1"


def test_a_recovery_that_fails_is_one_if_the_property_holds_all_the_same(world: World) -> None:
    world.recoveries["p"] = lambda one: (world.sleep(1), world.set("p", "1"), world.fail("LATE"))
    assert world.run(a=tolerant(world, "p=1", 4), c=spoiling(world, 2))[-1] == "5 a: done"


def test_what_could_not_be_restored_may_be_wanted_anew(world: World) -> None:
    world.recoveries["p"] = lambda one: world.fail("STUCK")

    def again() -> None:
        tolerant(world, "p=1", 9)()
        world.hold("p=1")()

    lines = world.run(a=again, c=spoiling(world, 2))
    assert lines[-4:] == [
        "2 a: :UNRECOVERABLE-PROPERTY-VIOLATION p=1 :STUCK",
        "2 a: switch p=1",
        "3 a: in",
        "3 a: done",
    ]


def test_what_restores_itself_is_restored(world: World) -> None:
    def spoil() -> None:
        world.sleep(2)
        world.set("p", "0")
        world.give_way()
        world.set("p", "1")

    lines = world.run(a=tolerant(world, "p=1", 4), c=spoil)
    assert lines[2:] == [
        "2 a: waits for p=1",
        "2 a: goes on",
        "5 a: done",
    ]


def test_who_comes_during_a_recovery_waits_for_it(world: World) -> None:
    lines = world.run(
        a=tolerant(world, "p=1", 9),
        b=lambda: (world.sleep(2.5), world.hold("p=1")()),
        c=spoiling(world, 2),
        d=lambda: (world.sleep(2.5), world.hold("p=2")()),
    )
    assert lines[5:] == [
        "2.5 d: :PROPERTY-LOCK-UNAVAILABLE p=2 p=1 #<TASK a>",
        "3 a: goes on",
        "3 b: in",
        "3 b: done",
        "10 a: done",
    ]


def test_a_recovery_that_nobody_wants_any_more_is_called_off(world: World) -> None:
    from eslang.runtime.failures import run_with_cleanup

    def slowly(one: Property) -> None:
        run_with_cleanup(lambda: world.sleep(9), lambda: (world.sleep(1), world.note("cleaned")))

    world.recoveries["p"] = slowly
    lines = world.run(
        a=tolerant(world, "p=1", 9),
        c=spoiling(world, 2),
        d=lambda: (world.sleep(3), world.abort("a"), world.give_way(), world.hold("p=2")()),
        e=lambda: (world.sleep(5), world.hold("p=2")()),
    )
    assert lines[4:] == [
        "3 d: :PROPERTY-LOCK-UNAVAILABLE p=2 p=1 #<TASK recovery>",
        "4 recovery: cleaned",
        "5 e: switch p=2",
        "6 e: in",
        "6 e: done",
    ]


def test_who_comes_while_a_recovery_is_called_off_has_it_tried_again(world: World) -> None:
    from eslang.runtime.failures import run_with_cleanup

    tries: list[float] = []

    def slowly(one: Property) -> None:
        tries.append(world.interp.clock.now())
        if len(tries) == 1:
            run_with_cleanup(lambda: world.sleep(9), lambda: world.sleep(1))
        world.set("p", "1")

    world.recoveries["p"] = slowly
    lines = world.run(
        a=tolerant(world, "p=1", 9),
        b=lambda: (world.sleep(3.5), world.hold("p=1")()),
        c=spoiling(world, 2),
        d=lambda: (world.sleep(3), world.abort("a")),
    )
    assert tries == [2, 4]
    assert lines[-2:] == ["4 b: in", "4 b: done"]


def test_an_aborted_recovery_has_failed(world: World) -> None:
    world.recoveries["p"] = lambda one: world.sleep(99)

    def abort() -> None:
        world.sleep(3)
        lock = world.locks.locks["p"]
        world.scheduler.lives.abort(lock.busy, "abort-task")  # type: ignore[arg-type]

    lines = world.run(a=tolerant(world, "p=1", 9), c=spoiling(world, 2), d=abort)
    assert lines[-1] == "3 a: :UNRECOVERABLE-PROPERTY-VIOLATION p=1"


def test_a_slow_recovery_does_not_hold_up_another_violation(world: World) -> None:
    world.recoveries["p"] = lambda one: world.sleep(50)
    lines = world.run(
        a=tolerant(world, "p=1", 9),
        b=tolerant(world, "q=1", 9),
        c=spoiling(world, 2),
        d=spoiling(world, 3, "q"),
    )
    assert "4 b: goes on" in lines


def test_a_recovery_may_need_what_is_recovered_as_well(world: World) -> None:
    world.recoveries["p"] = lambda one: (world.maintain("q=1"), world.switch(one))

    def trip() -> None:
        world.sleep(3)
        world.set("p", "0")
        world.set("q", "0")

    lines = world.run(a=tolerant(world, "q=1", 9), b=tolerant(world, "p=1", 9), c=trip)
    assert [line for line in lines if "on" in line] == [
        "4 a: goes on",
        "5 b: goes on",
        "10 a: done",
        "10 b: done",
    ]


def test_an_aborted_subscriber_does_not_make_the_daemon_recover(world: World) -> None:
    from eslang.runtime.failures import run_with_cleanup

    def body() -> None:
        run_with_cleanup(lambda: world.sleep(9), lambda: world.sleep(3))

    lines = world.run(
        a=lambda: world.maintain("p=1", body),
        c=spoiling(world, 2.5),
        d=lambda: (world.sleep(2), world.abort("a")),
    )
    assert lines == ["0 a: switch p=1", "2.5 c: p=0"]


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
