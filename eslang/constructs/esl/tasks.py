"""Tasks one by one: spawned, looked at, aborted, interrupted."""

from __future__ import annotations

from eslang.base.arguments import take_keys
from eslang.base.failure import type_error
from eslang.base.hints import Any, Iterator
from eslang.base.lists import Cons, from_items, items, lisp_list
from eslang.base.many import many_of
from eslang.base.running import running, to_function
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.base.text import String
from eslang.compile.registry import CL, ESL, function, macro
from eslang.constructs.esl.checkpoints import as_task
from eslang.runtime.guarding import run_masked
from eslang.runtime.lives import SPAWNED
from eslang.runtime.tasks import READY, RUNNING, WAITING, Interrupt, Task

LAMBDA, QUOTE, QUASIQUOTE, LIST = (
    Symbol.intern(name, CL) for name in ("LAMBDA", "QUOTE", "QUASIQUOTE", "LIST")
)
SPAWN, MASK, TASK = (Symbol.intern(name, ESL) for name in ("%SPAWN", "%CALL-WITHOUT-INTERRUPTS", "TASK"))
PROGN = Symbol.intern("PROGN", CL)
STRUCTURE = frozenset(  # operators that a task is not called by
    Symbol.intern(name, CL)
    for name in ["PROG1", "LET", "LET*", "FLET", "LABELS", "BLOCK", "IF", "WHEN", "UNLESS", "COND"]
)
SIGNALLING = {
    Symbol.intern(name, ESL): name.split("-")[0].lower() for name in ("CHECKPOINT", "SIGNAL", "SIGNAL-EVENT")
}
ASSERTING = frozenset(Symbol.intern(name, ESL) for name in ("ASSERT", "RETRACT", "UPDATE"))


def promises_of(forms: Value) -> Value:
    """What the text of FORMS signals and asserts, ((KIND OF)...): for the report of a deadlock."""
    found: dict[tuple[str, Any], None] = {}
    pending = [forms]
    while pending:
        form = pending.pop()
        while form.__class__ is Cons:
            head, rest = form.car, form.cdr
            if isinstance(head, Symbol) and rest.__class__ is Cons:
                if head in SIGNALLING:
                    of = written(rest.car)
                    if of.__class__ is not Cons:
                        found[SIGNALLING[head], of] = None
                elif head in ASSERTING:
                    found.update({("assert", name): None for name in relations_of(rest)})
            if head.__class__ is Cons:
                pending.append(head)
            form = rest
    return from_items([lisp_list(Keyword(kind.upper()), of) for kind, of in found])


def written(form: Value) -> Value:
    """What stands under the quote of FORM, if it has one."""
    quoted = form.__class__ is Cons and form.car in (QUOTE, QUASIQUOTE) and form.cdr.__class__ is Cons
    return form.cdr.car if quoted else form


def relations_of(arguments: Value) -> Iterator[Symbol]:
    """The relations of the facts that ARGUMENTS write, as far as can be seen."""
    while arguments.__class__ is Cons:
        form = arguments.car
        fact = written(form)
        name = fact.car if fact.__class__ is Cons else None
        if fact is form:  # computed; the name may stand there all the same
            name = written(fact.cdr.car) if name is LIST and fact.cdr.__class__ is Cons else None
        if isinstance(name, Symbol):
            yield name
        arguments = arguments.cdr


def closure(*forms: Value) -> Value:
    """The form that gives a function of no arguments that runs FORMS."""
    return lisp_list(LAMBDA, None, *forms)


def name_of_form(form: Value) -> Value:
    """What a task that runs FORM is called, as a form: its operator, or what that begins with."""
    while form.__class__ is Cons and form.car is PROGN and form.cdr.__class__ is Cons:
        form = form.cdr.car
    named = form.__class__ is Cons and isinstance(form.car, Symbol) and form.car not in STRUCTURE
    return lisp_list(QUOTE, form.car if named else TASK)


@macro("(spawn form &key daemon name)", ESL)
def spawn(form: Cons, environment: Any) -> Value:
    """Run FORM in a task of its own, and go on.

    A task that is spawned at top level belongs to the run, which ends when
    it has ended; one that another task spawns belongs to that task, which
    ends after it. With DAEMON it is aborted at that end instead. It begins
    with the dynamic bindings that are in force here. A failure of it that
    nobody has looked at by then, by waiting for it or asking its status, is
    one of its owner. NAME, a symbol or a string, is what it is called.

    Returns: the task.

    Example:
        ? (defvar patrol (spawn (list :all :quiet)))
        PATROL
        ? (wait-for-task patrol)
        (:ALL :QUIET)

    Source: language reference §4; owners: decision 18.
    """
    body, options = form.cdr.car, form.cdr.cdr
    promises = lisp_list(QUOTE, promises_of(lisp_list(body)))
    return from_items([SPAWN, closure(body), promises, name_of_form(body)], options)


