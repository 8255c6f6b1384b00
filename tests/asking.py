"""A logical database whose facts and queries are text, for tests of eslang/facts."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from eslang.base.printer import prin1
from eslang.base.spans import Source
from eslang.base.symbols import Symbol, Value
from eslang.facts.nested import Written, filled
from eslang.facts.plans import Solution
from eslang.facts.query import Facts
from eslang.interpreter import Interpreter

LISP: dict[str, Callable[..., bool]] = {
    "<": lambda left, right: left < right,
    ">": lambda left, right: left > right,
    "EVENP": lambda number: number % 2 == 0,
    "EQUAL": lambda left, right: prin1(left) == prin1(right),
}


@cache
def _interpreter() -> Interpreter:
    return Interpreter()


def read(text: str) -> Value:
    """The one form in TEXT."""
    (reading,) = _interpreter().readings(Source("facts.esl", text))
    return reading.form


def bound(name: str) -> Symbol:
    """The variable of that name."""
    return Symbol(name)


def as_datum(argument: Value) -> Value:
    """An argument of a test, all of whose text is data."""
    return filled(*argument) if argument.__class__ is Written else argument


class Asking(Facts):
    """A database that reads text."""

    def __init__(self, *facts: str) -> None:
        self.calls: list[str] = []  # of Lisp, in order
        self.broken = False  # whether Lisp fails
        super().__init__(lambda name: name.name in LISP, self.call_lisp)
        for fact in facts:
            self.add(read(fact))

    def call_lisp(self, name: Symbol, arguments: list[Value]) -> bool:
        """Call a function of this Lisp."""
        self.calls.append(prin1(name))
        if self.broken:
            raise ZeroDivisionError
        return LISP[name.name](*map(as_datum, arguments))

    def rule(self, text: str) -> bool:
        """Take a rule, (head body...)."""
        form = read(text)
        return self.define_rule(form.car, form.cdr)

    def answers(self, query: str, **given: Any) -> list[str]:
        """All solutions, as text."""
        found = self.all(read(query), {bound(f"?{name}"): value for name, value in given.items()})
        return [told(solution) for solution in found]

    def held(self) -> list[str]:
        """All facts, as text."""
        return [prin1(fact) for fact in self.facts()]


def told(solution: Solution | None) -> str:
    """A solution as text: its values, in order."""
    if solution is None:
        return "none"
    assert not any(isinstance(value, str | tuple) for value in solution.values()), "a code has got out"
    return " ".join(prin1(value) for value in solution.values())
