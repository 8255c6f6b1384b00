"""Laws of the reader: what holds for any text."""

from __future__ import annotations

from collections.abc import Iterator

from hypothesis import given
from hypothesis import strategies as st

from eslang.base.decoding import decode
from eslang.base.diagnostics import EslError, IncompleteInput
from eslang.base.image import PACKAGE, Image
from eslang.base.lists import Cons
from eslang.base.printer import prin1
from eslang.base.resolve import resolve_in
from eslang.base.spans import Source, Span
from eslang.base.symbols import Symbol, Value
from eslang.reader.reader import Reading, read_at, read_forms

IMAGE = Image()
IMAGE.cell(PACKAGE).value = IMAGE.packages["ESL-USER"]
RESOLVE = resolve_in(IMAGE)

PIECES = r"""
( ) ' ` , ,@ #' #( #? #: #\ #x #b #36r #+ #- #. #| |# | \ " ; . .. : :: + - / 1 e 5 a B
esl cl nil t foo #S #1= # #< ä 日
"""
LEAVES = r"""
a foo-bar :key esl::x |b| a\(b nil t 1+ - 5 -3. 1/2 .5 1e3 1.5d0 #xFF #b-1/10 #36rZ #\a #\( #\Space
"" "x\"y" #:g #?v () #() 'q #'f
"""
BLANKS = [" ", "\n", "\t ", " ; note\n", " #| a #| ) |# ( |# "]

pieces = st.sampled_from([*PIECES.split(), " ", "\n", "\r", "\t", "\0", "\ufeff", "\u00a0"])
texts = st.one_of(st.text(), st.lists(pieces).map("".join))
blanks = st.sampled_from(BLANKS)
leaves = st.sampled_from([*LEAVES.split(), '"two\nlines"', "|odd one|", "#\\ "])


def gathered(children: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    """Lists, vectors and quotations of CHILDREN, with blanks of all kinds between them."""
    several = st.lists(st.tuples(children, blanks).map("".join), min_size=1, max_size=4).map("".join)
    return st.one_of(
        several.map("({})".format),
        several.map("#({})".format),
        st.tuples(several, blanks, children).map(lambda parts: "({}.{}{})".format(*parts)),
        st.tuples(st.sampled_from(["'", "`", "#'", "#+eslang ", "#+no (x) "]), children).map("".join),
    )


forms = st.recursive(leaves, gathered, max_leaves=12)
programs = st.lists(st.tuples(forms, blanks).map("".join), max_size=4).map("".join)


def anywhere(package: str | None, name: str, external_only: bool) -> Symbol:
    """Every name is a symbol of the package that it names."""
    return Symbol.intern(name, package or "ESL-USER")


def read_all(text: str) -> list[Reading]:
    """All the forms of TEXT."""
    return list(read_forms(Source("<law>", text), anywhere))


def text_of(span: Span) -> str:
    """What stands at SPAN."""
    lines = span.source.text.split("\n")[span.line - 1 : span.end_line]
    lines[-1] = lines[-1][: span.end_column - 1]
    lines[0] = lines[0][span.column - 1 :]
    return "\n".join(lines)


def placed(reading: Reading) -> Iterator[tuple[Span, Value]]:
    """Every place that READING noted, with what stands there."""
    pending = [reading.form]
    while pending:
        part = pending.pop()
        if part.__class__ is Cons:
            whole, element = reading.spans.of(part), reading.spans.element(part)
            assert element is not None
            yield element, part.car
            if whole is not None:
                yield whole, part
            pending += [part.car, part.cdr]


@given(texts)
def test_the_reader_raises_nothing_but_diagnostics(text: str) -> None:
    try:
        list(read_forms(Source("<law>", text), RESOLVE))
    except EslError as error:
        assert str(error).startswith("<law>:")


@given(st.binary())
def test_so_does_the_decoder(text: bytes) -> None:
    try:
        decode(text, "<law>")
    except EslError as error:
        assert error.diagnostic.name == "wrong-encoding"


@given(programs)
def test_each_place_reads_back_to_what_stands_there(text: str) -> None:
    for reading in read_all(text):
        for span, value in placed(reading):
            there = text_of(span)
            if there not in ("'", "`", "#'", "#?"):  # which stand for the operator alone
                (again,) = read_all(there)
                assert prin1(again.form) == prin1(value)


@given(programs, st.data())
def test_the_beginning_of_a_right_text_is_right_or_incomplete(text: str, draw: st.DataObject) -> None:
    beginning = text[: draw.draw(st.integers(0, len(text)))]
    try:
        read_all(text)
        read_all(beginning)
    except IncompleteInput:
        assert beginning != text


@given(programs)
def test_reading_on_from_each_end_gives_the_same_forms(text: str) -> None:
    source, found, offset = Source("<law>", text), [], 0
    while True:
        reading, offset = read_at(source, offset, anywhere)
        if reading is None:
            break
        found.append((prin1(reading.form), reading.span))
    assert [form for form, _ in found] == [prin1(reading.form) for reading in read_all(text)]
    assert [span[1:] for _, span in found] == [reading.span[1:] for reading in read_all(text)]


@given(programs, texts)
def test_what_stands_before_a_mistake_is_not_changed_by_it(text: str, rest: str) -> None:
    before = [prin1(reading.form) for reading in read_all(text)]
    after = []
    try:
        for reading in read_forms(Source("<law>", f"{text}\n{rest}"), anywhere):
            after.append(prin1(reading.form))
    except EslError:
        pass
    assert len(after) >= len(before)
