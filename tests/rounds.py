"""Plans that go through numbers and tools, and what comes of them."""

from __future__ import annotations

from eslang.tools.expectations import failure_text
from support import run

NUMBERS = "(dotimes (i 3) (assert (list 'n i)))"
TOOLS = "(assert '(tool saw)) (assert '(tool drill))"


def came_to(text: str) -> tuple[list[str], str]:
    """What TEXT prints, and how it fails."""
    came = run(text)
    failure = "no failure" if came.failure is None else failure_text(came.failure)
    return [line.strip() for line in came.output.split("\n") if line.strip()], failure
