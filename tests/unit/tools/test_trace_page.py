"""The page of a trace: whole in itself, and right in a browser where there is one."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from unit.tools.command import call
from unit.tools.traced import EVERY_KIND, RESCUE, traced, written

from eslang.tools.trace_page import ARROWS, FOLDER, STATES, page
from eslang.tools.trace_reading import read_lines

BROWSER = next(
    (path for name in ("chromium", "chromium-browser", "google-chrome") if (path := shutil.which(name))), None
)
EVIL = '(task-net (a (fail :evil "</script><script>alert(1)</script><b>&amp;</b>{{run}}")))'


def run_of(text: str) -> dict[str, Any]:
    """What the page of TEXT's run shows."""
    found = re.search(r'<script type="application/json" id="run">(.*?)</script>', page(traced(text)), re.S)
    assert found is not None
    shown: dict[str, Any] = json.loads(found[1])
    return shown


@pytest.mark.parametrize("text", [RESCUE, EVERY_KIND, EVIL, "1"])
def test_the_columns_fit_one_another(text: str) -> None:
    run = run_of(text)
    size, tasks = len(run["kind"]), len(run["tasks"])
    assert len(run["times"]) == size + 1
    assert run["times"] == sorted(run["times"])
    for name, limit in (("subject", tasks), ("text", len(run["strings"])), ("place", len(run["strings"]))):
        assert len(run[name]) == size
        assert all(-1 <= number < limit for number in run[name])
    assert all(0 <= number < len(run["kinds"]) for number in run["kind"])
    for task, state, first, last, cause in run["spans"]:
        assert (0 <= task < tasks, 0 <= state < len(STATES), -1 <= cause < size) == (True, True, True)
        assert 0 <= first < last <= size
    for kind, source, first, target, last in run["arrows"]:
        assert (0 <= kind < len(ARROWS), 0 <= source < tasks, 0 <= target < tasks) == (True, True, True)
        assert 0 <= first <= last < size
    for number, task in enumerate(run["tasks"]):
        assert -1 <= task["parent"] < number
        assert task["started"] <= task["ended"] <= size


def test_the_page_needs_nothing_else() -> None:
    text = page(traced(RESCUE))
    assert "{{" not in re.sub(r'<script type="application/json".*?</script>', "", text, flags=re.S)
    assert not re.search(r"https?://|\bsrc=|@import|url\(|<link|fetch\(|import\(", text)


def test_nothing_in_a_run_can_end_its_place_in_the_page() -> None:
    text = page(traced(EVIL))
    assert text.count("</script>") == 2
    assert "<b>" not in text.partition("<noscript>")[2]
    assert any("</script>" in string for string in run_of(EVIL)["strings"])


def test_the_script_knows_the_same_states_and_arrows() -> None:
    script = (FOLDER / "drawing.js").read_text(encoding="utf-8")
    for name, words in (("STATES", STATES), ("ARROWS", ARROWS)):
        found = re.search(rf"const {name} = (\[.*?\]);", script)
        assert found is not None
        assert tuple(json.loads(found[1])) == words


def test_the_colours_of_both_looks_have_the_same_names() -> None:
    style = (FOLDER / "page.css").read_text(encoding="utf-8")
    light, dark = (set(re.findall(r"--([\w-]+):", block)) for block in re.findall(r":root.*?\}", style, re.S))
    assert light == dark
    script = (FOLDER / "drawing.js").read_text(encoding="utf-8")
    named = re.search(r"for \(const name of \[(.*?)\]\)", script, re.S)
    assert named is not None
    assert set(json.loads(f"[{named[1]}]")) <= light


def test_the_command_writes_the_page_beside_the_trace(tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl"
    path.write_text(written(RESCUE))
    assert call(["trace", "--html", str(path)]) == (0, f"{tmp_path / 'run.html'}\n", "")
    assert (tmp_path / "run.html").read_text().startswith("<!doctype html>")
    assert call(["trace", "--html", "-o", "-", str(path)]).out == (tmp_path / "run.html").read_text()
    assert call(["trace", "--html", "-o", str(tmp_path / "no" / "x"), str(path)]).code == 2


def test_a_run_that_was_cut_says_so_on_its_page() -> None:
    cut = read_lines("run.jsonl", written(RESCUE).encode()[:-200])
    assert "the last line is cut" in page(cut)


def browse(text: str, tmp_path: Path, script: str = "") -> tuple[str, str]:
    """The page in a browser, after SCRIPT: its elements in the end, and what was complained of."""
    file = tmp_path / "run.html"
    file.write_text(page(traced(text)).replace("</body>", f"<script>{script}</script></body>"))
    assert BROWSER is not None
    options = ["--headless=new", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=3000"]
    options += [
        "--window-size=1200,700",
        "--enable-logging=stderr",
        "--dump-dom",
        f"--user-data-dir={tmp_path}",
    ]
    done = subprocess.run([BROWSER, *options, file.as_uri()], capture_output=True, text=True, timeout=60)
    return done.stdout, "\n".join(line for line in done.stderr.split("\n") if "CONSOLE" in line)


@pytest.mark.slow
@pytest.mark.skipif(BROWSER is None, reason="no browser is here")
class TestInBrowser:
    """The page at work."""

    @pytest.mark.parametrize("text", [RESCUE, EVERY_KIND, EVIL, "1"])
    def test_the_page_draws_itself_without_a_complaint(self, text: str, tmp_path: Path) -> None:
        elements, complaints = browse(text, tmp_path)
        assert 'data-ready="yes"' in elements
        assert complaints == ""

    def test_a_task_that_is_chosen_is_told_and_the_lanes_are_painted(self, tmp_path: Path) -> None:
        script = """
        const task = R.tasks.findIndex((each) => each.name === "camera");
        setScale("time"); zoom(0.5); choose({ task, event: R.tasks[task].ended });
        draw();
        const pen = lanes.getContext("2d"), all = pen.getImageData(0, 0, lanes.width, lanes.height).data;
        const colours = new Set();
        for (let i = 0; i < all.length; i += 4) colours.add(all.slice(i, i + 3).join());
        document.body.dataset.colours = colours.size > 20 ? "many" : "few";
        """
        elements, complaints = browse(RESCUE, tmp_path, script)
        assert complaints == ""
        assert 'data-colours="many"' in elements
        told = elements.partition('<aside id="more">')[2]
        assert "camera" in told
        assert "has failed: :DEADLINE-EXPIRED" in told
