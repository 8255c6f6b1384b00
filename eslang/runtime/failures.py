"""Failures: who answers them, and in which order (ESL §2).

A FAIL calls a recovery procedure where it stands; nothing is unwound until
the procedure jumps. The chain of active forms belongs to the running task.
Python's errors become failures at the nearest edge of something that could be
unwound (`signal_error`), so a procedure runs before anything is undone.
"""

from __future__ import annotations

from sys import exception

from eslang.base.calls import spread
from eslang.base.control import Abort, AbortNow, EndTask, Failed, Retry, RetryNow, Stop, Unwind
from eslang.base.errors import to_failure
from eslang.base.failure import (
    CONTROL_ERROR,
    DIVISION_BY_ZERO,
    ERROR,
    GENERAL_FAILURE,
    INDEX_OUT_OF_RANGE,
    PYTHON_ERROR,
    STACK_EXHAUSTED,
    TYPE_ERROR,
    UNBOUND_VARIABLE,
    UNDEFINED_FUNCTION,
    WRONG_NUMBER_OF_ARGUMENTS,
    Failure,
    control_error,
)
from eslang.base.hints import Any, Callable, Iterator, NamedTuple, NoReturn
from eslang.base.running import running
from eslang.base.stack import STACK
from eslang.base.symbols import Value
from eslang.runtime.logical import NOTHING_BOUND, Logical
from eslang.runtime.story import Asked, Story, as_place, capture_stack, has_come_far
from eslang.runtime.telling import (
    tell_cleanup,
    tell_cleanup_end,
    tell_recovery,
    tell_recovery_end,
    tell_taken,
)

HOST_CAUSES = (
    TYPE_ERROR,
    DIVISION_BY_ZERO,
    UNBOUND_VARIABLE,
    UNDEFINED_FUNCTION,
    WRONG_NUMBER_OF_ARGUMENTS,
    INDEX_OUT_OF_RANGE,
    STACK_EXHAUSTED,
    PYTHON_ERROR,
    CONTROL_ERROR,
)


class Clause(NamedTuple):
    """What is known of a recovery procedure from the text: its cause, and how often it may be invoked."""

    cause: Value
    limit: int | None  # None: :infinite
    place: Value  # a list, as the compiler noted it
    takes: Callable[[Failure], bool] | None = None  # HANDLER-BIND's own test; it declines by returning


class Form:
    """One entrance of a form that answers failures: its clauses, procedures, and how often each was used."""

    __slots__ = ("clauses", "live", "logical", "outer", "procedures", "used")
    outer: Form | None
    logical: Logical  # what logic variables are bound to where it stands
    clauses: tuple[Clause, ...]
    procedures: tuple[Callable[..., Value], ...]
    used: list[int]

    def __init__(self) -> None:
        self.live = False


class Jumps(list[Unwind]):
    """The jump that is about to be raised."""

    __slots__ = ()


class Dynamic:
    """What the running task has on its stack for failures to meet."""

    __slots__ = ("answering", "catches", "forms", "held", "jumps", "logical", "masked", "quiet")

    def __init__(self) -> None:
        self.forms: Form | None = None
        self.answering: list[tuple[Failure, Form]] = []  # who answers what, innermost last
        self.catches: list[tuple[Value, Any]] = []  # (tag, token), innermost last
        self.jumps = Jumps()
        self.logical = NOTHING_BOUND
        self.held = 0  # cleanups that are under way: interrupts from outside them wait
        self.masked = 0  # WITHOUT-INTERRUPTS forms that are under way
        self.quiet = False  # a macro is being expanded: nobody is told of its failures


class Causes:
    """The hierarchy of causes: DEFINE-FAILURE gives a cause its parents."""

    def __init__(self) -> None:
        self.parents: dict[Value, tuple[Value, ...]] = dict.fromkeys(HOST_CAUSES, (ERROR,))
        self._ancestors: dict[Value, frozenset[Value]] = {}

    def define(self, cause: Value, parents: tuple[Value, ...]) -> None:
        """Put CAUSE under PARENTS."""
        for parent in parents:
            if parent is cause or cause in self.ancestors(parent):
                raise control_error(f"the cause {cause} cannot be its own parent")
        self.parents[cause] = parents
        self._ancestors.clear()

    def ancestors(self, cause: Value) -> frozenset[Value]:
        """CAUSE and all that it is a kind of."""
        known = self._ancestors.get(cause)
        if known is None:
            found = {cause}
            for parent in self.parents.get(cause, ()):
                found |= self.ancestors(parent)
            known = self._ancestors[cause] = frozenset(found)
        return known

    def answers(self, wanted: Value, cause: Value) -> bool:
        """True if a clause for WANTED takes a failure of CAUSE."""
        return wanted is cause or wanted is GENERAL_FAILURE or wanted in self.ancestors(cause)


