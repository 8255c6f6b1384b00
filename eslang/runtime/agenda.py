"""The agenda: the top-level goals of one agent, and what has become of them (SCS §2).

A goal stays on the agenda until it is achieved, dropped, or given up because
it is impossible. It is an event, which is signalled by that end and stays so:
who waits for it later finds it as well. What its condition is, and how it is
brought about, is handed in; who sees to that is pursuit.py.
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import TYPE_CHECKING, Any, Callable, NamedTuple
from eslang.base.lists import lisp_list
from eslang.base.running import running
from eslang.base.shown import shown
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.runtime.events import Arguments, Event
from eslang.runtime.tasks import Task

if TYPE_CHECKING:
    from eslang.runtime.pursuit import Pursuit

PENDING, ACTIVE, INACTIVE, BLOCKED, ACHIEVED, DROPPED, IMPOSSIBLE = map(
    Keyword, ("PENDING", "ACTIVE", "INACTIVE", "BLOCKED", "ACHIEVED", "DROPPED", "IMPOSSIBLE")
)


class Means(NamedTuple):
    """What a goal asks and does; all are called in tasks that pursue it."""

    holds: Callable[[], bool]
    solution: Callable[[], Value]  # the variables under which it holds, as an alist
    await_need: Callable[[], None]  # wait until it does not hold
    attempt: Callable[[], object]  # bring it about; fails if it cannot


class Goal(Event):
    """A world state that is to be achieved, or to be maintained."""

    __slots__ = (
        "bindings",
        "condition",
        "failed",
        "failure",
        "is_leaving",
        "is_maintained",
        "means",
        "retries",
        "spec",
        "status",
        "utility",
    )

    def __init__(
        self,
        operator: Symbol,
        condition: Value,
        is_maintained: bool,
        means: Means,
        retries: int | None = None,
    ) -> None:
        self.spec = lisp_list(operator, condition)  # as it is written: (achieve CONDITION)
        super().__init__(self.spec)
        self.condition = condition
        self.is_maintained = is_maintained  # it stays when it holds
        self.means = means
        self.retries = retries  # how often a failed attempt is followed by another; None: for ever
        self.utility: Callable[[], Value] | None = None
        self.status = PENDING
        self.is_leaving = False  # it was dropped, and its attempt has not ended yet
        self.failed = 0  # how many attempts in a row
        self.failure: Failure | None = None  # of the last of them
        self.bindings: Value = None  # the variables under which it was achieved

    def print_lisp(self, settings: Any) -> str:
        """How the printer shows it."""
        return f"#<GOAL {shown(self.spec).upper()}>"

    def __repr__(self) -> str:
        return self.print_lisp(None)

    def __str__(self) -> str:
        return shown(self.spec)

    def name_of_task(self) -> str:
        """What a task is called that pursues it, such as achieve-at."""
        operators = [self.spec.car, getattr(self.condition, "car", None)]
        return "-".join([each.name.lower() for each in operators if isinstance(each, Symbol)])

    @property
    def is_over(self) -> bool:
        """True if nothing more will come of it."""
        return self.status in (ACHIEVED, DROPPED, IMPOSSIBLE)

    def outcome(self) -> Arguments | None:
        """How it ended, and with what; None while that is to come."""
        if not self.is_over:
            return None
        if self.status is IMPOSSIBLE and self.failure is not None:
            return (IMPOSSIBLE, self.failure.cause, *self.failure.arguments)
        return (ACHIEVED, self.bindings) if self.status is ACHIEVED else (self.status,)


class Agenda:
    """The goals of one agent that are not over, in the order in which they were given."""

    def __init__(
        self, session: Any, is_same: Callable[[Value, Value], bool], sketch: Callable[[Value], Value]
    ) -> None:
        self.scheduler = session.scheduler
        self.is_same = is_same  # of two conditions
        self.sketch = sketch  # of a condition: those that are the same have the same
        self.kept: dict[Goal, None] = {}
        self.sketched: dict[Value, list[Goal]] = {}  # the same goals by that
        self.pursuit: Pursuit | None = None  # whoever sees to them now

    def goals(self) -> list[Goal]:
        """Those that are to be pursued."""
        return [goal for goal in self.kept if not goal.is_leaving]

    def are_same(self, one: Goal, other: Goal) -> bool:
        """True if two goals differ at most in the names of their logic variables."""
        return one.is_maintained is other.is_maintained and self.is_same(one.condition, other.condition)

    def find(self, is_maintained: bool, condition: Value) -> Goal | None:
        """The goal for CONDITION, if there is one."""
        for goal in self.sketched.get(self.sketch(condition), ()):
            is_alike = goal.is_maintained is is_maintained and not goal.is_leaving
            if is_alike and self.is_same(goal.condition, condition):
                return goal
        return None

    def add(self, goal: Goal) -> Goal:
        """Take GOAL; or the one that is the same, which is to have its utility from now on, if it has one."""
        known = self.find(goal.is_maintained, goal.condition)
        if known is None:
            self.kept[goal] = None
            self.sketched.setdefault(self.sketch(goal.condition), []).append(goal)
            self.announce("added", goal)
        elif goal.utility is not None:
            known.utility = goal.utility
        if self.pursuit is not None:
            self.pursuit.take_note(goal if known is None else None)
        return known or goal

    def drop(self, goal: Goal) -> bool:
        """Let GOAL go, after the cleanups of an attempt that is under way; false if it was not there."""
        if goal not in self.kept or goal.is_leaving:
            return False
        goal.is_leaving = True
        task = None if self.pursuit is None else self.pursuit.task_of(goal)
        if task is None:
            self.end(goal, DROPPED)
        else:
            self.scheduler.lives.abort(task, "goal")
        return True

    def end(self, goal: Goal, status: Keyword, failure: Failure | None = None) -> None:
        """GOAL is over."""
        if goal not in self.kept:
            return
        del self.kept[goal]
        sketch = self.sketch(goal.condition)
        self.sketched[sketch].remove(goal)
        if not self.sketched[sketch]:
            del self.sketched[sketch]
        goal.status = status
        self.announce(status.name.lower(), goal, failure)
        if goal.waits:
            self.scheduler.wake(goal.signal(goal.outcome() or ()))

    def announce(self, change: str, goal: Goal, failure: Failure | None = None) -> None:
        """Tell the listeners what becomes of GOAL."""
        if running.session.hooks.listeners:
            self.scheduler.lives.tell("goal-changed", change=change, goal=goal.spec, failure=failure)


def goal_of(task: Task, members: dict[Task, Goal]) -> Goal | None:
    """The goal for which TASK is at work, if it belongs to one of MEMBERS."""
    return next((members[each] for each in task.ancestors() if each in members), None)
