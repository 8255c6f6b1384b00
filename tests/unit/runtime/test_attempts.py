"""Attempts: what counts as the failure of some work, and what goes outward."""

from __future__ import annotations

from typing import Any

import pytest
from locking.world import Body, World

from eslang import Failure, Keyword
from eslang.runtime.attempts import attempt
from eslang.runtime.guarding import run_until
from eslang.runtime.tasks import Interrupt


@pytest.fixture
def world() -> World:
    """A world of its own."""
    return World()


def attempted(world: World, work: Body) -> str:
    """What an attempt of WORK gives; behind a slash, what went outward instead."""
    found: list[Any] = []

    def body() -> None:
        found.append(attempt(world.scheduler.at_work(), work))

    out = []
    world.run(a=lambda: out.append(world.answering("GENERAL-FAILURE", body)))
    return f"{found[0]}" if found else f"/{out[0]}"


def test_work_that_ends_has_no_failure(world: World) -> None:
    assert attempted(world, lambda: 5) == "None"


def test_a_failure_that_nothing_inside_answers_is_that_of_the_work(world: World) -> None:
    assert attempted(world, lambda: world.fail("STUCK", 3)) == "failure :STUCK 3"


def test_an_error_of_python_is_one_as_well(world: World) -> None:
    assert attempted(world, lambda: {}["x"]).startswith("failure :PYTHON-ERROR")


def test_a_failure_that_is_answered_inside_is_none(world: World) -> None:
    def work() -> None:
        world.answering("STUCK", lambda: world.fail("STUCK"), lambda: None)

    assert attempted(world, work) == "None"


def test_a_deadline_inside_is_a_failure_of_the_work(world: World) -> None:
    def work() -> None:
        run_until(world.scheduler, 1.0, lambda: world.fail("LATE"), lambda: world.sleep(9))

    assert attempted(world, work) == "failure :LATE"


def test_a_deadline_outside_goes_outward(world: World) -> None:
    def work() -> None:
        attempt(world.scheduler.at_work(), lambda: world.sleep(9))
        world.note("never")

    found = []
    world.run(
        a=lambda: found.append(
            world.answering("LATE", lambda: run_until(world.scheduler, 1.0, lambda: world.fail("LATE"), work))
        )
    )
    assert [str(each) for each in found] == ["failure :LATE"]
    assert world.lines == []


def test_an_interrupt_from_another_task_goes_outward(world: World) -> None:
    def disturb() -> None:
        world.sleep(1)
        interrupt = Interrupt("interrupt-task", lambda: world.fail("STOP"))
        world.scheduler.interrupt(world.tasks["a"], interrupt)

    def body() -> None:
        world.note(str(attempt(world.scheduler.at_work(), lambda: world.sleep(9))))

    world.run(a=lambda: world.noting(body), b=disturb)
    assert world.lines == ["1 a: :STOP"]


def test_a_deadlock_amid_the_work_is_its_failure(world: World) -> None:
    from eslang.runtime.events import Event

    def body() -> None:
        failure = attempt(world.scheduler.at_work(), lambda: world.scheduler.wait_for(Event("never")))
        world.note(str(failure and failure.cause))

    world.run(a=body)
    assert world.lines == ["0 a: :DEADLOCK"]


def test_a_jump_goes_outward(world: World) -> None:
    from eslang.base.control import Throw

    def body() -> None:
        try:
            attempt(world.scheduler.at_work(), lambda: (_ for _ in ()).throw(Throw("here", 5)))
        except Throw as jump:
            world.note(str(jump.value))

    world.run(a=body)
    assert world.lines == ["0 a: 5"]


def test_the_failure_that_is_given_is_the_one_that_was_made(world: World) -> None:
    made = Failure(Keyword("STUCK"))

    def work() -> None:
        raise made

    found: list[Any] = []
    world.run(a=lambda: found.append(attempt(world.scheduler.at_work(), work)))
    assert found == [made]
