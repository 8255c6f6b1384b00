"""The prompt with tasks: they go on while it waits, and can be looked at and aborted."""

from __future__ import annotations

import signal
import time
from pathlib import Path

import pytest
from unit.tools.command import PYTHON, call, start
from unit.tools.terminal import Terminal

from eslang.tools.transcript import Stage

MISSION = """(defvar mission (spawn (task-net
  (left (checkpoint :a) (with-cleanup-procedure (princ "cleaned") (sleep 100)))
  (right (with-recovery-procedures ((:tired (sleep 50))) (fail :tired 3))))
  :name "mission"))"""


def said(*forms: str) -> list[str]:
    """What each of FORMS is answered with, on virtual time."""
    with Stage() as stage:
        return [stage.answer_to(form) for form in forms]


def test_what_a_form_has_spawned_goes_on_before_the_next() -> None:
    assert said("(defvar x (spawn (progn (princ 1) (sleep 5) (princ 2))))", "(princ 3)", "(sleep 5)") == [
        "X\n1\n",
        "3\n3\n",
        "2\nNIL\n",
    ]


def test_an_endless_task_does_not_keep_the_next_form_from_its_answer() -> None:
    assert said("(defvar x (spawn (loop)))", "(+ 1 2)", "(task-status x)") == ["X\n", "3\n", ":READY\n"]


def test_a_condition_that_a_form_makes_true_wakes_its_task() -> None:
    forms = "(defvar n 0)", "(defvar x (spawn (progn (wait-until (= n 1)) (princ :seen))))", "(setq n 1)"
    assert said(*forms)[-1] == "1\nSEEN\n"


def test_tasks_are_listed_as_a_tree() -> None:
    assert said("(defvar x (spawn 1 :name :ended))", MISSION, ":tasks")[-1] == (
        "ended    succeeded  1\n"
        "mission  waiting    for the end of left, right  <prompt>:1:24\n"
        "  left   waiting    for 100 seconds to pass     <prompt>:2:67\n"
        "  right  waiting    for 50 seconds to pass      <prompt>:3:45\n"
    )


def test_without_tasks_the_list_says_so() -> None:
    assert said("(+ 1 2)", ":tasks")[-1] == "No tasks.\n"


LEFT = """\
left: waiting for 100 seconds to pass, at <prompt>:2:67
  belongs to    mission
  checkpoints   :A
"""
RIGHT = """\
right: waiting for 50 seconds to pass, at <prompt>:3:45
  belongs to    mission
  last failure  :TIRED 3
"""
WHOLE = """\
mission: waiting for the end of left, right, at <prompt>:1:24
  belongs to    the run
  owns          left, right
"""


def test_all_that_is_known_of_one_task() -> None:
    assert said(MISSION, ":task left", ":task right", ":task MISSION")[1:] == [LEFT, RIGHT, WHOLE]


def test_a_task_that_is_aborted_is_cleaned_up_and_stays_to_be_seen() -> None:
    assert said(MISSION, ":abort mission ; enough", ":tasks", ":abort mission")[1:] == [
        "cleaned\n",
        "mission  aborted\n  left   aborted\n  right  aborted\n",
        "mission has ended.\n",
    ]


LOST = """\
:LOST 3 was raised at <prompt>:1:18, in task robot
No recovery procedure was active in task robot.
The stack, innermost first:
  in task robot  <prompt>:1:18
"""


def test_a_failed_task_tells_its_failure_and_where() -> None:
    forms = "(defvar x (spawn (fail :lost 3) :name :robot))", ":tasks", ":task robot", ":why"
    assert said(*forms) == [
        "X\nFailure :LOST, no recovery available.\n",
        "robot  failed  :LOST 3  <prompt>:1:18\n",
        "robot: failed :LOST 3, at <prompt>:1:18\n  belongs to    the run\n",
        LOST,
    ]


def test_an_unknown_name_gets_the_nearest() -> None:
    assert said(MISSION, ":task misson", ":abort nobody", ":task")[1:] == [
        "There is no task `misson`; the nearest name is `mission`.\n",
        "There is no task `nobody`.\n",
        "Say `:task NAME`; :tasks tells the names.\n",
    ]


def test_forms_behind_a_word_with_a_name_are_answered() -> None:
    assert said(MISSION, ":abort mission\n(list 1)\n:task left\n2")[1] == (
        "cleaned\n(1)\nleft: aborted\n  belongs to    mission\n  checkpoints   :A\n2\n"
    )


DEADLOCK = """\
<prompt>:1:1: error: deadlock: 2 tasks wait, and nothing can wake them
  t1  waits for checkpoint :cp of t2  <prompt>:1:15
      t2 never signals it: no (checkpoint :cp) stands in its body
  t2  waits for the end of t1         <prompt>:1:45
  = in    main, which waits for the end of t1, t2
  = hint  let t2 pass `(checkpoint :cp)`
No recovery procedure was active.
The stack, innermost first:
  in top level  <prompt>:1:1
"""


def test_a_deadlock_is_a_failure_like_another_and_why_tells_it() -> None:
    net = "(task-net (t1 (checkpoint-wait t2 :cp)) (t2 (wait-for-task t1)))"
    assert said(net, "(+ 1 2)", ":why") == [
        "Failure :DEADLOCK, no recovery available.\nAborted\n",
        "3\n",
        DEADLOCK,
    ]


