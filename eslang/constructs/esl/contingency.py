"""Contingency handling (ESL §2): failures, recovery procedures, cleanup procedures.

The constructs are macros over a few internal functions that hand bodies and
procedures, as functions, to the runtime. Which form a (retry) belongs to is a
matter of text: an internal name stands, inside each clause, for its form.
"""

from __future__ import annotations

from eslang.base.control import AbortNow, RetryNow
from eslang.base.failure import Failure, control_error, type_error
from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items, items, lisp_list
from eslang.base.many import many_of
from eslang.base.running import running
from eslang.base.shown import shown
from eslang.base.symbols import Symbol, Value
from eslang.compile.registry import ESL, function, macro
from eslang.constructs.esl.clauses import (
    INFINITE,
    THIS_FORM,
    RecoveryClause,
    is_one_clause,
    warn_of_unreachable,
)
from eslang.constructs.shapes import refuse
from eslang.runtime import failures
from eslang.runtime.failures import Clause, Form


def _cl(name: str) -> Symbol:
    return Symbol.intern(name, "COMMON-LISP")


def _esl(name: str) -> Symbol:
    return Symbol.intern(name, ESL)


NEW_FAILURE = Failure.__new__
LAMBDA, LET, LIST, QUOTE = map(_cl, ("LAMBDA", "LET", "LIST", "QUOTE"))
MAKE_FORM, RECOVER, RETRY, ABORT, CLEAN = map(
    _esl, ("%MAKE-RECOVERY-FORM", "%CALL-WITH-RECOVERY-PROCEDURES", "%RETRY", "%ABORT", "%CALL-WITH-CLEANUP")
)


@function("(fail cause &rest arguments)", ESL)
def fail(cause: Value, *arguments: Value) -> Value:
    """Fail with CAUSE and ARGUMENTS: call the active recovery procedure.

    The procedure is called here, before anything is unwound. It may jump
    away with RETRY or ABORT; if it runs off its end, execution goes on here.

    Returns: the value of the recovery procedure that answered.
    Fails:   with CAUSE, if no active procedure answers it.

    Example:
        ? (with-recovery-procedures ((:low-power 7))
            (+ 1 (fail :low-power)))
        Failure :LOW-POWER, recovery available. (No retries)
        8

    Source: ESL §2.1. A procedure that runs off its end: decision 4.
    """
    if not isinstance(cause, Symbol):
        raise type_error(cause, "SYMBOL", "fail")
    failure = NEW_FAILURE(Failure, cause, *arguments)  # as its __init__ would, in half the time
    failure.cause, failure.arguments = cause, arguments
    value = failures.answer(failure, True)
    if value.__class__ is failures.Jumps:
        raise value.pop()
    return value


# --- recovery procedures -------------------------------------------------------------


@macro("(with-recovery-procedures clauses &body body)", ESL)
def with_recovery_procedures(form: Cons, environment: Any) -> Value:
    """Run BODY; while it runs, CLAUSES answer its failures.

    A clause is (CAUSE [:retries N] . BODY) or ((CAUSE . ARGS) [:retries N] . BODY).
    A failure calls the first clause for its cause that has retries left;
    :general-failure answers any cause. N is 1 unless given, and may be :infinite.
    Clauses see one another, as in LABELS: a clause that fails may be answered
    by a sibling, or by itself. One clause may stand without a list around it.

    Returns: the value of BODY, or RESULT where a clause calls (abort RESULT).
    Fails:   with the cause at hand, when no clause is left to answer it.

    Example:
        ? (with-recovery-procedures ((:stuck (abort :freed)))
            (fail :stuck))
        Failure :STUCK, recovery available. (No retries)
        :FREED

    Source: ESL §2.1. A clause that runs off its end: decision 4.
    """
    clauses = form.cdr.car
    holder = form.cdr
    if clauses.__class__ is Cons and is_one_clause(clauses):
        parts = [RecoveryClause(clauses, holder, environment)]
    elif clauses is None or clauses.__class__ is Cons:
        parts = []
        rest = clauses
        while rest is not None:
            parts.append(RecoveryClause(rest.car, rest, environment))
            rest = rest.cdr
    else:
        refuse(environment, "malformed-clause", f"`{shown(clauses)}` is no list of recovery clauses", holder)
    warn_of_unreachable(parts, environment)
    this = Symbol.uninterned("FORM")
    procedures = [part.procedure(this) for part in parts]
    body = Cons(LAMBDA, Cons(None, form.cdr.cdr))
    call = lisp_list(RECOVER, this, body, _specifications(parts), *procedures)
    return lisp_list(LET, lisp_list(lisp_list(this, lisp_list(MAKE_FORM))), call)


