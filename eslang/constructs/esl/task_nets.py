"""Task nets (ESL §4.3): tasks that run in parallel, and end together."""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items, items, lisp_list
from eslang.base.many import pack, primary
from eslang.base.running import running
from eslang.base.shown import shown
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.compile.registry import CL, ESL, function, macro
from eslang.constructs.esl.tasks import LAMBDA, QUOTE, closure, make_task, name_of_form, promises_of
from eslang.constructs.shapes import refuse
from eslang.runtime import failures
from eslang.runtime.lives import passed_on
from eslang.runtime.nets import Net, all_must_succeed, any_may_fail, one_must_succeed
from eslang.runtime.tasks import FAILED, Task

LET, LIST, SETQ = (Symbol.intern(name, CL) for name in ("LET", "LIST", "SETQ"))
MAKE, NET, PARALLEL = (
    Symbol.intern(name, ESL) for name in ("%MAKE-TASK", "%CALL-TASK-NET", "%CALL-OR-PARALLEL")
)
ALLOW_FAILURES = Keyword("ALLOW-FAILURES")
ALL_FAILED = Keyword("ALL-SUBTASKS-FAILED")


@macro("(task-net &rest tasks)", ESL)
def task_net(form: Cons, environment: Any) -> Value:
    """Run TASKS, each (ID . BODY), in parallel, until all have ended.

    Inside every BODY each ID is bound to its task. The first failure aborts
    the other tasks, and once all have ended, cleanups included, the net fails
    with its cause and arguments. With :allow-failures before the tasks it
    never fails. A task that ABORT-TASK aborted does not fail its net.

    Returns: the value of each task, as multiple values in textual order; NIL
             for one that failed or was aborted.
    Fails:   with the cause of the first task that fails.
    Waits:   until all TASKS have ended.

    Example:
        ? (task-net (left (sleep 2) :left-done)
                    (right (sleep 1) :right-done))
        :LEFT-DONE
        :RIGHT-DONE

    Source: ESL §4.3; values: language reference §4.
    """
    tasks = form.cdr
    allow = tasks is not None and tasks.car is ALLOW_FAILURES
    if allow:
        tasks = tasks.cdr
    names: list[Symbol] = []
    makers: list[Value] = []
    while tasks is not None:
        name = checked_name(tasks, names, environment)
        names.append(name)
        body = tasks.car.cdr
        makers += [name, making(lisp_list(QUOTE, name), from_items([LAMBDA, None], body), body)]
        tasks = tasks.cdr
    call = lisp_list(NET, Keyword("ALLOW-FAILURES") if allow else None, *names)
    return lisp_list(LET, from_items(names), from_items([SETQ, *makers]), call) if names else call


def making(name: Value, body: Value, forms: Value) -> Value:
    """The form that makes the task called NAME, which is to run BODY, made of FORMS."""
    return lisp_list(MAKE, name, body, lisp_list(QUOTE, promises_of(forms)))


def making_of_form(form: Value) -> Value:
    """The form that makes a task that is to run FORM."""
    return making(name_of_form(form), closure(form), lisp_list(form))


def checked_name(holder: Cons, names: list[Symbol], environment: Any) -> Symbol:
    """The identifier of the task at HOLDER; a diagnostic if it is not written as one."""
    task = holder.car
    if task.__class__ is not Cons or not isinstance(task.car, Symbol) or isinstance(task.car, Keyword):
        wrong = f"`{shown(task)}` is no task of a task net"
        refuse(environment, "malformed-task", wrong, holder, hint="write `(name form...)`", within="task-net")
    if task.car in names:
        wrong = f"two tasks of this net are called `{shown(task.car)}`"
        refuse(environment, "malformed-task", wrong, holder, within="task-net")
    name: Symbol = task.car
    return name


@function("(%make-task name body promises)", ESL)
def make_member(name: Symbol, body: Any, promises: Value) -> Task:
    """A task of the net that the current task is about to run."""
    return make_task(name, body, promises, running.session.scheduler.at_work())


def task_net_values(allow_failures: Value, *members: Task) -> Value:
    """The values of the members, as multiple values."""
    scheduler = running.session.scheduler
    net = Net(scheduler, any_may_fail if allow_failures is not None else all_must_succeed)
    net.members.extend(members)
    net.run()
    if net.deciding is not None:
        return failures.signal(passed_on(net.deciding), continuable=True)
    return pack([member.value for member in members])


@function("(%call-task-net allow-failures &rest tasks)", ESL, many=task_net_values)
def call_task_net(allow_failures: Value, *members: Task) -> Value:
    """Run MEMBERS as a net."""
    return primary(task_net_values(allow_failures, *members))


@macro("(or-parallel &rest forms)", ESL)
def or_parallel(form: Cons, environment: Any) -> Value:
    """Run FORMS in parallel, each in a task of its own, until one succeeds.

    The others are aborted then, and have ended when this returns.

    Returns: the values of the first of FORMS that succeeds.
    Fails:   :all-subtasks-failed if none does, with the list of their
             failures, each (CAUSE . ARGUMENTS), in textual order.
    Waits:   until one has succeeded, or all have failed.

    Example:
        ? (or-parallel (progn (sleep 5) :radio)
                       (progn (sleep 2) :laser)
                       (fail :no-cable))
        Failure :NO-CABLE, no recovery available.
        :LASER

    Source: ESL §4.3; its failure: language reference §4.
    """
    return from_items([PARALLEL, *[making_of_form(each) for each in items(form.cdr)]])


def or_parallel_values(*members: Task) -> Value:
    """All the values of the first member that succeeds."""
    net = Net(running.session.scheduler, one_must_succeed)
    net.members.extend(members)
    net.run()
    if net.deciding is not None:
        return net.deciding.values
    failed = [member.failure for member in members if member.status is FAILED and member.failure is not None]
    causes = [Cons(failure.cause, from_items(list(failure.arguments))) for failure in failed]
    return failures.signal(Failure(ALL_FAILED, from_items(causes)), continuable=True)


@function("(%call-or-parallel &rest tasks)", ESL, many=or_parallel_values)
def call_or_parallel(*members: Task) -> Value:
    """Run MEMBERS until one succeeds."""
    return primary(or_parallel_values(*members))
