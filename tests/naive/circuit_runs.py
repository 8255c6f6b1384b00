"""Whole runs of programs of SCS, as tests/naive/circuits.py allows them.

The world changes by itself only while nothing can move: then the next of some
changes comes, as if time passed.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from naive.circuits import New, State, moves
from naive.steps import Done, Notes, World, changed

TICK = "tick"  # noted when time passes
Effects = tuple[tuple[Any, ...], ...]


class Run(NamedTuple):
    """What a program noted, and how it ended: as Done says, without the value of an ok."""

    notes: Notes
    how: str
    what: Any = None


class Point(NamedTuple):
    """How far a run is: how much it has noted, and what is to come."""

    noted: int
    state: State
    world: World
    changes: tuple[Effects, ...]


def next_points(point: Point) -> list[tuple[Notes, Point]]:
    """What may come next, each with what is noted."""
    noted, state, world, changes = point
    found = [
        (notes, Point(noted + len(notes), now, after, changes)) for notes, now, after in moves(state, world)
    ]
    if not found and not isinstance(state, Done):
        effects, *rest = changes
        found = [((TICK,), Point(noted + 1, state, changed(world, effects), tuple(rest)))]
    return found


def first_point(program: Any, world: World, changes: tuple[Effects, ...]) -> Point:
    """Where a run of PROGRAM begins. The last of CHANGES must end it."""
    return Point(0, New(program), world, changes)


def trouble(run: Run, program: Any, world: World, changes: tuple[Effects, ...]) -> str:
    """Why PROGRAM may not do RUN; nothing, if it may."""
    todo = [first_point(program, world, changes)]
    seen = set(todo)
    furthest = 0
    expected: set[str] = set()
    while todo:
        point = todo.pop()
        if isinstance(point.state, Done):
            expected_here = f"the end: {point.state.how} {point.state.what}"
            if point.noted == len(run.notes) and point.state == Done(run.how, run.what):
                return ""
            furthest, expected = noted(furthest, expected, point.noted, expected_here)
        for notes, after in next_points(point):
            if run.notes[point.noted : after.noted] != notes:
                furthest, expected = noted(furthest, expected, point.noted, " ".join(notes))
            elif after not in seen:
                seen.add(after)
                todo.append(after)
    found = [*run.notes[furthest:], f"the end: {run.how} {run.what}"]
    return f"after {run.notes[:furthest]}: found {found}, expected one of {sorted(expected)}"


def noted(furthest: int, expected: set[str], here: int, what: str) -> tuple[int, set[str]]:
    """How far the search has come, and what it expected there."""
    if here > furthest:
        return here, {what}
    return furthest, expected | {what} if here == furthest else expected


def every_run(program: Any, world: World, changes: tuple[Effects, ...]) -> set[Run]:
    """All runs of PROGRAM. There must be few."""
    return set(runs_from(first_point(program, world, changes), {}))


def runs_from(point: Point, known: dict[Point, list[Run]]) -> Iterator[Run]:
    """All that a run may note behind POINT, and how it ends."""
    if isinstance(point.state, Done):
        yield Run((), point.state.how, point.state.what)
        return
    if point not in known:
        known[point] = list(
            {
                rest._replace(notes=notes + rest.notes)
                for notes, after in next_points(point)
                for rest in runs_from(after, known)
            }
        )
    yield from known[point]
