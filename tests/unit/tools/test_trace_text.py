"""A trace as text: the tree, the timeline, and what is left out of long ones."""

from __future__ import annotations

from pathlib import Path
from textwrap import dedent

import pytest
from unit.tools.command import call
from unit.tools.traced import EVERY_KIND, RESCUE, traced, written

from eslang.tools.trace_lives import Lives
from eslang.tools.trace_text import LANES, Choice, trace_text

NET = """
(with-recovery-procedures ((:no-power (abort :dark)))
  (task-net
    (left (sleep 2) (fail :no-power 3))
    (right (with-cleanup-procedure (sleep 1) (sleep 9)))))
"""
LONG = "(dotimes (i 300) (sleep 1)) (task-net (a (fail :oops))) (dotimes (i 300) (sleep 1))"
CROWD = """
(let ((tasks nil))
  (dotimes (n 40)
    (push (let ((m n)) (spawn (progn (sleep 1) (if (= m 20) (fail :odd m))) :name "one")) tasks))
  (dolist (task tasks) (wait-for-task task)))
"""


def lines(text: str, columns: int = 80, **chosen: object) -> list[str]:
    """The lines that tell the run of TEXT."""
    choice = Choice(chosen.pop("tasks", []), chosen.pop("kinds", []), **chosen)  # type: ignore[arg-type]
    return [line.rstrip() for line in trace_text(traced(text), choice, columns)]


def test_a_run_is_told_as_a_tree_and_a_timeline() -> None:
    assert "\n".join(lines(NET)) + "\n" == dedent("""\
        plan.esl: 3.000 s on the virtual clock, seed 0
        21 events, 3 tasks: 1 aborted, 1 failed, 1 succeeded

        Tasks
          main         0.000 –    3.000  ✓ succeeded
          ├ left       0.000 –    2.000  ✗ :NO-POWER 3
                                                                      at plan.esl:4:21
          └ right      0.000 –    3.000  ⊘ aborted by left: the net is decided

        Timeline
            0.000  ●    main   begins
                   │●   left   begins                                       plan.esl:3:3
                   ││●  right  begins                                       plan.esl:3:3
                   ○││  main   waits for the ends of left, right            plan.esl:3:3
                   ┊○│  left   sleeps 2 s                                  plan.esl:4:11
                   ┊┊○  right  sleeps 9 s                                  plan.esl:5:46
            2.000  ┊●┊  left   goes on
                   ┊!┊  left   fails: :NO-POWER 3, no recovery             plan.esl:4:21
                   ┊✗┊  left   has failed: :NO-POWER 3
                   ┊ ⊘  right  is aborted by left: the net is decided
                   ┊ ●  right  leaves its wait
                   ┊ •  right  cleans up                                   plan.esl:5:12
                   ┊ ○  right  sleeps 1 s                                  plan.esl:5:36
            3.000  ┊ ●  right  goes on
                   ┊ •  right  has cleaned up
                   ┊ ⊘  right  has ended, aborted
                   ●    main   goes on
                   !    main   fails as left did: :NO-POWER 3               plan.esl:3:3
                   ↻    main   recovers from :NO-POWER 3 (no retries)      plan.esl:2:28
                   •    main   gives up the form, with a value
                   ✓    main   has succeeded
        """)


@pytest.mark.parametrize("columns", [60, 80, 120])
@pytest.mark.parametrize("text", [RESCUE, EVERY_KIND, CROWD])
def test_lines_fit_the_terminal(text: str, columns: int) -> None:
    assert max(map(len, lines(text, columns))) <= columns


def test_of_a_long_run_the_middle_is_left_out_but_not_what_went_wrong() -> None:
    found = lines(LONG)
    assert len(found) < 200
    assert sum("events left out" in line for line in found) >= 2
    assert any("fails: :OOPS" in line for line in found)
    assert len(lines(LONG, everything=True)) > 1200


def test_of_many_siblings_some_are_shown_and_those_that_failed() -> None:
    found = lines(CROWD)
    tree = found[found.index("Tasks") : found.index("Timeline")]
    assert len(tree) < 20
    assert any(":ODD 20" in line for line in tree)
    assert any("… 33 more: 33 succeeded" in line for line in tree)


def test_one_task_can_be_followed() -> None:
    found = lines(RESCUE, tasks=["camera"])
    timeline = found[found.index("Timeline") + 1 :]
    assert any("watcher" in line and "aborted by camera" in line for line in timeline)
    assert not any("either" in line.split()[1:3] for line in timeline)
    tree = found[found.index("Tasks") + 1 : found.index("Timeline")]
    assert [line.split()[-5 if "at" in line else 1] for line in tree if "├" in line or "└" in line] == [
        "camera"
    ]


