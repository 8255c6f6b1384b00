"""Symbols: compared by identity, shared by all interpreters (decision 0006)."""

from __future__ import annotations

import copy
import operator
import pickle
from collections.abc import Callable

import pytest

from eslang import Failure, Interpreter, Keyword, Symbol
from eslang.base.lists import Cons
from eslang.base.symbols import T, lisp_name, truth
from eslang.base.text import String


def test_a_name_has_one_symbol_in_each_package() -> None:
    assert Symbol("is-a") is Symbol("IS-A")
    assert Symbol.intern("X", "ESL") is not Symbol.intern("X", "ESL-USER")
    assert Symbol.intern("x", "ESL-USER") is not Symbol("x")


def test_a_keyword_is_a_symbol_of_its_own_kind() -> None:
    assert Keyword("two") is Symbol.intern("TWO", "KEYWORD")
    assert isinstance(Keyword("two"), Symbol)
    assert (str(Keyword("two")), Keyword("two").name) == (":TWO", "TWO")


def test_uninterned_symbols_are_all_different() -> None:
    assert Symbol.uninterned("G1") is not Symbol.uninterned("G1")
    assert str(Symbol.uninterned("G1")) == "#:G1"


@pytest.mark.parametrize("symbol", [Symbol("is-a"), Keyword("two"), T], ids=str)
def test_a_copy_of_a_symbol_is_the_symbol(symbol: Symbol) -> None:
    assert copy.copy(symbol) is symbol
    assert copy.deepcopy([symbol])[0] is symbol
    assert pickle.loads(pickle.dumps(symbol)) is symbol


def test_interpreters_share_symbols_but_not_what_they_mean() -> None:
    first, second = Interpreter(), Interpreter()
    assert first.eval("'widget-7") is second.eval("'widget-7") is Symbol("widget-7")
    first.eval("(setq widget-7 1)")
    with pytest.raises(Failure) as raised:
        second.eval("widget-7")
    assert raised.value.cause is Keyword("unbound-variable")


@pytest.mark.parametrize("datum", [Symbol("a"), Keyword("b"), String("c"), Cons(1, None)], ids=repr)
@pytest.mark.parametrize(
    "operation",
    [operator.add, operator.sub, operator.mul, operator.truediv, operator.lt, operator.ge],
    ids=lambda operation: operation.__name__,
)
def test_what_is_no_number_refuses_arithmetic(
    datum: object, operation: Callable[[object, object], object]
) -> None:
    for operands in ((datum, 3), (3, datum), (datum, datum)):
        with pytest.raises(Failure) as raised:
            operation(*operands)
        assert raised.value.cause is Keyword("type-error")
        assert raised.value.arguments[0] is datum


def test_names_cross_the_border_mechanically() -> None:
    assert lisp_name("with_recovery_procedures") == "WITH-RECOVERY-PROCEDURES"
    assert lisp_name("list_") == "LIST"
    assert (truth(True), truth(False)) == (T, None)
