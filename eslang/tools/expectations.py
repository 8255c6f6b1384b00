"""Plans that say in their comments what must come of them.

`; expect: LINE` is a line of output, `; expect trace: LINE` a line of the
narrator's, `; expect failure: :CAUSE [ARGUMENT...]` how the plan fails, and
`; expect error: NAME` the diagnostic that refuses it. They are compared in
order, blanks around them and blank lines left out. A text that expects some
line of output expects all of them; the same holds for the trace.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from eslang.base.control import Stop
from eslang.base.diagnostics import EslError
from eslang.base.failure import Failure
from eslang.base.printer import prin1
from eslang.base.render import render
from eslang.tools.narrator import trace_line

EXPECT = re.compile(r";+\s*expect(?: (?P<kind>\w+))?:(?P<rest>.*)$", re.MULTILINE)
KINDS = ("output", "trace", "failure", "error")


class Expected:
    """What the comments of a text expect, by kind."""

    def __init__(self, text: str) -> None:
        self.lines: dict[str, list[str]] = {kind: [] for kind in KINDS}
        self.unknown: list[str] = []
        for match in EXPECT.finditer(text):
            kind = match["kind"] or "output"
            if kind in self.lines:
                self.lines[kind].append(match["rest"].strip())
            else:
                self.unknown.append(kind)

    def __bool__(self) -> bool:
        return bool(self.unknown) or any(self.lines.values())


class Came:
    """What came of a run: the output, the trace, and how it ended."""

    def __init__(self) -> None:
        self.output = ""
        self.trace: list[str] = []
        self.failure: Failure | None = None
        self.error: EslError | None = None
        self.stop: Stop | None = None

    def hear(self, event: Any) -> None:
        """The listener that keeps the narrator's lines."""
        line = trace_line(event)
        if line is not None:
            self.trace.append(line)

    def of(self, work: Callable[[], object]) -> Came:
        """Do WORK, and keep how it ended."""
        try:
            work()
        except Failure as failure:
            self.failure = failure
        except EslError as error:
            self.error = error
        except Stop as stop:
            self.stop = stop
        return self


def troubles(expected: Expected, came: Came) -> list[str]:
    """What of EXPECTED did not come, and what came unexpected; empty if all is well."""
    found = [f"`; expect {kind}:` is not known (write one of {', '.join(KINDS)})" for kind in expected.unknown]
    if came.stop is not None:
        return [*found, f"the run was ended: {came.stop.reason}"]
    found += _end_troubles(expected, came)
    if expected and (expected.lines["output"] or not expected.lines["trace"]):
        found += compare_lines("output", expected.lines["output"], squeezed(came.output.split("\n")))
    if expected.lines["trace"]:
        found += compare_lines("trace", expected.lines["trace"], squeezed(came.trace))
    return found


def _end_troubles(expected: Expected, came: Came) -> list[str]:
    causes, names = expected.lines["failure"], expected.lines["error"]
    found = []
    if came.error is not None:
        if came.error.diagnostic.name not in names:
            found.append(render(came.error.diagnostic).rstrip())
    elif names:
        found.append(f"expected the error `{names[0]}`, but the program was accepted")
    if came.failure is not None:
        shown = failure_text(came.failure)
        if not any(cause in (shown, shown.split(" ")[0]) for cause in causes):
            wanted = f", expected `{causes[0]}`" if causes else ""
            found.append(f"failed with `{shown}`{wanted}")
    elif causes:
        found.append(f"expected the failure `{causes[0]}`, but nothing failed")
    return found


def failure_text(failure: Failure) -> str:
    """The cause of FAILURE and its arguments."""
    return " ".join([prin1(failure.cause), *(prin1(argument) for argument in failure.arguments)])


def squeezed(lines: list[str]) -> list[str]:
    """LINES without blanks around them, and without blank ones."""
    return [line.strip() for line in lines if line.strip()]


def compare_lines(what: str, expected: list[str], found: list[str]) -> list[str]:
    """Where FOUND first leaves EXPECTED; empty if it does not."""
    for index in range(max(len(expected), len(found))):
        wanted = expected[index] if index < len(expected) else "(nothing more)"
        came = found[index] if index < len(found) else "(nothing more)"
        if wanted != came:
            return [f"line {index + 1} of the {what}:\n  expected  {wanted}\n  found     {came}"]
    return []
