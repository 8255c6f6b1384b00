"""Expressions: the order of evaluation, whatever Python statements the parts need."""

from __future__ import annotations

import pytest
from compiling import values_of

PARTS = {
    "a call": "(note {})",
    "an assignment": "(setq x (note {}))",
    "a block": "(block b (if x (return-from b (note {}))) 5)",
    "a loop": "(dotimes (i 1 (note {})))",
    "a choice": "(if (progn (setq x 1) x) (note {}) 2)",
    "a let": "(let ((x (note {}))) (setq x x) x)",
    "a closure": "(funcall (lambda () (setq x 3) (note {})))",
    "a protected form": "(unwind-protect (note {}) (setq x 2))",
    "values": "(values (note {}) (setq x 9))",
    "received values": "(multiple-value-bind (p q) (values (note {}) 2) (setq x q) p)",
}
AROUND = [
    "(list {} {} {})",
    "(+ {} {} {})",
    "(< {} {} {})",
    "(cons {} (cons {} {}))",
    "(funcall #'list {} {} {})",
]


@pytest.mark.parametrize("around", AROUND)
@pytest.mark.parametrize("part", PARTS.values(), ids=PARTS)
@pytest.mark.parametrize("place", [0, 1, 2])
def test_arguments_are_computed_from_left_to_right(part: str, around: str, place: int) -> None:
    parts = [part.format(n) if n == place else f"(note {n})" for n in range(3)]
    text = f"(let* ((r nil) (x 1)) (flet ((note (n) (push n r) n)) {around.format(*parts)} (reverse r)))"
    assert values_of(text) == "(0 1 2)"


@pytest.mark.parametrize(
    ("form", "expected"),
    [
        ("(list x (setq x 2) x)", "(1 2 2)"),
        ("(list x (progn (setq x 2) 5) x)", "(1 5 2)"),
        ("(list x (funcall (lambda () (setq x 3))) x)", "(1 3 3)"),
        ("(+ x (setq x 5) x)", "11"),
        ("(list (setq x 2) (setq x 3) x)", "(2 3 3)"),
        ("(let ((y x) (z (setq x 7))) (list x y z))", "(7 1 7)"),
        ("(if (setq x nil) 1 (list x))", "(NIL)"),
        ("(list (or (setq x nil) x 4) x)", "(4 NIL)"),
        ("(funcall (progn (setq x 4) #'list) x)", "(4)"),
        ("(let ((f #'list)) (funcall f (progn (setq f #'vector) 1) x))", "(1 1)"),
        ("(list (and (setq x 2) (values x 3)) x)", "(2 2)"),
        ("(values x (setq x 2) x)", "1 2 2"),
        ("(car (list (values x (setq x 2)) x))", "1"),
    ],
)
def test_a_variable_is_read_when_its_turn_comes(form: str, expected: str) -> None:
    assert values_of(f"(let ((x 1)) {form})") == expected


def test_symbol_values_too_are_read_when_their_turn_comes() -> None:
    assert values_of("(defvar *%e* 1) (list *%e* (setq *%e* 2) (let ((*%e* 3)) *%e*) *%e*)") == "(1 2 3 2)"
