"""The end of the stack: deep recursion works, and recursion without end is a failure like others.

Each case runs in a Python of its own, since what goes wrong here would take the whole suite along.
"""

from __future__ import annotations

import subprocess
import sys
from typing import NamedTuple

import pytest

from support import ROOT

PROGRAM = """
import sys
from io import StringIO
from eslang.base.failure import Failure
from eslang.base.printer import prin1
from eslang.interpreter import Interpreter
interp = Interpreter(clock="virtual", output=StringIO())
limit, *texts = sys.argv[1:]
if limit != "0":
    sys.setrecursionlimit(int(limit))
for text in texts:
    try:
        result = interp.eval(text)
    except Failure as failure:
        result = failure.cause
    print(result)
print(interp.bindings.hidden)
print(sys.getrecursionlimit() == int(limit) or limit == "0")
"""
LOW = 40_000  # frames: soon reached, and yet more than the C stack would bear


class Path(NamedTuple):
    """A way for a function %F to come to itself, with `{}` for what it is called with."""

    definition: str
    call: str = "(%f {})"


def path(way: str, parameters: str = "n") -> Path:
    """%F counts down, and comes to itself by WAY."""
    return Path(f"(defvar *%v* 0) (defun %f ({parameters}) (if (= n 0) 0 {way}))")


PATHS = {
    "a call": path("(+ 1 (%f (- n 1)))"),
    "funcall": path("(+ 1 (funcall #'%f (- n 1)))"),
    "a symbol": path("(+ 1 (funcall (car '(%f)) (- n 1)))"),
    "apply": path("(+ 1 (apply #'%f (list (- n 1))))"),
    "labels": Path("(defun %f (n) (labels ((g (n) (if (= n 0) 0 (+ 1 (g (- n 1)))))) (g n)))"),
    "a closure": path("(+ 1 (funcall (lambda () (%f (- n 1)))))"),
    "rest arguments": path("(+ 1 (%f (- n 1) 2 3))", "n &rest more"),
    "keyword arguments": path("(+ 1 (%f (- n 1) :k 2))", "n &key k"),
    "a default": Path("(defun %f (n &optional (m (if (= n 0) 0 (%f (- n 1))))) (list m) n)"),
    "an argument left out": path("(+ 1 (%f (- n 1)))", "n &optional m"),
    "a rest unused": Path("(defun %f (n &rest r) (if (= n 0) 0 (+ 1 (%f (- n 1)))))"),
    "multiple values": path("(multiple-value-bind (a b) (%f (- n 1)) (values (+ 1 a) b))"),
    "multiple-value-call": path("(+ 1 (multiple-value-call #'%f (values (- n 1))))"),
    "a special variable": path("(let ((*%v* n)) (+ 1 (%f (- n 1))))"),
    "a special parameter": Path("(defvar *%v* 0) (defun %f (*%v*) (if (= *%v* 0) 0 (+ 1 (%f (- *%v* 1)))))"),
    "progv": path("(progv '(*%v*) '(1) (+ 1 (%f (- n 1))))"),
    "a loop": path("(dotimes (i 1 (+ i n)) (%f (- n 1)))"),
    "a setf function": Path(
        "(defun (setf %g) (v n) (if (= n 0) v (setf (%g (- n 1)) v)))", "(setf (%g {}) 1)"
    ),
    "structures": Path("(defstruct %s x) (defun %f (n) (if (= n 0) 0 (%s-x (make-%s :x (%f (- n 1))))))"),
}
SHALLOWER = {
    "many arguments": path("(+ 1 (apply #'%f (- n 1) '(2 3 4 5 6)))", "n &rest more"),
    "a block": path("(block b (+ 1 (funcall (lambda () (return-from b (%f (- n 1)))))))"),
    "a tagbody": path("(let (r) (tagbody (funcall (lambda () (setq r (%f (- n 1))) (go end))) end) r)"),
    "catch": path("(catch 'c (+ 1 (%f (- n 1))))"),
    "unwind-protect": path("(unwind-protect (+ 1 (%f (- n 1))) (setq *%v* (list n)))"),
    "a cleanup with calls": path('(unwind-protect (+ 1 (%f (- n 1))) (format nil "~a ~s" n (list n)))'),
    "mapcar": path("(+ 1 (car (mapcar #'%f (list (- n 1)))))"),
    "mapcar over two": path("(+ 1 (car (mapcar #'%f (list (- n 1)) '(2))))", "n &optional m"),
    "reduce": path("(reduce (lambda (a b) (%f (- n 1))) '(1 2))"),
    "sort": path("(progn (sort (list 1 2) (lambda (a b) (%f (- n 1)))) n)"),
    "find-if": path("(progn (find-if (lambda (a) (%f (- n 1))) '(1 2)) n)"),
    "remove-if": path("(progn (remove-if (lambda (a) (%f (- n 1))) '(1)) n)"),
    "some over two": path("(some (lambda (a b) (%f (- n 1))) '(1) '(2))"),
    "maphash": Path(
        "(defvar *%h* (make-hash-table)) (setf (gethash 1 *%h*) 2)"
        "(defun %f (n) (if (= n 0) 0 (maphash (lambda (k v) (%f (- n 1))) *%h*)))"
    ),
    "recovery procedures": path("(with-recovery-procedures ((:x (abort 1))) (+ 1 (%f (- n 1))))"),
    "a recovery procedure": path("(with-recovery-procedures (((:x m) (+ 1 (%f m)))) (fail :x (- n 1)))"),
    "retry": path(
        "(let (k) (with-recovery-procedures ((:x (retry))) (if k (+ 1 (%f (- n 1))) (fail :x (setq k t)))))"
    ),
    "a cleanup procedure": path("(with-cleanup-procedure (setq *%v* n) (+ 1 (%f (- n 1))))"),
    "handler-case": path("(handler-case (+ 1 (%f (- n 1))) (file-error () 3))"),
    "handler-bind": path("(handler-bind ((file-error #'list)) (+ 1 (%f (- n 1))))"),
    "restart-case": path("(restart-case (+ 1 (%f (- n 1))) (go-on () 3))"),
    "an output stream": path("(with-output-to-string (s) (princ (%f (- n 1)) s))"),
    "eval": path("(+ 1 (eval (list '%f (- n 1))))"),
}


