"""Values as Lisp text."""

from __future__ import annotations

import math
from typing import Any

import pytest

from eslang.base.failure import Failure
from eslang.base.lists import Cons, from_items, lisp_list
from eslang.base.packages import Package
from eslang.base.printer import READABLE, prin1, princ, unreadable
from eslang.base.ratios import Ratio
from eslang.base.sharing import Part
from eslang.base.symbols import Keyword, Symbol, T
from eslang.base.text import Array, String, Vector, character


def cl(name: str) -> Symbol:
    """The symbol of COMMON-LISP called NAME, exactly so."""
    return Symbol.intern(name, "COMMON-LISP")


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, "NIL"),
        (T, "T"),
        (Keyword("a"), ":A"),
        (Symbol.uninterned("G1"), "#:G1"),
        (12, "12"),
        (-3, "-3"),
        (Ratio(1, 2), "1/2"),
        (0.5, "0.5"),
        (1e10, "1.0e10"),
        (1e-4, "1.0e-4"),
        (12345678.0, "1.2345678e7"),
        (math.inf, "#<FLOAT infinity>"),
        (String('say "a\\b"'), r'"say \"a\\b\""'),
        (character("a"), r"#\a"),
        (character(" "), r"#\Space"),
        (character("\u200b"), r"#\U+200B"),
        (Vector([1, 2, 3]), "#(1 2 3)"),
        (Vector([1, 2, 3], fill=2), "#(1 2)"),
        (Array((2, 2), [1, 2, 3, 4]), "#2A((1 2) (3 4))"),
        (Array((), [5]), "#0A5"),
        (Array((2, 0), []), "#2A(() ())"),
        (lisp_list(1, lisp_list(2), Vector([3])), "(1 (2) #(3))"),
        (Cons(1, 2), "(1 . 2)"),
        (Cons(1, Cons(2, 3)), "(1 2 . 3)"),
        (Package("ESL"), '#<PACKAGE "ESL">'),
        (prin1, "#<FUNCTION PRIN1>"),
        (lambda: None, "#<FUNCTION LAMBDA>"),
    ],
)
def test_every_kind_of_value_has_its_text(value: Any, text: str) -> None:
    assert prin1(value) == text


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (String('a"b'), 'a"b'),
        (character(" "), " "),
        (Keyword("a"), "A"),
        (cl("a b"), "a b"),
        (lisp_list(String("a"), character("b")), "(a b)"),
    ],
)
def test_princ_leaves_out_what_only_the_reader_needs(value: Any, text: str) -> None:
    assert princ(value) == text


@pytest.mark.parametrize(
    ("form", "text"),
    [
        (lisp_list(cl("QUOTE"), cl("X")), "'X"),
        (lisp_list(cl("FUNCTION"), cl("CAR")), "#'CAR"),
        (lisp_list(cl("QUASIQUOTE"), lisp_list(cl("A"), lisp_list(cl("UNQUOTE"), cl("B")))), "`(A ,B)"),
        (lisp_list(cl("QUASIQUOTE"), lisp_list(cl("UNQUOTE-SPLICING"), cl("B"))), "`,@B"),
        (lisp_list(cl("QUASIQUOTE"), lisp_list(cl("UNQUOTE"), cl("@B"))), "`, @B"),
        (lisp_list(cl("UNQUOTE"), cl("B")), "(UNQUOTE B)"),
        (lisp_list(Symbol.intern("LOGICAL-BINDING", "ESL"), cl("?X")), "#?X"),
        (lisp_list(Symbol.intern("LOGICAL-BINDING", "ESL"), 5), "(LOGICAL-BINDING 5)"),
        (lisp_list(cl("QUOTE"), 1, 2), "(QUOTE 1 2)"),
        (Cons(cl("QUOTE"), 1), "(QUOTE . 1)"),
        (lisp_list(1, cl("QUOTE"), 2), "(1 QUOTE 2)"),
    ],
)
def test_quoted_forms_print_with_their_marks(form: Any, text: str) -> None:
    assert prin1(form) == text


