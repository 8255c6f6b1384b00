"""What to tell a person of a failure that nobody answered, and of a bug of ours.

The story of a failure is the runtime's (runtime/story.py): where it was
raised, which recovery procedures were asked, and the Lisp stack.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TextIO

from eslang.base.diagnostics import Diagnostic, Label
from eslang.base.failure import Failure
from eslang.base.printer import prin1
from eslang.base.render import render
from eslang.base.spans import Source, Span
from eslang.runtime.story import Asked, Frame, Place, Story
from eslang.tools.narrator import retries

SHOWN_FRAMES = 10  # of a deeper stack, as many at both ends together
FLAW = "This is a bug in eslang, not in your plan. Please send us what follows, and what brought it about."


def failure_text(failure: Failure) -> str:
    """The cause of FAILURE and its arguments."""
    parts = (failure.cause, *failure.arguments)
    return " ".join([part if isinstance(part, str) else prin1(part) for part in parts])


def place_of(failure: Failure) -> str:
    """Where FAILURE was raised, as file:line:column; empty if that is not known."""
    story: Story | None = failure.story
    return str(story.place) if story is not None and story.place is not None else ""


def wants_colour(stream: TextIO) -> bool:
    """True if STREAM is a terminal, and nobody asked for plain text (no-color.org)."""
    return stream.isatty() and not os.environ.get("NO_COLOR")


def failure_report(failure: Failure, colour: bool = False) -> str:
    """FAILURE in a few lines: where it was raised, with what, and who called whom."""
    story: Story | None = failure.story
    place = story.place if story is not None else None
    labels = (Label(span_of(place), "raised here"),) if place is not None else ()
    notes = stack_lines(story.stack) if story is not None else []
    message = failure_text(failure)
    if not notes:
        return f"failure: {message}"
    diagnostic = Diagnostic("failure", message, labels, notes=tuple(notes), severity="failure")
    return render(diagnostic, colour)


def span_of(place: Place) -> Span:
    """PLACE with its text, where the file can still be read."""
    try:
        with open(place.file, encoding="utf-8", errors="replace") as stream:
            text = stream.read()
    except OSError:
        text = ""
    return Span(Source(place.file, text), place.line, place.column, place.end_line, place.end_column)


def stack_lines(stack: Sequence[Frame]) -> list[str]:
    """The frames of a Lisp stack, innermost first; of a deep one both ends."""
    frames = list(stack)
    left_out = len(frames) - SHOWN_FRAMES
    width = max([len(frame.name) for frame in frames], default=0)
    lines = [f"in {frame.name.lower():<{width}}  {frame.place}" for frame in frames]
    if left_out > 1:
        half = SHOWN_FRAMES // 2
        lines[half:-half] = [f"... {left_out} more ..."]
    return lines


def why(failure: Failure | None) -> str:
    """All that is known of FAILURE: where, which procedures were asked, who called whom."""
    if failure is None:
        return "Nothing has failed yet.\n"
    story: Story | None = failure.story
    place = place_of(failure)
    lines = [f"{failure_text(failure)} was raised" + (f" at {place}" if place else "")]
    if story is None:
        return lines[0] + "\n"
    if story.asked:
        lines.append("Recovery procedures that were active, innermost first:")
        lines += asked_lines(story.asked)
    else:
        lines.append("No recovery procedure was active.")
    if story.stack:
        lines += ["The stack, innermost first:", *(f"  {line}" for line in stack_lines(story.stack))]
    return "\n".join(lines) + "\n"


def asked_lines(asked: Sequence[Asked]) -> list[str]:
    """One line for each recovery procedure: its cause, its place, and why it did not answer."""
    causes = [prin1(one.cause) for one in asked]
    places = [str(one.place or "") for one in asked]
    widths = max(map(len, causes)), max(map(len, places))
    return [
        f"  {cause:<{widths[0]}}  {place:<{widths[1]}}  {fate(one)}".rstrip()
        for one, cause, place in zip(asked, causes, places, strict=True)
    ]


def fate(asked: Asked) -> str:
    """Why a recovery procedure did not, or no longer, answer a failure."""
    if not asked.takes:
        return "is for another cause"
    times = "once" if asked.used == 1 else f"{asked.used} times"
    if not asked.used:
        return f"was not invoked ({retries(asked.left).lower()} left)"
    if asked.left == 0:
        return f"was invoked {times}, its retries are used up"
    return f"was invoked {times} ({retries(asked.left).lower()} left)"


def bug_report(bug: BaseException) -> str:
    """What to send us when we are wrong; only here Python frames are shown."""
    import platform
    from traceback import format_exception

    from eslang import __version__

    machine = f"eslang {__version__}, Python {platform.python_version()}, {platform.system()}"
    return f"esl: {FLAW}\n{machine}\n{''.join(format_exception(bug))}"
