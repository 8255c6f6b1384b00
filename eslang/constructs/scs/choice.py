"""Choices among steps (SCS Appendix C): do any, and what do first and do best share with it.

A step that is deactivated is not available. A choice that has nothing but
such steps left is deactivated itself.
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items
from eslang.base.many import primary
from eslang.base.running import running
from eslang.base.symbols import Keyword, Symbol, T, Value
from eslang.compile.registry import SCS, function, macro
from eslang.constructs.scs.asking import DEACTIVATED, run_under
from eslang.constructs.scs.stepping import Tries, expand, read_steps
from eslang.runtime import failures
from eslang.runtime.attempts import Unsuccessful, outcome
from eslang.runtime.circuits import stage_here, tell_deactivated

ANY = Symbol.intern("%DO-ANY", SCS)
ALL_FAILED = Keyword("ALL-SUBTASKS-FAILED")


def all_failed(found: list[Failure]) -> Value:
    """Fail, since every step did."""
    causes = [Cons(failure.cause, from_items(list(failure.arguments))) for failure in found]
    return failures.signal(Failure(ALL_FAILED, from_items(causes)), continuable=True)


class Alternatives(Tries):
    """What became of the alternatives of one entrance of a choice."""

    __slots__ = ("count", "failed", "left", "starred")

    def __init__(self, count: int, starred: bool) -> None:
        super().__init__()
        self.count = count
        self.left = list(range(count))  # those that are available
        self.failed: dict[int, Failure] = {}
        self.starred = starred

    def note(self, number: int, value: Value) -> bool:
        """The alternative NUMBER gave VALUE; true if that decides the choice."""
        if value is DEACTIVATED:
            self.left.remove(number)
        elif value.__class__ is Unsuccessful:
            self.failed[number] = value.failure
            self.renew()
            self.again()
        else:
            return True
        return False

    def renew(self) -> None:
        """Something was done: what was deactivated before may be available now."""
        self.left = [each for each in range(self.count) if self.starred or each not in self.failed]

    def end(self) -> Value:
        """No alternative is left: the choice fails, or is deactivated."""
        if len(self.failed) == self.count and not self.starred:
            return all_failed([self.failed[number] for number in sorted(self.failed)])
        tell_deactivated("alternatives")
        return DEACTIVATED


@macro("(do-any &rest steps)", SCS)
def do_any(form: Cons, environment: Any) -> Value:
    """Do any of STEPS, as chance has it; if it fails, another.

    It goes on until one succeeds. Modifiers may stand before STEPS, as in DO.

    Returns: the values of the step that succeeds; :deactivated, if a modifier
             ends it, or nothing but deactivated steps are left.
    Fails:   :all-subtasks-failed when all have failed, with the list of their
             failures, each (CAUSE . ARGUMENTS), in textual order.

    Example:
        ? (do-any (fail :door-shut) (fail :window-shut) :chimney)
        :CHIMNEY

    Source: SCS Appendix C; deactivated steps: language reference §7.
    """
    return expand(ANY, form, environment, None)


@macro("(do*-any &rest steps)", SCS)
def do_star_any(form: Cons, environment: Any) -> Value:
    """Do any of STEPS, those that have failed among them, until one succeeds.

    Returns: the values of the step that succeeds; :deactivated, if a modifier
             ends it, or nothing but deactivated steps are left.

    Example:
        ? (let ((knocks 0))
            (do*-any (if (< (incf knocks) 5) (fail :nobody-home) :let-in)))
        :LET-IN

    Source: SCS Appendix C.
    """
    return expand(ANY, form, environment, T)


def do_any_values(operator: Value, modifiers: Value, steps: Value, starred: Value) -> Value:
    """All that DO-ANY gives, or DO*-ANY if STARRED."""
    listed = read_steps(steps)

    def body() -> Value:
        tries, stage = Alternatives(len(listed), starred is not None), stage_here()
        task = running.session.scheduler.at_work()
        while tries.left:
            number = tries.left[running.session.chance.randrange(len(tries.left))]
            stage.number = number + 1
            value = outcome(task, listed[number].run)
            if tries.note(number, value):
                return value
        return tries.end()

    return run_under(operator, modifiers, body)


@function("(%do-any operator modifiers steps starred)", SCS, many=do_any_values)
def do_any_of(*parts: Value) -> Value:
    """DO-ANY, or DO*-ANY if STARRED."""
    return primary(do_any_values(*parts))
