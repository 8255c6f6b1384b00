"""Behaviour trees of py_trees, equal to the circuits that circuits.py measures.

What is equal: a memoryless Selector asks its children from the left at each
tick, as DO-FIRST has its conditions asked after each action, and leaves the
running one when an earlier one can run; a memoryless Sequence of a condition
and a step goes on with the step only while the condition holds, as a clause
or a `:while` does. A leaf that is an action counts it and is RUNNING: the
step is not at its end. One tick does one action, as one turn of the circuit.
The conditions look up what they need in a dict, which is py_trees's best
case: its blackboard takes longer.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from typing import Any

from tests.benchmarks.measure import Run


class Trees:
    """What makes trees, and their world: which gates are open, how many actions there were."""

    def __init__(self) -> None:
        import py_trees

        status = py_trees.common.Status
        self.composites = py_trees.composites
        self.all_of_them = py_trees.common.ParallelPolicy.SuccessOnAll(synchronise=False)
        self.open: dict[int, bool] = {0: True}
        self.actions = 0
        world = self

        class Gate(py_trees.behaviour.Behaviour):  # type: ignore[misc]
            """A condition."""

            number = 0

            def update(self) -> Any:
                """Ask whether the gate is open."""
                return status.SUCCESS if world.open.get(self.number) else status.FAILURE

        class Act(py_trees.behaviour.Behaviour):  # type: ignore[misc]
            """An action."""

            effect: Callable[[], None] | None = None

            def update(self) -> Any:
                """Do it once."""
                world.actions += 1
                if self.effect is not None:
                    self.effect()
                return status.RUNNING

        self.gate_class, self.act_class = Gate, Act

    def act(self, effect: Callable[[], None] | None = None) -> Any:
        """An action, which may have an effect."""
        made = self.act_class(name="act")
        made.effect = effect
        return made

    def guarded(self, number: int, step: Any) -> Any:
        """A step while a gate is open."""
        gate = self.gate_class(name=f"gate {number}")
        gate.number = number
        return self.composites.Sequence(name=f"while {number}", memory=False, children=[gate, step])

    def first(self, numbers: list[int], last: Any) -> Any:
        """The first of the clauses whose gate is open, or else the last, whose gate always is."""
        clauses = [self.guarded(number, self.act()) for number in numbers]
        return self.composites.Selector(
            name="first", memory=False, children=[*clauses, self.guarded(0, last)]
        )

    def nested(self, depth: int) -> Any:
        """An action under so many conditions."""
        tree = self.act()
        for _ in range(depth):
            tree = self.guarded(0, tree)
        return tree

    def turning(self) -> Any:
        """Ten clauses; the fifth shuts its gate, the last opens that."""

        def turn(is_open: bool) -> Callable[[], None]:
            return lambda: self.open.__setitem__(5, is_open)

        tree = self.first([1, 2, 3, 4, 5, 6, 7, 8, 9], self.act(turn(True)))
        tree.children[4] = self.guarded(5, self.act(turn(False)))
        tree.children[4].parent = tree
        return tree

    def side_by_side(self, count: int) -> Any:
        """So many actions in parallel."""
        acts = [self.act() for _ in range(count)]
        return self.composites.Parallel("all", policy=self.all_of_them, children=acts)

    def ticks(self, tree: Any, count: int) -> Run:
        """What ticks TREE so often, and tells how many actions that came to."""

        def run() -> int:
            before = self.actions
            for _ in range(count):
                tree.tick_once()
            return self.actions - before

        return run


def trees() -> Trees | None:
    """What makes trees, if py_trees is here."""
    return Trees() if importlib.util.find_spec("py_trees") else None
