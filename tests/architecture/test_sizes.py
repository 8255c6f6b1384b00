"""Sizes: a file is read in one sitting, a function at one glance."""

from __future__ import annotations

import ast
from collections.abc import Iterator

import pytest

from architecture.sources import MODULES, ROOT, TEST_MODULES

FILE_LIMIT = 400
FUNCTION_LIMIT = 40
NINE_IN_TEN = 30
EXCEPTIONS: set[str] = set()  # an entry needs a decision record


def extent(node: ast.stmt) -> int:
    """The lines that NODE takes."""
    return (node.end_lineno or node.lineno) - node.lineno + 1


def length(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """The lines of FUNCTION without docstrings: documentation is not to be saved on."""
    inside = [node for node in ast.walk(function) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
    return extent(function) - sum(extent(node.body[0]) for node in inside if ast.get_docstring(node))


def functions() -> Iterator[tuple[int, str]]:
    """Every function of the project: its length, and where it is."""
    for module in (*MODULES, *TEST_MODULES):
        for node in ast.walk(module.tree):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                yield length(node), f"{module.place}:{node.lineno} {node.name}"


@pytest.mark.parametrize("folder", ["eslang", "stdlib", "tests"])
def test_no_file_is_too_long(folder: str) -> None:
    sizes = {
        path.relative_to(ROOT).as_posix(): path.read_bytes().count(b"\n")
        for kind in ("*.py", "*.esl", "*.lark")
        for path in (ROOT / folder).rglob(kind)
    }
    assert {name: size for name, size in sizes.items() if size > FILE_LIMIT} == {}


def test_no_function_is_too_long() -> None:
    long = [f"{place}: {size} lines" for size, place in functions() if size > FUNCTION_LIMIT]
    assert [line for line in long if line.split()[0] not in EXCEPTIONS] == []


def test_nine_functions_in_ten_are_short() -> None:
    sizes = sorted(size for size, _ in functions())
    assert sizes[int(len(sizes) * 0.9)] <= NINE_IN_TEN
