"""Chance is fair (SCS Appendix C, §3 "Nondeterministic Behavior"): chi-square over seeds.

The seeds are fixed, so that a test says the same each time; the critical
values are those of one error in a thousand.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable

import pytest
from circuits.running import Stage

from naive.steps import Act, Clause, Clauses, Steps, World

pytestmark = pytest.mark.slow
CRITICAL = {1: 10.83, 2: 13.82, 3: 16.27, 5: 20.52, 7: 24.32}  # by degrees of freedom
SEEDS = range(600)
ALWAYS = ("t",)
NAMES = ("a1", "a2", "a3")


@pytest.fixture(scope="module")
def stage() -> Stage:
    """One interpreter for all programs."""
    return Stage()


def notes_of(stage: Stage, program: object, left: int = 1000) -> list[tuple[str, ...]]:
    """What PROGRAM notes, for each seed."""
    stage.prepare(program)
    return [stage.run(World(left=left), (), seed).notes for seed in SEEDS]


def is_fair(found: Iterable[object], count: int) -> bool:
    """Whether what was FOUND is each of COUNT things equally often, as far as can be told."""
    counts = Counter(found)
    expected = counts.total() / count
    distance = sum((number - expected) ** 2 for number in counts.values()) / expected
    distance += (count - len(counts)) * expected
    return len(counts) <= count and distance < CRITICAL[count - 1]


def choice(kind: str, starred: bool, acts: list[Act]) -> object:
    """A choice among ACTS, none of which is better than another."""
    if kind == "any":
        return Steps("any", starred, (), tuple(acts))
    return Clauses(kind, starred, (), tuple(Clause(ALWAYS, 1, (act,)) for act in acts))


def failing(names: Iterable[str]) -> list[Act]:
    """Actions that fail."""
    return [Act(name, fails=ALWAYS) for name in names]


@pytest.mark.parametrize("starred", [False, True])
@pytest.mark.parametrize("kind", ["any", "best"])
def test_each_alternative_is_as_likely(stage: Stage, kind: str, starred: bool) -> None:
    assert is_fair(notes_of(stage, choice(kind, starred, [Act(name) for name in NAMES])), 3)


@pytest.mark.parametrize("kind", ["any", "best"])
def test_alternatives_that_fail_are_tried_in_every_order(stage: Stage, kind: str) -> None:
    found = notes_of(stage, choice(kind, False, failing(NAMES)))
    assert is_fair(found, 6) and len(set(found)) == 6


@pytest.mark.parametrize("kind", ["any", "best"])
def test_a_starred_choice_forgets_what_has_failed(stage: Stage, kind: str) -> None:
    found = notes_of(stage, until_over(choice(kind, True, failing(NAMES[:2]))), left=3)
    assert is_fair(found, 8) and len(set(found)) == 8


def until_over(step: object) -> object:
    """STEP, until as many actions were done as the world allows."""
    return Steps("do", False, (("until", ("fact", "over")),), (step,))


def test_only_the_best_are_chosen_among(stage: Stage) -> None:
    clauses = tuple(
        Clause(ALWAYS, utility, (Act(name),)) for name, utility in zip(NAMES, (2, 1, 2), strict=True)
    )
    assert is_fair(notes_of(stage, Clauses("best", False, (), clauses)), 2)


@pytest.mark.parametrize("starred", [False, True])
def test_each_branch_is_as_likely_to_be_first(stage: Stage, starred: bool) -> None:
    found = notes_of(stage, Steps("all", starred, (), tuple(map(Act, NAMES))))
    assert is_fair(found, 6) and len(set(found)) == 6


def test_after_each_action_each_branch_is_as_likely_to_go_on(stage: Stage) -> None:
    branches = [
        Steps("do", False, (), tuple(Act(f"{name}{number}") for number in range(6))) for name in "bcd"
    ]
    found = notes_of(stage, Steps("all", False, (), tuple(branches)))
    turns = [tuple(note[0] for note in notes[:3]) for notes in found]
    assert is_fair((turn[0] for turn in turns), 3)
    for first in "bcd":
        assert is_fair((turn[1] for turn in turns if turn[0] == first), 3)
        for second in "bcd":
            assert is_fair((turn[2] for turn in turns if turn[:2] == (first, second)), 3)


def test_each_branch_that_fails_has_its_turns_as_the_others(stage: Stage) -> None:
    program = until_over(Steps("all", True, (), tuple(failing(NAMES[:2]))))
    found = notes_of(stage, program, left=3)
    assert is_fair(found, 8) and len(set(found)) == 8