@pytest.mark.slow
def test_structures_of_any_depth_and_length_print() -> None:
    deep: Any = None
    for _ in range(100_000):
        deep = Cons(deep, None)
    assert prin1(deep) == "(" * 100_000 + "NIL" + ")" * 100_000
    assert prin1(from_items(range(100_000))).count(" ") == 99_999


def test_a_structure_that_contains_itself_prints_with_labels() -> None:
    ring = lisp_list(1, 2)
    ring.cdr.cdr = ring
    assert prin1(ring) == "#1=(1 2 . #1#)"
    ring.car = ring
    assert prin1(ring) == "#1=(#1# 2 . #1#)"
    vector = Vector([1, 2])
    vector.items[0] = vector
    assert prin1(vector) == "#1=#(#1# 2)"


def test_shared_parts_print_with_labels_only_when_asked() -> None:
    part = lisp_list(1)
    assert prin1(lisp_list(part, part)) == "((1) (1))"
    assert prin1(lisp_list(part, part), READABLE._replace(circle=True)) == "(#1=(1) #1#)"


def test_length_and_level_cut_what_is_printed() -> None:
    assert prin1(lisp_list(1, 2, 3), READABLE._replace(length=2)) == "(1 2 ...)"
    assert prin1(Vector([1, 2, 3]), READABLE._replace(length=1)) == "#(1 ...)"
    assert prin1(lisp_list(1, lisp_list(2)), READABLE._replace(level=1)) == "(1 #)"
    ring = lisp_list(1)
    ring.cdr = ring
    assert prin1(ring, READABLE._replace(length=3)) == "(1 1 1 ...)"


def test_symbols_are_prefixed_as_a_package_needs() -> None:
    home, here = Package("HOME"), Package("HERE")
    inner, outer = home.intern("INNER"), home.intern("OUTER")
    home.export("OUTER")
    known = READABLE._replace(package=here, packages={"HOME": home, "HERE": here})
    assert prin1(inner, known) == "HOME::INNER"
    assert prin1(outer, known) == "HOME:OUTER"
    here.use(home)
    assert prin1(outer, known) == "OUTER"
    assert prin1(None, known) == "COMMON-LISP::NIL"


class Gadget:
    """An object that prints itself, and what it holds."""

    def __init__(self, part: Any) -> None:
        self.part = part

    def print_lisp(self, settings: Any) -> str:
        """A gadget."""
        return f"#<GADGET {prin1(self.part, settings)}>"


def test_an_object_may_print_itself() -> None:
    assert prin1(lisp_list(Gadget(String("a")))) == '(#<GADGET "a">)'
    gadget = Gadget(None)
    gadget.part = lisp_list(gadget)
    assert prin1(gadget) == "#<GADGET (...)>"


class Link:
    """An object that tells the printer its parts."""

    def __init__(self, after: Any) -> None:
        self.after = after

    def lisp_parts(self) -> list[Any]:
        """A link and what comes after it."""
        return ["#<LINK ", Part(self.after), ">"]


def test_objects_that_tell_their_parts_print_at_any_depth() -> None:
    chain: Any = None
    for _ in range(20_000):
        chain = Link(chain)
    assert prin1(chain) == "#<LINK " * 20_000 + "NIL" + ">" * 20_000
    assert prin1(lisp_list(Link(1)), READABLE._replace(level=1)) == "(#)"


def test_such_an_object_that_contains_itself_prints_with_labels() -> None:
    link = Link(None)
    link.after = lisp_list(1, link)
    assert prin1(link) == "#1=#<LINK (1 #1#)>"


def test_a_python_object_prints_what_it_is() -> None:
    assert prin1({1: 2}) == "#<PYTHON dict {1: 2}>"
    assert prin1("raw") == '"raw"'

    class Mute:
        def __repr__(self) -> str:
            raise RuntimeError

    assert prin1(Mute()) == "#<PYTHON Mute that cannot show itself>"


def test_what_cannot_be_read_back_fails_where_all_must_be_readable() -> None:
    with pytest.raises(Failure):
        prin1(prin1, READABLE._replace(readably=True))
    assert unreadable("THING", None, READABLE) == "#<THING>"
