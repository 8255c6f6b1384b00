"""The tracer: JSON lines, the same bytes for the same run."""

from __future__ import annotations

import json
import subprocess
import sys
from io import StringIO
from pathlib import Path
from typing import Any

import pytest
from unit.tools.command import call, environment, run
from unit.tools.traced import EVERY_KIND, RESCUE, written

from eslang import Interpreter
from eslang.tools.tracing import LONGEST, Tracer

CHANCE = "(task-net (a (dotimes (i 9) (sleep (random 3.0)))) (b (dotimes (i 9) (sleep (random 2.0)))))"


def records(text: str) -> list[dict[str, Any]]:
    """The events of the trace of TEXT, without its first and last line."""
    return [json.loads(line) for line in written(text).splitlines()[1:-1]]


@pytest.mark.slow
def test_the_same_run_gives_the_same_bytes_in_other_processes(tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text(RESCUE + CHANCE + EVERY_KIND.replace("(quit 3)", ""))
    found = set()
    for number, salt in enumerate(("0", "1", "4711")):
        trace = tmp_path / f"{number}.jsonl"
        command = [sys.executable, "-m", "eslang", "run", "--quiet", "--clock", "virtual", "--seed", "7"]
        subprocess.run(
            [*command, "--shuffle", "--trace", str(trace), str(plan)],
            env=environment(PYTHONHASHSEED=salt),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            timeout=60,
        )
        found.add(trace.read_bytes())
    assert len(found) == 1
    assert len(found.pop().splitlines()) > 100


def test_another_seed_gives_another_trace() -> None:
    assert written(CHANCE, seed=1) == written(CHANCE, seed=1)
    assert written(CHANCE, seed=1).splitlines()[1:] != written(CHANCE, seed=2).splitlines()[1:]


def test_the_first_line_tells_what_kind_of_run_and_the_last_that_it_is_whole() -> None:
    lines = written("(sleep 2)").splitlines()
    assert json.loads(lines[0]) == {
        "kind": "trace-begun",
        "format": 1,
        "clock": "virtual",
        "seed": 0,
        "plans": ["plan.esl"],
    }
    assert json.loads(lines[-1]) == {"kind": "trace-ended", "time": 2.0}


def test_tasks_and_events_stand_by_labels_that_only_they_have() -> None:
    text = """
    (defun hear (event) (wait-for-events event))
    (let ((one (make-event)) (two (make-event)) (cup (make-event 'cup)))
      (task-net (a (hear one)) (b (hear two)) (c (hear (list one cup)))
                (d (signal one) (signal two))))
    """
    waits = {record["task"]: record["of"] for record in records(text) if record.get("on") == "events"}
    assert waits == {"a": ["event"], "b": ["event.2"], "c": ["event", "CUP"]}
    signals = [(record["event"], record["wakes"]) for record in records(text) if record["kind"] == "signal"]
    assert signals == [("event", ["a", "c"]), ("event.2", ["b"])]


def test_an_event_of_a_task_stands_by_the_name_of_the_task() -> None:
    found = records("(let ((sleeper (spawn (sleep 1)))) (wait-for-events sleeper))")
    assert [record["of"] for record in found if record.get("on") == "events"] == [["sleep"]] * 2


def test_no_address_of_this_process_gets_into_a_trace() -> None:
    stream = StringIO()
    with Interpreter(output=StringIO(), listeners=[Tracer(stream, {})]) as interp:
        interp.set_value("thing", object())
        interp.eval("(signal (make-event) thing (list thing #'car (lambda () 1) (make-hash-table)))")
    assert "0x" not in stream.getvalue()
    assert "object object" in stream.getvalue()


def test_a_long_value_is_cut() -> None:
    found = records("(signal (make-event) (make-list 100000)) (checkpoint (make-string 100000))")
    assert max(len(str(record)) for record in found) < LONGEST + 300


def test_what_cannot_be_printed_does_not_disturb_the_plan() -> None:
    text = """
    (defstruct (odd (:print-function (lambda (odd stream depth) (fail :cannot-print)))) size)
    (with-recovery-procedures ((:cannot-print (print :asked) (abort :disturbed)))
      (signal (make-event) (make-odd)))
    (signal (make-event) (expt 10 5000) (code-char 55296))
    """
    found = [record for record in records(text) if record["kind"] in ("signal", "recovery", "failure")]
    assert [record["kind"] for record in found] == ["signal", "signal"]
    assert found[0]["arguments"] == "#<unprintable>"


def test_any_character_can_be_written(tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl"
    form = "(signal (make-event) (make-string 2 :initial-element (code-char 55296)) (expt 10 5000))"
    assert call(["run", "--trace", str(path), "-e", form]) == (0, "NIL\n", "")
    assert call(["trace", str(path)]).code == 0


def test_a_trace_does_not_take_the_place_of_its_plan(tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text("(print 1)")
    code, _, err = call(["run", str(plan), "--trace", str(plan)])
    assert (code, "would take the place" in err, plan.read_text()) == (2, True, "(print 1)")
    trace = tmp_path / "run.html"
    trace.write_text(written("1"))
    code, _, err = call(["trace", "--html", str(trace)])
    assert (code, "is the trace itself" in err, trace.read_text()) == (2, True, written("1"))


def test_a_failure_that_was_passed_on_says_from_whom() -> None:
    found = records('(task-net (left (fail :no-power 3 "volt")))')
    assert found[-2]["failure"] == {"cause": ":NO-POWER", "arguments": [3, "volt"], "from": "left"}


def test_a_trace_can_go_to_standard_output_while_the_plan_prints_elsewhere() -> None:
    code, out, err = call(["run", "--clock", "virtual", "--trace", "-", "-e", "(print :hello)"])
    assert code == 0
    kinds = [json.loads(line)["kind"] for line in out.splitlines()]
    assert (kinds[0], kinds[-1]) == ("trace-begun", "trace-ended")
    assert ":HELLO" in err


def test_the_prompt_keeps_standard_output_for_itself() -> None:
    code, _, err = call(["repl", "--trace", "-"], stdin="1")
    assert code == 2
    assert "let `--trace` name a file" in err


def test_a_trace_that_cannot_be_written_is_told_and_the_run_goes_on() -> None:
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full here")
    code, out, err = call(["run", "--trace", "/dev/full", "-e", "(+ 1 2)"])
    assert (code, out) == (0, "3\n")
    assert err == "esl: the trace could not be written: no space left on device\n"


@pytest.mark.slow
def test_what_was_traced_is_there_even_if_the_run_is_killed(tmp_path: Path) -> None:
    from unit.tools.command import start

    trace = tmp_path / "run.jsonl"
    with start(
        "run", "--trace", str(trace), "-e", '(task-net (a (format t "here~%") (sleep 60)))'
    ) as running:
        assert running.stdout is not None
        while "here" not in running.stdout.readline():
            pass
        while '"sleep"' not in trace.read_text():
            pass
        running.kill()
    ended = run("trace", str(trace))
    assert ended.code == 0
    assert "But the run had not ended: it was killed, or goes on." in ended.out
    assert "sleeps 60 s" in ended.out
