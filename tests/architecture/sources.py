"""What the architecture tests look at: the project's own files, parsed once."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
TEXT_FOLDERS = ("eslang", "stdlib", "plans", "tests", "docs", ".ci")
TEXT_FILES = ("README.md", "CHANGELOG.md", "Makefile", "pyproject.toml")


class Module(NamedTuple):
    """One Python file of the project."""

    name: str  # as it is imported: eslang.base.symbols
    path: Path
    tree: ast.Module

    @property
    def place(self) -> str:
        """Where it stands, for messages."""
        return self.path.relative_to(ROOT).as_posix()


def read_modules(folder: str) -> list[Module]:
    """Every Python file under FOLDER, a package's sign under the package's name."""
    found = []
    for path in sorted((ROOT / folder).rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        found.append(Module(name, path, ast.parse(path.read_text(encoding="utf-8"))))
    return found


MODULES = read_modules("eslang")
TEST_MODULES = read_modules("tests")


def imports_of(module: Module) -> Iterator[tuple[str, str | None, int]]:
    """Every import in MODULE, inside functions too: (module imported, name taken from it, line).

    What stands under `if TYPE_CHECKING:` is left out, since it never runs.
    """
    pending: list[ast.AST] = [module.tree]
    while pending:
        node = pending.pop()
        if isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING"):
            pending.extend(node.orelse)
            continue
        if isinstance(node, ast.Import):
            yield from ((alias.name, None, node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield from ((node.module, alias.name, node.lineno) for alias in node.names)
        pending.extend(ast.iter_child_nodes(node))


def text_files() -> Iterator[Path]:
    """Every file of the project that people read."""
    kinds = {".py", ".esl", ".lark", ".md", ".toml", ".transcript", ".scenario", ".expected", ".lisp"}
    for folder in TEXT_FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.is_file() and (path.suffix in kinds or folder == ".ci"):
                yield path
    yield from (ROOT / name for name in TEXT_FILES)