def test_kinds_and_moments_can_be_chosen() -> None:
    found = lines(RESCUE, kinds=["signal", "recovery"])
    assert [line.split("  ")[-1] for line in found[4:]] != []
    assert all("signals" in line or "recovers" in line or ":" in line for line in found[4:])
    found = lines(RESCUE, first=1.0, last=1.0)
    assert {line[:9].strip() for line in found[4:]} == {"1.000", ""}
    assert lines(RESCUE, kinds=["goal"])[-1] == "  (no such event)"


def test_more_tasks_than_lanes_are_told_without() -> None:
    found = lines(CROWD, everything=True)
    assert any("┊" * LANES in line for line in found)
    assert not any("┊" * (LANES + 1) in line for line in found)


def test_what_a_task_was_doing_when_the_run_was_killed() -> None:
    cut = "".join(written(NET).splitlines(keepends=True)[:7])
    from eslang.tools.trace_reading import read_lines

    found = list(trace_text(read_lines("run.jsonl", cut.encode()), Choice([], [])))
    assert "But the run had not ended: it was killed, or goes on." in found
    assert any("left" in line and "… sleeps 2 s" in line for line in found)


def test_names_that_the_trace_does_not_have_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl"
    path.write_text(written(NET))
    for option, told in {
        ("--task", "rigth"): "there is no task `rigth`; the nearest is `right`",
        ("--kind", "recover"): "there is no kind of event `recover`; the nearest is `recovery`",
        ("--from", "x"): "`--from` is a number of seconds, not `x`",
        ("-o", "x"): "`-o` is for `--html` and `--perfetto`",
    }.items():
        code, out, err = call(["trace", *option, str(path)])
        assert (code, out, err.split("\n")[0]) == (2, "", f"esl: {told}")
    assert call(["trace"]).code == call(["trace", str(path), str(path)]).code == 2
    assert call(["trace", "--html", "--perfetto", str(path)]).code == 2


def test_the_spans_of_a_task_follow_one_another() -> None:
    for life in Lives(traced(RESCUE)).lives.values():
        assert life.spans[0].first == life.started
        assert life.spans[-1].last == life.ended
        for one, next_one in zip(life.spans, life.spans[1:], strict=False):
            assert one.last == next_one.first


def test_the_arrows_of_a_run() -> None:
    found = {(arrow.kind, arrow.source, arrow.target) for arrow in Lives(traced(RESCUE)).arrows}
    assert found >= {
        ("start", "main.6", "camera"),
        ("signal", "camera", "watcher"),
        ("signal", "watcher", "arm"),
        ("interrupt", "battery", "guarded"),
        ("abort", "camera", "arm"),
        ("abort", "laser", "radio"),
        ("failure", "camera", "main.6"),
        ("join", "guarded", "main.6"),
    }


def test_who_ended_before_what_is_told_has_no_lane_any_more() -> None:
    told = lines("(task-net (short (sleep 1)) (long (sleep 9)))", first=2.0)
    assert told[4:] == [
        "    9.000  ┊ ●  long  goes on",
        "           ┊ ✓  long  has succeeded",
        "           ●    main  goes on",
        "           ✓    main  has succeeded",
    ]


FACTS = """
(defproperty power-state (device state))
(task-net
  (film (wait-until (power-state camera :on)))
  (clock (wait-until (> 1 (+ 1 1)) :timeout 9))
  (switch (sleep 1) (assert '(heat camera 40)) (update '(heat camera ?_) '(heat camera 50))
          (assert '(power-state camera :on))))
"""


def test_facts_are_told_as_they_come_and_go() -> None:
    assert "\n".join(lines(FACTS, kinds=["fact"])[3:]) + "\n" == dedent("""\
        Timeline
            1.000  ┊┊┊+  switch  asserts (HEAT CAMERA 40)                  plan.esl:6:21
                   ┊┊┊−  switch  retracts (HEAT CAMERA 40)                 plan.esl:6:48
                   ┊┊┊+  switch  asserts (HEAT CAMERA 50)                  plan.esl:6:48
                   ┊┊┊+  switch  asserts (POWER-STATE CAMERA :ON)          plan.esl:7:11
        """)


def test_what_will_wake_a_condition_is_told() -> None:
    told = "\n".join(lines(FACTS, columns=120, kinds=["watch"]))
    assert "film   is to wake when facts of POWER-STATE change" in told
    assert "clock  is to look again after each step of another task" in told


def test_an_arrow_leads_from_who_asserts_to_whom_that_wakes() -> None:
    arrows = [arrow for arrow in Lives(traced(FACTS)).arrows if arrow.kind == "signal"]
    assert [(arrow.source, arrow.target) for arrow in arrows] == [("switch", "film")]
