"""Text becomes forms, one at a time, each part with its place."""

from __future__ import annotations

import pytest

from eslang.base.decoding import decode
from eslang.base.diagnostics import EslError, IncompleteInput
from eslang.base.image import PACKAGE, Image
from eslang.base.lists import Cons, items
from eslang.base.packages import Package
from eslang.base.printer import prin1
from eslang.base.resolve import resolve_in
from eslang.base.spans import Source
from eslang.base.symbols import Symbol
from eslang.base.text import Vector
from eslang.reader.reader import Reading, read_at, read_forms


def new_image() -> Image:
    image = Image()
    image.cell(PACKAGE).value = image.packages["ESL-USER"]
    return image


def readings(text: str, **given) -> list[Reading]:
    return list(read_forms(Source("a.esl", text), resolve_in(new_image()), **given))


def read(text: str, **given):
    (reading,) = readings(text, **given)
    return reading.form


def cl(name: str) -> Symbol:
    return Symbol.intern(name, "COMMON-LISP")


EMPTY = ["", " \n\t", "; only a comment", "#| a #| b |# c |#", "\ufeff", "#-eslang x"]
BROKEN_OFF = ["(a", "'", "`(,", '"a', "|a", "a\\", "#|", "#\\", "#", "#+a", "#x", "#:", "(a .", "#("]


@pytest.mark.parametrize("text", EMPTY)
def test_a_text_without_forms(text):
    assert readings(text) == []


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("(a b c)", "(A B C)"),
        ("()", "NIL"),
        ("(a . b)", "(A . B)"),
        ("(a b . (c d))", "(A B C D)"),
        ("(a .b)", "(A .B)"),
        ("(a . #| x |# b ; y\n)", "(A . B)"),
        ("(a.b)", "(A.B)"),
        ("#(1 (2) #(3))", "#(1 (2) #(3))"),
        ('("a\\"b\\\\c")', '("a\\"b\\\\c")'),
        ('"two\nlines"', '"two\nlines"'),
        ("(a\r\nb)\r\n", "(A B)"),
        ("(a\u00a0b)", "(A B)"),
        ("#:x", "#:X"),
        ("#\\a", "#\\a"),
        ("#\\ ", "#\\Space"),
        ("#?x", "(ESL::LOGICAL-BINDING ?X)"),
        ("#?x", "#?X"),
    ],
)
def test_forms(text, printed):
    form = read(text)
    assert prin1(form) in (printed, prin1(read(printed)))


@pytest.mark.parametrize(
    ("text", "operator"),
    [
        ("'x", "QUOTE"),
        ("#'x", "FUNCTION"),
        ("`x", "QUASIQUOTE"),
    ],
)
def test_a_prefix_is_a_list(text, operator):
    assert items(read(text)) == [cl(operator), Symbol("x")]


def test_commas_inside_a_backquote():
    form = read("`(,a ,@b ,.c #(,d) `(,e ,,f))")
    inner = items(items(form)[1])
    assert [items(part)[0].name for part in inner[:3]] == ["UNQUOTE", "UNQUOTE-SPLICING", "UNQUOTE-SPLICING"]
    assert isinstance(inner[3], Vector)
    assert items(inner[3].items[0]) == [cl("UNQUOTE"), Symbol("d")]


def test_a_logical_variable_is_a_list_of_two():
    operator, variable = items(read("#?Widget"))
    assert operator is Symbol.intern("LOGICAL-BINDING", "ESL")
    assert variable is Symbol("?widget")


def test_names_belong_to_the_package_of_the_moment():
    image = new_image()
    forms = read_forms(Source("a.esl", "a a"), resolve_in(image))
    first = next(forms).form
    image.cell(PACKAGE).value = image.packages["SCS-USER"]
    assert (first.package, next(forms).form.package) == ("ESL-USER", "SCS-USER")


def test_package_prefixes():
    image = new_image()
    image.add_package(Package("RIG", ("R",))).export("ARM")
    text = "rig:arm r::leg :key keyword:key cl:nil |rig|::x"
    source = Source("a.esl", text)
    forms = read_forms(source, resolve_in(image))
    found = [next(forms).form for _ in range(5)]
    assert found[:2] == [Symbol.intern("ARM", "RIG"), Symbol.intern("LEG", "RIG")]
    assert found[2] is found[3] is Symbol.intern("KEY", "KEYWORD")
    assert found[4] is None
    with pytest.raises(EslError, match=r"there is no package `\|rig\|`"):
        next(forms)


def test_what_stands_before_a_mistake_is_read_first():
    forms = read_forms(Source("a.esl", "(a) (b) )"), resolve_in(new_image()))
    assert [prin1(next(forms).form), prin1(next(forms).form)] == ["(A)", "(B)"]
    with pytest.raises(EslError, match="closes nothing"):
        next(forms)


