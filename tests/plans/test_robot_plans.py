"""The plans for the robot (plans/scs), under twenty seeds: wheels and sensors err, chance chooses.

Whatever they draw, each plan reaches its end, and prints the same.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from eslang.tools.cli import main

ROOT = Path(__file__).resolve().parents[2]
HALLWAY = ROOT / "plans" / "scs" / "05-hallway-robot.esl"
SCENARIOS = sorted(HALLWAY.parent.glob("05-hallway-robot-*.scenario"))
PLANS = sorted((ROOT / "plans" / "scs").glob("0[1-7]-*.esl"))


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("plan", PLANS, ids=lambda plan: plan.stem)
def test_a_plan_for_the_robot_reaches_its_end(
    plan: Path, seed: int, capsys: pytest.CaptureFixture[str]
) -> None:
    order = ["--shuffle"] if seed % 2 else []
    code = main(["run", "--clock", "virtual", "--seed", str(seed), *order, str(plan)])
    printed = capsys.readouterr()
    assert printed.out == plan.with_suffix(".expected").read_text(encoding="utf-8")
    assert (code, printed.err) == (0, "")


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("scenario", SCENARIOS, ids=lambda scenario: scenario.stem)
def test_the_robot_comes_through_a_rough_day(
    scenario: Path, seed: int, capsys: pytest.CaptureFixture[str]
) -> None:
    code = main(["run", "--clock", "virtual", "--seed", str(seed), "--scenario", str(scenario), str(HALLWAY)])
    printed = capsys.readouterr()
    assert printed.out == scenario.with_suffix(".expected").read_text(encoding="utf-8")
    assert (code, printed.err) == (0, "")