def fail(cause: Value, *arguments: Value) -> Value:
    """Fail; the value is that of the recovery procedure that answers, if it runs off its end."""
    return signal(Failure(cause, *arguments), continuable=True)


def signal(failure: Failure, *, continuable: bool) -> Value:
    """Call the active recovery procedures for FAILURE; jump if one of them asks for it."""
    value = answer(failure, continuable)
    if value.__class__ is Jumps:
        raise value.pop()
    return value


def answer(failure: Failure, continuable: bool) -> Value:
    """Call the active recovery procedures for FAILURE, from the innermost form outward.

    A procedure that ends with a jump may return it, a RetryNow or AbortNow. It is
    put on dynamic.jumps, and that is returned: the caller is to raise it. The
    fewer frames a jump passes, the faster it is; and no frame that it passes
    may hold it in a variable, or a circle of references would keep both.
    """
    session = running.session
    hooks, dynamic = session.hooks, session.dynamic
    innermost = form = dynamic.forms
    while form is not None:
        for index, (cause, limit, _, takes) in enumerate(form.clauses):
            if takes is not None:
                _offer(session, form, index, failure)
                continue
            used = form.used[index]
            if used == limit or not (cause is failure.cause or session.causes.answers(cause, failure.cause)):
                continue
            form.used[index] = used + 1
            if hooks.listeners or hooks.speakers:
                tell_recovery(session, form.clauses[index], used, failure)
            procedure, arguments = form.procedures[index], failure.arguments
            logical, dynamic.logical = dynamic.logical, form.logical
            dynamic.forms = form
            dynamic.answering.append((failure, form))
            try:
                value = spread(procedure, arguments) if arguments else procedure()
            except Unwind as jump:
                jump.failed = True
                if hooks.listeners:
                    tell_recovery_end(session, failure, jump, continuable)
                raise
            finally:
                dynamic.answering.pop()
                dynamic.forms = innermost
                dynamic.logical = logical
            if hooks.listeners:
                tell_recovery_end(session, failure, value, continuable)
            if value.__class__ is RetryNow or value.__class__ is AbortNow:
                dynamic.jumps.append(value)
                value = dynamic.jumps
            elif not continuable:
                break
            return value
        form = form.outer
    give_up(session, failure, innermost)


def give_up(session: Any, failure: Failure, innermost: Form | None) -> NoReturn:
    """Nothing answers FAILURE: tell its story, and leave the task."""
    failure.story = tell_story(failure, innermost, session.causes)
    hooks = session.hooks
    if (hooks.listeners or hooks.speakers) and not session.dynamic.quiet:
        hooks.tell("failure", failure.story.place, failure=failure)
    raise Failed(failure)


def _offer(session: Any, form: Form, index: int, failure: Failure) -> None:
    """Call what HANDLER-BIND, entered as FORM, has at INDEX for FAILURE; it declines by returning."""
    clause, dynamic = form.clauses[index], session.dynamic
    if clause.takes is None or not clause.takes(failure):
        return
    saved, dynamic.forms = dynamic.forms, form.outer
    logical, dynamic.logical = dynamic.logical, form.logical
    dynamic.answering.append((failure, form))
    try:
        form.procedures[index](failure)
    except Unwind as jump:
        jump.failed = True
        if session.hooks.listeners:
            tell_taken(session, clause, failure)
        raise
    finally:
        dynamic.answering.pop()
        dynamic.forms = saved
        dynamic.logical = logical


def signal_error(error: Exception) -> None:
    """Signal a Python error that left Lisp code; it has no place to continue."""
    if error.__class__ is RecursionError:
        STACK.make_room()
    failure = error if error.__class__ is Failure else to_failure(error)
    signal(failure, continuable=False)


# --- forms ---------------------------------------------------------------------------


def run_form(
    form: Form,
    clauses: tuple[Clause, ...],
    procedures: tuple[Callable[..., Value], ...],
    body: Callable[[], Value],
) -> Value:
    """Run BODY while PROCEDURES, one for each of CLAUSES, answer its failures; again after each (retry)."""
    session = running.session
    dynamic: Dynamic = session.dynamic
    rounds: Iterator[None] | None = None
    outer = form.outer = dynamic.forms
    form.logical = dynamic.logical
    form.clauses = clauses
    form.procedures = procedures
    form.used = [0] * len(clauses)
    form.live = True
    try:
        while True:
            dynamic.forms = form
            try:
                try:
                    if rounds is not None:
                        next(rounds)  # a retry counts as the round of a loop; an interrupt may come here
                    return body()
                except Exception as error:
                    return signal_error(error)
            except Retry as jump:
                if jump.args[0] is not form:  # its target, without a call
                    raise
                if STACK.raised:
                    STACK.give_back()
            except Abort as jump:
                if jump.target is not form:
                    raise
                return jump.value
            rounds = session.ticks.source
    finally:
        form.live = False
        dynamic.forms = outer
        if STACK.raised:
            STACK.give_back()


