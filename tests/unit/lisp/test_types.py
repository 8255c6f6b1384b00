"""TYPEP, TYPE-OF and COERCE."""

from __future__ import annotations

from typing import Any

import pytest
from values import call, char, fails, fn, lisp, symbol

from eslang.base.ratios import Ratio
from eslang.base.symbols import Keyword
from eslang.lisp.types import is_of_type


def spec(text: Any) -> Any:
    """A type specifier: words are symbols, lists are lists."""
    if isinstance(text, list):
        return lisp([spec(each) for each in text])
    return symbol(text) if isinstance(text, str) else text


@pytest.mark.parametrize(
    ("value", "specifier", "holds"),
    [
        (5, "integer", True),
        (5, "string", False),
        (None, "list", True),
        (None, "symbol", True),
        (None, "boolean", True),
        (5, "t", True),
        (5, None, False),
        (5, ["integer", 0, 5], True),
        (5, ["integer", 0, [5]], False),
        (5, ["integer", 6], False),
        (-5, ["integer", "*", 0], True),
        (1.0, ["float", 0.5, "*"], True),
        (Ratio(1, 2), ["rational", 0, 1], True),
        (5, ["or", "string", "integer"], True),
        (5, ["or"], False),
        (5, ["and"], True),
        (3, ["and", "integer", ["not", ["eql", 3]]], False),
        (symbol("a"), ["member", "a", "b"], True),
        (symbol("c"), ["member", "a", "b"], False),
        ([1, 2], ["cons", "integer", "list"], True),
        ([1, 2], ["cons", "string"], False),
        ([1, 2], ["cons", "*", "cons"], True),
        ("ab", ["string", 2], True),
        ("ab", ["string", 3], False),
        ((1, 2), ["vector", "t", 2], True),
        ((1, 2), ["simple-vector", 2], True),
        ("ab", ["vector", "character"], True),
        ("ab", ["array", "character", [2]], True),
        ("ab", ["array", "*", 1], True),
        (255, ["unsigned-byte", 8], True),
        (256, ["unsigned-byte", 8], False),
        (-128, ["signed-byte", 8], True),
        (-129, ["signed-byte", 8], False),
        (2, ["mod", 3], True),
        (3, ["mod", 3], False),
        (1 << 70, "bignum", True),
        (char("a"), "standard-char", True),
        (len, "function", True),
        (Keyword("a"), "keyword", True),
        ([1], "sequence", True),
        ("a", "sequence", True),
    ],
)
def test_typep(value: Any, specifier: Any, holds: bool) -> None:
    assert is_of_type(lisp(value), spec(specifier)) is holds


def test_satisfies_asks_the_function() -> None:
    odd = lisp(lambda number: number % 2 == 1)
    assert is_of_type(3, lisp([symbol("satisfies"), odd]))
    assert not is_of_type(4, lisp([symbol("satisfies"), odd]))


def test_an_unknown_type_is_an_error() -> None:
    with fails("ERROR"):
        call("typep", 1, symbol("no-such-type"))


@pytest.mark.parametrize(
    ("value", "name"),
    [
        (None, "NULL"),
        (True, "BOOLEAN"),
        (symbol("a"), "SYMBOL"),
        (Keyword("a"), "KEYWORD"),
        (1, "BIT"),
        (2, "FIXNUM"),
        (1 << 70, "BIGNUM"),
        (1.5, "DOUBLE-FLOAT"),
        (Ratio(1, 2), "RATIO"),
        ([1], "CONS"),
        (char("a"), "STANDARD-CHAR"),
        (char("ä"), "CHARACTER"),
        (len, "FUNCTION"),
    ],
)
def test_type_of(value: Any, name: str) -> None:
    assert call("type-of", value) is symbol(name)


def test_the_type_of_an_array_tells_its_size() -> None:
    assert call("type-of", (1, 2)) == [symbol("simple-vector"), 2]
    assert call("type-of", "abc") == [symbol("simple-array"), symbol("character"), [3]]
    assert call("type-of", call("make-array", [2, 2])) == [symbol("simple-array"), True, [2, 2]]


@pytest.mark.parametrize("value", [None, 1, 2, 1.5, Ratio(1, 2), [1], "a", (1,), symbol("a"), char("x"), len])
def test_a_value_is_of_its_own_type(value: Any) -> None:
    assert is_of_type(lisp(value), fn("type-of")(lisp(value)))


@pytest.mark.parametrize(
    ("value", "specifier", "result"),
    [
        ([1, 2], "vector", (1, 2)),
        ("ab", "list", [char("a"), char("b")]),
        ((1,), "list", [1]),
        ([char("a")], "string", "a"),
        (None, "vector", ()),
        ("a", "character", char("a")),
        (symbol("a"), "character", char("A")),
        (1, "float", 1.0),
        (Ratio(1, 2), "double-float", 0.5),
        (3, "integer", 3),
        (3, "t", 3),
    ],
)
def test_coerce(value: Any, specifier: str, result: Any) -> None:
    came = call("coerce", value, symbol(specifier))
    assert came == result
    assert came.__class__ is result.__class__


@pytest.mark.parametrize(
    ("value", "specifier"),
    [(1.5, "integer"), ([1], "string"), ("abc", "symbol"), ("ab", "character"), ("a", "float")],
)
def test_what_cannot_be_coerced_is_a_type_error(value: Any, specifier: str) -> None:
    with fails("TYPE-ERROR"):
        call("coerce", value, symbol(specifier))
