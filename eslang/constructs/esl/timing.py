"""Time: sleeping, deadlines, waiting for conditions, and doing things periodically.

The papers leave real time to the user's guide (ESL §6); what is here is ours.
"""

from __future__ import annotations

from eslang.base.arguments import take_keys
from eslang.base.failure import Failure, type_error
from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items, lisp_list
from eslang.base.many import many_of
from eslang.base.number_kinds import is_number
from eslang.base.running import running
from eslang.base.shown import shown
from eslang.base.symbols import Keyword, Symbol, T, Value
from eslang.base.text import String
from eslang.compile.registry import CL, ESL, function, macro
from eslang.constructs.conditions import (
    computed_once,
    is_one_query,
    query_form,
    test_form,
    with_variables,
)
from eslang.constructs.esl.tasks import LAMBDA, QUOTE, closure
from eslang.constructs.shapes import refuse
from eslang.constructs.watching import Look, Serving
from eslang.runtime import failures
from eslang.runtime.guarding import run_until
from eslang.runtime.periods import Periods

DEADLINE, WAIT, WHEN, MAKE_SERVING, SERVE, UNSERVED = (
    Symbol.intern(name, ESL)
    for name in ("%CALL-WITH-DEADLINE", "%WAIT-UNTIL", "%WHEN", "%MAKE-SERVING", "%SERVE", "%UNSERVED-P")
)
LET, LOOP, NOT = (Symbol.intern(name, CL) for name in ("LET", "LOOP", "NOT"))
DEADLINE_EXPIRED, TIMEOUT = Keyword("DEADLINE-EXPIRED"), Keyword("TIMEOUT")
LONGEST = 1e9  # seconds


def seconds_of(value: Value, operator: str, *, above_zero: bool = False) -> float:
    """VALUE, which is to be a time in seconds."""
    if not is_number(value) or value < 0 or value != value or (above_zero and value == 0):
        name = Symbol.intern(operator.upper(), CL if operator == "sleep" else ESL)
        raise type_error(value, "POSITIVE-REAL" if above_zero else "NON-NEGATIVE-REAL", name)
    return min(float(value), LONGEST)


@function("(sleep seconds)")
def sleep(seconds: Value) -> Value:
    """Let this task wait for SECONDS; the others go on.

    Returns: NIL.
    Fails:   :type-error, if SECONDS is no real number, or below 0.
    Waits:   until SECONDS have passed on the clock of the interpreter.
    """
    running.session.scheduler.sleep(seconds_of(seconds, "sleep"))
    return None


# --- deadlines -----------------------------------------------------------------------


@macro("(with-deadline (seconds) &body body)", ESL)
def with_deadline(form: Cons, environment: Any) -> Value:
    """Run BODY, which fails where it stands when SECONDS have passed.

    Of several deadlines the earliest counts; the arguments of the failure
    tell which it was.

    Returns: the values of BODY.
    Fails:   :deadline-expired inside BODY, with SECONDS and the place of the
             form.

    Example:
        ? (with-recovery-procedures ((:deadline-expired (abort :too-slow)))
            (with-deadline (2) (sleep 5) :done))
        Failure :DEADLINE-EXPIRED, recovery available. (No retries)
        :TOO-SLOW

    Source: language reference §4.
    """
    seconds, body = form.cdr.car, form.cdr.cdr
    if seconds.__class__ is not Cons or seconds.cdr is not None:
        wrong = f"`{shown(seconds)}` is no deadline"
        hint = "write `(seconds)`"
        refuse(environment, "malformed-form", wrong, form.cdr, hint=hint, within="with-deadline")
    span = environment.analyser.span if environment is not None else None
    place = String(f"{span.source.name}:{span.line}:{span.column}") if span is not None else None
    return lisp_list(DEADLINE, seconds.car, place, from_items([LAMBDA, None], body))


def with_deadline_values(seconds: Value, place: Value, body: Any) -> Value:
    """All the values of the body."""
    return run_to_deadline(seconds, place, many_of(body))


@function("(%call-with-deadline seconds place body)", ESL, many=with_deadline_values)
def call_with_deadline(seconds: Value, place: Value, body: Any) -> Value:
    """Call BODY, which fails when SECONDS have passed."""
    return run_to_deadline(seconds, place, body)


def run_to_deadline(seconds: Value, place: Value, body: Any) -> Value:
    """What BODY gives before SECONDS have passed."""

    def expire() -> Value:
        return failures.signal(Failure(DEADLINE_EXPIRED, seconds, place), continuable=True)

    return run_until(running.session.scheduler, seconds_of(seconds, "with-deadline"), expire, body)


# --- conditions ----------------------------------------------------------------------


