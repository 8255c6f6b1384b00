"""Symbols as Lisp writes them."""

from __future__ import annotations

import pytest

from eslang.base.symbol_text import escaped_name, in_case, symbol_text
from eslang.base.symbols import Keyword, Symbol


@pytest.mark.parametrize(
    "name", ["FOO", "IS-A", "?X", "*X*", "1+", "+", "-", "A.B", "É", "%SET", "@X", "A#B"]
)
def test_plain_names_stand_as_they_are(name: str) -> None:
    assert escaped_name(name) == name


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("foo", "|foo|"),
        ("A B", "|A B|"),
        ("", "||"),
        ("12", "|12|"),
        ("1/2", "|1/2|"),
        (".", "|.|"),
        ("..", "|..|"),
        ("A:B", "|A:B|"),
        ("#A", "|#A|"),
        ("A|B", r"|A\|B|"),
        ("A\\B", r"|A\\B|"),
        ("A\nB", "|A\nB|"),
        ("(", "|(|"),
    ],
)
def test_other_names_stand_between_bars(name: str, text: str) -> None:
    assert escaped_name(name) == text


def test_case_is_that_of_the_printer_variable() -> None:
    assert in_case("FOO-BAR2", "CAPITALIZE") == "Foo-Bar2"
    assert symbol_text(Keyword("foo"), case="DOWNCASE") == ":foo"
    assert symbol_text(Symbol.intern("Foo", "ESL"), case="DOWNCASE") == "|Foo|"


def test_without_escape_only_the_name_is_written() -> None:
    assert symbol_text(Keyword("foo"), escape=False) == "FOO"
    assert symbol_text(Symbol.uninterned("g 1"), escape=False) == "g 1"
    assert symbol_text(None, escape=False) == "NIL"
