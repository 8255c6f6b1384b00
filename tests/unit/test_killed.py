"""kill -9 at any moment: the file holds the state of some step, and the next run goes on from it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
KILLS = 200


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes are made by fork")
@pytest.mark.parametrize("seed", [1])
def test_a_run_that_is_killed_leaves_the_state_of_a_step(tmp_path: Path, seed: int) -> None:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), str(ROOT / "tests")])}
    command = [sys.executable, "-m", "killing", str(tmp_path), str(KILLS), str(seed)]
    ended = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=300)
    assert (ended.returncode, ended.stderr) == (0, "")
    lines = ended.stdout.split("\n")[:-1]
    last = next(place for place, line in enumerate(lines) if line.startswith("of "))
    anew, onward = lines[:last], lines[last + 1 :]
    assert len(anew) == KILLS // 2 + 1
    assert "none" not in anew, "a file holds what was true at no step's end"
    assert len(set(anew)) > 10, "all were killed at the same step"
    assert "broken" not in onward
    assert len(onward) > KILLS // 4
    assert onward == sorted(onward, key=int), "a step that was written is lost"
    assert int(onward[-1]) > int(onward[0])