def test_a_task_may_end_the_conversation() -> None:
    assert call(["repl", "--quiet"], stdin="(spawn (quit 3))\n:never\n") == (
        3, "? (spawn (quit 3))\n#<TASK quit>\n", "",
    )  # fmt: skip


def test_the_end_of_the_input_aborts_what_runs() -> None:
    form = "(spawn (with-cleanup-procedure (princ :cleaned) (loop)) :name :x)"
    for rest, last in (("", "? \n"), (":quit\n:never\n", "? :quit\n")):
        code, out, err = call(["repl"], stdin=f"{form}\n{rest}")
        assert (code, out, err) == (0, f"? {form}\n#<TASK x>\n{last}CLEANED\n", "")


# --- while it waits ---------------------------------------------------------------------


@pytest.mark.slow
def test_from_a_pipe_tasks_go_on_while_nothing_comes() -> None:
    form = '(spawn (progn (sleep 0.2) (princ "late") (sleep 0.2) (fail :gone)) :name :robot)'
    with start("repl") as running:
        assert running.stdin is not None and running.stdout is not None
        running.stdin.write(f"{form}\n")
        running.stdin.flush()
        lines = [running.stdout.readline() for _ in range(4)]
        time.sleep(0.5)
        running.stdin.write(":tasks\n(read-line)\ntyped")
        out, err = running.communicate(timeout=20)
    assert lines == [f"? {form}\n", "#<TASK robot>\n", "? \n", "late\n"]
    told = "Failure :GONE, no recovery available.\n? :tasks\nrobot  failed  :GONE"
    assert out.lstrip("? \n").startswith(told)  # whether the prompt stood there already is a matter of time
    assert out.endswith('? (read-line)\n"typed"\nT\n? \n')
    assert err == ""


@pytest.mark.slow
def test_ctrl_c_while_a_pipe_is_silent_ends_the_session_with_cleanups() -> None:
    with start("repl") as running:
        assert running.stdin is not None and running.stdout is not None
        running.stdin.write("(spawn (with-cleanup-procedure (princ :cleaned) (loop)) :name :x)\n")
        running.stdin.flush()
        assert running.stdout.readline() and running.stdout.readline()
        time.sleep(0.3)
        running.send_signal(signal.SIGINT)
        out, err = running.communicate(timeout=20)
    assert (running.returncode, err) == (130, "")
    assert out.endswith("CLEANED\n")


TICKING = '(spawn (periodically 0.3 (format t "tick~%")) :daemon t :name :clock)'
HANGING = "(labels ((f (n) (if (< n 2) n (+ (f (- n 1)) (f (- n 2)))))) (spawn (f 80)))"


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["xterm", "dumb"])
def test_at_a_terminal_tasks_go_on_above_the_prompt(kind: str, tmp_path: Path) -> None:
    with Terminal(["env", f"TERM={kind}", *PYTHON, "repl"], XDG_STATE_HOME=str(tmp_path)) as terminal:
        terminal.until(r"\n?\?")
        terminal.type(f"{TICKING}\r")
        terminal.until(r"#<TASK clock>\ntick\n")
        terminal.until(r"tick\n(.|\n)*tick\n")
        terminal.type(f"{HANGING}\r")
        terminal.until(r"#<TASK f>\n")
        terminal.until(r"tick\n(.|\n)*tick\n")
        terminal.type("(list 1 ")
        terminal.until(r"tick\n")
        terminal.type("2)\r")
        terminal.until(r"\n\(1 2\)\n")
        terminal.type("(progn (princ :here) (terpri) (loop))\r")
        terminal.until(r"HERE\n")
        terminal.type("\x03")
        terminal.until(r"Aborted\n")
        terminal.until(r"tick\n")
        terminal.type("\x03")
        terminal.until(r"tick\n")
        terminal.type(":tasks\r")
        terminal.until(r"clock +(waiting +for the next period|ready)(.|\n)*f +ready")
        terminal.type("(spawn (fail :lost))\r")
        terminal.until(r"Failure :LOST, no recovery available.\n; task fail has failed; :why tells more\n")
        terminal.type('(spawn (with-cleanup-procedure (princ "cleaned") (loop)))\r')
        terminal.until(r"#<TASK with-cleanup-procedure>\n(.|\n)*\?")
        terminal.type("\x04")
        terminal.until(r"cleaned\n")
        assert terminal.wait() == 0


@pytest.mark.slow
def test_at_a_terminal_a_task_may_quit_and_its_name_is_completed(tmp_path: Path) -> None:
    with Terminal([*PYTHON, "repl"], XDG_STATE_HOME=str(tmp_path)) as terminal:
        terminal.until(r"\n?\?")
        terminal.type('(spawn (with-cleanup-procedure (princ "cleaned") (sleep 100)) :name :explorer)\r')
        terminal.until(r"#<TASK explorer>\n\?")
        terminal.type(":ab\t")
        terminal.until(r":abort")
        terminal.type(" expl\t")
        terminal.until(r"orer")
        terminal.type("\r")
        terminal.until(r"cleaned\n\?")
        terminal.type("(spawn (progn (sleep 0.2) (quit 9)))\r")
        assert terminal.wait() == 9
