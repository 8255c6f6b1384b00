"""Mistakes in a program, as data; render.py alone lays them out.

An error belongs to the program's author and has a place; a bug is ours. What
a plan did not manage is a Failure (failure.py) and not of this kind.
"""

from __future__ import annotations

from eslang.base.hints import NamedTuple
from eslang.base.spans import Span


class Label(NamedTuple):
    """A place to point at, and a few words beside the caret."""

    span: Span
    text: str = ""


class Diagnostic(NamedTuple):
    """One mistake: its kebab-case name, what is wrong, where, and what to do."""

    name: str
    message: str
    labels: tuple[Label, ...] = ()  # the first is where line one points
    within: str | None = None  # `= in`: the construct and definition around it
    hint: str | None = None  # `= hint`: one action
    notes: tuple[str, ...] = ()  # lines between the excerpt and the hint, two spaces in
    severity: str = "error"  # or "warning"


class EslError(Exception):
    """The program is wrong (exit code 65)."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic)
        self.diagnostic = diagnostic

    def __str__(self) -> str:
        from eslang.base.render import render

        return render(self.diagnostic)


class IncompleteInput(EslError):
    """The text ends inside a form: more of it may still come."""


def error_at(
    name: str,
    message: str,
    span: Span | None,
    label: str = "",
    *,
    within: str | None = None,
    hint: str | None = None,
) -> EslError:
    """The EslError for one mistake at one place."""
    labels = (Label(span, label),) if span is not None else ()
    return EslError(Diagnostic(name, message, labels, within, hint))
