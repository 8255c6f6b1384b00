"""Which diagnostics there are: the names that the source gives to those that make one.

A Diagnostic's name is its first argument. Where that is a parameter of the
function around it, callers of that function give the name, and so on outward.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache

from architecture.sources import MODULES

NAME = re.compile(r"[a-z]+(?:-[a-z]+)+")
FIRST_MAKERS = {("Diagnostic", 0), ("Unreadable", 0), ("Example", 1)}


def called(call: ast.Call) -> str:
    """The last part of the name of what CALL calls."""
    return call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")


def parameters(function: ast.FunctionDef) -> list[str]:
    """The names of FUNCTION's parameters, as a caller counts them."""
    names = [argument.arg for argument in function.args.args]
    return names[1:] if names[:1] in (["self"], ["cls"]) else names


def named(call: ast.Call, makers: set[tuple[str, int]]) -> Iterator[ast.expr]:
    """The arguments of CALL that name a diagnostic."""
    for maker, position in makers:
        if called(call) == maker:
            yield from call.args[position : position + 1]
            yield from (keyword.value for keyword in call.keywords if keyword.arg == "name")


@cache
def makers_in_the_source() -> frozenset[tuple[str, int]]:
    """What makes a diagnostic, and which of its arguments is the name."""
    functions = [
        node for module in MODULES for node in ast.walk(module.tree) if isinstance(node, ast.FunctionDef)
    ]
    makers, before = set(FIRST_MAKERS), set[tuple[str, int]]()
    while makers != before:
        before = set(makers)
        for function in functions:
            given = parameters(function)
            for call in ast.walk(function):
                if isinstance(call, ast.Call):
                    for name in named(call, before):
                        if isinstance(name, ast.Name) and name.id in given:
                            makers.add((function.name, given.index(name.id)))
    return frozenset(makers)


@cache
def names_in_the_source() -> frozenset[str]:
    """The name of every diagnostic."""
    makers = set(makers_in_the_source())
    return frozenset(
        part.value
        for module in MODULES
        for call in ast.walk(module.tree)
        if isinstance(call, ast.Call)
        for name in named(call, makers)
        for part in ast.walk(name)
        if isinstance(part, ast.Constant) and isinstance(part.value, str) and NAME.fullmatch(part.value)
    )
