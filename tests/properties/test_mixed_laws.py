"""The law of mixed plans: whatever SCS and ESL do inside each other, nothing of it is left behind.

Plans are made by chance of the constructs of both. Every cleanup procedure
that was entered has run once, or its body has ended; no task lives, no
condition is looked at or watched, and every property lock is free.
"""

from __future__ import annotations

import sys
from io import StringIO

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from eslang import Failure, Interpreter
from trees.remains import of_the_run

FAILED_ALONE = "lives.unseen"  # what was spawned may have failed while nobody looked

WORLD = """
(defvar *inside* 0) (defvar *x* 0)
(defproperty mode (number)) (defproperty power (state))
(assert '(mode 0)) (assert '(power :off)) (assert '(p 1)) (assert '(q 1))
(to-achieve (power ?s) (t (sleep 0.03) (update '(power ?_) '(power #?s))))
(defun flip (name) (if (db-query (list name 1)) (retract (list name 1)) (assert (list name 1))))
(defaction act () (incf *x*))
(defaction slow () (sleep 0.02) 1)
(defaction flipping (name) (flip name))
(defaction bad () (fail :bad))
(defmacro tracked (body)
  `(progn (incf *inside*)
          (multiple-value-prog1 (with-cleanup-procedure (decf *inside*) ,body) (decf *inside*))))
"""
CONDITIONS = st.sampled_from(
    [
        *("t", "(p 1)", "(q ?v)", "(mode 0)", "(not (p 1))", "(and (p ?v) (q ?v))", "(or (q 1) (mode 1))"),
        *("(evenp *x*)", "(< (mod *x* 7) 5)", "(and (p 1) (oddp *x*))"),
    ]
)
LEAVES = st.sampled_from(
    [
        *(
            "(act)",
            "(slow)",
            "(flipping 'p)",
            "(flipping 'q)",
            "(bad)",
            '(error "x")',
            "(sleep 0.01)",
            "(yield)",
        ),
        *(
            "(update '(mode ?_) '(mode 0))",
            "(update '(mode ?_) '(mode 1))",
            "(progn (act) (sleep 0.01) (act))",
        ),
        *("(atomic (flip 'p) (sleep 0.01) (flip 'p))", "(wait-until (p 1) :timeout 0.05)"),
    ]
)
SHAPES = st.sampled_from(
    [
        *("(scs:do {a} {b})", "(scs:do :while {c} {a} {b})", "(scs:do :until {c} :when {d} {a} {b})"),
        *(
            "(do-all {a} {b})",
            "(do-all :while {c} {a} {b})",
            "(do-any {a} {b})",
            "(do-any :unless {c} {a} {b})",
        ),
        *("(do-first ({c} {a}) ({d} {b}))", "(do-first :while {c} ({d} {a}) (t {b}))"),
        *("(do-best ({c} 1 {a}) ({d} *x* {b}))", "(do*-first ({c} {a}) ({d} {b}))"),
        *("(repeat :while {c} (sleep 0.01) {a} {b})", "(with-cycle (50) :while {c} {a})"),
        *("(scs:do* :while {c} {a})", "(do*-all :until {c} {a} {b})", "(do*-any {a} {b})"),
        *("(task-net (a {a}) (b {b}))", "(task-net :allow-failures (a {a}) (b {b}))"),
        *("(or-parallel {a} {b})", "(with-guardian {a} (fail :guarded) {b})"),
        *("(with-recovery-procedures ((:bad (retry))) {a})", "(with-recovery-procedures ((:bad {a})) {b})"),
        *("(with-deadline (0.02) {a})", "(with-maintained-properties ((power :on)) {a})"),
        *("(let ((task (spawn {a}))) {b} (abort-task task))",),
    ]
)


def within(shape: str, a: str, b: str, c: str, d: str) -> str:
    """A construct, with a deadline around it: it may idle, or go on for ever."""
    return f"(tracked (with-deadline (0.1) {shape.format(a=a, b=b, c=c, d=d)}))"


PLANS = st.recursive(
    LEAVES, lambda inner: st.builds(within, SHAPES, inner, inner, CONDITIONS, CONDITIONS), max_leaves=12
)


def fresh(seed: int, output: StringIO) -> Interpreter:
    """An interpreter that does not change the limit of the stack, which Hypothesis watches."""
    limit = sys.getrecursionlimit()
    try:
        return Interpreter(clock="virtual", seed=seed, output=output)
    finally:
        sys.setrecursionlimit(limit)


@pytest.mark.slow
@settings(
    max_examples=60,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example],
)
@given(st.builds(within, SHAPES, PLANS, PLANS, CONDITIONS, CONDITIONS), st.integers(0, 2**16))
def test_nothing_is_left_of_a_mixed_plan(plan: str, seed: int) -> None:
    with fresh(seed, StringIO()) as agent:
        agent.eval(WORLD)
        try:
            agent.eval(f"(with-deadline (1) {plan})")
        except Failure as failure:
            assert str(failure.cause) not in (":DEADLOCK", ":PYTHON-ERROR"), failure
        agent.eval("(sleep 9)")
        assert agent.eval("*inside*") == 0
        assert {name: left for name, left in of_the_run(agent).items() if left and name != FAILED_ALONE} == {}
        assert [str(name) for name, made in agent.database.relations.items() if made.watched] == []
        for state in (":on", ":off"):
            agent.eval(f"(with-deadline (1) (with-maintained-properties ((power {state})) 1))")
