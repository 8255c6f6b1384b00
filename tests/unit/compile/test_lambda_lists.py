"""Lambda lists: their parts, and what is wrong with one."""

from __future__ import annotations

import pytest
from compiling import failure_of, mistake_of, values_of

from eslang.base.lists import lisp_list
from eslang.base.symbols import Keyword, Symbol
from eslang.compile.lambda_list_words import KEY, OPTIONAL, REST
from eslang.compile.lambda_lists import BadLambdaList, parse_lambda_list

A, B, C, S = (Symbol.intern(name, "ESL-USER") for name in "ABCS")
FULL = """(lambda (a &optional (b (+ a 1) bp) &rest r &key (k b kp) ((:z zz) 5)
               &aux (s (list a b bp r k kp zz))) s)"""


def test_the_parts_of_a_lambda_list() -> None:
    parts = parse_lambda_list(lisp_list(A, OPTIONAL, lisp_list(B, 1, S), REST, C, KEY, B))
    assert (parts.required, parts.rest, parts.least, parts.most) == ([A], C, 1, None)
    assert (parts.optional[0].name, parts.optional[0].default, parts.optional[0].supplied) == (B, 1, S)
    assert parts.keys is not None
    assert parts.keys[0].keyword is Keyword("B")


def test_how_many_arguments_there_may_be() -> None:
    assert parse_lambda_list(lisp_list(A, OPTIONAL, B)).most == 2
    assert parse_lambda_list(lisp_list(A, B)).least == 2


def test_the_names_of_all_parameters_in_order() -> None:
    parts = parse_lambda_list(lisp_list(A, OPTIONAL, lisp_list(B, None, S), REST, C))
    assert parts.names() == [A, B, S, C]


def test_what_cannot_be_a_parameter() -> None:
    for wrong in (5, Keyword("K"), lisp_list(A)):
        with pytest.raises(BadLambdaList):
            parse_lambda_list(lisp_list(wrong))


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ("1", "(1 2 NIL NIL 2 NIL 5)"),
        ("1 9", "(1 9 T NIL 9 NIL 5)"),
        ("1 9 :k 3", "(1 9 T (:K 3) 3 T 5)"),
        ("1 9 :z 7 :k nil", "(1 9 T (:Z 7 :K NIL) NIL T 7)"),
        ("1 9 :k 1 :k 2", "(1 9 T (:K 1 :K 2) 1 T 5)"),
        ("1 9 :q 1 :allow-other-keys t", "(1 9 T (:Q 1 :ALLOW-OTHER-KEYS T) 9 NIL 5)"),
    ],
)
def test_a_lambda_list_with_everything(call: str, expected: str) -> None:
    assert values_of(f"(funcall {FULL} {call})") == expected


@pytest.mark.parametrize(
    "lambda_list",
    [
        "(a a)",
        "(a &optional a)",
        "(&rest)",
        "(&rest r s)",
        "(&key k &optional o)",
        "(&foo a)",
        "(a . b)",
        "(:k)",
        "(5)",
    ],
)
def test_a_lambda_list_that_is_wrong_is_refused(lambda_list: str) -> None:
    assert mistake_of(f"(lambda {lambda_list} 1)") == "malformed-lambda-list"


@pytest.mark.parametrize("call", ["", "1 2 3"])
def test_too_few_and_too_many_arguments_are_failures(call: str) -> None:
    assert (
        failure_of(f"(funcall (lambda (a &optional b) (list a b)) {call})", 0) == ":WRONG-NUMBER-OF-ARGUMENTS"
    )


@pytest.mark.parametrize("call", [":b 1", ":a", ":a 1 :b"])
def test_wrong_keyword_arguments_are_failures(call: str) -> None:
    assert failure_of(f"(funcall (lambda (&key a) a) {call})", 0) == ":ERROR"


def test_other_keywords_may_be_allowed() -> None:
    assert values_of("(funcall (lambda (&key a &allow-other-keys) a) :b 1 :a 2)") == "2"
