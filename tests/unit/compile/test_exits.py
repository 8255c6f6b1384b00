"""Jumps: blocks, tags, loops, catch and throw, unwind-protect; and their values."""

from __future__ import annotations

import pytest
from compiling import failure_of, mistake_of, values_of


@pytest.mark.parametrize(
    ("form", "expected"),
    [
        ("(block b)", "NIL"),
        ("(block b 1 (values 2 3))", "2 3"),
        ("(block b (return-from b (values 1 2)) 3)", "1 2"),
        ("(block b (return-from b))", "NIL"),
        ("(block nil (return 5))", "5"),
        ("(block a (block b (return-from a 1)) 2)", "1"),
        ("(block a (block a (return-from a 1)) 2)", "2"),
        ("(block b (funcall (lambda () (return-from b (values 1 2)))) 3)", "1 2"),
        ("(block b (mapcar (lambda (x) (if (> x 1) (return-from b x))) '(1 2 3)))", "2"),
        ("(+ 1 (block b (+ 1 (return-from b 5))))", "6"),
        (
            "(list (block b (dotimes (i 9) (dotimes (j 9) (if (= j 3) (return-from b (list i j)))))))",
            "((0 3))",
        ),
        ("(tagbody 1 2)", "NIL"),
        ("(let ((n 0)) (tagbody a (setq n (+ n 1)) (if (< n 5) (go a))) n)", "5"),
        ("(let ((r nil)) (tagbody (go b) a (push 1 r) (go c) b (push 2 r) (go a) c) r)", "(1 2)"),
        ("(let ((n 0)) (tagbody a (funcall (lambda () (setq n (+ n 1)) (if (< n 3) (go a))))) n)", "3"),
        ("(let ((n 0)) (tagbody 5 (setq n (+ n 1)) (if (< n 3) (go 5))) n)", "3"),
        ("(let ((r nil)) (tagbody (tagbody (go x) y) (push 1 r) x (push 2 r)) r)", "(2)"),
        ("(catch 'c 1 (values 2 3))", "2 3"),
        ("(catch 'c (throw 'c (values 1 2)))", "1 2"),
        ("(catch 'a (catch 'b (throw 'a 1)) 2)", "1"),
        ("(catch 'a (catch 'a (throw 'a 1)) 2)", "2"),
        ("(+ 1 (catch 'c (funcall (lambda () (throw 'c 4)))))", "5"),
        ("(unwind-protect (values 1 2) 3)", "1 2"),
        ("(let ((r nil)) (catch 'c (unwind-protect (throw 'c 1) (push 2 r))) r)", "(2)"),
        ("(let ((r nil)) (block b (unwind-protect (return-from b 1) (push 2 r))) r)", "(2)"),
        ("(block b (unwind-protect (return-from b 1) (return-from b 2)))", "2"),
        ("(catch 'a (unwind-protect (throw 'a 1) (throw 'a 2)))", "2"),
        ("(let ((n 0)) (tagbody a (unwind-protect (if (< n 3) (go a)) (setq n (+ n 1)))) n)", "4"),
        ("(let ((r nil)) (ignore-errors (unwind-protect (car 5) (push 1 r))) r)", "(1)"),
        ("(dolist (x '(1 2 3) (values x 4)))", "NIL 4"),
        ("(dolist (x '(1 2 3)) (if (= x 2) (return (values x 5))))", "2 5"),
        ("(dotimes (i 3 i))", "3"),
        ("(do ((i 0 (+ i 1)) (j 0 i)) ((= i 3) (list i j)))", "(3 2)"),
        ("(do* ((i 0 (+ i 1)) (j 0 i)) ((= i 3) (list i j)))", "(3 3)"),
        ("(loop (return (values 1 2)))", "1 2"),
        ("(prog (x) (setq x 1) a (setq x (+ x 1)) (if (< x 5) (go a)) (return x))", "5"),
    ],
)
def test_the_values_of_a_form(form: str, expected: str) -> None:
    assert values_of(form) == expected


@pytest.mark.parametrize(
    ("form", "name"),
    [
        ("(return-from %nowhere 1)", "unknown-block"),
        ("(return 1)", "unknown-block"),
        ("(block b (flet ((g () 1)) (return-from g 1)))", "unknown-block"),
        ("(go %nowhere)", "unknown-tag"),
        ("(tagbody a b a)", "duplicate-tag"),
        ("(block 5)", "malformed-form"),
    ],
)
def test_a_jump_to_nowhere_is_refused(form: str, name: str) -> None:
    assert mistake_of(form) == name


@pytest.mark.parametrize(
    "form",
    [
        "(throw 'nowhere 1)",
        "(let ((f nil)) (block b (setq f (lambda () (return-from b 1)))) (funcall f))",
        "(let ((f nil)) (tagbody a (setq f (lambda () (go a)))) (funcall f))",
        "(let ((f nil)) (catch 'c (setq f (lambda () (throw 'c 1)))) (funcall f))",
    ],
)
def test_a_jump_to_what_has_been_left_is_a_failure(form: str) -> None:
    assert failure_of(form, 0) == ":CONTROL-ERROR"


def test_each_entrance_of_a_block_is_one_of_its_own() -> None:
    text = """
    (defun %x1 (n inner)
      (block b
        (if (= n 0)
            (funcall inner)
            (list n (%x1 (- n 1) (or inner (lambda () (return-from b :outermost))))))))
    (%x1 3 nil)"""
    assert values_of(text) == ":OUTERMOST"


def test_cleanups_run_innermost_first_and_before_the_jump_lands() -> None:
    text = """
    (let ((r nil))
      (block b
        (unwind-protect
            (unwind-protect (funcall (lambda () (return-from b (push 1 r)))) (push 2 r))
          (push 3 r)))
      (push 4 r)
      (reverse r))"""
    assert values_of(text) == "(1 2 3 4)"
