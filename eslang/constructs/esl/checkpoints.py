"""Checkpoints (ESL §4.2): points of a task that others wait for, and never miss."""

from __future__ import annotations

from eslang.base.failure import type_error
from eslang.base.hashing import equal_key
from eslang.base.running import running
from eslang.base.symbols import Symbol, Value
from eslang.compile.registry import ESL, function
from eslang.runtime.events import Wait
from eslang.runtime.tasks import Task

TASK = Symbol.intern("TASK", ESL)


@function("(checkpoint id)", ESL)
def checkpoint(identifier: Value) -> Value:
    """Signal the checkpoint ID of this task, and record that it was passed.

    IDs are the same if they are EQUAL.

    Returns: NIL.

    Example:
        ? (checkpoint :cup-gripped)
        NIL

    Source: ESL §4.2.
    """
    scheduler = running.session.scheduler
    waits = scheduler.at_work().reach(equal_key(identifier))
    scheduler.lives.tell("checkpoint", id=identifier, wakes=[wait.task for wait in waits])
    scheduler.wake(waits)
    return None


@function("(checkpoint-wait task id)", ESL)
def checkpoint_wait(other: Value, identifier: Value) -> Value:
    """Wait until TASK has passed its checkpoint ID; not at all if it has.

    Returns: NIL.
    Fails:   :deadlock if TASK cannot pass it any more and nothing else runs.
    Waits:   until TASK passes the checkpoint.

    Example:
        ? (task-net (grip (checkpoint :cup-gripped) :gripped)
                    (lift (checkpoint-wait grip :cup-gripped) :lifted))
        :GRIPPED
        :LIFTED

    Source: ESL §4.2.
    """
    scheduler = running.session.scheduler
    task = as_task(other, "checkpoint-wait")
    key = equal_key(identifier)
    if not task.has_reached(key):
        event = task.checkpoint_event(key, identifier)
        scheduler.wait(Wait(scheduler.at_work(), "checkpoint", (task, identifier), (event,)))
    return None


def wait_for_task_values(other: Value) -> Value:
    """All the values of the task."""
    scheduler = running.session.scheduler
    task = as_task(other, "wait-for-task")
    task.seen = True
    scheduler.lives.await_end(scheduler.at_work(), task)
    return task.values


@function("(wait-for-task task)", ESL, many=wait_for_task_values)
def wait_for_task(other: Value) -> Value:
    """Wait until TASK has ended; not at all if it has.

    A task that failed or was aborted has ended, too.

    Returns: the values of TASK; NIL if it did not succeed.
    Fails:   :deadlock if TASK waits for this one.
    Waits:   until TASK has ended.

    Example:
        ? (wait-for-task (spawn (+ 1 2)))
        3

    Source: ESL §4.2.
    """
    wait_for_task_values(other)
    return as_task(other, "wait-for-task").value


def as_task(value: Value, operator: str) -> Task:
    """VALUE, which is to be a task."""
    if not isinstance(value, Task):
        raise type_error(value, TASK, Symbol.intern(operator.upper(), ESL))
    return value
