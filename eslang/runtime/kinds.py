"""Every kind of event that listeners hear of: when, and with which parts.

One table serves listeners' authors, docs/reference/events.md, and the test
that nothing else is told anywhere. The kernel does not need it to run.
"""

from __future__ import annotations

from eslang.base.hints import NamedTuple


class Part(NamedTuple):
    """One part of what an event tells: its name, its type, and what it means."""

    name: str
    type: str  # "X | None" if it may be missing
    meaning: str


class Kind(NamedTuple):
    """One kind of event: when it is told, what `form` is, and the parts of `data`."""

    name: str
    when: str
    form: str
    parts: tuple[Part, ...] = ()


HERE = "where the task stands"
FAILURE = Part("failure", "Failure", "the failure; its `origin` is the task that it was passed on from")
WAIT_ON = Part(
    "on",
    "str",
    "what it is for: `events`, `checkpoint`, `end`, `tasks`, `leaving`, `condition`, `sleep`, `period`, "
    "`achievement` and `recovery` (of a maintained property), `outside` (a coroutine or a blocking call), "
    "`goals` (that somebody gives), `turn`, `retry` (of a goal), …",
)
WAIT_OF = Part(
    "of",
    "value",
    "what belongs to it: the events, (task, checkpoint), tasks, the condition, the seconds, what it is",
)
WHY_INTERRUPT = Part(
    "why", "str", "`guardian`, `deadline`, `violation`, `lock`, `deadlock`, `interrupt-task`, …"
)
INTERRUPT_BY = Part("by", "Task | None", "the task that it comes from; none for a clock's")
WAKES = Part("wakes", "list[Task]", "the tasks that waited for it, in their order")
PATH = Part(
    "path",
    "list[list]",
    "the constructs that are under way there, outermost first, each (OPERATOR NUMBER [CONDITION]): "
    "which of its steps, and the condition for which that was chosen; of very many, the nearest, "
    "behind (:OUTER NUMBER)",
)
RAISED = Part("raised", "Place | None", "where the failure was raised")

