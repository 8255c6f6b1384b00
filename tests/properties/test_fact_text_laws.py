"""Laws of facts as text: what is saved is what is loaded, and the quick way to read it is the reader's."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from eslang import Interpreter
from eslang.base.diagnostics import EslError
from eslang.base.failure import Failure
from eslang.base.image import PACKAGE
from eslang.base.lists import Cons, from_items
from eslang.base.printer import prin1
from eslang.base.ratios import canonical
from eslang.base.resolve import resolve_in
from eslang.base.spans import Source
from eslang.base.symbols import Symbol, T, Value
from eslang.base.text import String, character
from eslang.constructs.esl.fact_text import OTHER, Scanner, UserNames, Writer, read_one
from eslang.facts.query import Facts
from eslang.facts.unify import is_variable
from eslang.reader.reader import read_forms

pytestmark = pytest.mark.slow
LAW = settings(max_examples=200, suppress_health_check=[HealthCheck.function_scoped_fixture])

AGENT = Interpreter(clock="virtual")
AGENT.eval("(defpackage :robot (:use :cl) (:shadow list)) (defpackage |odd one|)")
IMAGE = AGENT.image
RESOLVE = resolve_in(IMAGE)
NAMES = UserNames(IMAGE.packages)

texts = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=6)
pieces = st.sampled_from([*"ABZ019+-*/.:#|\\;'`,@()\" \n?eéßſ", "E5", "1.5", "NIL", "..", "1/2", "LIST", "T"])
names = st.one_of(texts, st.lists(pieces, max_size=5).map("".join))
homes = st.sampled_from(["ESL-USER", "KEYWORD", "ESL", "COMMON-LISP", "ROBOT", "odd one"])
symbols = st.builds(lambda home, name: IMAGE.packages[home].intern(name), homes, names)
atoms = st.one_of(
    st.none(),
    st.just(T),
    st.integers(),
    st.integers(-(10**5000), 10**5000),
    st.fractions().map(canonical),
    st.floats(allow_nan=False, allow_infinity=False),
    texts.map(String),
    st.characters(exclude_categories=["Cs"]).map(character),
    symbols,
)


def lists(parts: st.SearchStrategy[Value]) -> st.SearchStrategy[Value]:
    """Lists of PARTS, proper and dotted."""
    return st.one_of(
        st.lists(parts, max_size=4).map(from_items),
        st.tuples(st.lists(parts, min_size=1, max_size=3), atoms).map(lambda both: from_items(*both)),
    )


terms = st.recursive(atoms, lists, max_leaves=8)
facts = st.builds(lambda name, row: from_items([name, *row]), symbols, st.lists(terms, max_size=3))


def held(database: Facts) -> list[tuple[Any, ...]]:
    """All that DATABASE holds, in its order, as its codes, which are equal as EQUAL is."""
    rows = [(each.name, row) for each in database.relations.values() for row in each.rows]
    return sorted(rows, key=lambda pair: prin1(pair[0]))  # the order of relations is nobody's


def hold(given: list[Value]) -> Facts:
    """Let the database of AGENT hold those of the facts GIVEN that can be."""
    AGENT.database.clear()
    for fact in given:
        if fact.car is not Symbol.intern("IN-PACKAGE", "COMMON-LISP"):
            try:
                AGENT.database.add(fact)
            except Failure:
                continue  # a variable, or no name of a relation
    return AGENT.database


@LAW
@given(st.lists(facts, max_size=6), st.sampled_from(["ESL-USER", "CL-USER", "ROBOT", "odd one"]), st.data())
def test_what_is_saved_in_one_package_is_loaded_in_any(
    tmp_path: Path, given: list[Value], saving: str, data: st.DataObject
) -> None:
    database, path = hold(given), str(tmp_path / "all.facts")
    before = held(database)
    cell = IMAGE.cell(PACKAGE)
    try:
        cell.value = IMAGE.packages[saving]
        assert AGENT.call("esl:save-facts", path) == len(before)
        database.clear()
        cell.value = IMAGE.packages[data.draw(st.sampled_from(["ESL-USER", "KEYWORD", "odd one"]))]
        assert AGENT.call(Symbol.intern("LOAD-FACTS", "ESL"), path) == len(before)
    finally:
        cell.value = IMAGE.packages["ESL-USER"]
    assert held(database) == before


@LAW
@given(facts)
def test_a_fact_of_the_store_is_read_back_as_it_was(fact: Cons) -> None:
    for relation, row in ((each, row) for each in hold([fact]).relations.values() for row in each.rows):
        text = Writer(NAMES.name_of, "written").text(relation.name, row)
        read = Scanner(NAMES.resolve).plain(text)
        back = Facts(lambda name: False, lambda name, arguments: False)
        back.add(read_one(text, "law", NAMES.resolve) if read is OTHER else read)
        assert [row] == [row for each in back.relations.values() for row in each.rows]
        assert relation.name is next(iter(back.known))
        if "\n" not in text:
            assert read is not OTHER, "the quick way is for all that is written on one line"


WORDS = """a ( (a b) "x_y" " #\\a #\\( |o_d| 1/2 . ..
#( ' :k robot::w robot:w
nowhere:x 12 -1.5e3 ;c #| |# \\_ #?x ?x é #:u #x1F 1. + list nil (a_b) (a_(b_._c)) #+x ` ,"""
tokens = st.sampled_from(
    [*(word.replace("_", " ") for word in WORDS.split()), "(a b)", '"x y"', " ", "\t", "\n", "\r\n", "\xa0"]
)
scribbles = st.lists(tokens, max_size=10).map("".join)


def read_all(text: str) -> list[Any] | str:
    """What the reader makes of TEXT."""
    try:
        return [(prin1(each.form), each.span.line) for each in read_forms(Source("law", text), RESOLVE)]
    except EslError as error:
        return error.diagnostic.message


@LAW
@given(st.one_of(scribbles, scribbles.map(lambda text: f"({text})")))
def test_a_line_that_is_read_quickly_is_what_the_reader_says(line: str) -> None:
    found = Scanner(RESOLVE).plain(line)
    if found is not OTHER:
        assert read_all(line) == [(prin1(found), 1)]


@LAW
@given(st.lists(st.one_of(scribbles, scribbles.map(lambda text: f"({text})")), max_size=6).map("\n".join))
def test_a_text_is_read_as_the_reader_reads_it(text: str) -> None:
    try:
        found: Any = [(prin1(form), line) for line, form in Scanner(RESOLVE).forms(Source("law", text))]
    except EslError as error:
        found = error.diagnostic.message
    assert found == read_all(text)


@LAW
@given(st.lists(facts, min_size=1, max_size=5), scribbles)
def test_a_damaged_file_changes_nothing(tmp_path: Path, given: list[Value], scribble: str) -> None:
    path = tmp_path / "damaged.facts"
    database = hold(given)
    AGENT.call("save-facts", str(path))
    database.clear()
    database.add(from_items([Symbol("THERE"), 1]))
    with path.open("a", encoding="utf-8", newline="") as stream:
        stream.write(scribble)
    before = held(database)
    try:
        AGENT.call("load-facts", str(path))
    except Failure as failure:
        assert str(failure.arguments[0]).startswith(f"{path}:")
        assert held(database) == before
    else:
        assert all(not is_variable(name) for name, _ in held(database))
