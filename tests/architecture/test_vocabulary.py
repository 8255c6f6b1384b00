"""The papers' words win: what a thing is called here, and what it is never called."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from architecture.sources import MODULES, ROOT, Module, text_files

FORBIDDEN = {
    "cancel",
    "context",
    "data",
    "exception",
    "handler",
    "helper",
    "helpers",
    "info",
    "manager",
    "process",
    "thread",
    "util",
    "utils",
}
# Names that others gave: Common Lisp's, and Python's for its own things.
GIVEN = {"handler_case", "handler_bind", "handler-case", "handler-bind"}
NOTES = re.compile(r"\b(" + "|".join(("TO" + "DO", "FIX" + "ME", "X" + "XX")) + r")\b")
MACHINE_PATHS = re.compile(r"(?<![\w.$)}])/(work|root|home|Users)/\w")
LISP_DEFINITION = re.compile(r"^\(def(?:un|macro|var|parameter|struct|ine-failure)\s+\(?([^\s()]+)", re.M)


def words(name: str) -> set[str]:
    """The words that NAME is made of, in lower case."""
    return set(re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower().replace("-", "_").split("_"))


def coined_names(module: Module) -> Iterator[tuple[str, int]]:
    """The names that MODULE gives: its own, its classes', its functions', its constants'."""
    yield module.path.stem, 1
    for node in ast.walk(module.tree):
        named = isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef)
        if named and not node.name.startswith("__"):
            yield node.name, node.lineno
    for statement in module.tree.body:
        if isinstance(statement, ast.Assign):
            for target in statement.targets:
                if isinstance(target, ast.Name):
                    yield target.id, statement.lineno


def test_no_python_name_is_a_forbidden_word() -> None:
    wrong = [
        f"{module.place}:{line} {name}"
        for module in MODULES
        for name, line in coined_names(module)
        if words(name) & FORBIDDEN and not any(given in name.lower() for given in GIVEN)
    ]
    assert wrong == []


def test_no_name_in_the_library_is_a_forbidden_word() -> None:
    wrong = [
        f"{path.name}: {name}"
        for path in sorted((ROOT / "stdlib").glob("*.esl"))
        for name in LISP_DEFINITION.findall(path.read_text(encoding="utf-8"))
        if words(name) & FORBIDDEN and not any(given in name.lower() for given in GIVEN)
    ]
    assert wrong == []


def test_nothing_is_left_to_be_done_in_a_comment() -> None:
    wrong = [
        path.name for path in text_files() if NOTES.search(path.read_text(encoding="utf-8", errors="replace"))
    ]
    assert wrong == []


def test_no_file_knows_the_machine_it_was_written_on() -> None:
    wrong = [
        f"{path.name}: {match.group()}"
        for path in text_files()
        for match in MACHINE_PATHS.finditer(path.read_text(encoding="utf-8", errors="replace"))
    ]
    assert wrong == []
