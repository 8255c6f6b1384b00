"""Tokens that are none: what the grammar's terminals do not match, explained.

Such a text is a string or name that never ends, a NUL character, or syntax
behind a `#` that does not exist here.
"""

from __future__ import annotations

import re

from eslang.base.diagnostics import Diagnostic, EslError, IncompleteInput, Label, error_at
from eslang.base.spans import Source, Span
from eslang.reader.tables import WRONG, tables

Place = tuple[int, int]  # line, column

_STRING = re.compile(r'"(?:[^"\\\0]|\\[^\0])*')
_NAME = re.compile(r"(?:[^\s()\"';`,|\\\0]|\\[^\0]|\|(?:[^|\\\0]|\\[^\0])*\|)*")
_BARRED = re.compile(r"\|(?:[^|\\\0]|\\[^\0])*")
_DISPATCH = re.compile(r"#[0-9]*")
_COMMENT_EDGE = re.compile(r"#\||\|#|\0")

# What Common Lisp has behind a `#` and we have not: what to do instead.
_ELSEWHERE = {
    "S": "call the constructor of the structure",
    "C": None,
    "P": "write the file's name as a string",
    "A": "call `make-array`",
    "*": "write a vector, `#(1 0 1)`",
    "=": None,
    "#": None,
    "<": None,
    "(": "write `#(…)` without a length",
}


def place_at(source: Source, offset: int) -> Place:
    """Line and column of an offset."""
    return source.text.count("\n", 0, offset) + 1, offset - source.text.rfind("\n", 0, offset)


def point(source: Source, place: Place, length: int = 1) -> Span:
    """LENGTH characters of one line."""
    line, column = place
    return Span(source, line, column, line, column + length)


def never_closed(
    name: str, what: str, source: Source, opened: Place, hint: str, length: int = 1
) -> IncompleteInput:
    """A string, symbol or comment that the text ends in."""
    end = place_at(source, len(source.text.rstrip()))
    labels = (
        Label(point(source, opened, length), "opened here"),
        Label(point(source, end, 0), f"the {kind_of(source)} ends here"),
    )
    return IncompleteInput(Diagnostic(name, f"this {what} is never closed", labels, hint=hint))


def kind_of(source: Source) -> str:
    """What people call a source of that name."""
    return "text" if source.name.startswith(("<", "-")) else "file"


def explain_broken(source: Source, offset: int, begin: int) -> EslError:
    """The diagnostic for the text at OFFSET, where no token begins, in a form read from BEGIN on."""
    char = source.text[offset]
    if char == "\0":
        return nul_character(source, offset)
    if char == "#":
        return _explain_dispatch(source, offset)
    if char == '"':
        offset = _likely_string(source, begin, offset)
        return _cut_off(source, offset, _STRING, "unclosed-string", "string", 'add `"` where it should end')
    return _explain_name(source, offset)


def _likely_string(source: Source, begin: int, offset: int) -> int:
    """Where the string began whose end is missing, if that is earlier than OFFSET.

    A string over several lines with a name right behind its end has most
    likely ended at the beginning of the next one.
    """
    text = source.text
    while (found := tables().pattern.match(text, begin)) is not None and found.end() < offset:
        kind = found.lastgroup or WRONG
        start, begin = found.span(kind)
        if kind == "BLOCK":
            begin = pass_comment(source, start)
        elif kind == WRONG:
            break
        elif kind == "STRING" and "\n" in found[kind] and text[begin].isalnum():
            return start
    return offset


def _explain_name(source: Source, offset: int) -> EslError:
    """A symbol or number in which `|` or `\\` begins something that does not end."""
    found = _NAME.match(source.text, offset)
    assert found is not None
    stop = found.end()
    if source.text.startswith("|", stop):
        return _cut_off(source, stop, _BARRED, "unclosed-bar", "`|`", "add `|` where the name should end")
    if source.text.startswith("\\\0", stop):
        return nul_character(source, stop + 1)
    span = point(source, place_at(source, stop))
    return IncompleteInput(Diagnostic("missing-form", "no character follows `\\`", (Label(span),)))


def _cut_off(
    source: Source, offset: int, pattern: re.Pattern[str], name: str, what: str, hint: str
) -> EslError:
    """What begins at OFFSET and ends with the text, or at a NUL."""
    found = pattern.match(source.text, offset)
    assert found is not None
    nul = source.text.find("\0", found.end(), found.end() + 2)
    if nul >= 0:
        return nul_character(source, nul)
    return never_closed(name, what, source, place_at(source, offset), hint)


def nul_character(source: Source, offset: int) -> EslError:
    """A NUL in a text."""
    span = point(source, place_at(source, offset))
    return error_at("nul-character", "there is a NUL character in this text", span, "", hint="take it out")


def pass_comment(source: Source, offset: int) -> int:
    """The offset behind the block comment that begins at OFFSET; these nest."""
    opened = []
    for edge in _COMMENT_EDGE.finditer(source.text, offset):
        if edge[0] == "#|":
            opened.append(edge.start())
        elif edge[0] == "|#":
            opened.pop()
            if not opened:
                return edge.end()
        else:
            raise nul_character(source, edge.start())
    place = place_at(source, opened[-1])
    raise never_closed("unclosed-comment", "comment", source, place, "add `|#` where it should end", length=2)


def _explain_dispatch(source: Source, offset: int) -> EslError:
    found = _DISPATCH.match(source.text, offset)
    assert found is not None
    stop = found.end()
    sign = source.text[offset : stop + 1]
    span = point(source, place_at(source, offset), len(sign))
    what = source.text[stop : stop + 1].upper()
    numbered = stop > offset + 1
    if what and ((what in ":?XBO" and not numbered) or (what == "R" and numbered)):
        name = _NAME.match(source.text, stop + 1)
        assert name is not None
        if source.text[name.end() : name.end() + 1] in ("|", "\\", "\0"):
            return _explain_name(source, stop + 1)
        thing = "number" if what in "XBOR" else "name"
        label = Label(span, f"expected a {thing} right behind it")
        diagnostic = Diagnostic("missing-form", f"no {thing} follows `{sign}`", (label,))
        return (IncompleteInput if stop + 1 == len(source.text) else EslError)(diagnostic)
    if what == "\0" or (what == "\\" and source.text.startswith("\0", stop + 1)):
        return nul_character(source, source.text.index("\0", stop))
    if not what or (what == "\\" and not numbered):
        return IncompleteInput(Diagnostic("missing-form", f"the text ends behind `{sign}`", (Label(span),)))
    return error_at(
        "unknown-hash-syntax",
        f"there is no syntax `{sign.rstrip()}`" if what.isspace() else f"there is no syntax `{sign}` here",
        span,
        "",
        hint=_ELSEWHERE.get(what),
    )