def guarded(body: Callable[[], Value]) -> Value:
    """The value of BODY; a Python error becomes a failure at this edge."""
    try:
        return body()
    except Exception as error:
        return signal_error(error)


def retry(form: Form) -> None:
    """Jump to the start of the body of FORM."""
    if not form.live:
        raise control_error("this RETRY belongs to a form that has been left")
    raise Retry(form)


def abort(form: Form, result: Value) -> None:
    """Return RESULT from FORM."""
    if not form.live:
        raise control_error("this ABORT belongs to a form that has been left")
    raise Abort(form, result)


def run_with_cleanup(body: Callable[[], Value], cleanup: Callable[[], Value]) -> Value:
    """Run BODY; if it is left because it failed, run CLEANUP on the way out.

    What ends a task, and the failure that came first, are stronger than what
    CLEANUP does: its own failure is told, and then forgotten.
    """
    dynamic: Dynamic = running.session.dynamic
    outer = dynamic.forms
    try:
        return guarded(body)
    except BaseException as jump:
        if not isinstance(jump, Unwind) or jump.failed:
            dynamic.forms = outer
            try:
                clean(cleanup)
            except Unwind as second:
                if not is_stronger(jump, second):
                    raise
        raise


def is_stronger(jump: BaseException, second: Unwind) -> bool:
    """True if JUMP goes on although a cleanup that it passed ended with a SECOND one."""
    if not isinstance(jump, Unwind):
        return True  # what Python raises to leave everything
    if isinstance(jump, EndTask | Stop):
        return not isinstance(second, EndTask | Stop) or second.__class__ is jump.__class__
    return jump.__class__ is Failed and second.__class__ is Failed


def is_last(jump: BaseException) -> bool:
    """True if nothing that JUMP passes can stop it: it ends the task, or the run, or is Python's own."""
    return isinstance(jump, EndTask | Stop) or not isinstance(jump, Unwind | Exception)


def clean(cleanup: Callable[[], Value]) -> Value:
    """Run CLEANUP, which interrupts from outside it must wait for, and which stands in no circuit.

    What ends a task goes on although a cleanup jumps out: nothing survives an abort.
    """
    dynamic: Dynamic = running.session.dynamic
    ending = None if dynamic.held else exception()  # inside a cleanup, this one is not on its way
    tells, left = bool(running.session.hooks.listeners), True
    if tells:
        tell_cleanup(running.session)
    logical, dynamic.held = dynamic.logical, dynamic.held + 1
    dynamic.logical = logical.shielded()
    try:
        value = guarded(cleanup)
        left = False
        return value
    except Unwind as second:
        if ending is None or not is_last(ending) or not is_stronger(ending, second):
            raise
        return None
    finally:
        dynamic.logical, dynamic.held = logical, dynamic.held - 1
        if tells:
            tell_cleanup_end(running.session, left)


SUPPORT = {"%signal-error": signal_error, "%clean": clean}  # what compiled code calls


def run_apart(body: Callable[[], Value]) -> Value:
    """Run BODY with nothing around it that answers; a failure that it does not answer is raised as such."""
    dynamic: Dynamic = running.session.dynamic
    saved, dynamic.forms = dynamic.forms, None
    catches, dynamic.catches = dynamic.catches, []
    try:
        return guarded(body)
    except Failed as jump:
        failure = jump.value
    finally:
        dynamic.forms, dynamic.catches = saved, catches
        if STACK.raised:
            STACK.give_back()
    hooks = running.session.hooks
    if (hooks.listeners or hooks.speakers) and not dynamic.quiet:
        hooks.tell("aborted", None, failure=failure)
    raise failure


# --- telling -------------------------------------------------------------------------


def tell_story(failure: Failure, innermost: Form | None, causes: Causes) -> Story:
    """Where FAILURE came about, and who was asked."""
    asked: list[Asked] = []
    form = innermost
    while form is not None:
        for clause, used in zip(form.clauses, form.used, strict=True):
            takes = clause.takes is None and causes.answers(clause.cause, failure.cause)
            left = None if clause.limit is None else clause.limit - used
            asked.append(Asked(clause.cause, as_place(clause.place), takes, used, left))
        form = form.outer
    before: Story | None = failure.story
    if before is not None and has_come_far(failure):  # through Python and back, more than once
        return Story(tuple(asked), before.stack)
    return Story(tuple(asked), capture_stack(failure))
