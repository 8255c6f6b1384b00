"""Property locks (ARM §4): whole traces. `1 a: in` is what task A noted at second 1."""

from __future__ import annotations

import pytest
from locking.world import World

from eslang import Failure


@pytest.fixture
def world() -> World:
    """A world of its own."""
    return World()


# --- the three outcomes ----------------------------------------------------------------


def test_the_first_subscriber_owns_the_lock_and_achieves_the_property(world: World) -> None:
    assert world.run(a=world.hold("p=1", 2)) == ["0 a: switch p=1", "1 a: in", "3 a: done"]
    assert world.changes == [
        "subscribed p=1 a (a)",
        "achieving p=1 a (a)",
        "achieved p=1 a (a)",
        "released p=1 a (-)",
    ]


def test_who_wants_the_same_value_waits_for_the_owner(world: World) -> None:
    lines = world.run(a=world.hold("p=1", 2), b=world.hold("p=1", 1))
    assert lines == ["0 a: switch p=1", "1 a: in", "1 b: in", "2 b: done", "3 a: done"]


def test_who_wants_another_value_fails_and_is_told_who_is_in_the_way(world: World) -> None:
    lines = world.run(a=world.hold("p=1"), b=world.hold("p=2"))
    assert lines[1] == "0 b: :PROPERTY-LOCK-UNAVAILABLE p=2 p=1 #<TASK a>"


def test_values_that_unify_are_compatible_and_each_is_achieved_in_its_turn(world: World) -> None:
    lines = world.run(a=world.hold("p=?", 9), b=world.hold("p=1", 1), c=world.hold("p=2"))
    assert lines == [
        "0 a: switch p=?",
        "0 c: :PROPERTY-LOCK-UNAVAILABLE p=2 p=1 #<TASK b>",
        "1 a: in",
        "1 b: switch p=1",
        "2 b: in",
        "3 b: done",
        "10 a: done",
    ]


def test_a_lock_that_was_left_is_free_for_another_value(world: World) -> None:
    def twice() -> None:
        world.hold("p=1")()
        world.hold("p=2")()

    assert world.run(a=twice)[-1] == "2 a: done"


def test_a_subscriber_whose_property_is_true_already_does_not_sleep(world: World) -> None:
    world.set("p", "1")
    told: list[str] = []
    world.interp.hooks.listeners.append(lambda event: told.append(event.kind))
    world.run(a=lambda: world.maintain("p=1 p=1", world.give_way), b=lambda: world.maintain("p=1"))
    assert "wait" not in told


# --- owners that fail, are aborted, or leave ---------------------------------------------


def test_if_the_owner_fails_to_achieve_all_subscribers_fail(world: World) -> None:
    world.methods["p"] = lambda one: (world.sleep(1), world.fail("STUCK", 3))
    lines = world.run(a=world.hold("p=1"), b=world.hold("p=1"), c=world.hold("p=?"))
    assert lines == [f"1 {name}: :CONDITION-NOT-ACHIEVED p=1 :STUCK 3" for name in "abc"]


def test_a_failure_that_achieve_itself_reports_is_not_told_twice(world: World) -> None:
    world.methods["p"] = lambda one: None
    assert world.run(a=world.hold("p=1")) == ["0 a: :CONDITION-NOT-ACHIEVED p=1"]


def test_the_failure_of_a_subscriber_knows_where_it_came_from(world: World) -> None:
    world.methods["p"] = lambda one: (world.give_way(), world.fail("STUCK"))
    seen: list[Failure] = []
    world.run(
        a=world.hold("p=1"),
        b=lambda: seen.append(world.answering("GENERAL-FAILURE", world.hold("p=1"))),
        c=lambda: seen.append(world.answering("GENERAL-FAILURE", lambda: world.maintain("p=1"))),
    )
    assert seen[-1].origin is world.tasks["a"]
    assert isinstance(seen[-1].__cause__, Failure)


def test_an_owner_that_is_aborted_while_achieving_leaves_that_to_the_next(world: World) -> None:
    lines = world.run(
        a=world.hold("p=1"), b=world.hold("p=1", 1), c=lambda: (world.sleep(0.5), world.abort("a"))
    )
    assert lines == ["0 a: switch p=1", "0.5 b: switch p=1", "1.5 b: in", "2.5 b: done"]
    assert "owned p=1 b (b)" in world.changes


