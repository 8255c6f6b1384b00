"""Choices by conditions (SCS Appendix C): do first, which is a T-R program, and do best."""

from __future__ import annotations

from eslang.base.failure import type_error
from eslang.base.hints import Any, Callable, NamedTuple
from eslang.base.lists import Cons, from_items, items, lisp_list
from eslang.base.many import primary
from eslang.base.number_kinds import is_number
from eslang.base.running import running
from eslang.base.shown import shown
from eslang.base.symbols import Symbol, T, Value
from eslang.compile.registry import CL, SCS, function, macro
from eslang.constructs.scs.asking import LEFT, Asked, Asker, Bindings, run_under
from eslang.constructs.scs.choice import Alternatives
from eslang.constructs.scs.learning import Learned, discount_of, rate_of
from eslang.constructs.scs.stepping import (
    Step,
    asking_form,
    call_of,
    in_order,
    parts_of,
    read_steps,
    spelled,
    steps_form,
)
from eslang.constructs.shapes import refuse
from eslang.runtime import failures
from eslang.runtime.attempts import outcome
from eslang.runtime.circuits import stage_here, tell_deactivated

LAMBDA, LIST, OR, QUOTE = (Symbol.intern(name, CL) for name in ("LAMBDA", "LIST", "OR", "QUOTE"))
FIRST, BEST = (Symbol.intern(name, SCS) for name in ("%DO-FIRST", "%DO-BEST"))


class Alternative(NamedTuple):
    """One clause: what it does, as it is written; its condition, its utility if it has one, and its steps."""

    action: Value
    asked: Asked
    utility: Callable[[], Value] | None
    steps: list[Step]


def clauses_form(clauses: Value, environment: Any, within: str, valued: bool) -> Value:
    """The form that gives the clauses of a choice: for each its condition, test, utility and steps."""
    parts = []
    least = 2 if valued else 1
    while clauses is not None:
        clause = clauses.car
        if not is_list_of(clause, least):
            shape = "(condition utility step...)" if valued else "(condition step...)"
            wrong = f"`{shown(clause)}` is no clause of {within}"
            refuse(environment, "malformed-step", wrong, clauses, hint=f"write `{shape}`", within=within)
        condition, rest = clause.car, clause.cdr
        utility = None
        if valued:
            utility, rest = lisp_list(LAMBDA, None, rest.car), rest.cdr
        test = asking_form(condition, environment)
        action = rest.car if rest is not None and rest.cdr is None else rest
        data = lisp_list(QUOTE, lisp_list(condition, action))
        parts.append(lisp_list(LIST, data, test, utility, steps_form(rest, environment, within)))
        clauses = clauses.cdr
    return Cons(LIST, from_items(parts))


def is_list_of(clause: Value, least: int) -> bool:
    """Whether CLAUSE is a list with that many elements at LEAST."""
    while clause.__class__ is Cons:
        clause, least = clause.cdr, least - 1
    return clause is None and least <= 0


@macro("(do-first &rest clauses)", SCS)
def do_first(form: Cons, environment: Any) -> Value:
    """Do the steps of the first of CLAUSES whose condition holds.

    A clause is (CONDITION . STEPS). After every action the conditions are
    asked: if an earlier one holds now, or that of the running clause does not
    any more, the steps are left where they are, and the choice is made anew.
    While no condition holds, it idles. Modifiers may stand before CLAUSES, as
    in DO.

    Returns: the values of the steps, when they succeed; :deactivated, if a
             modifier ends it, or nothing but deactivated steps are left.
    Fails:   as soon as the steps that run fail.
    Waits:   while no condition holds.

    Example:
        ? (let ((distance 2))
            (do-first ((= distance 0) (princ "grip ") :held)
                      (t (repeat (princ "step ") (decf distance)))))
        step step grip
        :HELD

    Source: SCS Appendix C; T-R programs: SCS Appendix B.
    """
    return _expand_clauses(FIRST, form, environment, None)


