"""Plans that say in their comments what must come of them.

`; expect: LINE` is a line of output, `; expect trace: LINE` a line of the
narrator's, `; expect failure: :CAUSE ARGUMENT...` how the plan fails, and
`; expect error: NAME` the diagnostic that refuses it. They are compared in
order, blanks around them and blank lines left out. The output is expected
whole; so is the trace, where a text expects any of it.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from eslang.base.control import Stop
from eslang.base.diagnostics import EslError
from eslang.base.failure import Failure
from eslang.base.render import render
from eslang.tools.narrator import trace_line
from eslang.tools.report import failure_text

EXPECT = re.compile(r";+ expect(?: (?P<kind>\w+))?:(?P<rest>.*)$", re.MULTILINE)
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
    """What came of a run: the output, and how it ended."""

    def __init__(self, output: str = "") -> None:
        self.output = output
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
    found = [
        f"`; expect {kind}:` is not known (write one of {', '.join(KINDS)})" for kind in expected.unknown
    ]
    if came.stop is not None:
        found.append(f"the run was ended: {came.stop.reason}")
    found += error_troubles(expected.lines["error"], came.error)
    found += failure_troubles(expected.lines["failure"], came.failure)
    found += line_troubles("output", expected.lines["output"], squeezed(came.output.split("\n")))
    if expected.lines["trace"]:
        found += line_troubles("trace", expected.lines["trace"], squeezed(came.trace))
    return found


def error_troubles(names: list[str], error: EslError | None) -> list[str]:
    """What is wrong with the diagnostic ERROR, where one of NAMES is expected."""
    if error is not None and error.diagnostic.name not in names:
        return [render(error.diagnostic)]
    if error is None and names:
        return [f"expected the error `{names[-1]}`, but the program was accepted"]
    return []


def failure_troubles(texts: list[str], failure: Failure | None) -> list[str]:
    """What is wrong with FAILURE, where one of TEXTS is expected."""
    if failure is None:
        return [f"expected the failure `{texts[-1]}`, but nothing failed"] if texts else []
    shown = failure_text(failure)
    if shown in texts:
        return []
    return [f"failed with `{shown}`" + (f", expected `{texts[-1]}`" if texts else "")]


def squeezed(lines: list[str]) -> list[str]:
    """LINES without blanks around them, and without blank ones."""
    return [line.strip() for line in lines if line.strip()]


def line_troubles(what: str, expected: list[str], found: list[str]) -> list[str]:
    """Where the lines FOUND of WHAT first leave those EXPECTED."""
    for index in range(max(len(expected), len(found))):
        wanted = expected[index] if index < len(expected) else "(nothing more)"
        came = found[index] if index < len(found) else "(nothing more)"
        if wanted != came:
            return [f"line {index + 1} of the {what}:\n  expected  {wanted}\n  found     {came}"]
    return []
