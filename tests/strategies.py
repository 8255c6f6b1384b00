"""Hypothesis strategies that several tests share."""

from __future__ import annotations

from hypothesis import strategies as st

from programs.writer import program


def programs(depth: int = 4, *, failures: bool = True) -> st.SearchStrategy[str]:
    """Programs, as text: see tests/programs."""
    return st.randoms(use_true_random=False).map(lambda chance: program(chance, depth, failures=failures))