TABLE = (
    # --- the lives of tasks
    Kind(
        "task-started",
        "a task is about to have its first turn",
        "the form that starts it",
        (
            Part("about", "Task", "the new task"),
            Part("parent", "Task | None", "the task that it belongs to; none for those of the run"),
            Part("role", "str", "`main`, `member` (of a net or OR-PARALLEL), `guardian`, `goal`, `spawned`"),
            Part("daemon", "bool", "the run, or its owner, does not wait for it"),
        ),
    ),
    Kind(
        "task-ended",
        "a task has ended, its cleanups and its children included",
        "none",
        (
            Part("about", "Task", "the task"),
            Part("status", "Keyword", "`:succeeded`, `:failed` or `:aborted`"),
            Part("failure", "Failure | None", "what it failed with"),
        ),
    ),
    Kind(
        "abort",
        "a task is asked to leave everything; it does so at its next step",
        HERE,
        (
            Part("of", "Task", "the task that is aborted"),
            Part(
                "why",
                "str",
                "`abort-task`; `net`: its net is decided; `guardian`: what it guarded is over; "
                "`owner`: its owner ends; `run`: the run does; "
                "`caller`: the coroutine that awaits it was cancelled; `recovery`: nobody wants it any more; "
                "`goal`: its goal is over",
            ),
            Part("by", "Task | None", "the task that asks for it, or whose end decided it"),
        ),
    ),
    # --- waits and signals
    Kind("wait", "a task begins to wait; the wait may be over at once", HERE, (WAIT_ON, WAIT_OF)),
    Kind(
        "resume",
        "a wait of the task is over",
        "none",
        (
            WAIT_ON,
            WAIT_OF,
            Part(
                "how",
                "str",
                "`came`: what it waited for; `timeout`: the time was over; `left`: a jump led out of it",
            ),
        ),
    ),
    Kind(
        "watch",
        "the condition that a task waits for does not hold: what will have it looked at again",
        HERE,
        (
            Part("of", "value", "the condition"),
            Part(
                "relations",
                "list",
                "the relations of the facts that it rests on, whose change wakes it",
            ),
            Part("polls", "bool", "it asks Lisp, too, and is looked at after each step"),
        ),
    ),
    Kind(
        "signal",
        "the task signals an event",
        HERE,
        (Part("event", "Event", "the event"), Part("arguments", "list", "what goes with it"), WAKES),
    ),
    Kind(
        "checkpoint", "the task passes a checkpoint", HERE, (Part("id", "value", "which of its own"), WAKES)
    ),
    Kind(
        "period-missed",
        "PERIODICALLY skips periods that are over already",
        HERE,
        (Part("missed", "int", "how many"), Part("seconds", "float", "how long each is")),
    ),
    # --- interrupts
    Kind(
        "interrupt-sent",
        "a task is to be interrupted, at its next step",
        "where the sender stands",
        (Part("to", "Task", "the task"), WHY_INTERRUPT, INTERRUPT_BY),
    ),
    Kind(
        "interrupt",
        "the task is interrupted, and does now what it is to do",
        HERE,
        (WHY_INTERRUPT, INTERRUPT_BY),
    ),
    Kind(
        "interrupt-ended",
        "the task has done so, and goes on where it stood",
        HERE,
        (WHY_INTERRUPT, Part("left", "bool", "it does not go on: a jump led out")),
    ),
    # --- failures
    Kind(
        "recovery",
        "a recovery procedure is called",
        "its clause",
        (FAILURE, Part("left", "int | None", "how many retries it has left; none: infinite"), RAISED),
    ),
    Kind(
        "recovery-ended",
        "the recovery procedure has ended",
        "none",
        (
            FAILURE,
            Part(
                "how",
                "str",
                "`retry`, `abort`; `left`: by another jump; `continued`: FAIL returned its value; "
                "`declined`: it ran off its end, and the failure goes on",
            ),
        ),
    ),
    Kind(
        "failure-taken",
        "a clause of HANDLER-CASE or the like takes a failure",
        "the clause",
        (FAILURE, RAISED),
    ),
    Kind(
        "failure",
        "no recovery procedure is left for a failure; nothing is unwound yet",
        "where it was raised",
        (FAILURE,),
    ),
    Kind(
        "failure-passed",
        "a task fails because of another: the failure is about to be signalled in it",
        HERE,
        (FAILURE, Part("of", "Task", "the task that failed first")),
    ),
    Kind("aborted", "what was entered from outside was left with a failure", "none", (FAILURE,)),
    Kind("cleanup-started", "a cleanup begins", HERE),
    Kind("cleanup-ended", "the cleanup is over", "none", (Part("left", "bool", "a jump led out of it"),)),
    Kind(
        "deadlock",
        "nothing can wake any task any more",
        "none",
        (
            FAILURE,
            Part("waiting", "tuple[Waiting, ...]", "each task, what it waits for, where, and why in vain"),
            Part("to", "Task", "the task in which the failure is raised"),
        ),
    ),
    # --- circuits (SCS)
    Kind("action", "an atomic action is about to begin", HERE, (Part("action", "value", "the action"), PATH)),
    Kind(
        "deactivated",
        "a construct leaves what it is at, because of a condition",
        HERE,
        (
            Part(
                "why",
                "str",
                "`when`, `unless`, `while`, `until`: that modifier ends it; `condition`: that of the running "
                "clause does not hold any more; `earlier`: an earlier one holds; "
                "`alternatives`: none is left that could run",
            ),
            Part("condition", "value | None", "the condition"),
            PATH,
        ),
    ),
    # --- goals and the run
    Kind(
        "goal",
        "ACHIEVE is at work",
        HERE,
        (
            Part("state", "str", "`no-action`, `attempting`, `achieved`"),
            Part("condition", "value", "the condition"),
        ),
    ),
    Kind(
        "goal-changed",
        "something becomes of a top-level goal",
        HERE,
        (
            Part(
                "change",
                "str",
                "`added`; `pursued`: an attempt begins; `inactive`: it is to be maintained, and holds; "
                "`failed`: an attempt has, and another follows; `blocked`: no method applies until facts "
                "change; its end: `achieved`, `dropped`, `impossible`",
            ),
            Part("goal", "list", "the goal, as (ACHIEVE CONDITION) or (MAINTAIN CONDITION)"),
            Part("failure", "Failure | None", "how the attempt ended that failed"),
        ),
    ),
    Kind(
        "fact",
        "a fact came or went; the change that it belongs to is whole",
        HERE,
        (Part("added", "bool", "it came"), Part("fact", "list", "the fact")),
    ),
    Kind(
        "lock",
        "somebody takes a property lock, or something becomes of its property",
        HERE,
        (
            Part(
                "change",
                "str",
                "`subscribed`, `released`, `owned` (the next one is the owner now); `achieving`, `achieved`, "
                "`not-achieved`; `violated`, `recovering`, `recovered`, `unrecoverable`",
            ),
            Part("property", "value", "the property, with the value that is claimed"),
            Part("of", "Task | None", "the subscriber, or who achieves or recovers the property"),
            Part("owner", "Task | None", "the owner of the lock, now"),
        ),
    ),
    Kind(
        "resource",
        "something becomes of a claim on a resource",
        HERE,
        (
            Part("change", "str", "`granted`, `released`, `refused`; `preempted`: its holder is to give way"),
            Part("resource", "Symbol", "the resource"),
            Part("amount", "number", "how much is claimed"),
            Part("of", "Task", "whose claim it is"),
            Part("left", "number", "how much is left now"),
        ),
    ),
    Kind(
        "run-stopped",
        "the run is to end: Ctrl-C, the time limit, QUIT",
        HERE,
        (Part("reason", "str", "why"), Part("code", "int", "the exit code")),
    ),
)

KINDS = {kind.name: kind for kind in TABLE}
