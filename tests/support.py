"""What the suite is run with: a text on virtual time, and the files that are tests.

A conformance file says in comments what it must do: `; expect: LINE` for each
line that it prints (blank ones left out), `; expect failure: :CAUSE arguments`
for a failure that nothing answers, `; expect error: name` for a diagnostic.
An esl block of a page says it in the same way, each block in a new session.
A console block holds commands behind `$ ` and what they print.
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
from typing import Any, NamedTuple

import pytest

ROOT = Path(__file__).resolve().parents[1]
EXPECTATION = re.compile(r"^\s*; expect( failure| error)?: ?(.*)$", re.M)
FENCE = re.compile(r"^```(\w*)[^\n]*\n(.*?)^```", re.M | re.S)


class Outcome(NamedTuple):
    """What a program did: its printed lines, the failure nothing answered, the name of its mistake."""

    lines: list[str]
    failure: str | None = None
    error: str | None = None


def run(text: str, *, name: str = "<test>", seed: int = 0, listeners: Sequence[Any] = ()) -> Outcome:
    """Run TEXT form by form in a new interpreter on virtual time, up to its first trouble."""
    from eslang.base.diagnostics import EslError
    from eslang.base.failure import Failure
    from eslang.base.spans import Source
    from eslang.interpreter import Interpreter

    written, failure, error = StringIO(), None, None
    with Interpreter(seed=seed, clock="virtual", output=written, listeners=list(listeners)) as interp:
        try:
            for reading in interp.readings(Source(name, text)):
                interp.evaluate(reading)
        except Failure as unanswered:
            failure = failure_text(unanswered)
        except EslError as mistake:
            error = mistake.diagnostic.name
    lines = [line.strip() for line in written.getvalue().split("\n")]
    return Outcome([line for line in lines if line], failure, error)


def failure_text(failure: Any) -> str:
    """A failure as the expectations write it: cause and arguments."""
    from eslang.base.printer import prin1

    return " ".join(
        part if isinstance(part, str) else prin1(part) for part in (failure.cause, *failure.arguments)
    )


def expectations(text: str) -> Outcome:
    """What the comments of TEXT expect."""
    found = EXPECTATION.findall(text)
    last = {kind.strip(): said.strip() for kind, said in found if kind}
    return Outcome([said.strip() for kind, said in found if not kind], last.get("failure"), last.get("error"))


def check_program(text: str, name: str) -> None:
    """Fail unless TEXT does what its comments expect."""
    assert run(text, name=name) == expectations(text)


def check_transcript(text: str, name: str, first_line: int = 1) -> None:
    """Fail unless a replay of the transcript TEXT answers as it says."""
    from eslang.tools.transcript import read_transcript, replay

    entries = read_transcript(text, first_line)
    assert entries, f"{name} holds no prompt"
    found = replay(entries)
    assert found is None, found.text(name)


def check_console(text: str) -> None:
    """Fail unless the commands of a console block print what stands behind them."""
    for command, expected in console_commands(text):
        assert console_output(command) == expected, command


def console_commands(text: str) -> Iterator[tuple[str, list[str]]]:
    """The commands of a console block, each with the lines it must print."""
    for part in re.split(r"^\$ ", text, flags=re.M)[1:]:
        command, *lines = part.rstrip("\n").split("\n")
        yield command, [line.rstrip() for line in lines]


def console_output(command: str) -> list[str]:
    """What COMMAND prints, in the project's folder; `esl` is the one under test, `2>&1` is understood."""
    words = shlex.split(command.replace("2>&1", ""))
    if words[0] == "esl":
        words = [sys.executable, "-m", "eslang", *words[1:]]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONWARNINGS": "", "NO_COLOR": "1"}
    done = subprocess.run(
        words, cwd=ROOT, env=environment, text=True, stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60,
    )  # fmt: skip
    return [line.rstrip() for line in done.stdout.rstrip("\n").split("\n") if done.stdout.strip()]


class Block(pytest.Item):
    """One file, or one block of a page, as a test."""

    def __init__(self, *, check: Any, arguments: tuple[Any, ...], **given: Any) -> None:
        super().__init__(**given)
        self.check, self.arguments = check, arguments

    def runtest(self) -> None:
        """Check it."""
        self.check(*self.arguments)

    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        """An assertion needs no Python frames: the file says what was expected."""
        if excinfo.errisinstance(AssertionError):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, int | None, str]:
        """Where it is."""
        return self.path, None, self.name


class Program(pytest.File):
    """A .esl file that says in comments what it must do."""

    def collect(self) -> Iterable[pytest.Item]:
        """The file is one test."""
        text = self.path.read_text(encoding="utf-8")
        yield Block.from_parent(
            self, name=self.path.stem, check=check_program, arguments=(text, place(self.path))
        )


class Transcript(pytest.File):
    """A .transcript file."""

    def collect(self) -> Iterable[pytest.Item]:
        """The file is one test."""
        text = self.path.read_text(encoding="utf-8")
        yield Block.from_parent(
            self, name=self.path.stem, check=check_transcript, arguments=(text, place(self.path))
        )


class Page(pytest.File):
    """A Markdown page: each of its esl and console blocks, and all its prompts together, are tests."""

    def collect(self) -> Iterable[pytest.Item]:
        """One test a block; the blocks with prompts are one conversation."""
        text, prompts = self.path.read_text(encoding="utf-8"), []
        for fence in FENCE.finditer(text):
            kind, block = fence.groups()
            line = text.count("\n", 0, fence.start(2)) + 1
            if re.search(r"^\? ", block, re.M):
                prompts.append((line, block))
            elif kind == "console":
                yield Block.from_parent(self, name=f"line-{line}", check=check_console, arguments=(block,))
            elif kind == "esl":
                where = f"{place(self.path)}:{line}"
                yield Block.from_parent(
                    self, name=f"line-{line}", check=check_program, arguments=(block, where)
                )
        if prompts:
            yield Block.from_parent(
                self, name="prompts", check=check_transcript, arguments=(joined(prompts), place(self.path))
            )


def joined(blocks: list[tuple[int, str]]) -> str:
    """Blocks of a page as one text, each on the lines where it stands."""
    text = ""
    for line, block in blocks:
        text += "\n" * (line - 1 - text.count("\n")) + block
    return text


def place(path: Path) -> str:
    """PATH as messages show it."""
    return path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else str(path)


class Collector:
    """Makes tests of the project's plans, transcripts and pages."""

    def pytest_collect_file(self, file_path: Path, parent: pytest.Collector) -> pytest.File | None:
        """The kind of test that FILE_PATH is, if it is one."""
        where = place(file_path)
        if file_path.suffix == ".esl" and where.startswith(("tests/conformance/", "plans/")):
            return Program.from_parent(parent, path=file_path)
        if file_path.suffix == ".transcript":
            return Transcript.from_parent(parent, path=file_path)
        if file_path.suffix == ".md" and (where.startswith(("docs/", "plans/")) or where == "README.md"):
            return Page.from_parent(parent, path=file_path)
        return None
