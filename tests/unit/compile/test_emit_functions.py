"""Closures: whose variables they see, and what those hold."""

from __future__ import annotations

import pytest
from compiling import values_of


@pytest.mark.parametrize(
    ("loop", "expected"),
    [
        ("(dotimes (i 3) (let ((j i)) (push (lambda () j) fs)))", "(2 1 0)"),
        ("(dotimes (i 3) (push (lambda () i) fs))", "(3 3 3)"),
        ("(dolist (x '(4 5 6)) (push (lambda () x) fs))", "(6 5 4)"),
        ("(dotimes (i 3) (let ((j i)) (push (lambda () (setq j (+ j 10))) fs)))", "(12 11 10)"),
        ("(dotimes (i 3) (let ((j i)) (setq j (* 2 j)) (push (lambda () j) fs)))", "(4 2 0)"),
        ("(dotimes (i 3) (let* ((j i) (k (* j j))) (push (lambda () (+ j k)) fs)))", "(6 2 0)"),
        (
            "(dotimes (i 3) (multiple-value-bind (q r) (floor i 2) (push (lambda () (list q r)) fs)))",
            "((1 0) (0 1) (0 0))",
        ),
        (
            "(dotimes (i 3) (flet ((f () i)) (let ((j i)) (push (lambda () (list j (f))) fs))))",
            "((2 3) (1 3) (0 3))",
        ),
        (
            "(dotimes (i 3) (let ((j i)) (labels ((f (n) (if n (f nil) j))) (push (lambda () (f 2)) fs))))",
            "(2 1 0)",
        ),
        (
            "(dotimes (i 3) (let ((j i)) (push (let ((k j)) (lambda () (list j k))) fs)))",
            "((2 2) (1 1) (0 0))",
        ),
        (
            "(let ((i 0)) (tagbody a (let ((j i)) (push (lambda () j) fs)) (if (< (incf i) 3) (go a))))",
            "(2 1 0)",
        ),
        ("(do ((i 0 (+ i 1))) ((= i 3)) (let ((j i)) (push (lambda () (lambda () j)) fs)))", None),
        ("(loop for i from 0 below 3 do (let ((j i)) (push (lambda () j) fs)))", "(2 1 0)"),
        ("(dotimes (i 3) (destructuring-bind (a b) (list i 5) (push (lambda () (+ a b)) fs)))", "(7 6 5)"),
        ("(mapc (lambda (x) (push (lambda () x) fs)) '(1 2 3))", "(3 2 1)"),
    ],
)
def test_each_round_has_variables_of_its_own(loop: str, expected: str | None) -> None:
    call = "#'funcall" if expected is not None else "(lambda (f) (funcall (funcall f)))"
    assert values_of(f"(let ((fs nil)) {loop} (mapcar {call} fs))") == (expected or "(2 1 0)")


def test_closures_of_one_round_share_its_variables() -> None:
    text = """
    (let ((fs nil))
      (dotimes (i 2)
        (let ((j i)) (push (cons (lambda () (setq j (+ j 10))) (lambda () j)) fs)))
      (funcall (car (first fs)))
      (funcall (car (first fs)))
      (mapcar (lambda (f) (funcall (cdr f))) fs))"""
    assert values_of(text) == "(21 0)"


def test_a_block_in_a_loop_is_left_from_its_own_round() -> None:
    text = (
        "(let ((r nil)) (dotimes (i 3) (push (block b (funcall (lambda () (return-from b (+ i 5))))) r)) r)"
    )
    assert values_of(text) == "(7 6 5)"


def test_a_counter() -> None:
    text = """
    (defun %counter () (let ((n 0)) (lambda (&optional (by 1)) (setq n (+ n by)))))
    (let ((a (%counter)) (b (%counter))) (list (funcall a) (funcall a 5) (funcall b) (funcall a)))"""
    assert values_of(text) == "(1 6 1 7)"


def test_parameters_that_closures_change() -> None:
    text = """
    (funcall (lambda (x &optional (y x) &key (z y))
               (mapc (lambda (n) (incf x n) (incf y n) (incf z n)) '(1 2))
               (list x y z))
             1)"""
    assert values_of(text) == "(4 4 4)"
