"""`--scenario`: what the world does to a plan that the command runs."""

from __future__ import annotations

from pathlib import Path

import pytest
from unit.tools.command import call

PLAN = """
(load-spacecraft)
(defun main ()
  (turn-device-on :camera)
  (wait-until (health-state :camera :single-event-upset))
  (print :upset))
"""


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    """A plan that waits for a fault."""
    path = tmp_path / "plan.esl"
    path.write_text(PLAN)
    return path


def test_what_a_scenario_says_happens_while_the_plan_runs(plan: Path) -> None:
    scenario = plan.with_suffix(".scenario")
    scenario.write_text("(at 3600 (break-device :camera :single-event-upset))")
    ended = call(["run", "--clock", "virtual", "--scenario", str(scenario), str(plan)])
    assert (ended.code, ended.out.strip(), ended.err) == (0, ":UPSET", "")


def test_without_it_the_plan_waits_in_vain(plan: Path) -> None:
    assert call(["run", "--clock", "virtual", str(plan)]).code == 1


def test_several_scenarios_happen_together(plan: Path) -> None:
    texts = ["(at 5 (break-device :camera :stuck))", "(at 6 (break-device :camera :single-event-upset))"]
    words = []
    for number, text in enumerate(texts):
        path = plan.with_name(f"{number}.scenario")
        path.write_text(text)
        words += ["--scenario", str(path)]
    assert call(["run", "--clock", "virtual", *words, str(plan)]).code == 0


@pytest.mark.parametrize("command", ["run", "repl"])
def test_a_wrong_scenario_is_reported_before_anything_runs(command: str, plan: Path) -> None:
    scenario = plan.with_name("wrong.scenario")
    scenario.write_text("\n(at 5 (break-device :camara :stuck))")
    ended = call([command, "--clock", "virtual", "--scenario", str(scenario), str(plan)], "(print 1)")
    assert (ended.code, ended.out) == (65, "")
    assert ended.err.startswith(f"{scenario}:2:21: error: there is no device `:camara`")
    assert "hint  write `:camera`" in ended.err


def test_at_the_prompt_the_world_goes_on(plan: Path) -> None:
    scenario = plan.with_suffix(".scenario")
    scenario.write_text("(at 7 (assert '(rain)))")
    words = ["repl", "--clock", "virtual", "--scenario", str(scenario)]
    assert "T\n" in call(words, "(wait-until (rain))\n").out