@macro("(do*-first &rest clauses)", SCS)
def do_star_first(form: Cons, environment: Any) -> Value:
    """Do as DO-FIRST does, but try steps that fail again.

    Returns: the values of the steps, when they succeed; :deactivated, if a
             modifier ends it, or nothing but deactivated steps are left.
    Waits:   while no condition holds.

    Example:
        ? (let ((pulls 0))
            (do*-first (t (if (< (incf pulls) 3) (fail :stuck) :open))))
        :OPEN

    Source: SCS Appendix C.
    """
    return _expand_clauses(FIRST, form, environment, T)


@macro("(do-best &rest clauses)", SCS)
def do_best(form: Cons, environment: Any) -> Value:
    """Do the steps of the best of CLAUSES, each (CONDITION UTILITY . STEPS).

    Of those whose condition holds, the one whose UTILITY is highest then; of
    several, any. When its condition does not hold any more, the choice is
    made anew; when it fails, another is tried. While none holds, it idles.
    A clause stands for the first solution of its condition. With :learn t among
    the modifiers, or :learn RATE, each utility is multiplied by what was
    learned of its steps (see REINFORCE).

    Returns: the values of the steps that succeed; :deactivated, if a modifier
             ends it, or nothing but deactivated steps are left.
    Fails:   :all-subtasks-failed when all have failed, with the list of their
             failures, each (CAUSE . ARGUMENTS), in textual order;
             :type-error if a utility is no real number.
    Waits:   while no condition holds.

    Example:
        ? (let ((battery 20))
            (do-best (t battery :explore)
                     ((< battery 50) (- 100 battery) :recharge)))
        :RECHARGE

    Source: SCS Appendix C, §3 "Best-First Behavior".
    """
    return _expand_clauses(BEST, form, environment, None)


@macro("(do*-best &rest clauses)", SCS)
def do_star_best(form: Cons, environment: Any) -> Value:
    """Do as DO-BEST does, but clauses that have failed may be chosen again.

    Returns: the values of the steps that succeed; :deactivated, if a modifier
             ends it, or nothing but deactivated steps are left.
    Waits:   while no condition holds.

    Example:
        ? (let ((tries 0))
            (do*-best (t (- tries) (if (< (incf tries) 3) (fail :slow) :there))))
        :THERE

    Source: SCS Appendix C.
    """
    return _expand_clauses(BEST, form, environment, T)


def _expand_clauses(function_name: Symbol, form: Cons, environment: Any, starred: Value) -> Value:
    within = spelled(form.car)
    valued = function_name is BEST
    options: dict[str, Value] = {"LEARN": None} if valued else {}
    modifiers, clauses = parts_of(form, environment, within, options)
    listed = clauses_form(clauses, environment, within, valued)
    return call_of(function_name, form, modifiers, listed, starred, *options.values())


