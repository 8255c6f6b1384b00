"""Doubles: scripted functions that stand in for devices and whatever else a plan calls.

A double takes the place of a function in one interpreter, answers each call by
the next step of its script, and remembers the calls. The script's language is
stdlib/testing.esl; the embedding interface builds on the same class.
Source: ours; the papers tell of no tests.
"""

from __future__ import annotations

from eslang.base.border import to_lisp, to_python
from eslang.base.calls import spread
from eslang.base.failure import simple_error
from eslang.base.hints import Any, Callable
from eslang.base.image import Cell
from eslang.base.lists import from_items, items
from eslang.base.many import many_of, primary
from eslang.base.running import running, to_function
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.compile.registry import ESL, function
from eslang.runtime.failures import fail

Answer = Callable[..., Value]


class Step:
    """What a double does for so many calls: after some seconds, answer (None: as the original does)."""

    __slots__ = ("after", "answer", "times")

    def __init__(self, answer: Answer | None, times: int = 1, after: float = 0) -> None:
        self.answer = answer
        self.times = times
        self.after = after


class Double:
    """A stand-in for the function of one cell: its steps, and the calls so far."""

    def __init__(self, cell: Cell) -> None:
        symbol = cell.symbol
        if symbol is None or symbol.package in ("COMMON-LISP", "KEYWORD") or cell.macro is not None:
            raise simple_error("only a function outside Common Lisp can have a double", symbol)
        self.cell = cell
        self.name = symbol
        self.steps: list[Step] = []
        self.received: list[tuple[Value, ...]] = []
        self.original: Any = None
        self.stand_in = self._make_stand_in()

    def _make_stand_in(self) -> Any:
        def stand_in(*arguments: Value) -> Value:
            return primary(self.answer(arguments))

        def stand_in_many(*arguments: Value) -> Value:
            return self.answer(arguments)

        stand_in.many = stand_in_many  # type: ignore[attr-defined]
        stand_in.double = self  # type: ignore[attr-defined]
        stand_in.lisp_name = self.name  # type: ignore[attr-defined]
        return stand_in

    def answer(self, arguments: tuple[Value, ...]) -> Value:
        """Answer one call, with all values."""
        self.received.append(arguments)
        step = self.step_for(len(self.received))
        if step is None:
            return None
        if step.after:
            running.session.scheduler.sleep(step.after)
        answer = step.answer if step.answer is not None else self.original
        if answer is None:
            raise simple_error("there is no function behind the double", self.name)
        return spread(many_of(answer), arguments)

    def step_for(self, call: int) -> Step | None:
        """The step that answers call number CALL, counted from 1; the last one for all that follow."""
        for step in self.steps:
            call -= step.times
            if call <= 0:
                return step
        return self.steps[-1] if self.steps else None

    # The script, as Python writes it: `double.returns(3, times=2).fails("grip-lost", 4, after=1.5)`.

    def returns(self, value: Any = None, *, times: int = 1, after: float = 0) -> Double:
        """Next, return VALUE."""
        return self._then(lambda *_: to_lisp(value), times, after)

    def fails(self, cause: Any, *arguments: Any, times: int = 1, after: float = 0) -> Double:
        """Next, fail with CAUSE and ARGUMENTS, at the place of the call."""
        given = [to_lisp(argument) for argument in arguments]
        name = Keyword(cause) if isinstance(cause, str) else cause
        return self._then(lambda *_: fail(name, *given), times, after)

    def does(self, function: Callable[..., Any], *, times: int = 1, after: float = 0) -> Double:
        """Next, do what the Python FUNCTION does with the arguments."""
        return self._then(lambda *args: to_lisp(function(*map(to_python, args))), times, after)

    def passes(self, *, times: int = 1, after: float = 0) -> Double:
        """Next, do what the function itself does."""
        return self._then(None, times, after)

    def _then(self, answer: Answer | None, times: int, after: float) -> Double:
        self.steps.append(Step(answer, times, after))
        return self

    @property
    def calls(self) -> list[list[Any]]:
        """The arguments of each call so far, as Python values."""
        return [[to_python(argument) for argument in call] for call in self.received]

    def install(self) -> Double:
        """Take the place of the function, unless the double has it already."""
        current = getattr(self.cell, "function", None)
        if current is not self.stand_in:
            self.original = current
            self.cell.function = self.stand_in
        return self

    def remove(self) -> None:
        """Give the place back, unless somebody else has taken it."""
        if getattr(self.cell, "function", None) is self.stand_in:
            if self.original is None:
                del self.cell.function
            else:
                self.cell.function = self.original

    def print_lisp(self, settings: Any) -> str:
        """The double as Lisp prints it."""
        return f"#<DOUBLE {self.name}>"


@function("(%double-step times after answer)", ESL)
def double_step(times: Value, after: Value, answer: Value) -> Value:
    """Make a step: ANSWER, a function or NIL, for TIMES calls, each AFTER so many seconds."""
    return Step(None if answer is None else to_function(answer), times, float(after))


@function("(%make-double name steps)", ESL)
def make_double(name: Value, steps: Value) -> Value:
    """Let a double with STEPS stand in for the function NAME."""
    if not isinstance(name, Symbol):
        raise simple_error("a double stands in for a function, by its name", name)
    double = Double(running.session.image.cell(name))
    double.steps = items(steps)
    return double.install()


@function("(%remove-double double)", ESL)
def remove_double(double: Value) -> Value:
    """Let DOUBLE stand in no longer."""
    double.remove()
    return None


@function("(double-calls name)", ESL)
def double_calls(name: Value) -> Value:
    """List the arguments of each call that the double for NAME has had.

    Returns: a list of argument lists, oldest call first.
    Fails:   :error, if no double stands in for NAME.

    Example:
        ? (with-doubles ((move-arm (:returns :moved)))
            (move-arm :up 3)
            (move-arm :down 1)
            (double-calls 'move-arm))
        ((:UP 3) (:DOWN 1))

    Source: ours, docs/how-to/test-a-plan.md.
    """
    stand_in = getattr(running.session.image.cell(name), "function", None)
    double = getattr(stand_in, "double", None)
    if double is None:
        raise simple_error("no double stands in for this name", name)
    return from_items([from_items(call) for call in double.received])
