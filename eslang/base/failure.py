"""Failures: what a plan did not manage, as data (ESL §2).

A failure has a cause, a keyword, and arguments. Raised in Python it is an
exception; the runtime turns it into a call of the active recovery procedure.
The makers below are the only place that says what a host error's arguments
are, so that one situation always looks the same (language reference §1).
"""

from __future__ import annotations

from eslang.base.hints import Any
from eslang.base.symbols import Keyword, Symbol

TYPE_ERROR = Keyword("TYPE-ERROR")
DIVISION_BY_ZERO = Keyword("DIVISION-BY-ZERO")
UNBOUND_VARIABLE = Keyword("UNBOUND-VARIABLE")
UNDEFINED_FUNCTION = Keyword("UNDEFINED-FUNCTION")
WRONG_NUMBER_OF_ARGUMENTS = Keyword("WRONG-NUMBER-OF-ARGUMENTS")
INDEX_OUT_OF_RANGE = Keyword("INDEX-OUT-OF-RANGE")
STACK_EXHAUSTED = Keyword("STACK-EXHAUSTED")
PYTHON_ERROR = Keyword("PYTHON-ERROR")
CONTROL_ERROR = Keyword("CONTROL-ERROR")
ERROR = Keyword("ERROR")
GENERAL_FAILURE = Keyword("GENERAL-FAILURE")


class Failure(Exception):
    """A plan did not succeed: a cause (a keyword) and the arguments that came with it.

    What a plan raises reaches Python code with arguments as Python has them;
    `values` are they as Lisp has them.
    """

    story: Any = None  # what the runtime noted of it: where, who was asked (runtime/story.py)
    condition: str | None = None  # of :error, the standard condition type that it is
    origin: Any = None  # the task that failed first, if this was passed on from it
    report: Any = None  # of :deadlock, who waits for what (runtime/deadlock.py)
    kept: tuple[Any, ...] | None = None  # the arguments as Lisp had them, once outside

    def __init__(self, cause: Any, *arguments: Any) -> None:
        self.cause: Any = Keyword(cause) if isinstance(cause, str) else cause
        self.arguments: tuple[Any, ...] = arguments

    @property
    def values(self) -> tuple[Any, ...]:
        """The arguments as Lisp has them."""
        return self.arguments if self.kept is None else self.kept

    def __str__(self) -> str:
        shown = " ".join([str(self.cause), *(str(a) for a in self.arguments)])
        return f"failure {shown}"

    def __repr__(self) -> str:
        return f"{self.__class__.__name__}({', '.join(map(repr, (self.cause, *self.arguments)))})"

    def print_lisp(self, settings: Any) -> str:
        """How the printer shows it: for people, as a sentence."""
        from eslang.base.failure_text import message_of  # made of what prints, and it of failures

        return f"#<FAILURE {self.cause}>" if settings.escape else message_of(self)


def type_error(datum: Any, expected: str | Symbol, operator: str | Symbol | None = None) -> Failure:
    """DATUM is not of the type EXPECTED; arguments (datum expected [operator])."""
    names = [expected] if operator is None else [expected, operator]
    return Failure(TYPE_ERROR, datum, *[standard_name(name) for name in names])


def standard_name(name: str | Symbol) -> Symbol:
    """NAME as a symbol: of Common Lisp, unless it is one already."""
    return Symbol.intern(name.upper(), "COMMON-LISP") if name.__class__ is str else name  # type: ignore[return-value]


def division_by_zero(operator: str, *operands: Any) -> Failure:
    """A division by zero; arguments (operator operand...)."""
    return Failure(DIVISION_BY_ZERO, Symbol.intern(operator.upper(), "COMMON-LISP"), *operands)


def unbound_variable(name: Symbol) -> Failure:
    """A variable without a value; arguments (name)."""
    return Failure(UNBOUND_VARIABLE, name)


def undefined_function(name: Any) -> Failure:
    """A call of what is no function; arguments (name)."""
    return Failure(UNDEFINED_FUNCTION, name)


def index_out_of_range(sequence: Any, index: Any) -> Failure:
    """An index that the sequence does not have; arguments (index sequence)."""
    return Failure(INDEX_OUT_OF_RANGE, index, sequence)


def control_error(message: str) -> Failure:
    """A jump to what is no longer there; arguments (message)."""
    return Failure(CONTROL_ERROR, message)


def simple_error(message: str, *arguments: Any, condition: str | None = None) -> Failure:
    """Any other error of the host; arguments (message datum...); CONDITION names its standard type."""
    failure = Failure(ERROR, message, *arguments)
    failure.condition = condition
    return failure