@macro("(wait-until condition &key timeout)", ESL)
def wait_until(form: Cons, environment: Any) -> Value:
    """Wait until CONDITION holds; not at all if it does.

    A condition over facts is looked at again when a fact that it rests on has
    changed, and never else; comparisons of what facts say do not count as
    calls. One that calls Lisp is looked at again whenever another task has
    made a step; if it calls a primitive, on the real clock, also as time
    passes. What stands under a backquote is computed once.

    Returns: T.
    Fails:   :timeout, with the number of seconds, if CONDITION does not hold
             by then; :deadlock if nothing runs that could make it true.
    Waits:   until CONDITION holds.

    Example:
        ? (let ((cups 0))
            (spawn (dotimes (i 3) (sleep 1) (incf cups)))
            (wait-until (= cups 2))
            cups)
        2
        ? (progn (spawn (assert '(at robot dock))) (wait-until (at robot dock)))
        T

    Source: language reference §4 and 5; what wakes it: decision 19.
    """
    condition, options = form.cdr.car, form.cdr.cdr
    asked, bindings = computed_once(condition)
    test = closure(test_form(asked, environment))
    return with_variables(bindings, from_items([WAIT, lisp_list(QUOTE, condition), test], options))


@function("(%wait-until condition test &key timeout)", ESL)
def wait_until_function(condition: Value, test: Any, *options: Value) -> Value:
    """Wait until TEST is true."""
    (timeout,) = take_keys(options, ("TIMEOUT",))
    seconds = None if timeout is None else seconds_of(timeout, "wait-until")
    came = Look(condition, test).wait(seconds)
    return T if came else failures.signal(Failure(TIMEOUT, timeout), continuable=True)


@function("(%when condition test body)", ESL)
def when_function(condition: Value, test: Any, body: Any) -> Value:
    """Wait until TEST is true; then call BODY, with the logic variables of CONDITION bound."""
    look = Look(condition, test)
    look.wait(None)
    return look.inquiry.call_within(body)


@function("(%make-serving)", ESL)
def make_serving() -> Serving:
    """What WHENEVER remembers of the solutions that it has served."""
    return Serving()


@function("(%unserved-p query serving)", ESL)
def is_unserved(query: Value, serving: Serving) -> Value:
    """Tell whether QUERY has a solution that was not served."""
    return serving.look(query)


@function("(%serve serving condition test body)", ESL)
def serve(serving: Serving, condition: Value, test: Any, body: Any) -> Value:
    """Call BODY for the next solution, once TEST says that there is one."""
    return serving.serve(condition, test, body)


@macro("(whenever condition &body body)", ESL)
def whenever(form: Cons, environment: Any) -> Value:
    """Run BODY each time that CONDITION becomes true, and now if it is true.

    If CONDITION has logic variables, it is run for each solution that comes
    up, one after the other, and #?X in BODY is what ?X is bound to; again for
    the same one only when that was no solution in between. A change that comes
    and goes while BODY runs is not seen. RETURN leaves.

    Returns: what RETURN gives.
    Fails:   as BODY does; :deadlock if nothing runs that could change CONDITION.
    Waits:   until CONDITION becomes true.

    Example:
        ? (let ((level 0))
            (spawn (dotimes (i 4) (sleep 1) (setq level (- 1 level))) :daemon t)
            (whenever (= level 1) (return (list :full level))))
        (:FULL 1)
        ? (progn (spawn (dolist (order '(soup tea bill)) (assert `(order ,order))))
                 (whenever (order ?what)
                   (princ #?what)
                   (if (eq #?what 'bill) (return :done))))
        SOUPTEABILL
        :DONE

    Source: language reference §4; what wakes it: decision 19.
    """
    condition, run = form.cdr.car, from_items([LAMBDA, None], form.cdr.cdr)
    quoted = lisp_list(QUOTE, condition)
    asked, bindings = computed_once(condition)
    if is_one_query(asked):
        serving = Symbol.uninterned("SERVING")
        more = closure(lisp_list(UNSERVED, query_form(asked, environment), serving))
        each = lisp_list(LOOP, lisp_list(SERVE, serving, quoted, more, run))
        made = lisp_list(lisp_list(serving, lisp_list(MAKE_SERVING)))
        return with_variables(bindings, lisp_list(LET, made, each))
    test, no_more = (closure(test_form(each, environment)) for each in (asked, lisp_list(NOT, asked)))
    until = lisp_list(WAIT, lisp_list(QUOTE, lisp_list(NOT, condition)), no_more)
    return with_variables(bindings, lisp_list(LOOP, lisp_list(WHEN, quoted, test, run), until))


# --- periods -------------------------------------------------------------------------


@function("(%start-periods seconds)", ESL)
def start_periods(seconds: Value) -> Periods:
    """Periods of SECONDS, the first of which begins now."""
    return Periods(running.session.scheduler, seconds_of(seconds, "periodically", above_zero=True))


@function("(%wait-for-period periods)", ESL)
def wait_for_period(periods: Periods) -> Value:
    """Wait until the next period begins."""
    periods.wait()
    return None
