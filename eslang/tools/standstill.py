"""A deadlock, laid out for people: who waits for what, where, and why that does not come.

What is known of it is the runtime's (runtime/deadlock.py). A task that only
waits for the tasks that it has started stands among them in the `in` line.
"""

from __future__ import annotations

from collections.abc import Iterator

from eslang.base.diagnostics import Diagnostic, Label
from eslang.base.spans import Source, Span
from eslang.runtime.deadlock import Deadlock, Waiting
from eslang.runtime.story import Place

FOR_OTHERS = ("tasks", "leaving")  # kinds of waits that are over when those of others are
MUTUAL = "each waits for the other; let one of them pass its checkpoint first"


def standstill(report: Deadlock, place: Place | None) -> Diagnostic:
    """The deadlock of REPORT, which was raised at PLACE."""
    stuck = [each for each in report.waiting if each.kind not in FOR_OTHERS] or list(report.waiting)
    over = [each for each in report.waiting if each not in stuck]
    count = "1 task waits" if len(stuck) == 1 else f"{len(stuck)} tasks wait"
    woken = "it" if len(stuck) == 1 else "them"
    at = place or next((each.place for each in stuck if each.place is not None), None)
    return Diagnostic(
        "deadlock",
        f"deadlock: {count}, and nothing can wake {woken}",
        (Label(bare_span(at)),) if at is not None else (),
        within="; ".join([f"{each.task}, which waits for {each.what}" for each in over]) or None,
        hint=hint(stuck),
        notes=tuple(lines(stuck)),
    )


def bare_span(place: Place) -> Span:
    """PLACE, without a text to show."""
    return Span(Source(place.file, ""), place.line, place.column, place.end_line, place.end_column)


def lines(stuck: list[Waiting]) -> Iterator[str]:
    """For each task a line, and one for the reason if there is any."""
    width = max([len(each.task) for each in stuck], default=0)
    waits = [f"waits for {each.what}" for each in stuck]
    reach = max([len(wait) for wait in waits], default=0)
    for each, wait in zip(stuck, waits, strict=True):
        yield f"{each.task:<{width}}  {wait:<{reach}}  {each.place or ''}".rstrip()
        if each.why:
            yield f"{'':<{width}}  {each.why}"


def hint(stuck: list[Waiting]) -> str | None:
    """What would end the deadlock."""
    could = [each for each in stuck if each.advice]
    if len(stuck) == 2 and all(each.kind == "checkpoint" and each.advice.endswith("first") for each in stuck):
        return MUTUAL
    hopeless = [each for each in could if not each.advice.endswith("first")]
    return (hopeless or could)[0].advice if could else None
