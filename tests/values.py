"""Lisp values written in Python, for tests that call Lisp functions directly.

A list is a list, a tuple a vector, a str a string, True and False are T and
NIL, and a Python function is one that may answer in any of these. Keyword
arguments of `call` become Lisp's: `call("find", 2, [1, 2], from_end=True)`.
"""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FunctionType
from typing import Any

import pytest

from eslang.base.failure import Failure
from eslang.base.lists import Cons, from_items
from eslang.base.symbols import Keyword, Symbol, T
from eslang.base.text import CHARACTERS, Character, String, Vector
from eslang.compile.registry import DEFINITIONS

_LISP = Path(__file__).resolve().parents[1] / "eslang" / "lisp"


def _definitions() -> dict[str, Any]:
    for path in sorted(_LISP.glob("*.py")):
        importlib.import_module(f"eslang.lisp.{path.stem}")
    return {each.name: each for each in DEFINITIONS if each.kind == "function"}


DEFINED = _definitions()
_IMPLEMENTATIONS = {each.implementation for each in DEFINED.values()}


def symbol(name: str) -> Symbol:
    """The symbol NAME of COMMON-LISP."""
    return Symbol.intern(name.upper(), "COMMON-LISP")


def char(text: str) -> Character:
    """The character TEXT."""
    return CHARACTERS[text]


def fn(name: str) -> Any:
    """The function that Lisp calls NAME."""
    return DEFINED[name.upper()].implementation


def lisp(value: Any) -> Any:
    """The Lisp value that VALUE stands for."""
    if value is True or value is False:
        return T if value else None
    if isinstance(value, list):
        return from_items([lisp(each) for each in value])
    if isinstance(value, tuple):
        return Vector([lisp(each) for each in value])
    if isinstance(value, str):
        return String(value)
    if isinstance(value, FunctionType) and value not in _IMPLEMENTATIONS:
        return lambda *arguments: lisp(value(*arguments))
    return value


def python(value: Any) -> Any:
    """What stands for the Lisp value VALUE; NIL is None, a dotted list ends in ("." tail)."""
    if value.__class__ is Cons:
        elements = []
        while value.__class__ is Cons:
            elements.append(python(value.car))
            value = value.cdr
        return elements if value is None else [*elements, ".", python(value)]
    if value.__class__ is Vector:
        return tuple(python(each) for each in value.active())
    if value.__class__ is String:
        return value.text
    return True if value is T else value


def options(keywords: dict[str, Any]) -> list[Any]:
    """KEYWORDS as the end of a Lisp argument list."""
    flat: list[Any] = []
    for name, value in keywords.items():
        flat += [Keyword(name.replace("_", "-")), lisp(value)]
    return flat


def raw(name: str, *arguments: Any, **keywords: Any) -> Any:
    """What the Lisp function NAME returns."""
    return fn(name)(*[lisp(each) for each in arguments], *options(keywords))


def call(name: str, *arguments: Any, **keywords: Any) -> Any:
    """What the Lisp function NAME returns, as Python writes it."""
    return python(raw(name, *arguments, **keywords))


def many(name: str, *arguments: Any) -> list[Any]:
    """All the values of the Lisp function NAME."""
    return [python(each) for each in DEFINED[name.upper()].many(*[lisp(each) for each in arguments])]


@contextmanager
def fails(cause: str) -> Iterator[None]:
    """What is done here fails with CAUSE."""
    with pytest.raises(Failure) as caught:
        yield
    assert caught.value.cause is Keyword(cause)
