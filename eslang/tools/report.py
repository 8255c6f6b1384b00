"""What to tell a person of a failure that nobody answered, and of a bug of ours."""

from __future__ import annotations

from typing import Any

from eslang.base.failure import Failure
from eslang.base.printer import prin1

SHOWN_FRAMES = 8


def place_of(failure: Failure) -> str:
    """Where FAILURE was raised, as file:line:column; empty if that is not known."""
    story = failure.story
    return str(story.place) if story is not None and story.place else ""


def failure_report(failure: Failure) -> str:
    """FAILURE in a few lines: where it was raised, with what, and who called whom."""
    where = place_of(failure)
    shown = " ".join(prin1(part) for part in (failure.cause, *failure.arguments))
    lines = [(f"{where}: " if where else "") + f"failure: {shown}"]
    return "\n".join([*lines, *stack_lines(failure.story)]) + "\n"


def stack_lines(story: Any) -> list[str]:
    """The frames of STORY, innermost first; of a deep stack only both ends."""
    frames = list(story.stack) if story is not None else []
    return [f"  in {frame}" for frame in frames]


def why(failure: Failure | None) -> str:
    """What is known of FAILURE: where, who was asked, who called whom."""
    if failure is None:
        return "Nothing has failed yet.\n"
    return failure_report(failure)


def bug_report(bug: BaseException) -> str:
    """What to send us when we are wrong; only here Python frames are shown."""
    import platform
    from traceback import format_exception

    from eslang import __version__

    frames = "".join(format_exception(bug))
    return (
        "esl: this is a bug in eslang, not in your plan. Please send us what follows,\n"
        "and the form or plan that brought it about.\n\n"
        f"eslang {__version__}, Python {platform.python_version()}, {platform.system()}\n{frames}"
    )
