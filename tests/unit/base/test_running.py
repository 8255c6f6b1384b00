"""The running session: two interpreters in one process never meet (decision 0002)."""

from __future__ import annotations

import threading
from io import StringIO

import pytest

from eslang import Failure, Interpreter
from eslang.base.running import running


def new(output: StringIO | None = None) -> Interpreter:
    """An interpreter on virtual time."""
    return Interpreter(clock="virtual", output=output or StringIO())


def test_each_has_its_own_definitions() -> None:
    first, second = new(), new()
    first.eval("(defun who () :first) (defvar *x* 1)")
    second.eval("(defun who () :second)")
    assert [str(first.eval("(who)")), str(second.eval("(who)"))] == [":FIRST", ":SECOND"]
    with pytest.raises(Failure):
        second.eval("*x*")


def test_each_writes_to_its_own_output_when_one_calls_the_other() -> None:
    out, inn = StringIO(), StringIO()
    outer, inner = new(out), new(inn)

    @outer.primitive
    def ask() -> object:
        return inner.eval("(princ :inside) 7")

    assert outer.eval("(princ :before) (prog1 (ask) (princ :after))") == 7
    assert (out.getvalue().split(), inn.getvalue().split()) == (["BEFOREAFTER"], ["INSIDE"])


def test_each_has_its_own_chance() -> None:
    first, second = new(), new()
    drawn = [first.eval("(random 1000000)") for _ in range(3)]
    assert [second.eval("(random 1000000)") for _ in range(3)] == drawn


def test_a_failure_of_one_is_recovered_in_the_other() -> None:
    outer, inner = new(), new()

    @outer.primitive
    def ask() -> object:
        return inner.eval("(fail :lost 3)")

    recovering = "(with-recovery-procedures (((:lost n) (abort (list :lost n)))) (ask))"
    found = outer.eval(recovering)
    assert [str(part) for part in found] == [":LOST", "3"]


def test_two_run_on_two_threads_at_once() -> None:
    results: dict[int, object] = {}

    def work(number: int) -> None:
        results[number] = new().eval(f"(let ((sum 0)) (dotimes (i 20000) (incf sum {number})) sum)")

    threads = [threading.Thread(target=work, args=(number,)) for number in (1, 2)]
    for each in threads:
        each.start()
    for each in threads:
        each.join()
    assert results == {1: 20000, 2: 40000}


def test_outside_of_any_entrance_no_session_runs() -> None:
    interp = new()
    interp.eval("(+ 1 2)")
    assert running.session is None
    with pytest.raises(Failure):
        interp.eval("(fail :lost)")
    assert running.session is None