def test_a_form_is_complete_at_its_last_character():
    forms = read_forms(Source("a.esl", "(a)(b"), resolve_in(new_image()))
    assert prin1(next(forms).form) == "(A)"
    with pytest.raises(IncompleteInput):
        next(forms)


@pytest.mark.parametrize(
    ("text", "printed"),
    [
        ("(a #+eslang b c)", "(A B C)"),
        ("(a #-eslang b c)", "(A C)"),
        ("(a #-eslang b)", "(A)"),
        ("(a #+(and eslang (not cmu)) b)", "(A B)"),
        ("(a #+(or) b #+(and) c)", "(A C)"),
        ("(a #+sbcl #+eslang b c)", "(A C)"),
        ("(a #+eslang #+sbcl b c)", "(A C)"),
        ("'#+sbcl a b", "'B"),
        ("#+sbcl (no:such ,package #\\Zork a:b:c #.(x) #xZZ 1/0) c", "C"),
        ("(#+nil a b)", "(B)"),
        ("(#+:eslang a b)", "(A B)"),
    ],
)
def test_features(text, printed):
    assert prin1(read(text)) == printed


def test_what_a_feature_leaves_out_is_not_interned():
    image = new_image()
    assert list(read_forms(Source("a.esl", "#+sbcl (never seen)"), resolve_in(image))) == []
    assert image.packages["ESL-USER"].find("NEVER") == (None, False)


def test_evaluation_while_reading_when_it_is_allowed():
    assert prin1(read("(a #.(b) #+sbcl #.(c))", evaluate=lambda form: items(form)[0])) == "(A B)"


def place_of(span) -> tuple[int, ...]:
    return tuple(span[1:])


def test_every_list_and_element_has_its_place():
    reading = readings('\n(foo \'bar\n  (baz "two\nlines") . end)')[0]
    form, spans = reading.form, reading.spans
    assert place_of(reading.span) == place_of(spans.default) == place_of(spans.of(form)) == (2, 1, 4, 15)
    assert place_of(spans.element(form)) == (2, 2, 2, 5)
    quoted = form.cdr.car
    assert place_of(spans.element(form.cdr)) == place_of(spans.of(quoted)) == (2, 6, 2, 10)
    assert place_of(spans.element(quoted)) == (2, 6, 2, 7)
    assert place_of(spans.element(quoted.cdr)) == (2, 7, 2, 10)
    inner = form.cdr.cdr.car
    assert place_of(spans.of(inner)) == (3, 3, 4, 8)
    assert place_of(spans.element(inner.cdr)) == (3, 8, 4, 7)
    assert spans.of(form.cdr) is None


def test_a_form_behind_a_feature_stands_where_it_stands_itself():
    reading = readings("(a #+eslang (b))")[0]
    assert place_of(reading.spans.of(reading.form.cdr.car)) == (1, 13, 1, 16)
    assert place_of(readings("#+eslang x")[0].span) == (1, 10, 1, 11)


def test_places_behind_comments_and_long_tokens():
    spans = [place_of(reading.span) for reading in readings("#| a\nb |# x |y\nz| w\n\n#\\\n v")]
    assert spans == [(2, 6, 2, 7), (2, 8, 3, 3), (3, 4, 3, 5), (5, 1, 6, 1), (6, 2, 6, 3)]


def test_reading_one_form_at_an_offset():
    source, resolve = Source("<string>", "a (b\n) c "), resolve_in(new_image())
    found, offset = [], 0
    while True:
        reading, offset = read_at(source, offset, resolve)
        if reading is None:
            break
        found.append((prin1(reading.form), offset, place_of(reading.span)))
    assert found == [("A", 1, (1, 1, 1, 2)), ("(B)", 6, (1, 3, 2, 2)), ("C", 8, (2, 3, 2, 4))]
    assert offset == 9


@pytest.mark.slow
def test_nesting_has_no_limit():
    form, depth = read("(" * 100_000 + ")" * 100_000), 0
    while form.__class__ is Cons:
        form, depth = form.car, depth + 1
    assert depth == 99_999
    assert isinstance(read("'" * 100_000 + "x"), Cons)


def test_bytes_are_decoded_and_a_mark_before_them_is_dropped():
    assert decode(b"\xef\xbb\xbf(a)", "a.esl").text == "(a)"
    with pytest.raises(EslError) as caught:
        decode("(ä\n ü ".encode() + b"\xfc)", "a.esl")
    assert str(caught.value).startswith("a.esl:2:4: error: the byte FC is no UTF-8")


@pytest.mark.parametrize("text", BROKEN_OFF)
def test_a_text_that_ends_too_early_is_incomplete(text):
    with pytest.raises(IncompleteInput):
        readings(text)


@pytest.mark.parametrize("text", [")", "(a . b c", "('", "#S(a", "(. ", ", ", "a:b:c (", "\0"])
def test_a_wrong_text_is_not_incomplete_unless_more_could_mend_it(text):
    with pytest.raises(EslError) as caught:
        readings(text)
    assert isinstance(caught.value, IncompleteInput) == (text == "('")