def test_a_deadline_of_the_owner_is_no_failure_to_achieve(world: World) -> None:
    from eslang.runtime.guarding import run_until

    def hurried() -> None:
        world.noting(lambda: run_until(world.scheduler, 0.5, lambda: world.fail("LATE"), world.hold("p=1")))

    def inside() -> None:
        run_until(world.scheduler, 0.5, lambda: world.fail("LATE"), lambda: world.maintain("p=1"))

    lines = world.run(a=lambda: world.noting(inside), b=world.hold("p=1"))
    assert lines == ["0 a: switch p=1", "0.5 a: :LATE", "0.5 b: switch p=1", "1.5 b: in", "1.5 b: done"]
    world.lines.clear()
    world.set("p", None)
    assert world.run(c=hurried)[-1] == "2 c: :LATE"


def test_a_deadline_inside_the_method_is_one(world: World) -> None:
    from eslang.runtime.guarding import run_until

    world.methods["p"] = lambda one: run_until(
        world.scheduler, 0.5, lambda: world.fail("LATE"), lambda: world.sleep(9)
    )
    lines = world.run(a=world.hold("p=1"), b=world.hold("p=1"))
    assert lines == [f"0.5 {name}: :CONDITION-NOT-ACHIEVED p=1 :LATE" for name in "ab"]


def test_when_the_owner_leaves_the_next_subscriber_owns_the_lock(world: World) -> None:
    world.run(a=world.hold("p=1", 1), b=world.hold("p=1", 2), c=world.hold("p=1", 3))
    assert [line for line in world.changes if line.startswith("owned")] == [
        "owned p=1 b (b)",
        "owned p=1 c (c)",
    ]


def test_a_jump_out_of_the_body_releases_the_lock(world: World) -> None:
    lines = world.run(
        a=lambda: world.noting(lambda: world.maintain("p=1", lambda: world.fail("OUT"))),
        b=lambda: (world.sleep(1), world.give_way(), world.hold("p=2")()),
    )
    assert lines[1:3] == ["1 a: :OUT", "1 b: switch p=2"]


def test_a_cleanup_runs_before_the_lock_is_released(world: World) -> None:
    from eslang.runtime.failures import run_with_cleanup

    def body() -> None:
        run_with_cleanup(lambda: world.sleep(9), lambda: (world.sleep(1), world.note("cleaned")))

    lines = world.run(
        a=lambda: world.maintain("p=1", body),
        b=lambda: (world.sleep(2), world.abort("a"), world.give_way(), world.hold("p=2")()),
    )
    assert lines[1:] == ["2 b: :PROPERTY-LOCK-UNAVAILABLE p=2 p=1 #<TASK a>", "3 a: cleaned"]


# --- failures that are answered by running off the end -----------------------------------


def test_a_lock_that_cannot_be_had_may_be_done_without(world: World) -> None:
    lines = world.run(
        a=world.hold("p=1", 9),
        b=lambda: world.answering("PROPERTY-LOCK-UNAVAILABLE", world.hold("p=2 q=1"), lambda: None),
        c=lambda: world.answering(
            "PROPERTY-LOCK-UNAVAILABLE",
            lambda: world.maintain("q=1 p=2", lambda: world.note("in")),
            lambda: world.note("without"),
        ),
    )
    assert lines[1] == "0 b: :PROPERTY-LOCK-UNAVAILABLE p=2 p=1 #<TASK a>"  # answered inside first
    assert lines[2:5] == ["0 c: without", "0 c: switch q=1", "1 a: in"]
    assert lines[5] == "1 c: in"


def test_a_property_that_was_not_achieved_may_be_done_without(world: World) -> None:
    world.methods["p"] = lambda one: world.fail("STUCK")
    lines = world.run(
        a=lambda: world.answering(
            "CONDITION-NOT-ACHIEVED",
            lambda: world.maintain("p=1 q=1", lambda: world.note("in")),
            lambda: world.note("without"),
        )
    )
    assert lines == ["0 a: without", "0 a: switch q=1", "1 a: in"]


