"""Hash tables as values, and the keys under which they hold things.

Two values that are the same under EQL, EQUAL or EQUALP have the same Python
key under that test; keys are flat, so neither their making nor their hashing
goes deep into the C stack. Python's own order of hashing never shows: a table
is walked in the order of insertion.
"""

from __future__ import annotations

from types import FunctionType

from eslang.base.hints import Any, Callable
from eslang.base.lists import Cons
from eslang.base.symbols import Datum, Keyword, Symbol, Value
from eslang.base.text import CHARACTERS, Array, Character, String, Vector

PLAIN = frozenset((int, Symbol, Keyword, type(None)))  # their own key, whatever the test

Parts = Callable[[Any], "list[Value]"]
STRUCTURED: dict[type, Parts] = {}  # class -> what of its instances EQUALP compares, the type first
_PAIR, _ARRAY, _TABLE, _PARTS = ("pair",), ("array",), ("table",), ("parts",)


class Identity:
    """The key of an object that is none of Lisp's: it is the same as itself only."""

    __slots__ = ("value",)

    def __init__(self, value: Value) -> None:
        self.value = value

    def __hash__(self) -> int:
        return id(self.value)

    def __eq__(self, other: object) -> bool:
        return other.__class__ is Identity and other.value is self.value


def eql_key(value: Value) -> Any:
    """The key of VALUE under EQL (and EQ)."""
    kind = value.__class__
    if kind is float:
        return (float, value.hex())
    if kind in PLAIN or kind is FunctionType or isinstance(value, Datum) or kind.__name__ == "Ratio":
        return value
    return Identity(value)


def equal_key(value: Value) -> Any:
    """The key of VALUE under EQUAL: strings by content, conses by structure."""
    if value.__class__ is String:
        return value.text
    return _flat_key(value, _equal_atom) if value.__class__ is Cons else eql_key(value)


def equalp_key(value: Value) -> Any:
    """The key of VALUE under EQUALP: case and the types of numbers make no difference."""
    return value if value.__class__ in PLAIN else _flat_key(value, _equalp_atom)


def _flat_key(value: Value, take: Callable[[Value, list[Any], list[Value]], None]) -> Any:
    tokens: list[Any] = []
    pending = [value]
    while pending:
        value = pending.pop()
        while value.__class__ is Cons and value.car.__class__ in PLAIN:
            tokens.append(_PAIR)
            tokens.append(value.car)
            value = value.cdr
        if value.__class__ is Cons:
            tokens.append(_PAIR)
            pending.append(value.cdr)
            pending.append(value.car)
        elif value.__class__ in PLAIN:
            tokens.append(value)
        else:
            take(value, tokens, pending)
    return tuple(tokens) if len(tokens) > 1 else tokens[0]


def _equal_atom(value: Value, tokens: list[Any], _pending: list[Value]) -> None:
    tokens.append(value.text if value.__class__ is String else eql_key(value))


def _equalp_atom(value: Value, tokens: list[Any], pending: list[Value]) -> None:
    kind = value.__class__
    if kind is Character:
        tokens.append(CHARACTERS[_folded(value.char)])
    elif kind is float:
        tokens.append(value if value == value else eql_key(value))
    elif kind is String:
        tokens.extend((_ARRAY, len(value.text), *[CHARACTERS[_folded(char)] for char in value.text]))
    elif kind is Vector:
        elements = value.active()
        tokens.extend((_ARRAY, len(elements)))
        pending.extend(reversed(elements))
    elif kind is Array:
        tokens.extend((_ARRAY, value.dimensions))
        pending.extend(reversed(value.items))
    elif kind is HashTable:
        entries = frozenset((key, equalp_key(held)) for key, held in value.entries.items())
        tokens.append((_TABLE, value.test, entries))
    elif kind in STRUCTURED:
        tokens.append(_PARTS)
        pending.extend(reversed(STRUCTURED[kind](value)))
    else:
        tokens.append(eql_key(value))


def _folded(char: str) -> str:
    upper = char.upper()
    return upper if len(upper) == 1 else char


KEY_OF: dict[str, Callable[[Value], Any]] = {
    "EQ": eql_key,
    "EQL": eql_key,
    "EQUAL": equal_key,
    "EQUALP": equalp_key,
}


class HashTable(Datum):
    """A hash table. `entries` maps keys to values; `originals` a key to the object it stands for."""

    __slots__ = ("entries", "key_of", "originals", "test")

    def __init__(self, test: str = "EQL") -> None:
        self.test = test
        self.key_of = KEY_OF[test]
        self.entries: dict[Any, Value] = {}
        self.originals: dict[Any, Value] = {}

    def print_lisp(self, settings: Any) -> str:
        """How the printer shows a table."""
        return f"#<HASH-TABLE :TEST {self.test} :COUNT {len(self.entries)}>"

    def get(self, key: Value, default: Value = None) -> Value:
        """What is held under KEY, or DEFAULT."""
        return self.entries.get(key if key.__class__ in PLAIN else self.key_of(key), default)

    def put(self, key: Value, value: Value) -> None:
        """Hold VALUE under KEY."""
        if key.__class__ in PLAIN:
            self.entries[key] = value
            return
        place = self.key_of(key)
        if place is not key and place not in self.entries:
            self.originals[place] = key
        self.entries[place] = value

    def has(self, key: Value) -> bool:
        """Whether something is held under KEY."""
        return self.key_of(key) in self.entries

    def remove(self, key: Value) -> bool:
        """Hold nothing under KEY any more; whether something was."""
        place = self.key_of(key)
        if place not in self.entries:
            return False
        del self.entries[place]
        self.originals.pop(place, None)
        return True

    def clear(self) -> None:
        """Hold nothing any more."""
        self.entries.clear()
        self.originals.clear()

    def keys(self) -> list[Value]:
        """The objects that something is held under, in the order of insertion."""
        originals = self.originals
        return [originals.get(key, key) for key in self.entries] if originals else list(self.entries)

    def pairs(self) -> list[tuple[Value, Value]]:
        """The objects and what is held under each, in the order of insertion."""
        return list(zip(self.keys(), self.entries.values(), strict=True))
