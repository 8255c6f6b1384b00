"""The law of the compiler: what it makes of a program does what a naive evaluator does.

The programs are made by chance (tests/programs); compared are the values or
the cause of the failure, the trace, and the special variables afterwards.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from io import StringIO
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given, settings

import naive.forms
import naive.functions
import naive.jumps  # noqa: F401
from eslang.base.failure import Failure
from eslang.base.lists import Cons, items
from eslang.base.spans import Source
from eslang.base.symbols import Value
from naive.evaluator import Naive, TooLong
from programs.words import SPECIALS
from strategies import programs

DEFINITIONS = """
    (defvar *trace* nil)
    (defvar *a* 10)
    (defvar *b* 20)
    (defun note (x) (setq *trace* (cons x *trace*)) x)
"""
LAW = settings(
    max_examples=60,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example],
)
Outcome = tuple[str, list[str], list[str], list[str]]


@cache
def interpreter() -> Any:
    """The one that compiles all programs."""
    from eslang.interpreter import Interpreter

    interp = Interpreter(clock="virtual", output=StringIO())
    interp.eval(DEFINITIONS)
    return interp


@pytest.fixture(scope="module", autouse=True)
def made_beforehand() -> None:
    """Make the interpreter before the first example."""
    interpreter()


@contextmanager
def deep_stack() -> Iterator[None]:
    """Lift the limit that Hypothesis sets to the stack of an example."""
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(100_000)
    try:
        yield
    finally:
        sys.setrecursionlimit(limit)


def shown(value: Value) -> str:
    """VALUE as text, the same for a function of either side."""
    if value.__class__ is Cons:
        return f"({' '.join(shown(each) for each in items(value))})"
    return "#<FUNCTION>" if callable(value) else str(value)


def outcome(kind: str, values: list[Value], trace: list[Value], specials: list[Value]) -> Outcome:
    """What came of a program, to be compared."""
    return kind, [*map(shown, values)], [*map(shown, trace)], [*map(shown, specials)]


def compiled(text: str) -> Outcome:
    """What the interpreter makes of a program."""
    interp = interpreter()
    cells = [interp.image.cell(interp.symbol(name)) for name in ("*trace*", *SPECIALS)]
    for cell, value in zip(cells, (None, *SPECIALS.values()), strict=True):
        cell.value = value
    try:
        (reading,) = interp.readings(Source("<program>", text))
        with deep_stack():
            kind, values = "values", interp.evaluate(reading)
    except Failure as failure:
        kind, values = "failure", [failure.cause]
    return outcome(kind, values, items(cells[0].value)[::-1], [cell.value for cell in cells[1:]])


def naively(text: str) -> Outcome:
    """What the naive evaluator makes of a program; one that takes too long is not considered."""
    (reading,) = interpreter().readings(Source("<program>", text))
    evaluator = Naive(SPECIALS)
    try:
        with deep_stack():
            kind, values = evaluator.run(reading.form)
    except TooLong:
        assume(False)
    return outcome(kind, values, evaluator.trace, list(evaluator.specials.values()))


@pytest.mark.slow
@LAW
@given(programs(failures=False))
def test_a_program_without_failures_does_what_it_naively_does(text: str) -> None:
    assert compiled(text) == naively(text)


@pytest.mark.slow
@LAW
@given(programs())
def test_a_program_that_fails_and_recovers_does_what_it_naively_does(text: str) -> None:
    assert compiled(text) == naively(text)


@pytest.mark.slow
@settings(LAW, max_examples=150)
@given(programs(depth=2))
def test_a_small_program_does_what_it_naively_does(text: str) -> None:
    assert compiled(text) == naively(text)


@pytest.mark.parametrize(
    "text",
    [
        "(flet ((g () (values 1 x))) (multiple-value-list (g)))",
        "(funcall (lambda (*a* &optional (v (note *a*))) (list *a* v)) 1)",
        "(let (fs) (dotimes (i 3) (setq fs (cons (lambda () (setq i (+ i 9))) fs))) (mapcar #'funcall fs))",
        "(let ((r nil)) (block b (setq r (lambda () (return-from b 1)))) (funcall r))",
        "(tagbody a (unwind-protect (go b) (note 1)) b (note 2))",
        "(catch 'c (unwind-protect (throw 'c (note 1)) (throw 'c (note 2))))",
        "(multiple-value-list (progn (values 1 2 3) (if (values nil 1) 2 (values))))",
    ],
)
def test_programs_that_once_went_wrong(text: str) -> None:
    program = f"(let ((x 5)) {text})"
    assert compiled(program) == naively(program)
