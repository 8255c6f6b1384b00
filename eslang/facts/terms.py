"""Terms: Lisp values as the store holds them.

A fact is what it was when it was asserted, so the store keeps no string or
list that a program could still change, but a code of it: a Python value that
is hashed and compared as EQUAL compares (1 and 1.0 differ, strings are their
text). Symbols and integers are their own code. Codes become values again only
where a solution leaves the store.
"""

from __future__ import annotations

from types import FunctionType

from eslang.base.hashing import Identity
from eslang.base.hints import Any
from eslang.base.lists import Cons, check_finite
from eslang.base.symbols import Datum, Keyword, Symbol, Value
from eslang.base.text import String

Code = Any  # what stands for a value in the store
Row = tuple[Code, ...]  # the arguments of a fact

DIRECT = frozenset((int, Symbol, Keyword, type(None)))  # classes of values that are their own codes
LONG = 100_000  # tokens; a list so long is asked whether it contains itself


class _Mark:
    """A pair begins: its two parts follow."""

    def __repr__(self) -> str:
        return "PAIR"


PAIR = _Mark()


def code_of(value: Value) -> Code:
    """The code of VALUE; equal for values that are EQUAL, and for no others."""
    kind = value.__class__
    if kind in DIRECT:
        return value
    if kind is String:
        return value.text
    if kind is Cons:
        return _list_code(value)
    if kind is float:
        plain = value == value and (value != 0 or str(value)[0] != "-")
        return (value,) if plain else (float, str(value))
    if isinstance(value, Datum) or kind is FunctionType or kind.__name__ == "Ratio":
        return value
    return Identity(value)


def _list_code(value: Cons) -> Code:
    tokens: list[Code] = []
    whole, is_checked = value, False
    pending: list[Value] = [value]
    while pending:
        value = pending.pop()
        while value.__class__ is Cons:
            tokens.append(PAIR)
            if len(tokens) > LONG and not is_checked:
                check_finite(whole)
                is_checked = True
            if value.car.__class__ is Cons:
                pending.append(value.cdr)
                value = value.car
                continue
            tokens.append(code_of(value.car))
            value = value.cdr
        tokens.append(code_of(value))
    return tuple(tokens)


def value_of(code: Code) -> Value:
    """The value that CODE stands for; a string or list is made anew."""
    kind = code.__class__
    if kind in DIRECT:
        return code
    if kind is str:
        return String(code)
    if kind is tuple:
        if len(code) == 1:
            return code[0]
        return float(code[1]) if code[0] is float else _list_of(code)
    return code.value if kind is Identity else code


def _list_of(tokens: Row) -> Value:
    built: list[Value] = []
    for token in reversed(tokens):
        if token is PAIR:
            car = built.pop()
            built.append(Cons(car, built.pop()))
        else:
            built.append(value_of(token))
    return built.pop()


def fact_of(name: Symbol, row: Row) -> Cons:
    """The fact as a list."""
    rest = None
    for code in reversed(row):
        rest = Cons(code if code.__class__ in DIRECT else value_of(code), rest)
    return Cons(name, rest)
