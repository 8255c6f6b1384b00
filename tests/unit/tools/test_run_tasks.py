"""`esl run` with tasks: when the run ends, with which code, and what is cleaned up before."""

from __future__ import annotations

import re
import signal
import time
from pathlib import Path

import pytest
from unit.tools.command import Ended, call, run, start

CALLS = "(labels ((f (n) (if (< n 2) n (+ (f (- n 1)) (f (- n 2)))))) (f 80))"  # and never a loop
DEEP = "(labels ((f (n) (when (> n 0) (f (- n 1)) (f (- n 1))))) (f 90))"


def cleaned(number: int, body: str) -> str:
    """BODY, which tells by NUMBER when it is cleaned up."""
    return f'(with-cleanup-procedure (format t "clean {number}~%") {body})'


def ready(body: str) -> str:
    """BODY, after telling that all is under way."""
    return f'(progn (format t "ready~%") {body})'


LAST = ready(cleaned(0, "(sleep 1000)"))
ENDLESS = {
    "a loop in a spawned task": f"(spawn {cleaned(1, '(loop)')}) {LAST}",
    "only a spawned task": f"(spawn {cleaned(1, ready('(loop)'))})",
    "calls in a spawned task": f"(spawn {cleaned(1, CALLS)}) {LAST}",
    "endless recursion in a spawned task": f"(spawn {cleaned(1, DEEP)}) {LAST}",
    "or-parallel": cleaned(0, f"(or-parallel {cleaned(1, '(loop)')} {cleaned(2, CALLS)} {ready('(loop)')})"),
    "a net": cleaned(0, f"(task-net (a {cleaned(1, DEEP)}) (b {cleaned(2, ready('(sleep 1000)'))}))"),
    "without interrupts": cleaned(0, f"(without-interrupts {ready('(loop)')})"),
    "a task without interrupts": f"(spawn {cleaned(1, '(without-interrupts (sleep 0.2) (loop))')}) {LAST}",
    "a task of calls without interrupts": (
        f"(spawn {cleaned(1, f'(without-interrupts (sleep 0.2) {CALLS})')}) {LAST}"
    ),
    "a guardian": cleaned(0, f"(with-guardian {cleaned(1, '(loop)')} 1 {ready('(sleep 1000)')})"),
    "what is guarded": cleaned(0, f"(with-guardian {cleaned(1, '(sleep 1000)')} 1 {ready('(loop)')})"),
    "all wait": f"(spawn {cleaned(1, '(sleep 1000)')}) {LAST}",
    "a daemon": f"(spawn {cleaned(1, '(loop)')} :daemon t) {LAST}",
    "a task of a task": f"(spawn {cleaned(1, '(task-net (a (spawn ' + cleaned(2, '(loop)') + ')))')}) {LAST}",
    "a cleanup that waits": f"(spawn {cleaned(1, cleaned(2, '(loop)'))}) {LAST}",
}


def what_is_cleaned(text: str) -> list[str]:
    """The numbers of the cleanups in TEXT, a plan or an output."""
    return sorted(re.findall(r"clean (\d)", text))


def interrupted(plan: str, times: int = 1) -> Ended:
    """How PLAN ends when Ctrl-C is pressed each time that it is ready."""
    with start("run", "--quiet", "-e", plan) as running:
        assert running.stdout is not None
        try:
            for _ in range(times):
                while running.stdout.readline() not in ("ready\n", ""):
                    pass
                time.sleep(0.3)
                running.send_signal(signal.SIGINT)
            out, err = running.communicate(timeout=20)
        finally:
            running.kill()
    return Ended(running.returncode, out, err)


@pytest.mark.slow
@pytest.mark.parametrize("plan", ENDLESS)
def test_ctrl_c_ends_all_tasks_after_their_cleanups(plan: str) -> None:
    code, out, err = interrupted(ENDLESS[plan])
    assert (code, err) == (130, "esl: interrupted\n")
    assert what_is_cleaned(out) == what_is_cleaned(ENDLESS[plan])


@pytest.mark.slow
@pytest.mark.parametrize("clock", ["real", "virtual"])
@pytest.mark.parametrize("plan", ["calls in a spawned task", "a task of calls without interrupts"])
def test_the_time_limit_ends_all_tasks_after_their_cleanups(plan: str, clock: str) -> None:
    code, out, err = run("run", "--quiet", "--clock", clock, "--time-limit", "0.6", "-e", ENDLESS[plan])
    assert (code, err) == (124, "esl: the time limit of 0.6 s is over\n")
    assert what_is_cleaned(out) == what_is_cleaned(ENDLESS[plan])


@pytest.mark.slow
def test_a_second_ctrl_c_does_not_wait_for_cleanups() -> None:
    cleanup = ready("(sleep 1000)")
    plan = f"(spawn (with-cleanup-procedure {cleanup} {ready('(loop)')})) (sleep 1000)"
    code, _, err = interrupted(plan, times=2)
    assert (code, err) == (130, "esl: interrupted\n")