def _specifications(parts: list[RecoveryClause]) -> Value:
    """The form that gives what is known of the clauses: a constant, unless some retries are computed."""
    if all(part.limit is INFINITE or part.limit.__class__ is int for part in parts):
        return lisp_list(
            QUOTE, from_items([lisp_list(part.cause, part.limit, part.place()) for part in parts])
        )
    listed = [
        lisp_list(LIST, lisp_list(QUOTE, part.cause), part.limit, lisp_list(QUOTE, part.place()))
        for part in parts
    ]
    return Cons(LIST, from_items(listed))


def _of_this_form(form: Cons, environment: Any, operator: Symbol, name: str, *arguments: Value) -> Value:
    """The call of OPERATOR for the form whose recovery clause FORM stands in."""
    if environment is None or environment.find_variable(THIS_FORM) is None:
        message = f"`{name}` stands outside a recovery clause"
        if environment is None:
            raise control_error(message)
        environment.analyser.fail(
            f"{name}-outside-recovery",
            message,
            hint=f"move `({name})` into a clause of `with-recovery-procedures`",
        )
    return lisp_list(operator, THIS_FORM, *arguments)


@macro("(retry)", ESL)
def retry(form: Cons, environment: Any) -> Value:
    """Run the body of the WITH-RECOVERY-PROCEDURES form from its start again.

    It stands inside a recovery clause, and jumps; the clause's retries are
    not renewed by it.

    Example:
        ? (let ((tries 0))
            (with-recovery-procedures ((:slipped :retries 2 (retry)))
              (if (< (incf tries) 3) (fail :slipped) tries)))
        Failure :SLIPPED, recovery available. (1 retry)
        Failure :SLIPPED, recovery available. (No retries)
        3

    Source: ESL §2.1.
    """
    return _of_this_form(form, environment, RETRY, "retry")


@macro("(abort &optional result)", ESL)
def abort(form: Cons, environment: Any) -> Value:
    """Return RESULT from the WITH-RECOVERY-PROCEDURES form at once.

    It stands inside a recovery clause.

    Example:
        ? (with-recovery-procedures ((:no-path (abort :stay)))
            (fail :no-path)
            :moved)
        Failure :NO-PATH, recovery available. (No retries)
        :STAY

    Source: ESL §2.1.
    """
    result = form.cdr.car if form.cdr is not None else None
    return _of_this_form(form, environment, ABORT, "abort", result)


function("(%make-recovery-form)", ESL)(Form)


class Known(dict[int, tuple[Value, tuple[Clause, ...]]]):
    """The clauses of specifications that were met, by the identity of each; it keeps them alive."""

    MOST = 10_000

    def clauses(self, specifications: Value) -> tuple[Clause, ...]:
        """The clauses that SPECIFICATIONS tell."""
        known = self.get(id(specifications))
        if known is not None:
            return known[1]
        if len(self) >= self.MOST:
            self.clear()
        clauses = tuple([_clause(*items(specification)) for specification in items(specifications)])
        self[id(specifications)] = specifications, clauses
        return clauses


KNOWN = Known()


def _clause(cause: Value, limit: Value, place: Value) -> Clause:
    if limit is not INFINITE and (limit.__class__ is not int or limit < 0):
        raise type_error(limit, "UNSIGNED-BYTE", "with-recovery-procedures")
    return Clause(cause, limit if limit.__class__ is int else None, place)


def _recover_many(form: Form, body: Value, specifications: Value, *procedures: Value) -> Value:
    return failures.run_form(form, KNOWN.clauses(specifications), procedures, many_of(body))


@function(
    "(%call-with-recovery-procedures form body specifications &rest procedures)", ESL, many=_recover_many
)
def call_with_recovery_procedures(
    form: Form, body: Value, specifications: Value, *procedures: Value
) -> Value:
    """Call BODY while PROCEDURES, of which SPECIFICATIONS tell, answer its failures."""
    return failures.run_form(form, KNOWN.clauses(specifications), procedures, body)


