"""`--watch`: the tree, the terminal that it is drawn on, and how that is left."""

from __future__ import annotations

from io import StringIO
from pathlib import Path
from typing import Any

import pytest
from unit.tools.command import PYTHON, call
from unit.tools.terminal import Terminal
from unit.tools.traced import RESCUE, told

from eslang.tools.columns import fitted, width
from eslang.tools.watch_tree import KEPT, WatchTree
from eslang.tools.watching import Watch

PLAN = """
(defun main ()
  (with-recovery-procedures ((:no-power (abort :dark)))
    (task-net
      (left (sleep 2) (format t "left is here~%") (sleep 0.5) (fail :no-power 3))
      (right (princ "no newline yet ") (sleep 9)))))
"""


class Screen(StringIO):
    """A terminal: what stands on it after the control sequences that a tree needs."""

    def rows(self) -> list[str]:
        """The lines on it."""
        rows, row, rest = [""], 0, self.getvalue()
        while rest:
            char, rest = rest[0], rest[1:]
            if char == "\x1b":
                end = next(index for index, char in enumerate(rest) if char.isalpha())
                numbers, kind, rest = rest[1:end], rest[end], rest[end + 1 :]
                if kind == "A":
                    row -= int(numbers)
                elif kind == "J":
                    rows[row:] = [""]
            elif char == "\n":
                row += 1
                rows[row:] = rows[row:] or [""]
            elif char != "\r":
                rows[row] += char
        return rows


def tree_after(text: str, until: float = 1e9, room: int = 50) -> list[tuple[str, str, str]]:
    """The lines of the tree when the run of TEXT has come to the moment UNTIL."""
    tree = WatchTree()
    for event in told(text):
        if event.time <= until:
            tree(event)
    return tree.lines(until, room)


def snapshots(text: str, kind: str) -> list[str]:
    """The tree as text, each time that an event of KIND was told."""
    tree, found = WatchTree(), []

    def listen(event: Any) -> None:
        tree(event)
        if event.kind == kind:
            found.append("\n".join(" ".join(line) for line in tree.lines(event.time, 50)))

    from unit.tools.traced import run

    run(text, [listen], 0)
    return found


def test_each_task_stands_below_its_parent_with_what_it_waits_for() -> None:
    last = snapshots(RESCUE, "wait")[8]
    assert last.split("\n")[5:] == [
        "○ main.6 waits for the end of watcher, camera, arm, guarded, either  plan.esl:11:3",
        "○ ├ watcher waits for event cup-seen  plan.esl:12:14",
        "○ ├ camera sleeps, 1.0 s left  plan.esl:15:13",
        "○ ├ arm waits for checkpoint :ready of watcher  plan.esl:16:10",
        "○ ├ guarded sleeps, 20.0 s left  plan.esl:17:56",
        "○ │ └ battery sleeps, 4.0 s left  plan.esl:7:19",
        "○ └ either waits for the end of radio, laser  plan.esl:18:13",
        "○   ├ radio sleeps, 5.0 s left  plan.esl:8:17",
        "○   └ laser sleeps, 2.0 s left  plan.esl:9:17",
    ]


def test_what_ended_stays_to_be_seen() -> None:
    found = {name.lstrip("├└│ "): (mark, words) for mark, name, words in tree_after(RESCUE)}
    assert found["camera"][0] == "✗"
    assert found["camera"][1].startswith("failed: :DEADLINE-EXPIRED 5")
    assert found["arm"] == ("⊘", "aborted by camera")
    assert found["either"] == ("✓", "succeeded")


def test_the_last_failure_is_kept_and_who_recovers() -> None:
    tree = WatchTree()
    for event in told(RESCUE):
        tree(event)
    assert tree.last_failure.startswith(":DEADLINE-EXPIRED 5")
    assert tree.last_failure.endswith("in main.6, recovery at plan.esl:10:28")


def test_facts_are_counted_and_the_last_change_is_told() -> None:
    tree = WatchTree()
    for event in told("(sleep 1)"):
        tree(event)
    assert tree.fact_line() == ""
    for event in told(
        "(task-net (a (assert '(at robot dock)) (assert '(at arm 2)) (retract '(at robot ?x))))"
    ):
        tree(event)
    assert tree.fact_line() == "facts: 2 came, 1 went, last − (at robot dock) in a at plan.esl:1:61"


