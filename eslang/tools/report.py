"""What to tell a person of a failure that nobody answered, and of a bug of ours.

The story of a failure is the runtime's (runtime/story.py): where it was
raised, which recovery procedures were asked, and the Lisp stack.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, TextIO

from eslang.base.diagnostics import Diagnostic, Label
from eslang.base.failure import UNBOUND_VARIABLE, UNDEFINED_FUNCTION, Failure
from eslang.base.failure_text import message_of
from eslang.base.printer import prin1
from eslang.base.render import render
from eslang.base.spans import Source, Span
from eslang.base.suggest import nearest
from eslang.base.symbols import Symbol
from eslang.runtime.story import Asked, Place, Story
from eslang.tools.fact_hints import fact_hint
from eslang.tools.names import known_names
from eslang.tools.narrator import retries
from eslang.tools.stacks import passed_on, stack_lines

FLAW = "This is a bug in eslang, not in your plan. Please send us what follows, and what brought it about."


def failure_text(failure: Failure) -> str:
    """The cause of FAILURE and its arguments."""
    parts = (failure.cause, *failure.values)
    return " ".join([part if isinstance(part, str) else prin1(part) for part in parts])


def place_of(failure: Failure) -> str:
    """Where FAILURE was raised, as file:line:column; empty if that is not known."""
    return str(place_raised(failure) or "")


def wants_colour(stream: TextIO) -> bool:
    """True if STREAM is a terminal, and nobody asked for plain text (no-color.org)."""
    return stream.isatty() and not os.environ.get("NO_COLOR")


def failure_report(failure: Failure, interp: Any = None, colour: bool = False) -> str:
    """FAILURE in a few lines: where it was raised, with what, and who called whom."""
    place = place_raised(failure)
    first = passed_on(failure)[0]
    if first.report is not None:
        from eslang.tools.standstill import standstill

        return render(standstill(first.report, place), colour)
    message = failure_text(failure)
    if place is None:
        return f"failure: {message}"
    label = Label(span_of(place), sentence_of(failure) or "raised here")
    notes = tuple(stack_lines(failure, interp))
    hint = hint_for(failure, interp)
    return render(Diagnostic("failure", message, (label,), None, hint, notes, "failure"), colour)


def place_raised(failure: Failure) -> Place | None:
    """Where FAILURE was raised first, in whichever task, if that is known."""
    stories: list[Story] = [each.story for each in passed_on(failure) if each.story is not None]
    return next((story.place for story in stories if story.place is not None), None)


def sentence_of(failure: Failure) -> str:
    """What a failure of the host means, in words; empty for a plan's own failures."""
    words = message_of(failure)
    if words.startswith("Failure "):
        return ""
    begins_with_name = words[1:2].isupper()
    return (words[0] if begins_with_name else words[0].lower()) + words[1:].rstrip(".")


def hint_for(failure: Failure, interp: Any) -> str | None:
    """A hint: what may have been meant by a name that means nothing, or what a query needs."""
    if failure.cause not in (UNDEFINED_FUNCTION, UNBOUND_VARIABLE) or interp is None:
        return fact_hint(failure, interp)
    symbol = failure.values[0]
    if not isinstance(symbol, Symbol):
        return None
    if symbol.name.startswith("?") and failure.cause is UNBOUND_VARIABLE:
        return f"`#{symbol.name.lower()}` is its value, in a form that binds it (with-query-bindings, say)"
    if failure.cause is UNDEFINED_FUNCTION and interp.is_relation(symbol):
        return f"`{symbol.name.lower()}` is a relation: facts and queries that are data stand under a quote"
    package = package_with(symbol, interp)
    if package is not None:
        return (
            f"let package `{(symbol.package or '').lower()}` use `{package}`, where this name means something"
        )
    names = [name.lower() for name, _ in known_names(interp)]
    near = nearest(symbol.name.lower(), names)
    return f"the nearest name that is known is `{near}`" if near else None


def package_with(symbol: Symbol, interp: Any) -> str | None:
    """The package of the languages in which the name of SYMBOL, which is of another, means something."""
    for name in ("COMMON-LISP", "ESL", "SCS"):
        package = interp.image.packages[name]
        if symbol.name in package.external and package.find(symbol.name)[0] is not symbol:
            return name.lower()
    return None


def remark(failure: Failure, interp: Any) -> str:
    """One line for the prompt about a failure of the host, of which the papers tell nothing; else empty."""
    sentence = sentence_of(failure)
    parts = [sentence, hint_for(failure, interp), ":why tells more"]
    return "; " + "; ".join([part for part in parts if part]) if sentence else ""


def span_of(place: Place) -> Span:
    """PLACE with its text, where the file can still be read."""
    try:
        with open(place.file, encoding="utf-8", errors="replace") as stream:
            text = stream.read()
    except OSError:
        text = ""
    source, end = Source(place.file, text), place.end_column
    line = source.line(place.line)
    if place.end_line == place.line and line[place.column - 1 : end - 1] == "(":
        end = len(line) + 1  # the compiler gives only the start of some forms of many lines
    return Span(source, place.line, place.column, place.end_line, end)


def why(failure: Failure | None, interp: Any = None) -> str:
    """All that is known of FAILURE: where, which procedures were asked, who called whom."""
    if failure is None:
        return "Nothing has failed yet.\n"
    place = place_of(failure)
    stages = passed_on(failure)
    tasks = [each.origin.name for each in stages[1:]]
    lines = [f"{failure_text(failure)} was raised" + (f" at {place}" if place else "")]
    lines[0] += f", in task {tasks[0]}" if tasks else ""
    if stages[0].report is not None:
        lines = [failure_report(failure, interp)]
    lines += [text for text in (sentence_of(failure), hint_for(failure, interp)) if text]
    for each, task in zip(stages, [*tasks, ""], strict=True):
        if each.story is not None:
            lines += asked_of(each.story, task if len(stages) > 1 else "", bool(tasks))
    stack = stack_lines(failure, interp)
    if stack:
        lines += ["The stack, innermost first:", *(f"  {line}" for line in stack)]
    return "\n".join(lines) + "\n"


def asked_of(story: Story, task: str, several: bool) -> list[str]:
    """Which recovery procedures were asked, in TASK where SEVERAL have seen the failure."""
    where = f" in task {task}" if task else " where it was passed on to" if several else ""
    if not story.asked:
        return [f"No recovery procedure was active{where}."]
    return [f"Recovery procedures that were active{where}, innermost first:", *asked_lines(story.asked)]


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
