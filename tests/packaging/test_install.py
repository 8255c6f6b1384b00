"""It works as people get it: from a wheel, and from an editable install."""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FIRST_PLAN = ROOT / "plans" / "esl" / "01-widget.esl"
WHERE = "import eslang; print(eslang.__file__)"
pytestmark = pytest.mark.slow


def run(*command: str | Path, folder: Path, path: Path | None = None) -> str:
    """What COMMAND prints when it is run in FOLDER, with PATH before all other places of Python modules."""
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    environment.update({"PYTHONPATH": str(path)} if path else {}, NO_COLOR="1")
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A wheel of the project."""
    pytest.importorskip("hatchling")
    folder = tmp_path_factory.mktemp("wheel")
    run(sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", folder, folder=ROOT)
    (built,) = folder.glob("*.whl")
    return built


def test_the_wheel_holds_the_library_and_the_grammar(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    library = {f"eslang/stdlib/{path.name}" for path in (ROOT / "stdlib").glob("*.esl")}
    assert library <= names
    assert {"eslang/reader/esl.lark", "eslang/py.typed"} <= names
    assert [name for name in names if name.startswith(("tests/", "docs/", "plans/"))] == []


def test_the_first_plan_runs_from_the_wheel(wheel: Path, tmp_path: Path) -> None:
    unpacked = tmp_path / "site"
    zipfile.ZipFile(wheel).extractall(unpacked)
    assert run(sys.executable, "-c", WHERE, folder=tmp_path, path=unpacked).startswith(str(unpacked))
    from_wheel = run(sys.executable, "-m", "eslang", "run", FIRST_PLAN, folder=tmp_path, path=unpacked)
    from_source = run(sys.executable, "-m", "eslang", "run", FIRST_PLAN, folder=tmp_path, path=ROOT)
    assert from_wheel == from_source
    assert "OPERATING WIDGET SUCCESSFULLY." in from_wheel


def test_the_first_plan_runs_from_the_editable_install(tmp_path: Path) -> None:
    command = Path(sysconfig.get_path("scripts")) / "esl"
    if not command.exists():
        pytest.skip("eslang is not installed in this Python")
    assert run(sys.executable, "-c", WHERE, folder=tmp_path).startswith(str(ROOT))
    assert "OPERATING WIDGET SUCCESSFULLY." in run(command, "run", FIRST_PLAN, folder=tmp_path)
