"""The command as the tests of it call it: in this process, or as one of its own."""

from __future__ import annotations

import io
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).resolve().parents[3]
PYTHON = (sys.executable, "-W", "error", "-m", "eslang")


class Ended(NamedTuple):
    """How a command ended, and what it wrote."""

    code: int
    out: str
    err: str


def environment(**more: str) -> dict[str, str]:
    """The environment of a command under test."""
    return {**os.environ, "PYTHONPATH": str(ROOT), **more}


def start(*arguments: str, **given: Any) -> subprocess.Popen[Any]:
    """The command as a process of its own, with pipes of text."""
    pipe = subprocess.PIPE
    options = {"stdin": pipe, "stdout": pipe, "stderr": pipe, "text": True, **given}
    return subprocess.Popen([*PYTHON, *arguments], env=environment(), **options)


def run(*arguments: str, stdin: str = "", timeout: float = 30) -> Ended:
    """Run the command as a process of its own, to its end."""
    with start(*arguments) as running:
        out, err = running.communicate(stdin, timeout)
        return Ended(running.returncode, out, err)


def call(arguments: Sequence[str], stdin: str = "") -> Ended:
    """Run the command in this process."""
    from eslang.tools.cli import main

    saved = sys.stdin, sys.stdout, sys.stderr
    out, err = (io.TextIOWrapper(io.BytesIO(), encoding="utf-8") for _ in range(2))
    sys.stdin, sys.stdout, sys.stderr = io.StringIO(stdin), out, err
    try:
        code = main(list(arguments))
        out.flush()
        err.flush()
        return Ended(code, out.buffer.getvalue().decode(), err.buffer.getvalue().decode())  # type: ignore[attr-defined]
    finally:
        sys.stdin, sys.stdout, sys.stderr = saved
