"""Guardians (ESL §4.4): a task that watches over another."""

from __future__ import annotations

from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items, lisp_list
from eslang.base.many import many_of
from eslang.base.running import running
from eslang.base.symbols import Symbol, Value
from eslang.compile.registry import ESL, function, macro
from eslang.constructs.esl.task_nets import making_of_form
from eslang.constructs.esl.tasks import LAMBDA, closure
from eslang.runtime.guarding import run_guarded
from eslang.runtime.tasks import Task

GUARD = Symbol.intern("%CALL-WITH-GUARDIAN", ESL)


@macro("(with-guardian guardform failform &body body)", ESL)
def with_guardian(form: Cons, environment: Any) -> Value:
    """Run BODY while GUARDFORM, in a task of its own, watches over it.

    If BODY ends, in any way, GUARDFORM is aborted. If GUARDFORM ends before,
    by returning or by failing, the task that runs BODY is interrupted where
    it stands and runs FAILFORM there, so that recovery procedures inside BODY
    may answer its failure. If FAILFORM returns, BODY goes on, unguarded.

    Returns: the values of BODY.
    Fails:   as FAILFORM does, usually.
    Waits:   for the guardian's cleanup procedures, at the end.

    Example:
        ? (with-guardian (sleep 3) (fail :battery-low)
            (sleep 1)
            :done)
        :DONE

    Source: ESL §4.4; procedures that answer from outside: decision 23.
    """
    guard, alarm, body = form.cdr.car, form.cdr.cdr.car, form.cdr.cdr.cdr
    return lisp_list(GUARD, making_of_form(guard), closure(alarm), from_items([LAMBDA, None], body))


def with_guardian_values(guard: Task, action: Any, body: Any) -> Value:
    """All the values of the body."""
    return run_guarded(running.session.scheduler, guard, action, many_of(body))


@function("(%call-with-guardian guard action body)", ESL, many=with_guardian_values)
def call_with_guardian(guard: Task, action: Any, body: Any) -> Value:
    """Call BODY under GUARD; ACTION when that ends before."""
    return run_guarded(running.session.scheduler, guard, action, body)
