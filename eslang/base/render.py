"""Diagnostic -> text: the only place that lays a diagnostic out.

Line one is complete by itself and can be clicked; then the user's own lines,
each label's caret under the very character it means (tabs, wide and combining
characters included); then notes, and at most three `=` lines. What the words
say is the business of whoever found the mistake.
"""

from __future__ import annotations

from eslang.base.diagnostics import Diagnostic, Label
from eslang.base.spans import Source, Span

WIDEST = 100  # columns of a source line that are shown; a longer one is cut round the caret
BEFORE = 30  # columns of context kept before the caret of a cut line

_RED, _BLUE, _YELLOW, _BOLD, _PLAIN = "\x1b[1;31m", "\x1b[34m", "\x1b[1;33m", "\x1b[1m", "\x1b[0m"
_TURNING = "\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"  # they reorder a terminal's line


def render(diagnostic: Diagnostic, colour: bool = False) -> str:
    """The text of DIAGNOSTIC, without a newline behind its last line."""
    lines = [_first_line(diagnostic, colour)]
    labels = _shown_labels(diagnostic)
    margin = max([len(str(label.span.line)) for label in labels], default=1)
    if labels:
        lines.append(_dim(" " * margin + " |", colour))
        lines += _excerpts(labels, margin, colour)
    lines += [f"  {clean(note)}" for note in diagnostic.notes]
    for word, text in _closing(diagnostic):
        lines.append(_dim(" " * margin + f" = {word:<4}", colour) + f"  {clean(text)}")
    return "\n".join(lines)


def clean(text: str) -> str:
    """TEXT with every character that could disturb a terminal replaced by a visible one."""
    if text.isascii() and text.isprintable():
        return text
    return "".join([_visible(char) for char in text])


def _visible(char: str) -> str:
    if char < " ":
        return chr(0x2400 + ord(char))
    if char == "\x7f":
        return "\u2421"
    if "\x80" <= char <= "\x9f" or "\ud800" <= char <= "\udfff" or char in _TURNING:
        return "\ufffd"
    return char


def _first_line(diagnostic: Diagnostic, colour: bool) -> str:
    place = f"{clean(str(diagnostic.labels[0].span))}: " if diagnostic.labels else ""
    severity, message = f"{diagnostic.severity}:", clean(diagnostic.message)
    if colour:
        tint = _YELLOW if diagnostic.severity == "warning" else _RED
        return f"{_BOLD}{place}{tint}{severity}{_PLAIN} {_BOLD}{message}{_PLAIN}"
    return f"{place}{severity} {message}"


def _shown_labels(diagnostic: Diagnostic) -> list[Label]:
    """The labels that get an excerpt; beside notes, a label without words only gives the place."""
    if diagnostic.notes and not any(label.text for label in diagnostic.labels):
        return []
    return [label for label in diagnostic.labels if label.span.source.text]


def _closing(diagnostic: Diagnostic) -> list[tuple[str, str]]:
    """The `=` lines. Several labels or notes tell the whole story: no `more` then."""
    lines = []
    if diagnostic.within:
        lines.append(("in", diagnostic.within))
    if diagnostic.hint:
        lines.append(("hint", diagnostic.hint))
    if len(diagnostic.labels) < 2 and not diagnostic.notes:
        lines.append(("more", f"esl explain {diagnostic.name}"))
    return lines


def _excerpts(labels: list[Label], margin: int, colour: bool) -> list[str]:
    """The user's lines with carets: the first label's file first, each file from top to bottom."""
    primary = labels[0]
    first = primary.span.source
    ordered = sorted(labels, key=lambda label: _order(label.span, first))
    lines: list[str] = []
    shown: tuple[object, ...] | None = None
    source = first
    for label in ordered:
        span = label.span
        if span.source is not source:
            source = span.source
            lines.append(_dim(" " * margin + f" : {clean(str(span))}", colour))
        text, column, length = _window(label)
        if shown != (source, span.line, text):
            shown = (source, span.line, text)
            lines.append(_dim(f"{span.line:>{margin}} |", colour) + (f" {text}" if text else ""))
        caret = f"{' ' * column}{'^' * length} {clean(label.text)}".rstrip()
        if colour:
            caret = f"{_RED if label is primary else _BLUE}{caret}{_PLAIN}"
        lines.append(_dim(" " * margin + " |", colour) + f" {caret}")
    return lines


def _order(span: Span, first: Source) -> tuple[bool, str, int, int]:
    return span.source is not first, span.source.name, span.line, span.column


def _window(label: Label) -> tuple[str, int, int]:
    """A label's line as it is shown, and the column (from 0) and length of its caret there."""
    span = label.span
    line = span.source.line(span.line)
    last = span.end_column if span.end_line == span.line else len(line.rstrip()) + 1
    cells = _cells(line)
    start = _columns(cells, span.column - 1)
    length = max(_columns(cells, last - 1) - start, 1)
    if _columns(cells, len(line)) <= WIDEST:
        return "".join([text for text, _ in cells]).rstrip(), start, length
    return _cut(cells, start, length)


def _cut(cells: list[tuple[str, int]], start: int, length: int) -> tuple[str, int, int]:
    """The part of a long line round its caret; an ellipsis stands for what was cut."""
    left, right = max(start - BEFORE, 0), max(start - BEFORE, 0) + WIDEST
    shown, column, begin = "", 0, right
    for text, width in cells:
        if left <= column and column + width <= right:
            begin = min(begin, column)
            shown += text
        column += width
    if column > right:
        shown += "…"
    if left == 0:
        return shown, start, min(length, right - start)
    return "…" + shown, start - begin + 1, min(length, right - start)


def _cells(line: str) -> list[tuple[str, int]]:
    """Each character of LINE as it is shown, with its width in columns."""
    if line.isascii() and line.isprintable():
        return [(char, 1) for char in line]
    from unicodedata import category, east_asian_width

    cells = []
    column = 0
    for char in line:
        shown, width = _visible(char), 1
        if char == "\t":
            width = 8 - column % 8
            shown = " " * width
        elif shown == char and east_asian_width(char) in "WF":
            width = 2
        elif shown == char and category(char) in ("Mn", "Me", "Cf"):
            width = 0
        cells.append((shown, width))
        column += width
    return cells


def _columns(cells: list[tuple[str, int]], count: int) -> int:
    """How many columns the first COUNT characters take; behind the line's end, one each."""
    return sum([width for _, width in cells[:count]]) + max(count - len(cells), 0)


def _dim(text: str, colour: bool) -> str:
    return f"{_BLUE}{text}{_PLAIN}" if colour else text