function("(%retry form)", ESL)(failures.retry)
function("(%abort form result)", ESL)(failures.abort)
function("(%retry-as-value form)", ESL)(RetryNow)
function("(%abort-as-value form result)", ESL)(AbortNow)


# --- inside a recovery procedure -----------------------------------------------------


def _answered(name: str) -> Failure:
    answering: list[tuple[Failure, Form]] = running.session.dynamic.answering
    if not answering:
        raise control_error(f"{name} is called outside a recovery procedure")
    return answering[-1][0]


@function("(failure-cause)", ESL)
def failure_cause() -> Value:
    """Give the cause of the failure that is being answered.

    Fails:   :control-error outside a recovery procedure.

    Example:
        ? (with-recovery-procedures ((:general-failure (abort (failure-cause))))
            (fail :motor-stalled 3))
        Failure :MOTOR-STALLED, recovery available. (No retries)
        :MOTOR-STALLED

    Source: language reference §2.
    """
    return _answered("FAILURE-CAUSE").cause


@function("(failure-arguments)", ESL)
def failure_arguments() -> Value:
    """Give the list of arguments of the failure that is being answered.

    Fails:   :control-error outside a recovery procedure.

    Example:
        ? (with-recovery-procedures ((:general-failure (abort (failure-arguments))))
            (fail :motor-stalled 3 :left))
        Failure :MOTOR-STALLED, recovery available. (No retries)
        (3 :LEFT)

    Source: language reference §2.
    """
    return from_items(list(_answered("FAILURE-ARGUMENTS").arguments))


@macro("(define-failure cause &optional parents)", ESL)
def define_failure(form: Cons, environment: Any) -> Value:
    """Put CAUSE under PARENTS: a clause for a parent answers it too.

    Returns: CAUSE.
    Fails:   :control-error if CAUSE would become its own parent.

    Example:
        ? (define-failure :arm-stuck (:hardware))
        :ARM-STUCK
        ? (with-recovery-procedures ((:hardware (abort :serviced)))
            (fail :arm-stuck))
        Failure :ARM-STUCK, recovery available. (No retries)
        :SERVICED

    Source: ESL §2.1 names the generalisation; language reference §2.
    """
    cause = form.cdr.car
    parents = form.cdr.cdr.car if form.cdr.cdr is not None else None
    return lisp_list(_esl("%DEFINE-FAILURE"), lisp_list(QUOTE, cause), lisp_list(QUOTE, parents))


@function("(%define-failure cause parents)", ESL)
def define_failure_function(cause: Value, parents: Value) -> Value:
    """Put CAUSE under PARENTS."""
    if not isinstance(cause, Symbol):
        raise type_error(cause, "SYMBOL", "define-failure")
    above = items(parents) if parents is None or parents.__class__ is Cons else [parents]
    for parent in above:
        if not isinstance(parent, Symbol):
            raise type_error(parent, "SYMBOL", "define-failure")
    running.session.causes.define(cause, tuple(above))
    return cause


# --- cleanup procedures --------------------------------------------------------------


@macro("(with-cleanup-procedure cleanup &body body)", ESL)
def with_cleanup_procedure(form: Cons, environment: Any) -> Value:
    """Run BODY; if it is left because it failed, run CLEANUP on the way out.

    It is left so by a failure that nothing inside recovers, or by any jump
    that an outer recovery procedure makes in answer to one. CLEANUP does not
    run when BODY returns, nor when BODY itself jumps out with no failure.

    Returns: the value of BODY.

    Example:
        ? (with-recovery-procedures ((:jammed (abort :gave-up)))
            (with-cleanup-procedure (princ "motors off ")
              (fail :jammed)))
        Failure :JAMMED, recovery available. (No retries)
        motors off
        :GAVE-UP

    Source: ESL §2.2; language reference §2.
    """
    cleanup, body = form.cdr.car, form.cdr.cdr
    return lisp_list(CLEAN, Cons(LAMBDA, Cons(None, body)), lisp_list(LAMBDA, None, cleanup))


def _clean_many(body: Value, cleanup: Value) -> Value:
    return failures.run_with_cleanup(many_of(body), cleanup)


@function("(%call-with-cleanup body cleanup)", ESL, many=_clean_many)
def call_with_cleanup(body: Value, cleanup: Value) -> Value:
    """Call BODY; CLEANUP if it is left because it failed."""
    return failures.run_with_cleanup(body, cleanup)
