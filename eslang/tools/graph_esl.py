"""What the constructs of ESL become in a drawing (ESL §2-5, ARM §4)."""

from __future__ import annotations

from collections.abc import Hashable

from eslang.base.lists import Cons, lisp_list
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.compile.registry import CL, ESL
from eslang.tools.graph_lisp import led, nothing
from eslang.tools.graph_model import Box, Key
from eslang.tools.graph_text import name_text, text_of
from eslang.tools.graph_walk import Reader, Scope, Walk, add, after, holders


def recovering(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """WITH-RECOVERY-PROCEDURES and its like: the body, and each clause."""
    box = walk.headed("recovery", holder, 0, walk.body(after(holder.car, 2), scope))
    listed = after(holder.car, 1)
    if listed is not None and listed.car.__class__ is Cons:
        alone = listed.car.car.__class__ is not Cons
        for each in holders(lisp_list(listed.car) if alone else listed.car):
            box.parts.append(recovery_clause(walk, each, scope))
    return [box]


def recovery_clause(walk: Walk, holder: Cons, scope: Scope) -> Box:
    """One clause: its cause, how often it may be used, what it does."""
    clause = holder.car
    if clause.__class__ is not Cons:
        return walk.box("clause", [text_of(walk.spans, holder)], clause)
    lines, body = [text_of(walk.spans, clause)], clause.cdr
    if body.__class__ is Cons and body.car is Keyword("RETRIES") and body.cdr.__class__ is Cons:
        lines.append(f"retries {text_of(walk.spans, body.cdr)}")
        body = body.cdr.cdr
    return walk.box("clause", lines, clause, tag="recovery", parts=walk.body(body, scope))


def cleaning(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """WITH-CLEANUP-PROCEDURE: the body, and the cleanup."""
    box = walk.headed("recovery", holder, 0, walk.body(after(holder.car, 2), scope))
    cleanup = after(holder.car, 1)
    if cleanup is not None:
        box.parts.append(led(walk.one(cleanup, scope), "cleanup"))
    return [box]


def guarding(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """WITH-GUARDIAN: the body, the guardian, and what is done when that ends."""
    box = walk.headed("parallel", holder, 0, walk.body(after(holder.car, 3), scope))
    guard, failing = after(holder.car, 1), after(holder.car, 2)
    if guard is not None and failing is not None:
        box.parts.append(led(walk.one(guard, scope._replace(task=walk.new_task())), "guardian"))
        box.parts.append(led(walk.one(failing, scope), "when it ends"))
    return [box]


def task_net(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """TASK-NET: its tasks, which know one another by name."""
    members = [each for each in holders(holder.car.cdr) if each.car.__class__ is Cons]
    heads = 1 if members and members[0] is not holder.car.cdr else 0
    box = walk.headed("parallel", holder, heads, [])
    known: dict[Value, Hashable] = {each.car.car: walk.new_task() for each in members}
    inner = scope.with_tasks(known)
    for each in members:
        task = known[each.car.car]
        parts = walk.body(each.car.cdr, inner._replace(task=task))
        member = walk.box("task", [text_of(walk.spans, each.car)], each.car, tag="task", parts=parts)
        member.gives.append(Key("end", task))
        box.parts.append(member)
    return [box]


def or_parallel(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """OR-PARALLEL: forms, each a task."""
    parts = [
        led(walk.one(each, scope._replace(task=walk.new_task())), "") for each in holders(holder.car.cdr)
    ]
    return [walk.headed("parallel", holder, 0, parts)]


def spawning(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """SPAWN: a task of its own."""
    task = walk.new_task()
    form = after(holder.car, 1)
    more = " ".join(text_of(walk.spans, each) for each in holders(after(holder.car, 2)))
    box = walk.box("task", [f"spawn {more}".rstrip()], holder.car)
    if form is not None:
        box.parts.append(walk.one(form, scope._replace(task=task)))
    box.gives.append(Key("end", task))
    return [box]


def looping(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """PERIODICALLY and WHENEVER: a body that is done again and again."""
    return walk.around("loop", holder, 1, scope)


def keeping(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """What holds something while its body is done: locks, resources."""
    heads = walk.heads_of(holder.car.car) or 0
    options, rest = walk.options(after(holder.car, heads + 1))
    box = walk.headed("keep", holder, heads, walk.body(rest, scope))
    box.lines += options
    return [box]


def acting(kind: str) -> Reader:
    """What does something by itself."""

    def read(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
        return [walk.act(kind, holder, scope)]

    return read


def achieving(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """ACHIEVE: lines to the methods of its goals."""
    box = walk.box("goal", [text_of(walk.spans, holder)], holder.car)
    goal = after(holder.car, 1)
    if goal is not None:
        want(walk, box, goal.car)
    return [box]


def want(walk: Walk, box: Box, goal: Value) -> None:
    """Let lines lead from BOX to the methods of GOAL, when all are known."""
    box.gives.append(Key("goal", len(walk.goals)))
    walk.goals.append(goal)


def bindings(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """WITH-QUERY-BINDINGS: the query, and the body for one solution."""
    option = after(holder.car, 2)
    heads = 2 if option is not None and isinstance(option.car, Keyword) else 1
    return walk.around("around", holder, heads, scope)


def checkpoint(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """CHECKPOINT: lines to those who wait for it, if it stands in the task's own text."""
    box = walk.act("signal", holder, scope)
    if scope.task is not None:
        box.gives.append(Key("checkpoint", (scope.task, point(holder.car, 1))))
    return [box]


def checkpoint_wait(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """CHECKPOINT-WAIT: lines from the checkpoint of that task."""
    box = walk.act("wait", holder, scope)
    task = after(holder.car, 1)
    number = scope.tasks.get(task.car) if task is not None and isinstance(task.car, Symbol) else None
    if number is not None:
        box.takes.append(Key("checkpoint", (number, point(holder.car, 2))))
    return [box]


def point(form: Value, place: int) -> str:
    """The name of a checkpoint, as far as it shows."""
    named = after(form, place)
    return name_text(named.car) if named is not None else ""


def waiting(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """WAIT-FOR-EVENTS and WAIT-FOR-TASK: lines from those who signal, and from tasks."""
    box = walk.act("wait", holder, scope)
    events = after(holder.car, 1)
    if events is not None:
        alone = isinstance(events.car, Symbol)
        for name in [events.car] if alone else [each.car for each in holders(events.car)]:
            if name in scope.tasks:
                add(box.takes, [Key("end", scope.tasks[name])])
            elif isinstance(name, Symbol):
                add(box.takes, [event_key(walk, name, scope)])
    return [box]


def signalling(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """SIGNAL: lines to those who wait for the event."""
    box = walk.act("signal", holder, scope)
    event = after(holder.car, 1)
    if event is not None and isinstance(event.car, Symbol):
        box.gives.append(event_key(walk, event.car, scope))
    return [box]


def event_key(walk: Walk, name: Symbol, scope: Scope) -> Key:
    """The event called NAME: that of the plan, or of the definition it is in."""
    is_global = walk.image.cell(name).special
    return Key("event", name if is_global else (scope.definition, name))


def named(*names: str) -> list[Symbol]:
    """These symbols of ESL."""
    return [Symbol.intern(name, ESL) for name in names]


KEEPING = (
    "WITH-MAINTAINED-PROPERTIES",
    "WITHOUT-PROPERTY-LOCK-FAILURES",
    "WITH-AUTOMATIC-RECOVERIES",
    "WITH-RESOURCE",
    "WITH-READY-DEVICE",
)
READERS: dict[Value, Reader] = {
    **dict.fromkeys(named("WITH-RECOVERY-PROCEDURES", "RETRYING", "WITH-FALLBACKS"), recovering),
    **dict.fromkeys(named("DEFRULE", "DEFINE-FAILURE", "DEFINE-RESOURCE"), nothing),
    **dict.fromkeys(named("WITH-CLEANUP-PROCEDURE"), cleaning),
    **dict.fromkeys(named("WITH-GUARDIAN"), guarding),
    **dict.fromkeys(named("TASK-NET"), task_net),
    **dict.fromkeys(named("OR-PARALLEL"), or_parallel),
    **dict.fromkeys(named("SPAWN"), spawning),
    **dict.fromkeys(named("PERIODICALLY", "WHENEVER"), looping),
    **dict.fromkeys(named(*KEEPING), keeping),
    **dict.fromkeys(named("WITH-QUERY-BINDINGS"), bindings),
    **dict.fromkeys(named("FAIL"), acting("fail")),
    **dict.fromkeys(named("RETRY", "ABORT", "NEXT-BINDINGS"), acting("leave")),
    **dict.fromkeys(named("ABORT-TASK", "INTERRUPT-TASK"), acting("signal")),
    **dict.fromkeys(named("ASSERT", "RETRACT", "UPDATE"), acting("fact")),
    **dict.fromkeys(named("WAIT-UNTIL", "WAIT-FOR-RECOVERY"), acting("wait")),
    **dict.fromkeys(named("ACHIEVE"), achieving),
    **dict.fromkeys(named("CHECKPOINT"), checkpoint),
    **dict.fromkeys(named("CHECKPOINT-WAIT"), checkpoint_wait),
    **dict.fromkeys(named("WAIT-FOR-EVENTS", "WAIT-FOR-TASK"), waiting),
    **dict.fromkeys(named("SIGNAL", "SIGNAL-EVENT"), signalling),
    Symbol.intern("SLEEP", CL): acting("wait"),
}
