"""What the constructs of SCS become in a drawing (SCS Appendix C)."""

from __future__ import annotations

from typing import NamedTuple

from eslang.base.lists import Cons
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.compile.registry import SCS
from eslang.tools.graph_esl import achieving, acting, want
from eslang.tools.graph_goals import goals_in
from eslang.tools.graph_lisp import led
from eslang.tools.graph_model import Box
from eslang.tools.graph_text import text_of
from eslang.tools.graph_walk import Reader, Scope, Walk, after, holders, numbered


class Construct(NamedTuple):
    """How a construct is read: its kind, what stands before its modifiers, how its parts are done."""

    kind: str
    parts: str  # ordered, together, any, first, best
    heads: int = 0


def reading(construct: Construct) -> Reader:
    """The reader of a construct."""

    def read(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
        box = walk.headed(construct.kind, holder, construct.heads, [])
        modifiers, rest = walk.options(after(holder.car, construct.heads + 1))
        box.lines += modifiers
        box.parts = parts_of(walk, construct.parts, rest, scope)
        return [box]

    return read


def parts_of(walk: Walk, how: str, rest: Value, scope: Scope) -> list[Box]:
    """The boxes of the steps or clauses in REST, each with what leads to it."""
    if how == "ordered":
        return numbered([led(walk.one(each, scope), "") for each in holders(rest)])
    if how in ("together", "any"):
        alone = how == "together"
        return [led(walk.one(each, branch(walk, scope) if alone else scope), "") for each in holders(rest)]
    parts = []
    for number, each in enumerate(holders(rest), 1):
        if each.car.__class__ is not Cons:
            continue
        condition = text_of(walk.spans, each.car)
        utility = after(each.car, 1) if how == "best" else None
        steps = after(each.car, 2 if how == "best" else 1)
        edge = condition if how == "best" else f"{number}: {condition}"
        under = f"utility {text_of(walk.spans, utility)}" if utility is not None else ""
        parts.append(led(walk.sequence(steps, scope), edge, under))
    return parts


def giving(walk: Walk, holder: Cons, scope: Scope) -> list[Box]:
    """ADD-GOAL: lines to the methods of the goal, or the step that sees to it."""
    box = walk.headed("goal", holder, 1, [])
    goal = after(holder.car, 1)
    rest = after(goal, 1)
    while rest.__class__ is Cons and rest.cdr.__class__ is Cons:
        if rest.car is BY:
            box.parts.append(led(walk.one(rest.cdr, scope), "by"))
        else:
            box.lines.append(f"{text_of(walk.spans, rest)} {text_of(walk.spans, rest.cdr)}")
        rest = rest.cdr.cdr
    for each in goals_in(goal.car) if goal is not None and not box.parts else ():
        if each.cdr.__class__ is Cons:
            want(walk, box, each.cdr.car)
    return [box]


def branch(walk: Walk, scope: Scope) -> Scope:
    """SCOPE in a task of its own."""
    return scope._replace(task=walk.new_task())


def named(*names: str) -> list[Symbol]:
    """These symbols of SCS."""
    return [Symbol.intern(name, SCS) for name in names]


BY = Keyword("BY")
READERS: dict[Value, Reader] = {
    **dict.fromkeys(named("DO", "DO*"), reading(Construct("sequence", "ordered"))),
    **dict.fromkeys(named("ATOMIC"), reading(Construct("sequence", "ordered"))),
    **dict.fromkeys(named("REPEAT", "REPEAT*"), reading(Construct("loop", "ordered"))),
    **dict.fromkeys(named("PURSUE-GOALS"), reading(Construct("loop", "ordered"))),
    **dict.fromkeys(named("ADD-GOAL"), giving),
    **dict.fromkeys(named("MAINTAIN"), achieving),
    **dict.fromkeys(named("DROP-GOAL"), acting("goal")),
    **dict.fromkeys(named("SUSPEND"), acting("wait")),
    **dict.fromkeys(named("RESUME"), acting("signal")),
    **dict.fromkeys(named("WITH-CYCLE"), reading(Construct("loop", "ordered", 1))),
    **dict.fromkeys(named("DO-ALL", "DO*-ALL"), reading(Construct("parallel", "together"))),
    **dict.fromkeys(named("DO-ANY", "DO*-ANY"), reading(Construct("choice", "any"))),
    **dict.fromkeys(named("DO-FIRST", "DO*-FIRST"), reading(Construct("choice", "first"))),
    **dict.fromkeys(named("DO-BEST", "DO*-BEST"), reading(Construct("choice", "best"))),
}
