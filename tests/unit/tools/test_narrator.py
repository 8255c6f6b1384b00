"""The papers' trace lines, to the letter."""

from __future__ import annotations

from typing import Any, NamedTuple

import pytest

from eslang.base.failure import Failure
from eslang.base.lists import lisp_list
from eslang.base.symbols import Symbol
from eslang.tools.narrator import trace_line


class Event(NamedTuple):
    kind: str
    data: dict[str, Any]


BROKEN = Failure("widget-broken")
GOAL = lisp_list(Symbol("widget-ok?"))


@pytest.mark.parametrize(
    ("kind", "told", "line"),
    [
        (
            "recovery",
            {"failure": BROKEN, "left": 2},
            "Failure :WIDGET-BROKEN, recovery available. (2 retries)",
        ),
        ("recovery", {"failure": BROKEN, "left": 1}, "Failure :WIDGET-BROKEN, recovery available. (1 retry)"),
        (
            "recovery",
            {"failure": BROKEN, "left": 0},
            "Failure :WIDGET-BROKEN, recovery available. (No retries)",
        ),
        (
            "recovery",
            {"failure": BROKEN, "left": None},
            "Failure :WIDGET-BROKEN, recovery available. (Infinite retries)",
        ),
        ("failure", {"failure": BROKEN}, "Failure :WIDGET-BROKEN, no recovery available."),
        ("aborted", {}, "Aborted"),
        ("goal", {"state": "no-action", "condition": GOAL}, "(WIDGET-OK?) achieved. (No action needed.)"),
        ("goal", {"state": "attempting", "condition": GOAL}, "Attempting to achieve (WIDGET-OK?)"),
        ("goal", {"state": "achieved", "condition": GOAL}, "(WIDGET-OK?) achieved."),
        ("task", {}, None),
    ],
)
def test_each_event_has_the_line_of_the_papers(kind: str, told: dict[str, Any], line: str | None) -> None:
    assert trace_line(Event(kind, told)) == line
