"""COERCE: a value as one of another type."""

from __future__ import annotations

from eslang.base.failure import type_error
from eslang.base.hints import Callable
from eslang.base.lists import Cons
from eslang.base.number_kinds import is_number
from eslang.base.running import running, to_function
from eslang.base.symbols import Symbol, Value
from eslang.base.text import Character, String, character
from eslang.compile.registry import function
from eslang.lisp.sequences import build, elements
from eslang.lisp.types import expand_type, is_of_type


def _as_float(value: Value) -> Value:
    if not is_number(value):
        raise type_error(value, "REAL", "COERCE")
    return float(value)


def _as_character(value: Value) -> Character:
    text = value.text if value.__class__ is String else value.name if isinstance(value, Symbol) else ""
    if len(text) != 1:
        raise type_error(value, "CHARACTER", "COERCE")
    return character(text)


def _as_function(value: Value) -> Value:
    if value.__class__ is Cons:
        return running.session.evaluate_form(value)
    return to_function(value)


_MAKERS: dict[str, Callable[[Value], Value]] = {
    "CHARACTER": _as_character,
    "FUNCTION": _as_function,
    "COMPLEX": lambda value: value,
}


@function("(coerce object output-type)")
def coerce(value: Value, specifier: Value) -> Value:
    """Return OBJECT as one of the type OUTPUT-TYPE.

    Sequences become sequences of another kind, numbers floats, strings of one
    character that character, symbols and lambda expressions functions.
    Fails: :type-error, where that cannot be.
    """
    if is_of_type(value, specifier):
        return value
    expanded = expand_type(specifier)
    head = expanded.car if expanded.__class__ is Cons else expanded
    name = head.name if isinstance(head, Symbol) else ""
    if name.endswith("FLOAT") or (name == "REAL" and is_number(value)):
        return _as_float(value)
    if name in _MAKERS:
        return _MAKERS[name](value)
    if name in ("LIST", "VECTOR", "ARRAY") or name.startswith("SIMPLE-") or name.endswith("STRING"):
        return build(specifier, elements(value))
    raise type_error(value, name or "TYPE", "COERCE")
