"""Learning which action is good (SCS Appendix A, "Learning").

DO-BEST with :LEARN multiplies each utility by a discount factor of its action.
The factor is a fact, (discount ACTION FACTOR), so it is saved and loaded with
the facts; REINFORCE brings it nearer to the utility that was met.
"""

from __future__ import annotations

from eslang.base.failure import control_error, type_error
from eslang.base.hints import Any, NamedTuple
from eslang.base.lists import Cons, lisp_list
from eslang.base.number_kinds import is_number
from eslang.base.running import running
from eslang.base.symbols import Symbol, T, Value
from eslang.compile.registry import SCS, function

DISCOUNT = Symbol.intern("DISCOUNT", SCS)
FACTOR = Symbol.intern("?FACTOR", SCS)
RATE = 0.1


class Learned(NamedTuple):
    """A choice that was made by what was learned: its action, and how fast that is."""

    action: Value
    rate: float


def discount_of(action: Value) -> Value:
    """The discount factor of ACTION: 1 until something was learned of it."""
    found = running.session.database.first(lisp_list(DISCOUNT, action, FACTOR))
    return 1 if found is None else found[FACTOR]


def rate_of(learn: Value) -> float | None:
    """How fast to learn, as :LEARN says: T, NIL, or the rate itself, from 0 to 1."""
    if learn is None or learn is T:
        return None if learn is None else RATE
    if not is_share(learn):
        raise type_error(learn, "UNIT-REAL", Symbol.intern("DO-BEST", SCS))
    return float(learn)


def is_share(value: Value) -> bool:
    """Whether VALUE is a number between 0 and 1."""
    return is_number(value) and bool(0 <= value <= 1)


@function("(reinforce reward)", SCS)
def reinforce(reward: Value) -> Value:
    """Tell what the last choice of DO-BEST with :LEARN was worth, from 0 to 1.

    It is the choice whose steps are under way, or that ended last here. The
    discount factor d of its action becomes d + rate * (REWARD - d). It is a
    fact, (discount ACTION FACTOR); ACTION is the step of the clause, or the list
    of its steps, as they are written.

    Returns: the new factor.
    Fails:   :type-error if REWARD is no number from 0 to 1;
             :control-error if no choice was made here.

    Example:
        ? (do-best :learn t (t 5 :left) (t 4 :right))
        :LEFT
        ? (do-best :learn t (t 5 (reinforce 0)) (t 4 :right))
        0.9

    Source: SCS Appendix A; the rule: language reference §7.
    """
    if not is_share(reward):
        raise type_error(reward, "UNIT-REAL", Symbol.intern("REINFORCE", SCS))
    learned: Learned | None = running.session.dynamic.logical.learned
    if learned is None:
        raise control_error("REINFORCE is called where no DO-BEST with :LEARN has chosen")
    database: Any = running.session.database
    before = discount_of(learned.action)
    after = before + learned.rate * (reward - before)
    pattern = lisp_list(DISCOUNT, learned.action, Symbol.intern("?_", SCS))
    database.update(pattern, Cons(DISCOUNT, lisp_list(learned.action, after)))
    return after