class Choice(Asker):
    """One entrance of DO-FIRST or DO-BEST."""

    __slots__ = ("alternatives", "rate", "tries")

    def __init__(self, clauses: Value, starred: bool, learn: Value = None) -> None:
        super().__init__()
        self.rate = rate_of(learn)
        self.alternatives = [
            Alternative(data.cdr.car, self.ask(data.car, test), utility, read_steps(steps))
            for data, test, utility, steps in map(items, items(clauses))
        ]
        self.tries = Alternatives(len(self.alternatives), starred)

    def run_first(self) -> Value:
        """Do as DO-FIRST does."""
        alternatives, starred = self.alternatives, self.tries.starred
        while self.tries.left:
            number = next((each for each in self.tries.left if alternatives[each].asked.holds()), None)
            if number is None:
                self.rest()
                continue
            before = [alternatives[each].asked for each in self.tries.left if each < number]
            mine = alternatives[number]

            def holds(mine: Alternative = mine, before: list[Asked] = before) -> bool:
                return not any(each.holds() for each in before) and mine.asked.holds()

            value = self.do_one(number, [*before, mine.asked], holds, starred)
            if value is not LEFT and self.tries.note(number, value):
                return value
        return self.tries.end()

    def run_best(self) -> Value:
        """Do as DO-BEST does."""
        while self.tries.left:
            number = self.best()
            if number is None:
                self.rest()
                continue
            mine = self.alternatives[number]
            dynamic = running.session.dynamic
            if self.rate is not None:
                dynamic.logical = dynamic.logical._replace(learned=Learned(mine.action, self.rate))
            value = self.do_one(number, [mine.asked], mine.asked.holds, True)
            if value is not LEFT and self.tries.note(number, value):
                return value
        return self.tries.end()

    def best(self) -> int | None:
        """The alternative with the highest utility; any of several; None if none is available."""
        best: list[int] = []
        highest: Value = None
        for number in self.tries.left:
            mine = self.alternatives[number]
            if not mine.asked.holds():
                continue
            utility = self.utility_of(mine)
            if highest is None or utility > highest:
                highest, best = utility, [number]
            elif utility == highest:
                best.append(number)
        if not best:
            return None
        return best[0] if len(best) == 1 else best[running.session.chance.randrange(len(best))]

    def utility_of(self, mine: Alternative) -> Value:
        """Its utility now, under the bindings of its condition."""
        dynamic = running.session.dynamic
        outer = dynamic.logical
        dynamic.logical = outer.within(mine.asked.bindings)
        try:
            utility = failures.guarded(mine.utility)  # type: ignore[arg-type]
            if not is_number(utility):
                raise type_error(utility, "REAL", Symbol.intern("DO-BEST", SCS))
            return utility if self.rate is None else utility * discount_of(mine.action)
        finally:
            dynamic.logical = outer

    def do_one(self, number: int, on: list[Asked], holds: Callable[[], bool], attempts: bool) -> Value:
        """Do the steps of one alternative while HOLDS, which asks ON; LEFT if that ended them."""
        mine, stage = self.alternatives[number], stage_here()
        stage.number, stage.condition = number + 1, [mine.asked.condition]

        def body() -> Value:
            return mine.steps[0].run() if len(mine.steps) == 1 else in_order(mine.steps, False)

        bindings: Bindings = mine.asked.bindings
        value = self.run(on, holds, bindings, (lambda: outcome(self.task, body)) if attempts else body)
        if value is LEFT:
            self.tries.renew()
            earlier = next((each for each in on if each is not mine.asked and each.value), None)
            condition = mine.asked.condition if earlier is None else earlier.condition
            tell_deactivated("condition" if earlier is None else "earlier", condition)
        return value

    def rest(self) -> None:
        """Wait until an alternative is available."""
        among = [self.alternatives[number].asked for number in self.tries.left]
        conditions = [asked.condition for asked in among]
        self.idle(conditions[0] if len(conditions) == 1 else Cons(OR, from_items(conditions)), among)


def do_first_values(operator: Value, modifiers: Value, clauses: Value, starred: Value) -> Value:
    """All that DO-FIRST gives, or DO*-FIRST if STARRED."""
    return _chosen(operator, modifiers, lambda: Choice(clauses, starred is not None), Choice.run_first)


@function("(%do-first operator modifiers clauses starred)", SCS, many=do_first_values)
def do_first_of(*parts: Value) -> Value:
    """DO-FIRST, or DO*-FIRST if STARRED."""
    return primary(do_first_values(*parts))


def do_best_values(operator: Value, modifiers: Value, clauses: Value, starred: Value, learn: Value) -> Value:
    """All that DO-BEST gives, or DO*-BEST if STARRED."""
    return _chosen(operator, modifiers, lambda: Choice(clauses, starred is not None, learn), Choice.run_best)


@function("(%do-best operator modifiers clauses starred learn)", SCS, many=do_best_values)
def do_best_of(*parts: Value) -> Value:
    """DO-BEST, or DO*-BEST if STARRED."""
    return primary(do_best_values(*parts))


def _chosen(
    operator: Value, modifiers: Value, make: Callable[[], Choice], how: Callable[[Choice], Value]
) -> Value:
    def body() -> Value:
        choice = make()
        try:
            return how(choice)
        finally:
            choice.end()

    return run_under(operator, modifiers, body)
