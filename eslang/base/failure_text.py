"""What a failure says of itself: a sentence for people, made of its cause and arguments.

failure.py says what the arguments of a host error are; here they become words.
The two change together.
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import Any, Callable
from eslang.base.lists import Cons, items
from eslang.base.printer import prin1, princ

Arguments = tuple[Any, ...]


def message_of(failure: Failure) -> str:
    """FAILURE as a sentence."""
    make = _MESSAGES.get(failure.cause.name)
    if make is None or not failure.values:
        return " ".join(["Failure", prin1(failure.cause), *map(prin1, failure.values)])
    return make(failure.values)


def _words(arguments: Arguments) -> str:
    """A message, and the values that belong to it."""
    return " ".join([princ(arguments[0]), *map(prin1, arguments[1:])])


def _type_error(arguments: Arguments) -> str:
    expected = prin1(arguments[1]) if len(arguments) > 1 else "of the right type"
    where = f" ({prin1(arguments[2])})" if len(arguments) > 2 and arguments[2] is not None else ""
    return f"The value {prin1(arguments[0])} is not of type {expected}{where}."


def _division_by_zero(arguments: Arguments) -> str:
    if len(arguments) == 1:
        return f"Division by zero, in {prin1(arguments[0])}."
    return f"Division by zero: ({' '.join(map(prin1, arguments))})."


def _unbound_variable(arguments: Arguments) -> str:
    return f"The variable {prin1(arguments[0])} is unbound."


def _undefined_function(arguments: Arguments) -> str:
    return f"The function {prin1(arguments[0])} is undefined."


def _wrong_number(arguments: Arguments) -> str:
    return " ".join(map(princ, arguments)) + "."


def _index_out_of_range(arguments: Arguments) -> str:
    if len(arguments) == 1:
        return _words(arguments)
    return f"The index {prin1(arguments[0])} is out of range for {prin1(arguments[1])}."


def _python_error(arguments: Arguments) -> str:
    return ": ".join(map(princ, arguments[:2]))


def _unbound_logic_variable(arguments: Arguments) -> str:
    return f"The logic variable {prin1(arguments[0])} has no value{_within(arguments)}."


def _unstratified_rules(arguments: Arguments) -> str:
    names = _names(arguments[0])
    return f"The relation {names[0]} would rest on its own absence: {', '.join(names)}."


def _unbounded_rules(arguments: Arguments) -> str:
    names = ", ".join(_names(arguments[0]))
    return f"The rules of {names} might make ever larger lists without end{_within(arguments)}."


def _names(value: Any) -> list[str]:
    return [prin1(name) for name in items(value)] if value.__class__ is Cons else [prin1(value)]


def _within(arguments: Arguments) -> str:
    return f" in {prin1(arguments[1])}" if len(arguments) > 1 else ""


_MESSAGES: dict[str, Callable[[Arguments], str]] = {
    "ERROR": _words,
    "CONTROL-ERROR": _words,
    "TYPE-ERROR": _type_error,
    "DIVISION-BY-ZERO": _division_by_zero,
    "UNBOUND-VARIABLE": _unbound_variable,
    "UNDEFINED-FUNCTION": _undefined_function,
    "WRONG-NUMBER-OF-ARGUMENTS": _wrong_number,
    "INDEX-OUT-OF-RANGE": _index_out_of_range,
    "PYTHON-ERROR": _python_error,
    "UNBOUND-LOGIC-VARIABLE": _unbound_logic_variable,
    "UNSTRATIFIED-RULES": _unstratified_rules,
    "UNBOUNDED-RULES": _unbounded_rules,
}
