"""Codes: equal for values that are EQUAL, and for no others; and they become values again."""

from __future__ import annotations

import pytest

from asking import read
from eslang.base.failure import Failure
from eslang.base.lists import Cons, from_items
from eslang.base.printer import prin1
from eslang.base.text import String, Vector, character
from eslang.facts.terms import code_of, fact_of, value_of

VALUES = ["a", ":a", "nil", "1", "1.0", "0.0", "-0.0", "1/2", "0.5", '"a"', "|a|", "(a)", '("a")', "(a . b)"]
VALUES += [
    "((a) b)",
    "(a (b))",
    "(1 2)",
    "(1.0 2)",
    "(nil)",
    "((nil))",
    "#\\a",
    "(1.0)",
    '(1.0 "x" (y . 2.5))',
]


@pytest.mark.parametrize("text", VALUES)
def test_a_code_becomes_the_value_again(text: str) -> None:
    assert prin1(value_of(code_of(read(text)))) == prin1(read(text))


@pytest.mark.parametrize("text", VALUES)
def test_equal_values_have_one_code_and_others_have_others(text: str) -> None:
    codes = {code_of(read(other)): other for other in VALUES}
    assert len(codes) == len(VALUES)
    assert codes[code_of(read(text))] == text


def test_what_changes_afterwards_is_not_in_the_code() -> None:
    text, cons = String("before"), from_items([1, 2])
    code, code_of_list = code_of(text), code_of(cons)
    text.text, cons.car = "after", 3
    assert value_of(code).text == "before"
    assert prin1(value_of(code_of_list)) == "(1 2)"


def test_objects_are_the_same_as_themselves_only() -> None:
    one, other, own = object(), object(), Vector([1])
    assert code_of(one) == code_of(one) != code_of(other)
    assert value_of(code_of(one)) is one
    assert code_of(own) is own != code_of(Vector([1]))
    assert code_of(character("x")) is character("x")


def test_not_a_number_is_the_same_as_itself() -> None:
    code = code_of(float("nan"))
    assert code == code_of(float("nan"))
    assert value_of(code) != value_of(code)


def test_a_deep_list_has_a_code() -> None:
    deep = None
    for _ in range(30_000):
        deep = Cons(deep, None)
    assert code_of(value_of(code_of(deep))) == code_of(deep)


def test_a_list_without_an_end_is_refused() -> None:
    endless = Cons(1, None)
    endless.cdr = endless
    with pytest.raises(Failure):
        code_of(endless)


def test_a_fact_is_a_list_again() -> None:
    fact = read('(is-at r1 (1 2.0) "x")')
    row = tuple(code_of(term) for term in fact.cdr)
    assert prin1(fact_of(fact.car, row)) == prin1(fact)
