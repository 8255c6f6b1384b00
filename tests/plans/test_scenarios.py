"""The plans of plans/ in worlds where something breaks: what they print then, to the letter.

A scenario is called after its plan, with some words more, and so is the file
beside it that says what the plan must print. Faults that chance draws are
those of seed 0.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from eslang.tools.cli import main

ROOT = Path(__file__).resolve().parents[2]
SCENARIOS = sorted((ROOT / "plans").glob("*/*.scenario"))
PLANS = sorted((ROOT / "plans").glob("*/[0-9]*.esl"))
every_scenario = pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda path: path.stem)


def plan_of(scenario: Path) -> Path:
    """The plan that SCENARIO is about."""
    plans = [plan for plan in PLANS if scenario.stem.startswith(f"{plan.stem}-")]
    assert plans, f"{scenario.name} is not called after a plan"
    return max(plans, key=lambda plan: len(plan.stem))


@every_scenario
@pytest.mark.parametrize("order", [[], ["--shuffle"]], ids=["in-turn", "shuffled"])
def test_a_plan_comes_through_what_the_world_does(
    scenario: Path, order: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    plan = str(plan_of(scenario))
    code = main(["run", "--clock", "virtual", *order, "--scenario", str(scenario), plan])
    printed = capsys.readouterr()
    assert printed.out == scenario.with_suffix(".expected").read_text(encoding="utf-8")
    assert (code, printed.err) == (0, "")
