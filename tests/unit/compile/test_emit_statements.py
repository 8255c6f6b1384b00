"""Statements: nesting beyond what Python allows, and jumps through it."""

from __future__ import annotations

import pytest
from compiling import mistake_of, values_of


def nested(count: int, before: str, after: str, inside: str) -> str:
    """INSIDE, with BEFORE and AFTER COUNT times around it; `#` in BEFORE is the number of the level."""
    return "".join(before.replace("#", str(n)) for n in range(count)) + inside + after * count


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (nested(30, "(block b# ", ")", "(return-from b0 4)"), "4"),
        (nested(30, "(+ 1 (block b# ", "))", "(return-from b3 4)"), "8"),
        (nested(30, "(block b# (funcall (lambda () ", ")))", "(return-from b0 (values 4 5))"), "4 5"),
        (nested(30, "(catch 'c ", ")", "(throw 'c 1)"), "1"),
        ("(let ((n 0)) " + nested(30, "(dotimes (i 1) ", ")", "(setq n (+ n 1))") + " n)", "1"),
        ("(let ((n 0)) " + nested(30, "(loop ", " (return))", "(setq n (+ n 1))") + " n)", "1"),
        ("(let ((n 0)) " + nested(30, "(unwind-protect ", " (setq n (+ n 1)))", "7") + " n)", "30"),
        ("(block out " + nested(30, "(unwind-protect ", " 1)", "(return-from out 7)") + ")", "7"),
        ("(let ((n 0)) " + nested(30, "(tagbody t# ", ")", "(if (< (incf n) 5) (go t3))") + " n)", "5"),
        ("(defvar *%s* 0) " + nested(30, "(let ((*%s* (+ *%s* 1))) ", ")", "*%s*"), "30"),
        (
            nested(30, "(handler-case ", " (type-error () 1))", "(error (symbol-name 'x))").replace(
                "type-", ""
            ),
            "1",
        ),
        (nested(30, "(with-recovery-procedures ((:x (abort 5))) (+ 1 ", "))", "(fail :x)"), "34"),
    ],
)
def test_thirty_levels_of_what_python_allows_twenty(text: str, expected: str) -> None:
    assert values_of(text) == expected


@pytest.mark.parametrize(
    ("jump", "expected"), [("(push :in r)", "31"), ("(return-from out (push :in r))", "31")]
)
def test_all_kinds_within_one_another(jump: str, expected: str) -> None:
    level = "(block b (unwind-protect (dotimes (i 1) (catch 'c "
    text = nested(30, level, ")) (push 1 r)))", jump)
    assert values_of(f"(let ((r nil)) (block out {text}) (length r))") == expected


@pytest.mark.parametrize(
    ("before", "after", "inside", "expected"),
    [
        ("(+ 1 ", ")", "0", "1000"),
        ("(+ ", " 1)", "0", "1000"),
        ("(- (+ 1 x) ", ")", "x", "1"),
        ("(progn 1 ", ")", "3", "3"),
        ("(car (list ", "))", "3", "3"),
        ("(funcall (lambda () ", "))", "x", "1"),
    ],
)
def test_a_thousand_levels_of_an_expression(before: str, after: str, inside: str, expected: str) -> None:
    count = 100 if "lambda" in before else 1000
    assert values_of(f"(let ((x 1)) {nested(count, before, after, inside)})") == expected


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("(let ((x x)) ", ")"),
        ("(let ((x x)) (funcall (lambda () x)) ", ")"),
        ("(if (= x 1) ", " 3)"),
        ("(if (/= x 1) 3 ", ")"),
        ("(if ", " x 4)"),
        ("(when (= x 1) (setq x 1) ", ")"),
        ("(and x ", ")"),
        ("(or (not x) ", ")"),
        ("(cond ((= x 2) 5) (t ", "))"),
        ("(multiple-value-bind (x) (values x 2) ", ")"),
        ("(setq x ", ")"),
        ("(prog1 ", " 5)"),
    ],
)
def test_three_hundred_levels_of_a_form(before: str, after: str) -> None:
    assert values_of(f"(let ((x 1)) {nested(300, before, after, 'x')})") == "1"
    assert values_of(f"(let ((x 1)) (list {nested(300, before, after, 'x')}))") == "(1)"


@pytest.mark.parametrize("before", ["(when (= x 1) (setq x 1) ", "(funcall (lambda () ", "(dotimes (i 1) "])
def test_more_levels_than_python_could_compile_are_refused(before: str) -> None:
    after = "))" if "lambda" in before else ")"
    assert mistake_of(f"(let ((x 1)) {nested(2000, before, after, 'x')})") == "nested-too-deep"


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("(dotimes (i 3) (dotimes (j 3) (if (= j 1) (return)) (push (list i j) r)))", "((2 0) (1 0) (0 0))"),
        ("(block b (dotimes (i 3) (dotimes (j 3) (if (= i j 1) (return-from b)) (push i r))))", "(1 0 0 0)"),
        (
            "(dotimes (i 2) (tagbody (dotimes (j 2) (if (= j 1) (go end)) (push j r)) (push :no r) end))",
            "(0 0)",
        ),
        (
            "(dotimes (i 2) (block b (dolist (x '(1 2)) (unwind-protect (return-from b) (push x r)))))",
            "(1 1)",
        ),
        (
            "(dotimes (i 2) (handler-case (progn (push i r) (car 5) (push :no r)) (error () (push :e r))))",
            "(:E 1 :E 0)",
        ),
    ],
)
def test_jumps_out_of_python_loops(text: str, expected: str) -> None:
    assert values_of(f"(let ((r nil)) {text} r)") == expected
