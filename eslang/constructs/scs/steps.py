"""Sequences of steps (SCS Appendix C): do and repeat."""

from __future__ import annotations

from eslang.base.hints import Any
from eslang.base.lists import Cons
from eslang.base.many import primary
from eslang.base.running import running
from eslang.base.symbols import Symbol, T, Value
from eslang.compile.registry import SCS, function, macro
from eslang.constructs.scs.asking import run_under
from eslang.constructs.scs.stepping import expand, in_order, read_steps
from eslang.runtime.circuits import stage_here

IN_ORDER, REPEAT = (Symbol.intern(name, SCS) for name in ("%DO-IN-ORDER", "%DO-REPEATEDLY"))


@macro("(do &rest steps)", SCS)
def do(form: Cons, environment: Any) -> Value:
    """Do STEPS in order; fail as soon as one of them fails.

    Modifiers stand before STEPS, each with a condition: :when or :unless,
    which is asked before they begin; :while or :until, which is asked after
    every action, and ends the construct wherever it is.

    Returns: the values of the last of STEPS; :deactivated, if a modifier ends it.
    Fails:   as the first of STEPS that fails.

    Example:
        ? (scs:do (princ "approach ") (princ "grip ") :done)
        approach grip
        :DONE
        ? (scs:do :when (evenp 3) (princ "never"))
        :DEACTIVATED

    Source: SCS Appendix C.
    """
    return expand(IN_ORDER, form, environment, None)


@macro("(do* &rest steps)", SCS)
def do_star(form: Cons, environment: Any) -> Value:
    """Do STEPS in order; one that fails is tried again until it succeeds.

    Returns: the values of the last of STEPS; :deactivated, if a modifier ends it.

    Example:
        ? (let ((tries 0))
            (scs:do* (if (< (incf tries) 3) (fail :slipped) tries)))
        3

    Source: SCS Appendix C.
    """
    return expand(IN_ORDER, form, environment, T)


def in_order_values(operator: Value, modifiers: Value, steps: Value, starred: Value) -> Value:
    """All that DO gives, or DO* if STARRED."""
    listed = read_steps(steps)
    return run_under(operator, modifiers, lambda: in_order(listed, starred is not None, stage_here()))


@function("(%do-in-order operator modifiers steps starred)", SCS, many=in_order_values)
def do_in_order(*parts: Value) -> Value:
    """DO, or DO* if STARRED."""
    return primary(in_order_values(*parts))


@macro("(repeat &rest steps)", SCS)
def repeat(form: Cons, environment: Any) -> Value:
    """Do STEPS in order, over and over, as DO does.

    Returns: :deactivated, when a modifier ends it.
    Fails:   as the first of STEPS that fails.

    Example:
        ? (let ((level 0))
            (repeat :while (< level 3) (princ (incf level))))
        123
        :DEACTIVATED

    Source: SCS Appendix C.
    """
    return expand(REPEAT, form, environment, None)


@macro("(repeat* &rest steps)", SCS)
def repeat_star(form: Cons, environment: Any) -> Value:
    """Do STEPS in order, over and over, as DO* does.

    Returns: :deactivated, when a modifier ends it.

    Example:
        ? (let ((turns 0))
            (repeat* :until (= turns 3) (if (oddp (incf turns)) (fail :odd))))
        :DEACTIVATED

    Source: SCS Appendix C.
    """
    return expand(REPEAT, form, environment, T)


@function("(%do-repeatedly operator modifiers steps starred)", SCS)
def do_repeatedly(operator: Value, modifiers: Value, steps: Value, starred: Value) -> Value:
    """REPEAT, or REPEAT* if STARRED."""
    listed = read_steps(steps)

    def body() -> Value:
        rounds = running.session.ticks.source
        stage = stage_here()
        while True:
            in_order(listed, starred is not None, stage)
            next(rounds)
            rounds = running.session.ticks.source

    return run_under(operator, modifiers, body)
