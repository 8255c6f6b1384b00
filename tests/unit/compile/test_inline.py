"""Standard functions that are compiled in place: what they give, and what they refuse."""

from __future__ import annotations

import pytest
from compiling import failure_of, values_of


@pytest.mark.parametrize(
    ("form", "datum"),
    [
        ('(+ "a" 1)', '"a"'),
        ('(+ "a" "b")', '"a"'),
        ('(+ 1 "b")', '"b"'),
        ('(- "a" 1)', '"a"'),
        ('(* "a" 3)', '"a"'),
        ('(* 3 "a")', '"a"'),
        ('(< "a" 1)', '"a"'),
        ('(< 1 "a")', '"a"'),
        ('(> "a" "b")', '"a"'),
        ("(<= 'x 1)", "X"),
        ("(>= 1 :x)", ":X"),
        ("(+ nil 1)", "NIL"),
        ("(+ 1 nil)", "NIL"),
        ("(- nil nil)", "NIL"),
        ("(< nil 1)", "NIL"),
        ("(+ 'x 1)", "X"),
        ("(+ t 1)", "T"),
        ("(+ '(1) '(2))", "(1)"),
        ("(+ #(1) 1)", "#(1)"),
        ("(+ 1 2 #\\a)", "#\\a"),
        ('(= 1 "a")', '"a"'),
        ('(= "a" "a")', '"a"'),
        ("(= nil nil)", "NIL"),
        ("(/= 'a 'a)", "A"),
        ("(zerop nil)", "NIL"),
        ("(plusp 'a)", "A"),
        ("(minusp #\\a)", "#\\a"),
        ("(1+ nil)", "NIL"),
        ('(1- "5")', '"5"'),
        ('(mod "%d" 3)', '"%d"'),
        ("(mod 5 nil)", "NIL"),
        ("(car 5)", "5"),
        ('(cdr "abc")', '"abc"'),
        ("(cadr '(1 . 2))", "2"),
        ("(third '(1 2 . 3))", "3"),
        ("(svref '(1) 0)", "(1)"),
        ("(aref '(1) 0)", "(1)"),
    ],
)
def test_what_is_of_the_wrong_type_is_a_failure_with_the_datum(form: str, datum: str) -> None:
    assert failure_of(form, 1) == f":TYPE-ERROR {datum}"


@pytest.mark.parametrize(
    ("form", "datum"),
    [('(funcall #\'+ "a" 1)', '"a"'), ("(apply #'< '(1 \"a\"))", '"a"'), ("(reduce #'+ '(1 nil))", "NIL")],
)
def test_so_it_is_where_the_function_is_called_as_a_value(form: str, datum: str) -> None:
    assert failure_of(form, 1) == f":TYPE-ERROR {datum}"


@pytest.mark.parametrize("form", ["(mod 5 0)", "(mod 5.0 0)", "(/ 1 0)", "(/ 1.5 0)"])
def test_a_division_by_zero_is_a_failure(form: str) -> None:
    assert failure_of(form, 0) == ":DIVISION-BY-ZERO"


@pytest.mark.parametrize("form", ["(aref #(1 2) 2)", "(svref #(1 2) -1)"])
def test_an_index_out_of_range_is_a_failure(form: str) -> None:
    assert failure_of(form, 0) == ":INDEX-OUT-OF-RANGE"


@pytest.mark.parametrize(
    ("form", "expected"),
    [
        ("(+ 1/2 1/2)", "1"),
        ("(- 5 2 1)", "2"),
        ("(mod 7 -2)", "-1"),
        ("(mod -7.5 2)", "0.5"),
        ("(= 1 1.0)", "T"),
        ("(= 1/2 0.5)", "T"),
        ("(/= 1 2)", "T"),
        ("(< 1 2 3)", "T"),
        ("(eql 1 1.0)", "NIL"),
        ("(eql 1/2 1/2)", "T"),
        ("(eq 'a 'a)", "T"),
        ("(eq 100000000000 100000000000)", "T"),
        ('(eql "a" "a")', "NIL"),
        ("(car nil)", "NIL"),
        ("(cddr '(1))", "NIL"),
        ("(fourth '(1 2 3 4))", "4"),
        ("(list)", "NIL"),
        ("(list 1 2 3 4 5 6 7 8 9 10)", "(1 2 3 4 5 6 7 8 9 10)"),
        ("(not 0)", "NIL"),
        ("(consp '(1))", "T"),
        ("(atom nil)", "T"),
        ("(identity (values 1 2))", "1"),
    ],
)
def test_what_it_gives(form: str, expected: str) -> None:
    assert values_of(form) == expected


def test_a_wrong_number_of_arguments_is_a_failure() -> None:
    assert failure_of("(car)", 0) == ":WRONG-NUMBER-OF-ARGUMENTS"
    assert failure_of("(cons 1)", 0) == ":WRONG-NUMBER-OF-ARGUMENTS"


@pytest.mark.parametrize("call", ["(= x (setq x 2))", "(eql x (setq x 2))", "(< x (setq x 2) x)"])
def test_arguments_are_computed_once_and_in_order(call: str) -> None:
    assert values_of(f"(let ((x 1)) (list {call} x))").endswith(" 2)")
    assert (
        values_of("(let ((n 0)) (flet ((next () (setq n (+ n 1)))) (list (= (next) (next)) n)))") == "(NIL 2)"
    )
