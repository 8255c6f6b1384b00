"""What a syntax mistake is called, and how it is told.

The reader says where it stuck: in which state of the grammar, before which
token. Examples of each mistake, run through the same tables, tell the mistakes
apart; no message knows a state or a terminal. A text that ends too early gets
labels at both ends: where something was opened, and where the text stops.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from functools import cache

from eslang.base.diagnostics import Diagnostic, EslError, IncompleteInput, Label
from eslang.base.hints import NamedTuple
from eslang.base.spans import Span
from eslang.reader.atoms import Unreadable
from eslang.reader.broken import Place, kind_of, pass_comment, place_at, point
from eslang.reader.tables import END, WRONG, tables


class Stuck(NamedTuple):
    """Where the reader cannot go on."""

    state: int
    kind: str  # what is there: a terminal of the grammar, or END
    span: Span
    before: str  # the token before it, if that waits for a form
    opened: list[Place]  # the lists that are open, outermost first
    begin: int  # the offset at which the reading of this form began
    last: Place  # the end of the token before


class Example(NamedTuple):
    """A mistake in its shortest form, its name, and what to say of it."""

    text: str
    name: str
    message: str
    label: str = ""
    hint: str | None = None


EXAMPLES = (
    Example(")", "stray-close", "this `)` closes nothing", "no list is open here", "take it out"),
    Example("')", "missing-form", "no form follows `{before}`", "expected a form here"),
    Example("#.)", "missing-form", "no form follows `{before}`", "expected a form here"),
    Example("#+)", "missing-form", "no feature follows `{before}`", "expected a feature here"),
    Example("#+a)", "missing-form", "no form follows the feature", "expected a form here"),
    Example(".", "misplaced-dot", "this dot stands outside of any list"),
    Example("(.", "misplaced-dot", "this dot has nothing before it", "expected an element first"),
    Example("(a .)", "misplaced-dot", "no form follows the dot", "expected a form here"),
    Example("(a . b c", "misplaced-dot", "more than one form follows the dot", "expected `)` here"),
    Example("(a . b .", "misplaced-dot", "this list has a second dot", "expected `)` here"),
    Example("#(.", "misplaced-dot", "a vector has no dot"),
    Example("#(a .", "misplaced-dot", "a vector has no dot"),
)


@cache
def _catalogue() -> dict[tuple[int, str | None], Example]:
    """The example for each state and token, and for a state whatever the token (None)."""
    found: dict[tuple[int, str | None], Example] = {}
    for example in EXAMPLES:
        state, kind = _stuck_at(example.text)
        found[state, kind] = example
        found.setdefault((state, None), example)
    return found


def _stuck_at(text: str) -> tuple[int, str]:
    """The state and the token at which the grammar refuses TEXT."""
    pattern, paths, rules, start, _ = tables()
    states, offset = [start], 0
    while True:
        found = pattern.match(text, offset)
        assert found is not None and found.lastgroup is not None
        kind, offset = found.lastgroup, found.end()
        if kind not in paths[states[-1]]:
            return states[-1], kind
        states.append(paths[states[-1]][kind])
        while (rule := rules[states[-1]]) is not None:
            del states[-rule.size :]
            states.append(paths[states[-1]][rule.origin])


def explain(stuck: Stuck) -> EslError:
    """The diagnostic for a token that cannot stand where it does, or for a text that ends there."""
    if stuck.kind == END:
        return _unclosed_list(stuck) if stuck.opened else _ends_before_a_form(stuck)
    found = _catalogue()
    example = found.get((stuck.state, stuck.kind)) or found[stuck.state, None]
    diagnostic = Diagnostic(
        example.name,
        example.message.format(before=stuck.before),
        (Label(stuck.span, example.label),),
        hint=example.hint,
    )
    source = stuck.span.source
    at_end = stuck.kind == "DOT" and place_at(source, len(source.text)) == stuck.span[3:]
    return IncompleteInput(diagnostic) if at_end else EslError(diagnostic)


def explain_token(wrong: Unreadable, span: Span, at_end: bool) -> EslError:
    """The diagnostic for a token that means nothing; AT_END, where it may be but the half of one."""
    diagnostic = Diagnostic(wrong.name, wrong.message, (Label(span, wrong.label),), hint=wrong.hint)
    return IncompleteInput(diagnostic) if at_end else EslError(diagnostic)


def _ends_before_a_form(stuck: Stuck) -> IncompleteInput:
    example = _catalogue()[stuck.state, None]
    label = Label(point(stuck.span.source, stuck.last, 0), f"the {kind_of(stuck.span.source)} ends here")
    message = example.message.format(before=stuck.before)
    return IncompleteInput(Diagnostic(example.name, message, (label,)))


def _unclosed_list(stuck: Stuck) -> IncompleteInput:
    """The innermost open list, or rather the one that the indentation shows to have been meant."""
    source, missing = stuck.span.source, len(stuck.opened)
    opened, words = stuck.opened[-1], "opened here"
    behind, count = stuck.last, missing
    slip = _find_slip(stuck)
    if slip is not None:
        opened, words = slip.opened, f"opened here, but line {slip.line} is not indented as a part of it"
        behind, count = slip.behind, min(slip.lists, missing)
    short = f"{'one' if missing == 1 else missing} `)` short"
    labels = (
        Label(point(source, opened), words),
        Label(point(source, stuck.last, 0), f"the {kind_of(source)} ends here, {short}"),
    )
    hint = f"add `{')' * min(count, 20)}` after {behind[0]}:{behind[1] - 1}"
    return IncompleteInput(Diagnostic("unclosed-list", "this list is never closed", labels, hint=hint))


class _Slip(NamedTuple):
    """A line that is not indented as a part of the list that it stands in."""

    opened: Place
    line: int
    behind: Place  # the end of the token before that line
    lists: int  # how many lists should have been closed there


def _find_slip(stuck: Stuck) -> _Slip | None:
    """The first element that begins a line, no farther right than the list that holds it."""
    pattern, source = tables().pattern, stuck.span.source
    text = source.text
    breaks = [found.start() for found in re.finditer("\n", text)]

    def place(offset: int) -> Place:
        line = bisect_left(breaks, offset)
        return line + 1, offset - (breaks[line - 1] if line else -1)

    opened: list[Place] = []
    offset = stuck.begin
    behind = place(offset)
    while (found := pattern.match(text, offset)) is not None:
        kind = found.lastgroup or WRONG
        if kind in (END, WRONG):
            break
        start, offset = found.span(kind)
        if kind == "BLOCK":
            offset = pass_comment(source, start)
            continue
        line, column = place(start)
        if opened and line > behind[0] and kind != "CLOSE" and column <= opened[-1][1]:
            late = [other for other in opened if other[1] >= column and other[0] < line]
            return _Slip(opened[-1], line, behind, len(late))
        if kind in ("OPEN", "VECTOR"):
            opened.append((line, column))
        elif kind == "CLOSE":
            opened.pop()
        behind = place(offset)
    return None
