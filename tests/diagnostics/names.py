"""Which diagnostics there are: the names that the source gives to those that make one.

A Diagnostic's name is its first argument. Where that is a parameter of the
function around it, callers of that function give the name, and so on outward.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator
from functools import cache
from typing import NamedTuple

from architecture.sources import MODULES

NAME = re.compile(r"[a-z]+(?:-[a-z]+)+")


class Maker(NamedTuple):
    """A function that makes a diagnostic: which argument tells the name, and what stands around it."""

    function: str
    position: int
    template: str = "{}"


FIRST_MAKERS = {Maker("Diagnostic", 0), Maker("Unreadable", 0), Maker("Example", 1)}


def called(call: ast.Call) -> str:
    """The last part of the name of what CALL calls."""
    return call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")


def parameters(function: ast.FunctionDef) -> list[str]:
    """The names of FUNCTION's parameters, as a caller counts them."""
    names = [argument.arg for argument in function.args.args]
    return names[1:] if names[:1] in (["self"], ["cls"]) else names


def named(call: ast.Call, makers: Iterable[Maker]) -> Iterator[tuple[ast.expr, str]]:
    """The arguments of CALL that tell the name of a diagnostic, each with what stands around it."""
    for maker in makers:
        if called(call) == maker.function:
            given = call.args[maker.position : maker.position + 1]
            given += [keyword.value for keyword in call.keywords if keyword.arg == "name"]
            for name in given:
                yield _unwrapped(name, maker.template)


def _unwrapped(name: ast.expr, template: str) -> tuple[ast.expr, str]:
    """The variable part of an f-string with a single one, and the template with the rest."""
    if isinstance(name, ast.JoinedStr):
        parts = [part for part in name.values if isinstance(part, ast.FormattedValue)]
        around = ["{}" if part in parts else getattr(part, "value", "") for part in name.values]
        return (parts[0].value if parts else name), template.format("".join(around))
    return name, template


@cache
def makers_in_the_source() -> frozenset[Maker]:
    """All that make a diagnostic."""
    functions = [
        node for module in MODULES for node in ast.walk(module.tree) if isinstance(node, ast.FunctionDef)
    ]
    makers, before = set(FIRST_MAKERS), set[Maker]()
    while makers != before:
        before = set(makers)
        for function in functions:
            given = parameters(function)
            for call in ast.walk(function):
                for name, template in named(call, before) if isinstance(call, ast.Call) else ():
                    if isinstance(name, ast.Name) and name.id in given:
                        makers.add(Maker(function.name, given.index(name.id), template))
    return frozenset(makers)


@cache
def names_in_the_source() -> frozenset[str]:
    """The name of every diagnostic."""
    makers = makers_in_the_source()
    return frozenset(
        template.format(part.value)
        for module in MODULES
        for call in ast.walk(module.tree)
        if isinstance(call, ast.Call)
        for name, template in named(call, makers)
        for part in ast.walk(name)
        if isinstance(part, ast.Constant)
        and isinstance(part.value, str)
        and NAME.fullmatch(template.format(part.value))
    )
