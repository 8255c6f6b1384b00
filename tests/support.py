"""What the suite is run with: a text on virtual time, and the files that are tests.

What plans, transcripts and pages expect is written as for `esl test`, and read
by the same code (eslang/tools). Only the console blocks of a page are the
suite's own: commands behind `$ `, and what they print.
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from io import StringIO
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[1]
CONSOLE = re.compile(r"^```console\n(.*?)^```", re.M | re.S)


def run(
    text: str,
    *,
    name: str = "<test>",
    seed: int = 0,
    shuffle: bool = False,
    listeners: Sequence[Any] = (),
) -> Any:
    """Run TEXT form by form in a new interpreter on virtual time; what came of it (expectations.Came)."""
    from eslang.base.spans import Source
    from eslang.interpreter import Interpreter
    from eslang.tools.endings import to_the_end
    from eslang.tools.expectations import Came

    written, came = StringIO(), Came()
    heard = [came.hear, *listeners]
    interp = Interpreter(seed=seed, clock="virtual", output=written, shuffle=shuffle, listeners=heard)

    def evaluate_all() -> None:
        for reading in interp.readings(Source(name, text)):
            interp.evaluate(reading)

    with interp:
        came.of(lambda: to_the_end(interp, evaluate_all))
    came.output = written.getvalue()
    return came


def lines_of(text: str, **given: Any) -> list[str]:
    """The lines that TEXT prints, without the blank ones; any trouble is raised."""
    from eslang.tools.expectations import squeezed

    came = run(text, **given)
    if came.failure or came.error or came.stop:
        raise came.failure or came.error or came.stop
    return squeezed(came.output.split("\n"))


def check_trace(found: Sequence[str], expected: Sequence[str | set[str]]) -> None:
    """Fail unless FOUND is the whole of EXPECTED; the lines of a set may come in any order."""
    rest = list(found)
    for part in expected:
        size = len(part) if isinstance(part, set) else 1
        head, rest = rest[:size], rest[size:]
        assert set(head) == part if isinstance(part, set) else head == [part], (head, part)
    assert rest == []


def check_program(text: str, name: str) -> None:
    """Fail unless the plan TEXT does what its comments expect."""
    from eslang.tools.expectations import Expected, troubles

    found = troubles(Expected(text), run(text, name=name))
    assert not found, "\n".join([name, *found])


def check_transcript(text: str, name: str) -> None:
    """Fail unless a replay of the transcript TEXT answers as it says."""
    from eslang.tools.transcript import read_transcript, replay

    entries = read_transcript(text)
    assert entries, f"{name} holds no prompt"
    found = replay(entries)
    assert found is None, found.text(name)


def check_page(text: str, name: str) -> None:
    """Fail unless the plans and transcripts of a page do as it says."""
    from eslang.tools.markdown import page_troubles

    found = page_troubles(text, name)
    assert not found, "\n".join(found)


def check_console(text: str, name: str) -> None:
    """Fail unless each command of a console block prints what stands behind it."""
    for command, expected in console_commands(text):
        found = console_output(command)
        assert found == expected, f"{name}: `{command}` prints\n" + "\n".join(found)


def console_commands(text: str) -> Iterator[tuple[str, list[str]]]:
    """The commands of a console block, each with the lines it must print."""
    for part in re.split(r"^\$ ", text, flags=re.M)[1:]:
        command, *lines = part.rstrip("\n").split("\n")
        yield command, [line.rstrip() for line in lines]


def console_output(command: str) -> list[str]:
    """What COMMAND prints in the project's folder; `esl` is the one under test."""
    words = shlex.split(command)
    if words[0] == "esl":
        words = [sys.executable, "-m", "eslang", *words[1:]]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "NO_COLOR": "1"}
    environment.pop("PYTHONWARNINGS", None)
    done = subprocess.run(
        words,
        cwd=ROOT,
        env=environment,
        text=True,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=60,
    )
    text = done.stdout.rstrip("\n")
    return [line.rstrip() for line in text.split("\n")] if text else []


class Check(pytest.Item):
    """One file, or one block of a page, as a test."""

    def __init__(self, *, check: Any, text: str, **given: Any) -> None:
        super().__init__(**given)
        self.check, self.text = check, text

    def runtest(self) -> None:
        """Check it."""
        self.check(self.text, place(self.path))

    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        """An assertion needs no Python frames: it says what was expected."""
        if excinfo.errisinstance(AssertionError):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Where it is."""
        return self.path, None, self.name


class Program(pytest.File):
    """A plan that says in its comments what it must do."""

    check = staticmethod(check_program)

    def collect(self) -> Iterable[pytest.Item]:
        """The file is one test."""
        text = self.path.read_text(encoding="utf-8")
        yield Check.from_parent(self, name=self.path.stem, check=self.check, text=text)


class Transcript(Program):
    """A transcript."""

    check = staticmethod(check_transcript)


class Page(pytest.File):
    """A Markdown page: its plans and transcripts are one test, each console block another."""

    def collect(self) -> Iterable[pytest.Item]:
        """The tests of the page."""
        from eslang.tools.markdown import read_page

        text = self.path.read_text(encoding="utf-8")
        if read_page(text):
            yield Check.from_parent(self, name="blocks", check=check_page, text=text)
        for number, block in enumerate(CONSOLE.findall(text), start=1):
            yield Check.from_parent(self, name=f"console-{number}", check=check_console, text=block)


def place(path: Path) -> str:
    """PATH as messages show it."""
    return path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else str(path)


class Collector:
    """Makes tests of the project's plans, transcripts and pages."""

    def pytest_collect_file(self, file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
        """The kind of test that FILE_PATH is, if it is one."""
        where = place(file_path)
        if file_path.suffix == ".esl" and where.startswith(("tests/conformance/", "tests/lisp/", "plans/")):
            return Program.from_parent(parent, path=file_path)
        if file_path.suffix == ".transcript" and where.startswith(("tests/transcripts/", "plans/")):
            return Transcript.from_parent(parent, path=file_path)
        if file_path.suffix == ".md" and (where.startswith(("docs/", "plans/")) or where == "README.md"):
            return Page.from_parent(parent, path=file_path)
        return None


def run_python(code: str) -> str:
    """What a fresh Python prints for CODE."""
    return subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout.strip()
