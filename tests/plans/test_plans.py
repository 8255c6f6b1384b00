"""The plans of plans/, run as a user runs them: what they print, to the letter, and how they end.

What a plan must print stands beside it, in a file of the same name that ends
in `.expected`. A plan whose meaning the papers fix prints the same under every
seed. A plan without such a file acts in a world that others wrote, and has
tests of its own (`tests/unit/devices/test_gym.py`).
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from eslang.tools.cli import main

ROOT = Path(__file__).resolve().parents[2]
PLANS = sorted((ROOT / "plans").glob("*/[0-9]*.esl"))
TRANSCRIPTS = ("widget-physics.transcript", "recovery-demo.transcript")
WHOLE = [plan for plan in PLANS if plan.stem != "08-lunar-lander"]  # those of our own worlds
every_plan = pytest.mark.parametrize("plan", PLANS, ids=lambda plan: plan.stem)
every_whole_plan = pytest.mark.parametrize("plan", WHOLE, ids=lambda plan: plan.stem)


def expected(plan: Path) -> str:
    """What PLAN must print."""
    return plan.with_suffix(".expected").read_text(encoding="utf-8")


@every_whole_plan
@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (1, 1996))])
@pytest.mark.parametrize("order", [[], ["--shuffle"]], ids=["in-turn", "shuffled"])
def test_a_plan_prints_what_stands_beside_it(
    plan: Path, seed: int, order: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    code = main(["run", "--clock", "virtual", "--seed", str(seed), *order, str(plan)])
    printed = capsys.readouterr()
    assert printed.out == expected(plan)
    assert (code, printed.err) == (0, "")


@pytest.mark.slow
@every_whole_plan
def test_a_plan_prints_the_same_from_the_command(plan: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "eslang", "run", "--clock", "virtual", plan.relative_to(ROOT).as_posix()],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONWARNINGS": "error"},
        capture_output=True,
        text=True,
        encoding="utf-8",
        timeout=60,
    )
    assert (done.stdout, done.stderr, done.returncode) == (expected(plan), "", 0)


@every_plan
def test_the_analyser_has_nothing_to_say_of_a_plan(plan: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code = main(["check", str(plan)])
    printed = capsys.readouterr()
    assert (printed.out, printed.err, code) == ("", "", 0)


def test_the_widget_plan_prints_the_papers_traces() -> None:
    """The same as tests/transcripts, without their remarks and the definition that they show."""
    printed = "".join(
        line
        for name in TRANSCRIPTS
        for line in (ROOT / "tests" / "transcripts" / name)
        .read_text(encoding="utf-8")
        .splitlines(keepends=True)
        if not line.startswith(";")
    )
    definition = re.compile(r"^\? \(defun .*?^RECOVERY-DEMO-1\n", re.M | re.S)
    assert definition.sub("", printed) == expected(ROOT / "plans" / "esl" / "01-widget.esl")


def test_every_plan_stands_in_the_table() -> None:
    table = (ROOT / "plans" / "README.md").read_text(encoding="utf-8")
    names = [plan.relative_to(ROOT / "plans").as_posix() for plan in PLANS]
    assert re.findall(r"^\| \[[^]]*\]\(([^)]*)\)", table, flags=re.M) == names