@pytest.mark.slow
def test_a_task_that_only_calls_does_not_keep_the_others_from_their_turns() -> None:
    other = '(progn (sleep 0.05) (format t "mine~%") (quit 5))'
    plan = f"(progn (spawn {other}) {cleaned(0, CALLS)})"
    assert run("run", "-e", plan)[:2] == (5, "mine\nclean 0\n")


@pytest.mark.slow
@pytest.mark.parametrize("limit", ["0.001", "0.05", "0.1", "0.2"])
def test_a_time_limit_counts_from_the_start(limit: str) -> None:
    started = time.monotonic()
    ended = run("run", "--time-limit", limit, "--quiet", "-e", f"(progn (spawn {CALLS}) (values))")
    assert ended == (124, "", f"esl: the time limit of {limit} s is over\n")
    assert time.monotonic() - started < 2


# --- how it ends --------------------------------------------------------------------------


def test_the_run_ends_when_what_was_spawned_has_ended() -> None:
    form = "(progn (spawn (progn (sleep 5) (princ :child))) (princ :main) (terpri) (values))"
    assert call(["run", "--clock", "virtual", "-e", form]) == (0, "MAIN\nCHILD\n", "")


def test_main_is_called_before_the_end_of_what_a_file_has_spawned(tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text("(spawn (progn (sleep 5) (print :child)))\n(defun main () (print :main))")
    assert call(["run", "--clock", "virtual", str(plan)]).out.split() == [":MAIN", ":CHILD"]


def test_standard_input_may_spawn() -> None:
    out = call(["run", "--clock", "virtual", "-"], stdin="(spawn (progn (sleep 1) (print 1)))").out
    assert out == "\n1 \n"


def test_daemons_are_aborted_at_the_end() -> None:
    form = f"(progn (spawn {cleaned(1, '(sleep 1000)')} :daemon t) (sleep 1) (values))"
    assert call(["run", "--clock", "virtual", "-e", form]) == (0, "clean 1\n", "")


def test_a_failure_of_the_plan_aborts_what_was_spawned() -> None:
    forms = f"(spawn {cleaned(1, '(sleep 1000)')}) (sleep 1) (fail :main)"
    code, out, err = call(["run", "--clock", "virtual", "--quiet", "-e", forms])
    assert (code, out.endswith("clean 1\n")) == (1, True)
    assert err.startswith("-e:1:") and "failure: :MAIN" in err


def test_a_mistake_in_the_program_aborts_what_was_spawned() -> None:
    code, out, err = call(
        ["run", "--clock", "virtual", "-"], f"(spawn {cleaned(1, '(loop)')}) (sleep 1)\n(if)"
    )
    assert (code, out) == (65, "clean 1\n")
    assert err.startswith("<stdin>:2:1: error")


def test_a_failure_that_nobody_has_seen_is_the_runs() -> None:
    code, out, err = call(["run", "--clock", "virtual", "-e", "(spawn (fail :lost 3)) (sleep 1)"])
    assert (code, out) == (1, "#<TASK fail>\nFailure :LOST, no recovery available.\nNIL\n")
    assert err.startswith("-e:1:8: failure: :LOST 3\n")


@pytest.mark.parametrize("rest", ["(sleep 1000)", "1"])
def test_any_task_may_quit(rest: str) -> None:
    forms = f"(spawn (progn (sleep 1) (quit 7))) (spawn {cleaned(1, '(sleep 1000)')} :name :b) {rest}"
    code, out, err = call(["run", "--clock", "virtual", "--quiet", "-e", f"(progn {forms} (values))"])
    assert (code, out, err) == (7, "clean 1\n", "")


def test_a_deadlock_of_what_was_spawned_is_a_failure_of_the_run() -> None:
    form = f"(progn (spawn {cleaned(1, '(wait-for-events (make-event))')}) (values))"
    code, out, err = call(["run", "-e", form])
    assert (code, out) == (1, "Failure :DEADLOCK, no recovery available.\nclean 1\n")
    assert "error: deadlock: 1 task waits, and nothing can wake it" in err


def test_the_seed_settles_the_order_of_shuffled_tasks() -> None:
    form = "(progn (dotimes (i 7) (let ((i i)) (spawn (princ i)))) (values))"
    orders = [call(["run", "--shuffle", "--seed", seed, "-e", form]).out for seed in "1122345"]
    assert orders[0] == orders[1] and orders[2] == orders[3]
    assert len(set(orders)) > 3
    assert {"".join(sorted(order.strip())) for order in orders} == {"0123456"}
    assert call(["run", "--seed", "5", "-e", form]).out == "0123456\n"
