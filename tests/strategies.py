"""Hypothesis strategies that several tests share."""

from __future__ import annotations

from hypothesis import strategies as st

from programs.writer import program
from trees.writer import task_plan


def programs(depth: int = 4, *, failures: bool = True) -> st.SearchStrategy[str]:
    """Programs, as text: see tests/programs."""
    return st.randoms(use_true_random=False).map(lambda chance: program(chance, depth, failures=failures))


def task_plans(depth: int = 3, *, jumps: bool = True) -> st.SearchStrategy[str]:
    """Plans of tasks, as text: see tests/trees. Without JUMPS, only failures leave a form."""
    return st.randoms(use_true_random=False).map(lambda chance: task_plan(chance, depth, jumps=jumps))