def test_nothing_is_held_while_a_failure_to_get_a_lock_is_answered(world: World) -> None:
    def patient() -> None:
        world.answering(
            "PROPERTY-LOCK-UNAVAILABLE", lambda: world.maintain("p=2 q=1"), lambda: world.sleep(5)
        )

    lines = world.run(a=world.hold("p=1", 9), b=patient, c=world.hold("q=2", 1))
    assert "2 c: done" in lines


# --- several properties ------------------------------------------------------------------


def test_several_properties_are_taken_at_once_and_achieved_in_the_order_of_the_text(world: World) -> None:
    lines = world.run(a=world.hold("q=1 p=1"), b=world.hold("p=1 q=1", 1))
    assert lines[:2] == ["0 a: switch q=1", "1 a: switch p=1"]
    assert world.changes[:2] == ["subscribed p=1 a (a)", "subscribed q=1 a (a)"]
    assert lines[2:] == ["2 a: in", "2 b: in", "2 a: done", "3 b: done"]


def test_if_one_of_several_cannot_be_had_none_is_achieved(world: World) -> None:
    lines = world.run(a=world.hold("q=1", 9), b=world.hold("p=1 q=2"))
    assert lines == [
        "0 a: switch q=1",
        "0 b: :PROPERTY-LOCK-UNAVAILABLE q=2 q=1 #<TASK a>",
        "1 a: in",
        "10 a: done",
    ]


def test_properties_that_contradict_each_other_are_refused(world: World) -> None:
    assert world.run(a=world.hold("p=1 p=2")) == ["0 a: :PROPERTY-LOCK-UNAVAILABLE p=2 p=1 #<TASK a>"]


def test_one_that_is_aborted_amid_several_leaves_all_to_the_next(world: World) -> None:
    lines = world.run(
        a=world.hold("p=1 q=1"),
        b=world.hold("q=1", 1),
        c=world.hold("p=1"),
        d=lambda: (world.sleep(0.5), world.abort("a")),
    )
    assert sorted(lines[1:3]) == ["0.5 b: switch q=1", "0.5 c: switch p=1"]
    assert sorted(lines[3:]) == ["1.5 b: in", "1.5 c: done", "1.5 c: in", "2.5 b: done"]


def test_a_failure_of_one_property_fails_who_is_still_busy_with_another(world: World) -> None:
    world.methods["q"] = lambda one: (world.sleep(0.5), world.fail("STUCK"))
    lines = world.run(a=world.hold("q=1"), b=world.hold("p=1 q=1"), c=world.hold("p=1"))
    assert lines == [
        "0 b: switch p=1",
        "0.5 a: :CONDITION-NOT-ACHIEVED q=1 :STUCK",
        "0.5 b: :CONDITION-NOT-ACHIEVED q=1 :STUCK",
        "0.5 c: switch p=1",
        "1.5 c: in",
        "1.5 c: done",
    ]


# --- one task, one lock, more than once ----------------------------------------------------


def test_a_task_may_take_a_lock_again_inside(world: World) -> None:
    lines = world.run(a=lambda: world.maintain("p=1", world.hold("p=1", 1)), b=world.hold("p=1", 3))
    assert lines == ["0 a: switch p=1", "1 a: in", "1 b: in", "2 a: done", "4 b: done"]


def test_a_task_cannot_want_the_contrary_of_what_it_maintains(world: World) -> None:
    lines = world.run(a=lambda: world.maintain("p=1", world.hold("p=2")))
    assert lines[1:] == ["1 a: :PROPERTY-LOCK-UNAVAILABLE p=2 p=1 #<TASK a>"]


def test_a_method_may_achieve_what_its_own_task_is_to_achieve_next(world: World) -> None:
    world.methods["p"] = lambda one: (world.maintain("q=1"), world.switch(one))
    lines = world.run(a=world.hold("p=1 q=1"), b=world.hold("q=1"))
    assert lines == [
        "0 a: switch q=1",
        "1 a: switch p=1",
        "1 b: in",
        "1 b: done",
        "2 a: in",
        "2 a: done",
    ]


