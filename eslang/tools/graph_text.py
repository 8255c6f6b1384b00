"""The words in a box: a form as its author wrote it, on one line and not too long."""

from __future__ import annotations

from eslang.base.lists import Cons
from eslang.base.printer import WriteSettings, prin1
from eslang.base.spans import Span, Spans
from eslang.base.symbols import Value
from eslang.tools.columns import fitted, width
from eslang.tools.tokens import BLANK, tokens

WIDEST = 46  # columns of a line in a box
LONGEST = 400  # characters of a title
LARGEST = 4000  # characters of the text of one form that are looked at, where it is one line
MANY = 40  # lines of the text of one form that are looked at
PRINTED = WriteSettings(case="DOWNCASE", length=12, level=5)


def text_of(spans: Spans, holder: Cons, most: int = WIDEST) -> str:
    """The car of HOLDER as it is written; as it prints, if a macro has made it."""
    span = spans.element(holder)
    return cut(prin1(holder.car, PRINTED), most) if span is None else written(span, most)


def form_text(spans: Spans, form: Value, most: int = WIDEST) -> str:
    """FORM as it is written; as it prints, if it is an atom, or a macro has made it."""
    span = spans.of(form)
    return cut(prin1(form, PRINTED), most) if span is None else written(span, most)


def name_text(name: Value) -> str:
    """NAME in lower case, as people would type it."""
    return prin1(name, PRINTED)


def cut(text: str, most: int = WIDEST) -> str:
    """TEXT on one line, cut to MOST columns."""
    return fitted(" ".join(text.split()), most)


def written(span: Span, most: int) -> str:
    """What stands at SPAN, without comments, on one line, cut to MOST columns."""
    text = text_at(span)
    found: list[str] = []
    columns = 0
    for kind, start, end in tokens(text):
        piece = " " if kind in BLANK else text[start:end]
        if piece != " " or (found and found[-1] not in (" ", "(")):
            if kind == "close" and found and found[-1] == " ":
                found.pop()
            found.append(piece)
            columns += width(piece)
        if columns > 2 * most:
            break
    return cut("".join(found), most)


def text_at(span: Span) -> str:
    """The text of SPAN, if it is very long only its first lines."""
    if span.line == span.end_line:
        end = min(span.end_column - 1, span.column + LARGEST)
        return span.source.line(span.line)[span.column - 1 : end]
    last = min(span.end_line, span.line + MANY)
    lines = [span.source.line(number) for number in range(span.line, last + 1)]
    if last == span.end_line:
        lines[-1] = lines[-1][: span.end_column - 1]
    lines[0] = lines[0][span.column - 1 :]
    return "\n".join(lines)
