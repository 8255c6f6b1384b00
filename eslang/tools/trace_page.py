"""A trace as one page for a browser, which needs nothing else."""

from __future__ import annotations

from eslang.tools.trace_reading import Trace


def page(trace: Trace) -> str:
    """TRACE as a page."""
    return ""