def test_a_condition_is_shown_with_the_values_of_its_variables() -> None:
    plan = """(assert '(is-a w1 widget))
      (with-query-bindings '(is-a ?w widget) (task-net (a (wait-until (power #?w :on) :timeout 1))))"""
    assert "waits for the condition (power w1 :on)" in snapshots(plan, "watch")[0]


@pytest.mark.parametrize("room", [4, 10, 25])
def test_there_are_never_more_lines_than_room(room: int) -> None:
    crowd = "(dotimes (n 60) (spawn (sleep (+ 1 n)))) (sleep 30) (fail :odd)"
    lines = tree_after(crowd, until=20.0, room=room)
    assert len(lines) <= room
    assert "more that live" in lines[-1][2]


def test_what_is_kept_of_tasks_that_ended_is_bounded() -> None:
    tree = WatchTree()
    for event in told(f"(dotimes (n {KEPT + 200}) (wait-for-task (spawn n)))"):
        tree(event)
    assert len(tree.tasks) <= KEPT + 1
    assert tree.summary() == f"0 running, 0 waiting, {KEPT + 201} succeeded"


def watched(stream: StringIO, *, work: Any) -> None:
    """Show a tree on STREAM while WORK is done with it."""
    watch = Watch(stream)
    watch.show(lambda: work(watch), lambda: 1.0)


def test_output_stands_above_the_tree_and_the_tree_stays_in_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NO_COLOR", "1")
    screen = Screen()

    def work(watch: Watch) -> None:
        for event in told("(task-net (a 1) (b 2))"):
            watch(event)
            watch.write(f"heard {event.kind}\n")
        watch.write("no newline")
        watch._made = watch._next = 0.0

    watched(screen, work=work)
    rows = screen.rows()
    heard = [row for row in rows if row.startswith("heard")]
    assert rows[: len(heard)] == heard
    assert rows[len(heard)] == "no newline"
    assert rows[len(heard) + 1].startswith("── 1.0 s  0 running, 0 waiting, 3 succeeded ─")
    assert rows[len(heard) + 2 :] == ["✓ main  succeeded", "✓ ├ a   succeeded", "✓ └ b   succeeded", ""]


def test_nothing_on_a_line_can_move_the_cursor() -> None:
    assert fitted("a\x1b[2Jb\nc\td", 20) == "a·[2Jb·c·d"
    assert fitted("漢字漢字", 6) == "漢字…"
    assert width("漢字…") == 5


def test_without_a_terminal_it_is_refused() -> None:
    code, out, err = call(["run", "--watch", "-e", "1"])
    assert (code, out) == (2, "")
    assert err.startswith("esl: `--watch` needs a terminal; `--trace FILE` writes down what happens\n")


@pytest.mark.slow
def test_on_a_terminal_the_tree_lives_and_ends_with_the_run(tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text(PLAN)
    with Terminal([*PYTHON, "run", "--watch", str(plan)], NO_COLOR="1") as terminal:
        terminal.until(r"○ ├ left +sleeps, [0-2]\.. s left")
        terminal.until("no newline yet left is here")
        terminal.until("Failure :NO-POWER, recovery available")
        terminal.until("✗ ├ left +failed: :NO-POWER 3")
        terminal.until("⊘ └ right +aborted by left")
        assert terminal.wait() == 0
        assert terminal.raw.count("left is here") == 1
        assert terminal.raw.endswith("\r\n\x1b[?2026l")


@pytest.mark.slow
def test_ctrl_c_leaves_the_terminal_in_order(tmp_path: Path) -> None:
    with Terminal([*PYTHON, "run", "--watch", "-e", "(task-net (a (loop)) (b (sleep 99)))"]) as terminal:
        terminal.until("sleeps, 9")
        terminal.type("\x03")
        assert terminal.wait() == 130
        assert terminal.text.endswith("esl: interrupted\n")
        assert "?25l" not in terminal.raw  # the cursor was never hidden
        assert "?1049" not in terminal.raw  # nor another screen taken


@pytest.mark.slow
def test_a_dumb_terminal_is_none(tmp_path: Path) -> None:
    with Terminal([*PYTHON, "run", "--watch", "-e", "1"]) as terminal:
        terminal.until("\n")
    with Terminal(["/usr/bin/env", "TERM=dumb", *PYTHON, "run", "--watch", "-e", "1"]) as terminal:
        terminal.until("needs a terminal")
        assert terminal.wait() == 2
