"""Aims: the goals that Python code gives an agent (SCS §2).

A goal is text, "(achieve (at robot dock))", or a list of its parts, worded as
facts are (wording.py); its condition is a query. All may be called in any
thread. While the interpreter is at work in another one, a change is left to be
done between two steps, and gives None (runtime/visits.py).
"""

from __future__ import annotations

from eslang.base.hints import TYPE_CHECKING, Any, Callable, Sequence
from eslang.base.symbols import Value

if TYPE_CHECKING:
    from eslang.interpreter import Interpreter
    from eslang.runtime.agenda import Goal
    from eslang.wording import Wording

Spec = str | Sequence[Any]
Utility = float | Callable[[], float] | None


def add_goal(
    session: Interpreter, goal: Spec, /, *, utility: Utility = None, retries: int | None = None
) -> Goal | None:
    """Give the agent GOAL; what (pursue-goals) sees to, or None if it is left to be added.

    UTILITY is a number, or is called when it is to be known; RETRIES is how often an attempt
    that fails is followed by another, None: for ever.
    """
    from eslang.constructs.scs.goals import add_goal_of

    with session.door():
        worth = None if utility is None else worth_of(utility)
    added: Goal | None = _done(
        session, goal, lambda spec: add_goal_of(spec, None, None, worth, None, retries)
    )
    return added


def drop_goal(session: Interpreter, goal: Spec | Goal, /) -> bool | None:
    """Drop GOAL, or the one that is worded so; whether it was there, or None if that is left to be done."""
    from eslang.constructs.scs.goals import drop_goal_of

    dropped: bool | None = _done(session, goal, lambda spec: drop_goal_of(spec) is not None)
    return dropped


def goals_of(session: Interpreter) -> list[Goal]:
    """The goals of the agent that are not over, in the order in which they were given."""
    from eslang.runtime.visits import NOT_NOW, send, visit

    def work() -> list[Goal]:
        return [] if session.agenda is None else session.agenda.goals()

    found: Any = visit(session.runs, work)
    listed: list[Goal] = send(session.runs, work) if found is NOT_NOW else found
    return listed


def worth_of(utility: Any) -> Callable[[], Value]:
    """The function that gives UTILITY, a number or a function of Python, as Lisp has it."""
    from eslang.primitives import run_python

    if callable(utility):
        return lambda: run_python(utility, [], {}, "utility")
    from eslang.base.border import to_lisp
    from eslang.constructs.scs.goals import as_real

    number = as_real(to_lisp(utility))
    return lambda: number


def _done(session: Interpreter, goal: Any, work: Callable[[Value], Any]) -> Any:
    """What WORK gives for GOAL, done now; or None, and it is left to be done, unless GOAL is none."""
    from eslang.base.resolve import resolve_in
    from eslang.runtime.visits import NOT_NOW, leave_errand, visit
    from eslang.wording import Wording, copied, resolve_unmade

    def do() -> Any:
        with session.door():
            return work(read_goal(Wording(resolve_in(session.image)), goal))

    done = visit(session.runs, do)
    if done is not NOT_NOW:
        return done
    goal = copied((goal,))[0]
    with session.door():
        read_goal(Wording(resolve_unmade(session.image)), goal)
    leave_errand(session.runs, do, lambda errand: _report(session, errand.error))
    return None


def _report(session: Interpreter, error: BaseException | None) -> None:
    """What was left has been done; what went wrong is a failure of the run."""
    from eslang.posts import post_call, raise_again

    if isinstance(error, Exception) and not session.closed:
        failed = error
        post_call(session, lambda: raise_again(failed))


def read_goal(wording: Wording, goal: Any) -> Value:
    """GOAL as Lisp has it. Raises a :type-error failure if it is none."""
    from eslang.constructs.scs.goals import ADD_GOAL, read_spec
    from eslang.runtime.events import Event

    if isinstance(goal, Event):
        return goal
    spec = wording.form(goal)
    read_spec(spec, ADD_GOAL)
    return spec
