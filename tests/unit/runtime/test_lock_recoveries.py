"""Recoveries of maintained properties (ARM §4): who waits, who leaves, and when one is called off."""

from __future__ import annotations

import pytest
from locking.bodies import spoiling, tolerant
from locking.world import World

from eslang.runtime.claims import Property


@pytest.fixture
def world() -> World:
    """A world of its own."""
    return World()


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


def test_the_locks_of_tasks_that_have_gone_with_their_thread_are_free(world: World) -> None:
    from threading import Thread

    world.recoveries["p"] = lambda one: world.sleep(99)

    def live() -> None:
        with world.interp.door():
            world.interp.runs.enter(
                lambda: [
                    world.spawn("a", tolerant(world, "p=1", 99)),
                    world.spawn("b", tolerant(world, "q=1", 99)),
                    world.spawn("c", spoiling(world, 2)),
                    world.sleep(3),
                ]
            )

    thread = Thread(target=live)
    thread.start()
    thread.join()
    world.lines.clear()
    world.tasks.clear()
    lines = world.run(d=world.hold("p=2", 1), e=tolerant(world, "q=2", 9), f=spoiling(world, 3, "q"))
    assert [line.partition(": ")[2] for line in lines] == [
        *("switch p=2", "switch q=2", "in", "in", "done"),
        *("q=0", "waits for q=2", "switch q=2", "goes on", "done"),
    ]
