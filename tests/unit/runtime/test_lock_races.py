"""The races of the flight code, each forced by a schedule; and small plans under every schedule there is.

The Remote Agent's property locks had four: a change between the daemon's
look and its wait; a property undone between its achievement and the note of
it; an abort during a release; and two tasks that missed each other's signal.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from locking.schedules import every_schedule, judged
from locking.world import World


def forced(*choices: str) -> World:
    """A world in which the tasks have their turns in the order of CHOICES."""
    world = World(choices=choices)
    return judged(world, world.scheduler.choose)


def holding(world: World, properties: str) -> Callable[[], Any]:
    """The body of a task that maintains PROPERTIES for a while, and waits for recoveries."""

    def inside() -> None:
        world.note("in")
        world.sleep(3)
        world.note("done")

    return lambda: world.noting(lambda: world.tolerating(properties, inside))


# --- (a) the daemon decides to wait while the change that it waits for happens -----------


def test_a_change_while_the_daemon_gives_way_is_noticed() -> None:
    """The daemon has found P violated, and is about to look no more: then Q is violated."""
    world = forced("a", "b", "maintain-properties", "c", "a")

    def spoil() -> None:
        world.set("p", "0")
        world.give_way()
        world.set("q", "0")

    world.values.update(p="1", q="1")
    world.run(a=holding(world, "p=1"), b=holding(world, "q=1"), c=spoil)
    assert [line for line in world.changes if line.startswith(("violated", "recovered"))] == [
        "violated p=1 - (a)",
        "violated q=1 - (b)",
        "recovered p=1 recovery (a)",
        "recovered q=1 recovery.2 (b)",
    ]


def test_a_change_in_the_daemons_last_step_is_noticed() -> None:
    """P is restored before the daemon looks, so it ends; while it does, P is violated again."""
    world = World()
    ends: list[str] = []

    def hear(event: Any) -> None:
        if event.kind == "task-ended" and event.data["about"].name == "maintain-properties" and not ends:
            ends.append(event.data["about"].name)
            world.set("p", "0")

    def flicker() -> None:
        world.sleep(1)
        world.set("p", "0")
        world.set("p", "1")

    world.interp.hooks.listeners.append(hear)
    world.values.update(p="1")
    world.run(a=holding(world, "p=1"), b=flicker)
    assert ends
    assert "recovered p=1 recovery (a)" in world.changes


def test_a_change_while_the_daemon_looks_is_noticed() -> None:
    """Looking takes a turn: P is found true, and is violated before that is known."""
    world = World()
    look, looks = world.observe, []

    def slowly(one: Any, changed: Callable[[], None]) -> Any:
        looks.append(one)
        found = look(one, changed)
        if len(looks) == 2:
            world.sleep(1)
        return found

    def flicker() -> None:
        world.sleep(1)
        world.set("p", "0")
        world.set("p", "1")
        world.sleep(0.5)
        world.set("p", "0")

    world.keeper.observe = slowly
    world.values.update(p="1")
    world.run(a=holding(world, "p=1"), b=flicker)
    assert "recovered p=1 recovery (a)" in world.changes


# --- (b) a property is achieved, undone, and only then marked achieved -------------------


@pytest.mark.parametrize("tolerant", [True, False])
def test_a_property_that_is_undone_before_it_is_marked_is_found_violated(tolerant: bool) -> None:
    """ACHIEVE has found P true, and loses its turn; P is undone; then the owner marks it."""
    world = forced("a", "b", "c")
    world.locks.achieve = lambda one: (world.set("p", "1"), world.give_way())
    body = holding(world, "p=1") if tolerant else world.hold("p=1", 3)
    world.run(a=body, b=world.hold("p=1", 3), c=lambda: world.set("p", "0"))
    assert "violated p=1 - (a)" in world.changes
    assert "0 b: :MAINTAINED-PROPERTY-VIOLATION p=1" in world.lines
    assert ("1 a: goes on" if tolerant else "0 a: :MAINTAINED-PROPERTY-VIOLATION p=1") in world.lines


# --- (c) a task is aborted while it is releasing -----------------------------------------


@pytest.mark.parametrize("change", ["released p=1", "released q=1", "owned q=1", "subscribed p=1"])
def test_a_task_that_is_aborted_while_it_releases_leaves_nothing_behind(change: str) -> None:
    world = World()

    def hear(event: Any) -> None:
        if event.kind == "lock" and f"{event.data['change']} {event.data['property']}" == change:
            world.abort("a")

    world.interp.hooks.listeners.append(hear)
    world.values.update(p="1", q="1")
    world.run(a=lambda: world.maintain("p=1 q=1"), b=lambda: world.hold("q=1", 1)())
    assert world.lines == ["0 b: in", "1 b: done"]


def test_an_abort_between_leaving_the_body_and_the_next_turn_leaves_nothing_behind() -> None:
    from eslang.runtime.failures import run_with_cleanup

    world = forced("a", "b", "c", "a", "c", "b")

    def body() -> None:
        run_with_cleanup(lambda: world.fail("OUT"), world.give_way)

    world.values.update(p="1")
    world.run(
        a=lambda: world.noting(lambda: world.maintain("p=1", body)),
        b=lambda: world.maintain("p=1", world.give_way),
        c=lambda: world.abort("a"),
    )


# --- (d) two tasks compare, and then wait, missing each other's signal --------------------


def test_a_recovery_that_is_over_before_anybody_waits_for_it_is_not_waited_for() -> None:
    """The subscriber takes its time to decide that it will wait; the daemon is done by then."""
    world = World()

    def inside() -> None:
        world.sleep(1)
        world.note("done")

    def slowly() -> None:
        world.sleep(5)
        world.keeper.wait_for_recovery(wanted_p())
        world.note("goes on")

    def wanted_p() -> Any:
        return next(iter(world.locks.locks["p"].claims)).property

    world.values.update(p="1")
    lines = world.run(
        a=lambda: world.answering(
            "MAINTAINED-PROPERTY-VIOLATION", lambda: world.maintain("p=1", inside), slowly
        ),
        c=lambda: (world.sleep(0.5), world.set("p", "0")),
    )
    assert lines == ["0.5 recovery: switch p=1", "5.5 a: goes on", "5.5 a: done"]


@pytest.mark.parametrize("order", ["ab", "ba", "abba", "aab", "bba"])
def test_an_owner_that_is_done_before_another_waits_is_not_waited_for(order: str) -> None:
    """B has looked, and found P not achieved; the owner achieves it; B begins to wait, or does not."""
    world = forced(*order)
    world.methods["p"] = lambda one: (world.give_way(), world.set("p", "1"))
    world.run(a=world.hold("p=1"), b=world.hold("p=1"))
    assert sorted(world.lines) == ["0 a: done", "0 a: in", "0 b: done", "0 b: in"]


# --- every schedule -----------------------------------------------------------------------


def slow_owner(world: World) -> dict[str, Callable[[], Any]]:
    """An owner that achieves in two turns, one who waits, one who aborts the owner."""
    world.methods["p"] = lambda one: (world.give_way(), world.set("p", "1"), world.give_way())
    return {
        "a": holding(world, "p=1"),
        "b": holding(world, "p=1"),
        "c": lambda: (world.give_way(), world.abort("a")),
    }


def violated_twice(world: World) -> dict[str, Callable[[], Any]]:
    """One who waits for recoveries, one who does not, one who spoils the property twice."""
    world.values["p"] = "1"
    world.recoveries["p"] = lambda one: (world.give_way(), world.set("p", "1"))

    def spoil() -> None:
        for _ in range(2):
            world.set("p", "0")
            world.give_way()

    return {"a": holding(world, "p=1"), "b": world.hold("p=1", 3), "c": spoil}


def undone_and_aborted(world: World) -> dict[str, Callable[[], Any]]:
    """A property is undone while it is achieved, and its owner is aborted."""
    world.recoveries["p"] = lambda one: (world.give_way(), world.set("p", "1"))
    world.locks.achieve = lambda one: (world.set("p", "1"), world.give_way())
    return {
        "a": holding(world, "p=1"),
        "b": holding(world, "p=1"),
        "c": lambda: (world.set("p", "0"), world.abort("a")),
    }


def unrecoverable(world: World) -> dict[str, Callable[[], Any]]:
    """A recovery that fails, and one who comes meanwhile."""
    world.values["p"] = "1"
    world.recoveries["p"] = lambda one: (world.give_way(), world.fail("STUCK"))
    return {
        "a": holding(world, "p=1"),
        "b": lambda: (world.give_way(), world.give_way(), holding(world, "p=1")()),
        "c": lambda: world.set("p", "0"),
    }


def contrary(world: World) -> dict[str, Callable[[], Any]]:
    """Two who contradict each other, one of whom is aborted while it is being recovered."""
    world.values["p"] = "1"
    world.recoveries["p"] = lambda one: (world.give_way(), world.set("p", "1"))
    return {
        "a": holding(world, "p=1"),
        "b": lambda: (world.give_way(), world.hold("p=2")()),
        "c": lambda: (world.set("p", "0"), world.give_way(), world.abort("a")),
    }


@pytest.mark.slow
@pytest.mark.parametrize(
    "plan",
    [slow_owner, violated_twice, undone_and_aborted, unrecoverable, contrary],
    ids=lambda plan: plan.__name__,
)
def test_no_schedule_of_a_small_plan_goes_wrong(plan: Any) -> None:
    def judge(world: World) -> None:
        assert not [line for line in world.lines if ":DEADLOCK" in line], world.lines
        for name, task in world.tasks.items():
            assert task.status is not None, name

    assert every_schedule(plan, judge, depth=8) > 50
