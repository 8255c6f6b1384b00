"""What compiled code calls.

These functions stand in the global names of every unit, under names no
program can write. What belongs to the running task (bindings, failures,
ticks) comes from the runtime and is added by the interpreter.
"""

from __future__ import annotations

from types import FunctionType

from eslang.base.calls import spread
from eslang.base.control import Exit, Go, ReturnFrom
from eslang.base.failure import control_error, simple_error
from eslang.base.hints import Any, Callable
from eslang.base.lists import Cons, from_items
from eslang.base.many import Values, many_of, primary, values_list
from eslang.base.running import to_function
from eslang.base.sameness import is_eq, is_eql
from eslang.base.symbols import Keyword, Symbol, T, Value
from eslang.base.text import CHARACTERS, Character, String, Vector


class Unsupplied:
    """The default of an optional parameter that was not given."""

    __slots__ = ()

    def __repr__(self) -> str:
        return "#<UNSUPPLIED>"


UNSUPPLIED = Unsupplied()
ALLOW = Keyword("ALLOW-OTHER-KEYS")


class Box:
    """A variable that closures share and that changes."""

    __slots__ = ("value",)

    def __init__(self, value: Value) -> None:
        self.value = value


def receive(result: Value, count: int) -> tuple[Value, ...]:
    """COUNT values out of what a many-variant returned."""
    if result.__class__ is Values:
        return tuple(result[:count]) + (None,) * (count - len(result))
    return (result,) + (None,) * (count - 1)


def here() -> None:
    """Do nothing; only, Python looks for the end of the stack where this is called."""


def call_with_values(function: Value, *results: Value) -> Value:
    """MULTIPLE-VALUE-CALL, for one value."""
    return spread(to_function(function), [value for result in results for value in values_list(result)])


def call_with_values_many(function: Value, *results: Value) -> Value:
    """MULTIPLE-VALUE-CALL, for all values."""
    return spread(
        many_of(to_function(function)), [value for result in results for value in values_list(result)]
    )


def return_from(token: Exit, value: Value) -> None:
    """Jump out of a closure to the block that TOKEN belongs to."""
    if not token.live:
        raise control_error("this RETURN-FROM names a block that has been left")
    raise ReturnFrom(token, value)


def go(token: Exit, segment: int) -> None:
    """Jump out of a closure to a tag of the tagbody that TOKEN belongs to."""
    if not token.live:
        raise control_error("this GO names a TAGBODY that has been left")
    raise Go(token, segment)


def take_keys(rest: tuple[Value, ...], known: tuple[Symbol, ...], allow: bool) -> list[Value]:
    """The values of the KNOWN keywords in REST, in order; UNSUPPLIED where there is none."""
    taken: list[Value] = [UNSUPPLIED] * len(known)
    if not rest:
        return taken
    if len(rest) % 2:
        raise simple_error("keyword arguments come in pairs; the last has no value", rest[-1])
    unknown: list[Value] = []
    for index in range(len(rest) - 2, -1, -2):
        try:
            taken[known.index(rest[index])] = rest[index + 1]
        except ValueError:
            unknown.append(rest[index])
    if unknown and not allow:
        for index in range(0, len(rest), 2):
            if rest[index] is ALLOW:
                allow = rest[index + 1] is not None
                break
        unknown = [keyword for keyword in unknown if keyword is not ALLOW]
        if unknown and not allow:
            raise simple_error("this function has no such keyword argument:", unknown[-1])
    return taken


# --- destructuring: Lisp functions, called by expansions -----------------------------


def destructure_need(tail: Value, what: Value) -> Value:
    """TAIL, which must have an element left."""
    if tail.__class__ is not Cons:
        raise simple_error("too few elements to destructure, expected", what)
    return tail


def destructure_end(tail: Value, what: Value) -> Value:
    """NIL; TAIL must be at its end."""
    if tail is not None:
        raise simple_error("too many elements to destructure, expected", what)
    return None


def destructure_key(tail: Value, keyword: Symbol) -> Value:
    """The part of the property list TAIL that begins with KEYWORD's value."""
    while tail is not None:
        if tail.car is keyword:
            return tail.cdr
        tail = tail.cdr.cdr
    return None


def destructure_check_keys(tail: Value, known: Value, allow: Value, what: Value) -> Value:
    """NIL; TAIL must be a property list of KNOWN keywords."""
    keywords = []
    allowed = allow is not None
    while tail is not None:
        if tail.__class__ is not Cons or tail.cdr.__class__ is not Cons:
            raise simple_error("keyword arguments come in pairs, expected", what)
        keywords.append(tail.car)
        allowed = allowed or (tail.car is ALLOW and tail.cdr.car is not None)
        tail = tail.cdr.cdr
    if not allowed:
        wanted = list(known) if known is not None else []
        for keyword in keywords:
            if keyword is not ALLOW and not any(keyword is k for k in wanted):
                raise simple_error("no such keyword argument:", keyword)
    return None


SUPPORT: dict[str, Any] = {
    "Cons": Cons,
    "String": String,
    "Character": Character,
    "Vector": Vector,
    "int": int,
    "float": float,
    "abs": abs,
    "chr": chr,
    "len": len,
    "ord": ord,
    "%Characters": CHARACTERS,
    "Exception": Exception,
    "%T": T,
    "%Box": Box,
    "%Function": FunctionType,
    "%Values": Values,
    "%Unsupplied": UNSUPPLIED,
    "%Exit": Exit,
    "%ReturnFrom": ReturnFrom,
    "%Go": Go,
    "%here": here,
    "%eq": is_eq,
    "%eql": is_eql,
    "%primary": primary,
    "%receive": receive,
    "%many-of": many_of,
    "%to-function": to_function,
    "%call-with-values": call_with_values,
    "%call-with-values-many": call_with_values_many,
    "%return-from": return_from,
    "%go": go,
    "%take-keys": take_keys,
    "%list-of": from_items,
}

LISP_SUPPORT: dict[str, Callable[..., Value]] = {
    "%DESTRUCTURE-NEED": destructure_need,
    "%DESTRUCTURE-END": destructure_end,
    "%DESTRUCTURE-KEY": destructure_key,
    "%DESTRUCTURE-CHECK-KEYS": destructure_check_keys,
}
