"""Functions that the naive evaluator knows."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from eslang.base.lists import Cons, from_items, items
from eslang.base.symbols import Value, truth
from naive.evaluator import ERROR, FUNCTIONS, HIGHER, HostError, Naive


def number(value: Value) -> int:
    """VALUE, which must be a number."""
    if value.__class__ is not int:
        raise HostError("TYPE-ERROR")
    return value  # type: ignore[no-any-return]


def part(name: str) -> Callable[[Value], Value]:
    """CAR or CDR."""

    def take(value: Value) -> Value:
        if value is not None and value.__class__ is not Cons:
            raise HostError("TYPE-ERROR")
        return getattr(value, name, None)

    return take


FUNCTIONS.update(
    {
        "+": lambda *given: sum(map(number, given)),
        "-": lambda first, *rest: number(first) - sum(map(number, rest)) if rest else -number(first),
        "*": lambda left, right: number(left) * number(right),
        "1+": lambda value: number(value) + 1,
        "1-": lambda value: number(value) - 1,
        "<": lambda left, right: truth(number(left) < number(right)),
        ">": lambda left, right: truth(number(left) > number(right)),
        "=": lambda left, right: truth(number(left) == number(right)),
        "EQL": lambda left, right: truth(
            left is right or (left.__class__ is right.__class__ is int and left == right)
        ),
        "NOT": lambda value: truth(value is None),
        "CONS": Cons,
        "CAR": part("car"),
        "CDR": part("cdr"),
        "LIST": lambda *given: from_items(given),
        "REVERSE": lambda lst: from_items(items(lst)[::-1]),
        "LENGTH": lambda lst: len(items(lst)),
        "FUNCTIONP": lambda value: truth(callable(value)),
    }
)


def higher(name: str) -> Callable[[Any], Any]:
    """Let a Python function be the Lisp function NAME, which needs the evaluator or gives several values."""

    def register(function: Any) -> Any:
        HIGHER[name] = function
        return function

    return register


@higher("NOTE")
def note(naive: Naive, value: Value) -> list[Value]:
    naive.trace.append(value)
    return [value]


@higher("FUNCALL")
def funcall(naive: Naive, function: Value, *given: Value) -> list[Value]:
    return naive.apply(function, list(given))


@higher("APPLY")
def apply(naive: Naive, function: Value, *given: Value) -> list[Value]:
    return naive.apply(function, [*given[:-1], *items(given[-1])])


@higher("MAPCAR")
def mapcar(naive: Naive, function: Value, lst: Value) -> list[Value]:
    return [from_items([(naive.apply(function, [each]) or [None])[0] for each in items(lst)])]


@higher("FAIL")
def fail(naive: Naive, cause: Value, *given: Value) -> list[Value]:
    return [naive.signal(cause, list(given), continuable=True)]


@higher("ERROR")
def error(naive: Naive, message: Value) -> list[Value]:
    return [naive.signal(ERROR, [])]


@higher("VALUES-LIST")
def values_list(naive: Naive, lst: Value) -> list[Value]:
    return items(lst)
