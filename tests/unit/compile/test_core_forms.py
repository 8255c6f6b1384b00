"""Order, choice, assignment and declarations: the values of each special form."""

from __future__ import annotations

import pytest
from compiling import failure_of, mistake_of, values_of


@pytest.mark.parametrize(
    ("form", "expected"),
    [
        ("(quote (a . b))", "(A . B)"),
        ("(progn)", "NIL"),
        ("(progn 1 (values 2 3))", "2 3"),
        ("(if nil 1)", "NIL"),
        ("(if 0 (values 1 2) 3)", "1 2"),
        ("(when t 1 (values 2 3))", "2 3"),
        ("(when nil 1)", "NIL"),
        ("(when t)", "NIL"),
        ("(unless nil (values 1 2))", "1 2"),
        ("(unless t 1)", "NIL"),
        ("(cond)", "NIL"),
        ("(cond (nil 1))", "NIL"),
        ("(cond ((values 5 6)))", "5"),
        ("(cond (nil) (t (values 1 2)))", "1 2"),
        ("(cond ((values nil 1) 2) ((car '(3))))", "3"),
        ("(and)", "T"),
        ("(and 1 nil 2)", "NIL"),
        ("(and 1 (values 2 3))", "2 3"),
        ("(or)", "NIL"),
        ("(or nil (values nil 2))", "NIL 2"),
        ("(or (values 1 2) 3)", "1"),
        ("(setq)", "NIL"),
        ("(let (a b) (setq a 1 b (+ a 1)) (list a b))", "(1 2)"),
        ("(let (a) (setq a (values 1 2)))", "1"),
        ("(locally (declare (optimize speed)) (values 1 2))", "1 2"),
        ("(the integer (values 1 2))", "1 2"),
        ("(eval-when (:execute) (values 1 2))", "1 2"),
    ],
)
def test_the_values_of_a_form(form: str, expected: str) -> None:
    assert values_of(form) == expected


@pytest.mark.parametrize(
    ("form", "name"),
    [
        ("(if)", "malformed-form"),
        ("(if 1 2 3 4)", "malformed-form"),
        ("(quote)", "malformed-form"),
        ("(setq x)", "malformed-form"),
        ("(setq :k 1)", "constant-assignment"),
        ("(setq t 1)", "constant-assignment"),
        ("(cond 5)", "malformed-form"),
        ("(progn . 1)", "malformed-form"),
        ("(progn (declare (special x)) 1)", "misplaced-declare"),
        ("(1 2)", "bad-operator"),
        ('("f" 2)', "bad-operator"),
    ],
)
def test_a_form_of_the_wrong_shape_is_refused(form: str, name: str) -> None:
    assert mistake_of(f"(list {form})") == name


def test_names_without_a_meaning_are_failures() -> None:
    assert failure_of("%no-such-variable") == ":UNBOUND-VARIABLE %NO-SUCH-VARIABLE"
    assert failure_of("(%no-such-function 1)") == ":UNDEFINED-FUNCTION %NO-SUCH-FUNCTION"
    assert failure_of("(funcall '%no-such-function)") == ":UNDEFINED-FUNCTION %NO-SUCH-FUNCTION"
    assert failure_of("#'%no-such-function") == ":UNDEFINED-FUNCTION %NO-SUCH-FUNCTION"
    assert failure_of("(setf (%no-such-place 1) 2)", 0) == ":UNDEFINED-FUNCTION"


TESTS = {
    "cond": "(cond {})",
    "cond for a value": "(car (list (cond {})))",
    "cond for effect": "(let ((r nil)) (cond {}) r)",
}


@pytest.mark.parametrize(
    "clause", ["((= x {0}) {0})", "((= x {0}) (setq r {0}) {0})", "((if (= x {0}) (setq r {0})))"]
)
@pytest.mark.parametrize("form", TESTS.values(), ids=TESTS)
def test_a_cond_may_have_a_thousand_clauses(form: str, clause: str) -> None:
    clauses = " ".join(clause.format(n) for n in range(1000))
    expected = "NIL" if form.startswith("(let") and "setq" not in clause else "999"
    text = form.format(clauses)
    assert values_of(f"(let ((x 999) (r nil)) {text.replace('(let ((r nil))', '(progn')})") == expected


def test_a_long_cond_jumps_only_where_it_is_told_to() -> None:
    clauses = " ".join(f"((= x {n}) (return-from out {n}))" for n in range(40))
    assert values_of(f"(block out (dotimes (x 50) (if (> x 7) (cond {clauses}))) 5)") == "8"
    clauses = " ".join(f"((= x {n}) (go end))" for n in range(40))
    assert values_of(f"(let ((x 3)) (tagbody (cond {clauses}) (setq x 0) end) x)") == "3"


@pytest.mark.parametrize("operator", ["and", "or"])
def test_and_and_or_of_a_thousand_forms(operator: str) -> None:
    forms = " ".join(f"(< x {n})" if operator == "or" else f"(> x {n})" for n in range(1000))
    assert values_of(f"(let ((x 998)) ({operator} {forms}))") == ("T" if operator == "or" else "NIL")
    assert values_of(f"(let ((x 998)) (if ({operator} {forms}) 1 2))") == ("1" if operator == "or" else "2")


def test_a_progn_of_ten_thousand_forms() -> None:
    assert values_of(f"(let ((x 0)) {' '.join('(setq x (+ x 1))' for _ in range(10_000))} x)") == "10000"
