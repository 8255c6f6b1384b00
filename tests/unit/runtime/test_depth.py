"""Tasks deep in the stack: they wait there, and what they must do whole is not cut by its end."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

import pytest

from eslang import interpreter
from eslang.base.stack import STACK
from eslang.runtime import lives
from support import lines_of
from trees.remains import remains
from trees.running import Run

DEEP = "(defun deep (n) (if (= n 0) (progn (yield) (sleep 1) 0) (+ 1 (deep (1- n)))))"
ENDLESS = "(defun endless (n) (+ 1 (endless n)))"


@pytest.fixture
def low(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A stack of 1500 frames."""
    limit = sys.getrecursionlimit()
    monkeypatch.setattr(interpreter, "DEEPEST", 1500)
    sys.setrecursionlimit(1500)
    yield
    sys.setrecursionlimit(limit)


def outcome(*forms: str) -> str:
    """What comes of FORMS; nothing may be left."""
    run = Run().evaluate("\n".join(forms))
    assert remains(run) == []
    return run.outcome.removesuffix(" None").strip()


@pytest.mark.slow
def test_two_tasks_wait_at_a_depth_of_50_000() -> None:
    net = "(multiple-value-list (task-net (a (deep 50000)) (b (deep 50000)) (c (sleep 0.5) :c)))"
    assert outcome(DEEP, net) == "[50000, 50000, Keyword('C')]"


@pytest.mark.slow
def test_the_stack_may_be_exhausted_in_tasks_while_others_are_deep_in_theirs() -> None:
    net = """(multiple-value-list
               (task-net (a (deep 50000))
                         (b (with-recovery-procedures (:stack-exhausted (sleep 2) (abort :b)) (endless 1)))
                         (c (with-recovery-procedures (:stack-exhausted (sleep 1) (abort :c)) (endless 1)))
                         (d (dotimes (i 8) (sleep 0.25)) :d)))"""
    assert outcome(DEEP, ENDLESS, net) == "[50000, Keyword('B'), Keyword('C'), Keyword('D')]"
    assert STACK.raised == 0


AT_THE_END = {
    "nets": "(task-net (a (sleep 1)) (b (yield)))",
    "guardians": "(with-guardian (sleep 1) (note :alarm) (yield))",
    "deadlines": "(with-deadline (100) (yield))",
    "sleeps": "(sleep 1)",
    "turns": "(yield)",
    "conditions": "(wait-until (not nil))",
    "waits": "(progn (spawn (signal *e1*)) (wait-for-events *e1*))",
    "spawned tasks": "(wait-for-task (spawn (sleep 1)))",
    "cleanups": "(unwind-protect 1 (yield))",
    "interrupts": "(interrupt-task (current-task) (lambda () (yield)))",
    "masks": "(without-interrupts (yield))",
}


@pytest.mark.slow
@pytest.mark.parametrize("kind", AT_THE_END)
@pytest.mark.parametrize("where", ["main", "a task"])
def test_at_the_end_of_the_stack_nothing_is_lost_by(kind: str, where: str, low: Any) -> None:
    function = f"(defun f (n) (let ((*d* n)) {AT_THE_END[kind]} (prog1 (+ 1 (f (1+ n))) (here n))))"
    call = "(with-recovery-procedures (:stack-exhausted (abort :full)) (f 1))"
    others = "(spawn (dotimes (i 50) (sleep 1) (here 0)))"
    plan = call if where == "main" else f"(task-net (a {call}) (b (dotimes (i 9) (yield) (here 0))))"
    run = Run().evaluate(f"{function} {others} {plan} (here 0)")
    assert remains(run) == []
    assert "STACK" not in run.outcome


@pytest.mark.slow
def test_interrupts_inside_one_another_do_not_exhaust_the_stack_of_c() -> None:
    net = """(let ((n 0) (done nil))
               (task-net (a (with-recovery-procedures (:stack-exhausted (abort :full)) (loop
                   (when done (return)))))
                         (b (dotimes (k 5000) (interrupt-task a (lambda () (incf n) (dotimes
                             (i 9000)))) (yield))
                            (setq done t)))
               (< 100 n 5001))"""
    assert outcome(net) == "True"


def test_nets_inside_one_another_without_end_fail(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lives, "NESTED", 1000)
    text = """
    (defun nest (n) (task-net (deeper (nest (+ n 1)))))
    (with-recovery-procedures ((:stack-exhausted (abort (print :given-up))))
      (nest 0))
    (defun chain () (spawn (chain)))
    (with-recovery-procedures ((:stack-exhausted (abort (print :given-up))))
      (task-net (first (chain))))
    """
    assert lines_of(text) == [":GIVEN-UP", ":GIVEN-UP"]


INSIDE = "(defun inside (n) (if (= n 0) :bottom (nth-value 0 (task-net (next (inside (1- n)))))))"


@pytest.mark.slow
def test_nets_may_stand_thousands_deep_inside_one_another() -> None:
    assert lines_of(f"{INSIDE} (print (inside 3000))") == [":BOTTOM"]


@pytest.mark.slow
def test_nets_too_deep_inside_one_another_exhaust_the_stack() -> None:
    form = "(with-recovery-procedures ((:stack-exhausted (abort (print :too-deep)))) (inside 40000))"
    assert lines_of(f"{INSIDE} {form}") == [":TOO-DEEP"]