def answers(limit: int, *texts: str) -> list[str]:
    """What a Python of its own prints of TEXTS, and whether no binding and no room is left."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(limit), *texts],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=100,
    )
    assert done.returncode == 0, done.stderr[-1000:]
    return done.stdout.splitlines()


def check_without_end(way: Path, limit: int) -> None:
    """Recursion without end, by WAY, fails; a recovery procedure may take that, again and again."""
    endless = way.call.format(-1)
    taken = f"(with-recovery-procedures ((:stack-exhausted (abort :taken))) {endless})"
    deep = f"(progn {way.call.format(300)} :done)"
    found = answers(limit, way.definition, deep, taken, taken, deep)
    assert found[1:] == [":DONE", ":TAKEN", ":TAKEN", ":DONE", "None", "True"]


@pytest.mark.slow
@pytest.mark.parametrize("way", PATHS.values(), ids=PATHS)
def test_recursion_may_be_a_hundred_thousand_deep(way: Path) -> None:
    found = answers(0, way.definition, f"(progn {way.call.format(100_000)} :done)")
    assert found[1:] == [":DONE", "None", "True"]


@pytest.mark.slow
@pytest.mark.parametrize("way", (PATHS | SHALLOWER).values(), ids=PATHS | SHALLOWER)
def test_recursion_without_end_is_a_failure_that_can_be_taken(way: Path) -> None:
    check_without_end(way, LOW)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["a call", "a special variable"])
def test_so_it_is_with_all_the_stack(name: str) -> None:
    check_without_end(PATHS[name], 0)


@pytest.mark.slow
def test_a_procedure_that_exhausts_the_stack_in_its_turn_is_a_failure() -> None:
    text = "(with-recovery-procedures ((:stack-exhausted (%f -1))) (%f -1))"
    assert answers(LOW, PATHS["a call"].definition, text, "(+ 1 2)")[1:] == [
        ":STACK-EXHAUSTED",
        "3",
        "None",
        "True",
    ]


@pytest.mark.slow
def test_the_innermost_procedure_answers_near_the_end_of_the_stack() -> None:
    definition = "(defun %f (n) (with-recovery-procedures ((:stack-exhausted (abort 5))) (+ 1 (%f n))))"
    found = answers(LOW, definition, "(> (%f 1) 1000)", "(> (%f 1) 1000)")
    assert found[1:] == ["True", "True", "None", "True"]
