"""What a program of SCS may do (SCS Appendix C), said as simply as can be: every move that it allows.

A program is a term; a term that has begun is a state. A move takes one branch
of a state as far as its next action; at the end of it a failure goes outward
to whoever takes it, and the conditions around are asked, outermost first.
What does not follow from the text (who is chosen, whose turn it is, in which
order the branches of an abort clean up) is each of the possible ones. A branch
sees what others have changed when its turn comes, or at once.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from naive.steps import (
    Act,
    Await,
    Done,
    Group,
    Guarded,
    Notes,
    Steps,
    World,
    acted,
    entries,
    filled,
    lasts,
    solutions,
)

Path = tuple[int, ...]  # which branch of each parallel, from the outermost in
State = Any
Came = tuple[Notes, State]


# --- states --------------------------------------------------------------------------


class New(NamedTuple):
    """A step that has not begun."""

    term: Any


class Running(NamedTuple):
    """A sequence at one of its steps, a parallel in all of them, or a guarded step in its one."""

    term: Any
    parts: tuple[State, ...]
    number: int = 0


class Picking(NamedTuple):
    """A choice: what is deactivated, what has failed; the one that is under way, if one is."""

    term: Any
    off: frozenset[int] = frozenset()
    failed: tuple[tuple[int, Any], ...] = ()
    number: int = -1
    parts: tuple[State, ...] = ()


class Waiting(NamedTuple):
    """A step that waits."""

    term: Await


class Failing(NamedTuple):
    """A parallel that has left all its branches, since one failed with what it says."""

    term: Any
    what: Any


class Cleaning(NamedTuple):
    """What was left, and has yet to note some things before it is something else; others go on meanwhile."""

    notes: Notes
    then: State


LEAVES = New | Done | Waiting | Failing | Cleaning


# --- one move ------------------------------------------------------------------------


def go(state: State, world: World, path: Path) -> list[tuple[Notes, State, World]]:
    """What STATE comes to when its branch PATH goes on: as far as an action, or as a step that ends."""
    if isinstance(state, New):
        return begun(state.term, world, path)
    if isinstance(state, Failing):
        return [((), Done("failed", state.what), world)]
    if isinstance(state, Waiting):
        ended = Done("ok", state.term.name)
        return [((f"end {state.term.name}",), ended, world)] if ("lit",) in world.facts else []
    if isinstance(state, Cleaning):
        return [(state.notes[:1], cleaned(state.notes[1:], state.then), world)]
    if isinstance(state, Picking):
        return picked(state, world, path)
    kind = getattr(state.term, "kind", "guarded")
    if kind == "all":
        if all(isinstance(part, Done) for part in state.parts):
            return [((), Done("ok", "t"), world)]
        return inside(state, path[0], go(state.parts[path[0]], world, path[1:]))
    part = state.parts[0] if state.parts else None
    if part is not None and not isinstance(part, Done):
        return inside(state, 0, go(part, world, path))
    if kind == "guarded":
        return [((f"out {state.term.name}",), part, world)]
    return [((), following(state, part), world)]


def following(state: Running, part: Done | None) -> State:
    """The sequence STATE behind PART, which did not fail."""
    index = state.number + 1 if part is not None else 0
    if index < len(state.term.steps):
        return state._replace(number=index, parts=(New(state.term.steps[index]),))
    if state.term.kind == "repeat":
        return first_of(state.term)
    return Done("ok", part.what if part is not None and part.how == "ok" else None)


def first_of(term: Steps) -> Running:
    """A sequence at its first step."""
    return Running(term, (New(term.steps[0]),) if term.steps else ())


def inside(state: State, index: int, came: list[tuple[Notes, State, World]]) -> list[Any]:
    """What one part of STATE came to, within STATE."""
    return [(notes, with_part(state, index, part), world) for notes, part, world in came]


def with_part(state: State, index: int, part: State) -> State:
    """STATE, with another part."""
    return state._replace(parts=(*state.parts[:index], part, *state.parts[index + 1 :]))


def begun(term: Any, world: World, path: Path) -> list[tuple[Notes, State, World]]:
    """What becomes of TERM when it begins."""
    if isinstance(term, Act | Group):
        return [acted(term.acts if isinstance(term, Group) else (term,), world)]
    if isinstance(term, Await):
        return [((f"begin {term.name}",), Waiting(term), world)]
    if isinstance(term, Guarded):
        came = go(New(term.step), world, path)
        return [((f"in {term.name}", *notes), Running(term, (part,)), now) for notes, part, now in came]
    entered = entries(term, world)
    if not entered:
        return [((), Done("off"), world)]
    found: list[tuple[Notes, State, World]] = []
    for each in entered:
        if each.kind == "all":
            found.append(((), Running(each, tuple(map(New, each.steps))), world))
        else:
            state = Picking(each) if each.kind in ("any", "first", "best") else first_of(each)
            found += go(state, world, path) or [((), state, world)]
    return found


def picked(state: Picking, world: World, path: Path) -> list[tuple[Notes, State, World]]:
    """What a choice comes to: its alternative goes on, or has ended, or another one begins."""
    term = state.term
    if state.parts:
        part = state.parts[0]
        if not isinstance(part, Done):
            return inside(state, 0, go(part, world, path))
        if part.how == "ok":
            return [((), part, world)]
        return [((), state._replace(number=-1, parts=(), off=state.off | {state.number}), world)]
    if not available(state):
        failures = tuple(failure for _, failure in sorted(state.failed))
        is_failed = len(failures) == len(term.steps) and not term.starred
        return [((), Done("failed", ("all", *failures)) if is_failed else Done("off"), world)]
    found = []
    for index, body in candidates(state, world):
        chosen = state._replace(number=index, parts=(New(body),))
        found += inside(chosen, 0, go(New(body), world, path))
    return found


def available(state: Picking) -> list[int]:
    """The alternatives that are neither deactivated nor have failed."""
    failed = {index for index, _ in state.failed} if not state.term.starred else set()
    return [index for index in range(len(state.term.steps)) if index not in state.off | failed]


def candidates(state: Picking, world: World) -> list[tuple[int, Any]]:
    """The alternatives that may be chosen now, each with its step."""
    listed, steps = available(state), state.term.steps
    if state.term.kind == "any":
        return [(index, steps[index]) for index in listed]
    listed = [index for index in listed if solutions(steps[index].condition, world)]
    if state.term.kind == "first":
        listed = listed[:1]
    else:
        values = {index: value_of(steps[index].utility, world) for index in listed}
        listed = [index for index in listed if values[index] == max(values.values())]
    return [
        (index, body_of(filled(steps[index].steps, bindings)))
        for index in listed
        for bindings in solutions(steps[index].condition, world)
    ]


def value_of(utility: Any, world: World) -> int:
    """What UTILITY is now."""
    return int({"x": world.x, "-x": -world.x}.get(utility, utility))


def body_of(steps: tuple[Any, ...]) -> Any:
    """The steps of a clause, as one."""
    return steps[0] if len(steps) == 1 else Steps("do", False, (), steps)


# --- what follows from an action -----------------------------------------------------


def unwound(state: State) -> list[Came]:
    """STATE, when a failure that is in it has gone outward to what takes it."""
    if isinstance(state, LEAVES):
        return [((), state)]
    found: list[Came] = [((), state)]
    for index, part in enumerate(state.parts):
        found = [
            ((*notes, *more), with_part(whole, index, now))
            for notes, whole in found
            for more, now in unwound(part)
        ]
    return [((*notes, *more), now) for notes, whole in found for more, now in taken(whole)]


def taken(state: State) -> list[Came]:
    """STATE, when it has answered the failure of one of its parts."""
    index = next((at for at, part in enumerate(state.parts) if part[:1] == ("failed",)), None)
    if index is None:
        return [((), state)]
    failed, term = state.parts[index], state.term
    if isinstance(term, Guarded):
        return [((f"out {term.name}",), failed)]
    if isinstance(state, Picking) and (term.kind != "first" or term.starred):
        known = {**dict(state.failed), state.number: failed.what}
        return [((), Picking(term, failed=tuple(sorted(known.items()))))]
    if not term.starred:
        return left(state, Failing(term, failed.what)) if term.kind == "all" else [((), failed)]
    return [((), with_part(state, index, New(term.steps[index if term.kind == "all" else state.number])))]


def left(state: State, then: State) -> list[Came]:
    """STATE, when it is left, and is THEN when it has cleaned up."""
    return [((), cleaned(notes, then)) for notes in leavings(state)]


def cleaned(notes: Notes, then: State) -> State:
    """What is THEN, when NOTES are made."""
    return Cleaning(notes, then) if notes else then


def leavings(state: State) -> list[Notes]:
    """What STATE may note when it is left: innermost first; branches in any order."""
    if isinstance(state, LEAVES):
        return [state.notes if isinstance(state, Cleaning) else ()]
    found: list[Notes] = [()]
    for part in state.parts:
        found = [both for one in found for other in leavings(part) for both in mixed(one, other)]
    if isinstance(state.term, Guarded):
        found = [(*notes, f"out {state.term.name}") for notes in found]
    return found


def mixed(one: Notes, other: Notes) -> Iterator[Notes]:
    """ONE and OTHER, at the same time."""
    if not one or not other:
        yield one + other
        return
    yield from ((one[0], *rest) for rest in mixed(one[1:], other))
    yield from ((other[0], *rest) for rest in mixed(one, other[1:]))


def asked(state: State, world: World, path: Path) -> list[Came]:
    """STATE, when the conditions around its branch PATH were asked, outermost first."""
    if isinstance(state, New | Done | Waiting | Cleaning):
        return [((), state)]
    if not lasts(state.term, world):
        return left(state, Done("off"))
    if isinstance(state, Failing):
        return [((), state)]
    if isinstance(state, Picking) and state.parts and is_to_be_left(state, world):
        return left(state, Picking(state.term, failed=state.failed))
    index = 0
    if getattr(state.term, "kind", "") == "all":
        if not path:
            return [((), state)]
        index, *rest = path
        path = tuple(rest)
    if not state.parts:
        return [((), state)]
    return [(notes, with_part(state, index, part)) for notes, part in asked(state.parts[index], world, path)]


def is_to_be_left(state: Picking, world: World) -> bool:
    """Whether the alternative that is under way is no longer the one to do."""
    if state.term.kind == "any":
        return False
    clauses = state.term.steps
    earlier = [index for index in available(state) if index < state.number]
    return not solutions(clauses[state.number].condition, world) or (
        state.term.kind == "first" and any(solutions(clauses[index].condition, world) for index in earlier)
    )


# --- all moves -----------------------------------------------------------------------


def paths(state: State) -> list[Path]:
    """The branches of STATE that can go on."""
    if isinstance(state, LEAVES) or not state.parts:
        return [()]
    if getattr(state.term, "kind", "") != "all":
        return paths(state.parts[0])
    live = [index for index, part in enumerate(state.parts) if not isinstance(part, Done)]
    return [(index, *path) for index in live for path in paths(state.parts[index])] or [()]


def moves(state: State, world: World) -> Iterator[tuple[Notes, State, World]]:
    """All that may come next: the notes, and what is then. No action begins while a failure is on its way."""
    if isinstance(state, Done):
        return
    is_quiet = is_failing(state)
    for path in paths(state):
        for notes, now in asked(state, world, path):
            if now != state:
                yield notes, now, world
                continue
            for begun_notes, reached, after in go(state, world, path):
                if is_quiet and (after != world or any(note.startswith("begin") for note in begun_notes)):
                    continue
                for failed_notes, whole in unwound(reached):
                    for left_notes, last in asked(whole, after, path):
                        yield (*begun_notes, *failed_notes, *left_notes), last, after


def is_failing(state: State) -> bool:
    """Whether a parallel in STATE has failed, but not yet told."""
    if isinstance(state, LEAVES):
        return isinstance(state, Failing)
    return any(map(is_failing, state.parts))
