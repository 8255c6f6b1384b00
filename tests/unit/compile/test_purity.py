"""Which expanders may be run once and for all."""

from __future__ import annotations

import pytest

from eslang import Interpreter
from eslang.compile.purity import is_pure


def purity_of(text: str, name: str = "m") -> bool:
    """Whether the macro called NAME, which TEXT defines, is pure."""
    interp = Interpreter(clock="virtual")
    interp.eval(text)
    return is_pure(interp.image.cell(interp.symbol(name)).macro)


@pytest.mark.parametrize(
    "text",
    [
        "(defmacro m (x) `(list ,x ,x))",
        "(defmacro m (&rest xs) `(progn ,@(mapcar (lambda (x) `(print ,x)) xs)))",
        "(defun twice (x) (list x x)) (defmacro m (x) `(list ,@(twice x)))",
        "(defconstant +n+ 3) (defmacro m (x) `(list ,x ,+n+))",
        "(defmacro m (x) (let ((g (gensym))) `(let ((,g ,x)) ,g)))",
    ],
)
def test_an_expander_that_only_builds_is_pure(text: str) -> None:
    assert purity_of(text)


@pytest.mark.parametrize(
    "text",
    [
        "(defvar *n* 0) (defmacro m () (incf *n*))",
        "(defvar *n* 0) (defmacro m () *n*)",
        "(defmacro m () (print :expanding))",
        "(defmacro m () (random 10))",
        "(defvar *table* (make-hash-table)) (defmacro m (x) (setf (gethash x *table*) t) nil)",
        "(defun note (x) (print x)) (defmacro m (x) (note x))",
        "(defmacro m (x) (setf (car x) 1) x)",
        "(defmacro m (x) (funcall (lambda () (read-line))) x)",
    ],
)
def test_an_expander_that_reads_or_changes_state_is_not(text: str) -> None:
    assert not purity_of(text)