def test_a_method_that_needs_what_it_is_to_achieve_fails(world: World) -> None:
    world.methods["p"] = lambda one: world.maintain("p=1")
    lines = world.run(a=world.hold("p=1"))
    assert lines == ["0 a: :CONDITION-NOT-ACHIEVED p=1 :CONTROL-ERROR what achieves p=1 needs it"]


def test_a_child_of_a_holder_is_a_subscriber_of_its_own(world: World) -> None:
    def parent() -> None:
        lives, me = world.scheduler.lives, world.scheduler.at_work()
        for text in ("p=1", "p=2"):
            child = lives.create(text, world.hold(text), me)
            child.seen = True
            lives.start(child, "spawned")
        world.sleep(2)

    lines = world.run(a=lambda: world.maintain("p=1", parent))
    assert lines == [
        "0 a: switch p=1",
        "1 p=1: in",
        "1 p=2: :PROPERTY-LOCK-UNAVAILABLE p=2 p=1 #<TASK a>",
        "1 p=1: done",
    ]


# --- circles -------------------------------------------------------------------------------


def test_methods_that_wait_for_one_another_are_a_deadlock_that_is_found_at_once(world: World) -> None:
    world.methods["p"] = lambda one: (world.sleep(1), world.maintain("q=1"), world.switch(one))
    world.methods["q"] = lambda one: (world.sleep(2), world.maintain("p=1"), world.switch(one))
    lines = world.run(a=world.hold("p=1"), b=world.hold("q=1"), other=lambda: world.sleep(99))
    assert lines[0].startswith("2 b: :CONDITION-NOT-ACHIEVED q=1 :DEADLOCK")
    assert lines[1].startswith("2 a: :CONDITION-NOT-ACHIEVED p=1 :CONDITION-NOT-ACHIEVED q=1")


# --- for those who look -----------------------------------------------------------------------


def test_holdings_tell_who_owns_and_who_waits(world: World) -> None:
    seen: list[tuple[str, str, bool, bool, str, float]] = []

    def look() -> None:
        for each in world.locks.holdings():
            seen.append(
                (str(each.lock), each.task.name, each.is_owner, each.waits, each.standing, each.since)
            )

    world.run(
        a=world.hold("p=1"),
        b=lambda: (world.sleep(0.5), world.hold("p=1")()),
        c=lambda: (world.sleep(0.7), look()),
    )
    assert seen == [
        ("p=1", "a", True, True, "wanted", 0.0),
        ("p=1", "b", False, True, "wanted", 0.5),
    ]


def test_a_listener_that_fails_leaves_no_lock_behind(world: World) -> None:
    def spoil(event: object) -> None:
        if getattr(event, "kind", "") == "lock" and event.data["change"] == "subscribed":  # type: ignore[attr-defined]
            raise ValueError("a listener's own trouble")

    world.interp.hooks.listeners.append(spoil)
    world.run(a=lambda: world.noting(lambda: world.maintain("p=1 q=1")))
    assert world.remains() == []


def test_who_waits_for_the_owner_achieves_what_the_owner_waits_for_itself(world: World) -> None:
    """C is the next owner of R, and waits for P; A achieves P, for which it needs R."""
    world.methods["p"] = lambda one: (world.maintain("r=1"), world.switch(one))
    lines = world.run(
        b=world.hold("r=1"),
        a=world.hold("p=1"),
        c=world.hold("p=1 r=1"),
        d=lambda: (world.sleep(0.5), world.abort("b")),
    )
    assert lines[1:3] == ["0.5 a: switch r=1", "1.5 a: switch p=1"]
    assert lines[-1] == "2.5 c: done"


def test_who_achieves_another_value_of_a_property_does_not_wait_for_its_recovery(world: World) -> None:
    def flicker(one: object) -> None:
        world.set("p", None)
        world.give_way()
        world.set("p", "2")

    world.methods["p"] = flicker
    world.values["p"] = "1"
    lines = world.run(a=lambda: world.tolerating("p=? p=2", lambda: world.note("in")), b=world.give_way)
    assert lines[-1].endswith("a: in")