@function("(%spawn body promises called &key daemon name)", ESL)
def spawn_function(body: Any, promises: Value, called: Value, *options: Value) -> Task:
    """Start a task that runs BODY; it is CALLED so unless it has a name."""
    daemon, name = take_keys(options, ("DAEMON", "NAME")) if options else (None, None)
    scheduler = running.session.scheduler
    owner = scheduler.current
    if owner is not None and owner.is_root:
        owner = None
    task = make_task(called if name is None else name, body, promises, owner)
    task.daemon = daemon is not None
    scheduler.lives.start(task, SPAWNED)
    return task


def make_task(name: Value, body: Any, promises: Value, parent: Task | None) -> Task:
    """A task called NAME, a symbol or a string, that is to run BODY, a function."""
    if not isinstance(name, (Symbol, String)):
        raise type_error(name, "SYMBOL", "spawn")
    text = name.text if isinstance(name, String) else name.name
    task: Task = running.session.scheduler.lives.create(text.lower(), many_of(body), parent)
    if promises is not None:
        task.promises = tuple([(each.car.name.lower(), each.cdr.car) for each in items(promises)])
    return task


@function("(current-task)", ESL)
def current_task() -> Task:
    """Give the task that calls this.

    Example:
        ? (task-status (current-task))
        :RUNNING

    Source: language reference §4.
    """
    task: Task = running.session.scheduler.at_work()
    return task


@function("(task-status task)", ESL)
def task_status(other: Value) -> Keyword:
    """Tell how TASK is.

    Returns: :ready, :running or :waiting; once it has ended, :succeeded,
             :failed or :aborted.

    Example:
        ? (let ((broken (spawn (fail :no-power))))
            (wait-for-task broken)
            (task-status broken))
        Failure :NO-POWER, no recovery available.
        :FAILED

    Source: language reference §4.
    """
    task = as_task(other, "task-status")
    if task.status is not None:
        task.seen = True
        return task.status
    if task is running.session.scheduler.current:
        return RUNNING
    return READY if task.queued else WAITING


@function("(abort-task task)", ESL)
def abort_task(other: Value) -> Value:
    """Abort TASK: it leaves everything, with its cleanup procedures, and ends.

    It does so at its next step; WAIT-FOR-TASK waits for its end. A task that
    has ended, or is being aborted, is not affected. A task may abort itself.

    Returns: NIL.

    Example:
        ? (let ((endless (spawn (loop))))
            (abort-task endless)
            (wait-for-task endless)
            (task-status endless))
        :ABORTED

    Source: ESL §6; language reference §4.
    """
    task = as_task(other, "abort-task")
    scheduler = running.session.scheduler
    scheduler.lives.abort(task, "abort-task")
    if task is scheduler.current:
        scheduler.attend(task)
    return None


@function("(interrupt-task task function)", ESL)
def interrupt_task(other: Value, work: Value) -> Value:
    """Let TASK call FUNCTION where it stands, at its next step.

    A task that waits is woken for it, and then goes on to wait. Cleanup
    procedures and WITHOUT-INTERRUPTS hold it off; a task that has ended is
    not affected.

    Returns: NIL.

    Example:
        ? (let ((sleeper (spawn (sleep 10))))
            (yield)
            (interrupt-task sleeper (lambda () (princ "ouch ")))
            (wait-for-task sleeper))
        ouch
        NIL

    Source: language reference §4.
    """
    task = as_task(other, "interrupt-task")
    scheduler = running.session.scheduler
    scheduler.interrupt(task, Interrupt("interrupt-task", to_function(work)))
    if task is scheduler.current:
        scheduler.attend(task)
    return None


@function("(yield)", ESL)
def yield_turn() -> Value:
    """Let all other tasks that are ready have their turn first.

    Returns: NIL.
    Waits:   until it is this task's turn again.

    Source: ours.
    """
    scheduler = running.session.scheduler
    scheduler.yield_turn(scheduler.current or scheduler.at_work())
    return None


@macro("(without-interrupts &body body)", ESL)
def without_interrupts(form: Cons, environment: Any) -> Value:
    """Run BODY without interrupts of this task, and without other tasks.

    No other task runs unless BODY waits. Interrupts that came meanwhile, an
    abort among them, reach it at the end of BODY. Ctrl-C and a time limit do
    not wait for that.

    Returns: the values of BODY.

    Example:
        ? (without-interrupts (+ 1 2))
        3

    Source: language reference §4.
    """
    return lisp_list(MASK, from_items([LAMBDA, None], form.cdr))


def without_interrupts_values(body: Any) -> Value:
    """All the values of the body."""
    return run_masked(running.session.scheduler, many_of(body))


@function("(%call-without-interrupts body)", ESL, many=without_interrupts_values)
def call_without_interrupts(body: Any) -> Value:
    """Call BODY; no interrupt reaches this task meanwhile."""
    return run_masked(running.session.scheduler, body)
