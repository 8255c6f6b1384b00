"""Python's errors, as the failures of the host language.

Most Lisp functions raise the right Failure themselves. What compiled code
does with Python's own operators and calls raises Python's own errors; here
they are given their causes and arguments (language reference §1).
"""

from __future__ import annotations

from types import TracebackType

from eslang.base.diagnostics import EslError
from eslang.base.failure import (
    ERROR,
    INDEX_OUT_OF_RANGE,
    PYTHON_ERROR,
    STACK_EXHAUSTED,
    WRONG_NUMBER_OF_ARGUMENTS,
    Failure,
    division_by_zero,
    type_error,
    unbound_variable,
    undefined_function,
)
from eslang.base.image import Cell
from eslang.base.lists import lisp_list
from eslang.base.running import running
from eslang.base.symbols import Symbol, Value
from eslang.base.text import String

SETF = Symbol.intern("SETF", "COMMON-LISP")
_EXPECTED = {
    "car": "LIST",
    "cdr": "LIST",
    "items": "VECTOR",
    "text": "STRING",
    "char": "CHARACTER",
    "name": "SYMBOL",
    "find_variable": "ENVIRONMENT",
    "find_function": "ENVIRONMENT",
}
_OPERATORS = ("unsupported operand", "not supported between", "bad operand type")


def to_failure(error: Exception) -> Failure:
    """The failure that ERROR is, with its traceback kept."""
    failure = _failure_of(error)
    failure.arguments = tuple(String(a) if a.__class__ is str else a for a in failure.arguments)
    if failure is not error:
        failure.__cause__ = error
        failure.__traceback__ = error.__traceback__
    return failure


def _failure_of(error: Exception) -> Failure:
    if isinstance(error, Failure):
        return error
    if isinstance(error, AttributeError):
        return _attribute_failure(error)
    if isinstance(error, RecursionError):
        return Failure(STACK_EXHAUSTED)
    if isinstance(error, ZeroDivisionError):
        return division_by_zero("/")
    if isinstance(error, TypeError):
        return _type_failure(error)
    if isinstance(error, IndexError) and _raised_here(error):
        return Failure(INDEX_OUT_OF_RANGE, str(error))
    if isinstance(error, OverflowError):
        return Failure(ERROR, f"a number is too large: {error}")
    if isinstance(error, EslError):
        return Failure(ERROR, error.diagnostic.message)
    return python_failure(error)


def python_failure(error: BaseException) -> Failure:
    """An error of somebody's Python code: its type, its message, and itself."""
    failure = Failure(PYTHON_ERROR, String(type(error).__name__), String(str(error)), error)
    failure.__cause__ = error
    return failure


def _attribute_failure(error: AttributeError) -> Failure:
    owner, name = getattr(error, "obj", None), getattr(error, "name", None)
    if isinstance(owner, Cell):
        if name == "value":
            return unbound_variable(owner.symbol)  # type: ignore[arg-type]
        return undefined_function(lisp_list(SETF, owner.symbol) if name == "setf_function" else owner.symbol)
    if name in _EXPECTED and _raised_here(error):
        return type_error(owner, _EXPECTED[name])
    return python_failure(error)


def _type_failure(error: TypeError) -> Failure:
    message = str(error)
    if any(words in message for words in _OPERATORS):
        return type_error(_operand(message), "NUMBER")
    if "object is not callable" in message:
        return type_error(None if "NoneType" in message else String(message.split("'")[1]), "FUNCTION")
    called, mark, rest = message.partition("() ")
    if mark and rest.startswith(("takes", "missing", "got")) and _raised_here(error):
        name, compiled, _ = called.partition("\0")
        called = (name if compiled else name.rpartition(".")[2]).upper()
        return Failure(WRONG_NUMBER_OF_ARGUMENTS, _named(called), _counts(rest))
    return python_failure(error)


def _named(name: str) -> Value:
    """The symbol that NAME means where the interpreter at work is."""
    if running.session is None:
        return Symbol.intern(name, "ESL-USER")
    symbol, found = running.session.image.package.find(name)
    return symbol if found else Symbol.intern(name, "ESL-USER")


def _operand(message: str) -> Value:
    """The operand that is no number, as far as the message tells: NIL, or the name of its type."""
    kinds = [kind for kind in message.split("'")[1::2] if kind not in ("int", "float", "Ratio")]
    if "NoneType" in kinds or not kinds:
        return None
    return String(kinds[-1])


def _counts(words: str) -> str:
    """How many arguments were given and are taken, in our words."""
    return words.replace("positional ", "").split(":")[0]


def _raised_here(error: Exception) -> bool:
    """True if ERROR was raised by a line of compiled Lisp or of ours, not inside foreign code."""
    trace: TracebackType | None = error.__traceback__
    if trace is None:
        return True
    while trace.tb_next is not None:
        trace = trace.tb_next
    name = trace.tb_frame.f_globals.get("__name__", "")
    return "%many" in trace.tb_frame.f_globals or str(name).startswith("eslang.")
