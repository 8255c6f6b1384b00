"""The listener that speaks the papers' trace lines (ESL §2.3, §3).

It writes to the value of *TRACE-OUTPUT*, each line on a line of its own. The
lines are normative text: they stay as the papers print them. Where the papers
show no line (a clause without limit), the wording follows theirs.
"""

from __future__ import annotations

from eslang.base.hints import Any
from eslang.base.printer import prin1
from eslang.base.running import running
from eslang.base.symbols import Symbol, Value

TRACE_OUTPUT = Symbol.intern("*TRACE-OUTPUT*", "COMMON-LISP")


def narrate(event: Any) -> None:
    """Write the line of EVENT, if it is one that the papers tell."""
    line = trace_line(event)
    if line is not None:
        say(line)


def narrate_ends(event: Any) -> None:
    """Write the lines of failures that nobody answered, and no others: the quiet prompt."""
    if event.kind in ("failure", "aborted"):
        narrate(event)


def say(line: str) -> None:
    """Write LINE to the trace output of the interpreter at work."""
    stream = running.session.image.cell(TRACE_OUTPUT).value
    stream.fresh_line()
    stream.write(line + "\n")


def trace_line(event: Any) -> str | None:
    """The papers' line for EVENT; None where they have none."""
    kind, told = event.kind, event.data
    if kind == "recovery":
        return f"Failure {prin1(told['failure'].cause)}, recovery available. ({retries(told['left'])})"
    if kind == "failure":
        return f"Failure {prin1(told['failure'].cause)}, no recovery available."
    if kind == "aborted":
        return "Aborted"
    if kind == "goal":
        return _goal_line(told["state"], told["condition"])
    return None


def retries(left: int | None) -> str:
    """How many retries are LEFT, in the papers' words; None is no limit."""
    if left is None:
        return "Infinite retries"
    if left == 0:
        return "No retries"
    return "1 retry" if left == 1 else f"{left} retries"


def _goal_line(state: str, condition: Value) -> str:
    shown = prin1(condition)
    if state == "no-action":
        return f"{shown} achieved. (No action needed.)"
    if state == "attempting":
        return f"Attempting to achieve {shown}"
    return f"{shown} achieved."
