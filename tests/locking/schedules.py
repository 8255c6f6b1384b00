"""Schedules: every order in which the tasks of a small plan can take turns, one after the other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from io import StringIO
from typing import Any

from eslang import Interpreter
from eslang.base.control import Stop
from locking.world import World

Plan = Callable[[World], dict[str, Callable[[], Any]]]


class Schedule:
    """One order of turns: indices, as far as they are told, then always the first; and what was chosen."""

    def __init__(self, course: list[int]) -> None:
        self.course = course
        self.choices: list[tuple[int, int]] = []  # what was chosen at each step, of how many

    def __call__(self, ready: Sequence[Any]) -> int:
        """The index of the one that is chosen among the READY."""
        step = len(self.choices)
        index = self.course[step] if step < len(self.course) else 0
        self.choices.append((index, len(ready)))
        return index

    def following(self, depth: int) -> list[int]:
        """The course behind this one: of its first DEPTH choices the last is another that can be."""
        choices = self.choices[:depth]
        while choices and choices[-1][0] + 1 == choices[-1][1]:
            choices.pop()
        return [*[index for index, _ in choices[:-1]], choices[-1][0] + 1] if choices else []


def every_schedule(plan: Plan, judge: Callable[[World], None], depth: int) -> int:
    """Run what PLAN makes of a world by every schedule; JUDGE looks. How many there were.

    After DEPTH choices the ready take turns: else a schedule might never let one have its turn.
    """
    count, course = 0, [0]
    with Interpreter(clock="virtual", output=StringIO()) as interp:
        while course:
            schedule = Schedule(course)
            world = judged(World(interp), schedule)
            world.run(**plan(world))
            judge(world)
            interp.hooks.listeners.clear()
            count += 1
            course = schedule.following(depth)
    return count


def judged(world: World, choose: Callable[[Sequence[Any]], int] | None) -> World:
    """WORLD, where turns are given by CHOOSE, and what must always be so is looked at all the time."""
    world.scheduler.choose = choose
    world.interp.hooks.listeners.append(lambda event: inspect(world, event))
    return world


def inspect(world: World, event: Any) -> None:
    """End the run if anything is as it must not be when EVENT is told."""
    found = wrongs(world) if event.kind in ("wait", "resume", "task-ended") else []
    if event.kind == "deadlock":
        found.append(f"everybody waits: {event.data['failure']}")
    if found:
        world.scheduler.ticks.stop(Stop("; ".join(found), 70))


def wrongs(world: World) -> list[str]:
    """What is as it must not be between two steps."""
    found = []
    for lock in world.locks.locks.values():
        values = [claim.property for claim in lock.claims]
        if not lock.subscriptions and lock.busy is None:
            found.append(f"{lock.key} is locked by nobody")
        if any(not world.compatible(one, other) for one in values for other in values):
            found.append(f"{lock.key} is to have values that contradict each other")
        if any(each.task.status is not None for each in lock.subscriptions):
            found.append(f"a task that has ended is subscribed to {lock.key}")
        for claim in lock.claims:
            seen = claim in world.keeper.suspects or claim in world.keeper.unsteady
            noticed = seen and world.keeper.daemon is not None
            if claim.standing == "achieved" and not (world.holds(claim.property) or noticed):
                found.append(f"nobody has noticed that {claim.property.text} is violated")
    return found
