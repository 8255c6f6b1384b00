"""The doors: output, time and chance each have one room, and starting is cheap."""

from __future__ import annotations

import ast
from pathlib import Path

from architecture.sources import MODULES, Module, imports_of
from support import run_python

# What only the named places may touch; the tools are where people and machine meet.
DOORS = {
    "time": {"eslang/runtime/clock.py"},
    "datetime": set(),
    "random": {"eslang/runtime/chance.py"},
    "secrets": {"eslang/runtime/chance.py"},
    "print": set(),
    "input": set(),
    "sys.stdout": {"eslang/lisp/streams.py"},
    "sys.stderr": {"eslang/lisp/streams.py"},
    "sys.stdin": {"eslang/lisp/streams.py"},
}
LATE = ("prompt_toolkit", "lark", "asyncio", "argparse", "inspect", "dataclasses", "logging", "fractions")
WEIGHTS = ("typing", "collections", "contextlib", "enum", "functools", "re", "signal", "weakref")


def touched(module: Module) -> list[tuple[str, int]]:
    """The doors that MODULE goes through, with the line."""
    found = [(name.split(".")[0], line) for name, _, line in imports_of(module)]
    for node in ast.walk(module.tree):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            found.append((node.func.id, node.lineno))
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "sys":
            found.append((f"sys.{node.attr}", node.lineno))
    return found


def test_nothing_prints_reads_the_clock_or_draws_a_number_outside_its_room() -> None:
    wrong = [
        f"{module.place}:{line} {door}"
        for module in MODULES
        if not module.name.startswith("eslang.tools")
        for door, line in touched(module)
        if door in DOORS and module.place not in DOORS[door]
    ]
    assert wrong == []


def test_nobody_imports_a_private_name_of_another_file() -> None:
    wrong = [
        f"{module.place}:{line} {name}.{taken}"
        for module in MODULES
        for name, taken, line in imports_of(module)
        if name.startswith("eslang") and taken and taken.startswith("_") and not taken.startswith("__")
    ]
    assert wrong == []


def test_importing_eslang_loads_nothing_slow() -> None:
    loaded = run_python("import sys, eslang; print(*sorted(sys.modules))").split()
    bare = run_python("import sys; print(*sorted(sys.modules))").split()
    assert [name for name in LATE if name in loaded and name not in bare] == []


def test_importing_eslang_takes_less_than_150_milliseconds() -> None:
    code = "import time; begun = time.process_time(); import eslang; print(time.process_time() - begun)"
    assert min(float(run_python(code)) for _ in range(5)) < 0.150


def test_a_start_carries_no_weight_that_it_does_not_need(tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text("(print :ready)")
    text = f"import sys; from eslang.tools.cli import main; main(['run', {str(plan)!r}]); print(*sys.modules)"
    run_python(text)  # whatever is not kept yet is compiled now
    loaded = run_python(text).split()
    bare = run_python("import sys; print(*sorted(sys.modules))").split()
    assert [name for name in WEIGHTS if name in loaded and name not in bare] == []


def test_below_the_tools_type_words_come_from_the_cheap_room() -> None:
    wrong = [
        f"{module.place}:{line} {name}"
        for module in MODULES
        if not module.name.startswith(("eslang.tools", "eslang.base.hints"))
        for name, _, line in imports_of(module)
        if name in ("typing", "collections.abc")
    ]
    assert wrong == []
