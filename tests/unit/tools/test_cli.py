"""`esl`: what is printed where, and the exit code."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from unit.tools.command import PYTHON, Ended, call, environment, run, start

from eslang import __version__

FAILING = "(defun repair ()\n  (fail :stuck 3))\n(repair)\n"


def written(folder: Path, text: str, name: str = "plan.esl") -> str:
    """The path of a new file with TEXT."""
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_the_values_of_a_form_are_printed_one_a_line() -> None:
    assert call(["-e", '(+ 1 2) "x" (values 1 :b) (values)']) == Ended(0, '3\n"x"\n1\n:B\n', "")
    assert call(["run", "-e", "(list)"]).out == "NIL\n"


def test_a_plan_is_loaded_and_main_is_called(tmp_path: Path) -> None:
    plan = written(tmp_path, "(print :loading)\n(defun main () (print :main) :not-printed)")
    assert call(["run", plan]).out.split() == [":LOADING", ":MAIN"]


def test_main_is_not_called_when_forms_are_given(tmp_path: Path) -> None:
    plan = written(tmp_path, "(defun main () (print :main))")
    assert call(["run", plan, "-e", ":form"]).out == ":FORM\n"


def test_files_are_loaded_in_order_and_main_is_called_once(tmp_path: Path) -> None:
    first = written(tmp_path, "(print 1) (defun main () (print :first))", "a.esl")
    second = written(tmp_path, "(print 2)", "b.esl")
    assert call(["run", first, second]).out.split() == ["1", "2", ":FIRST"]


def test_main_is_found_in_the_package_in_which_its_file_ends(tmp_path: Path) -> None:
    own = written(
        tmp_path, "(defpackage :robot (:use :cl)) (in-package :robot) (defun main () (print :robot))"
    )
    assert call(["run", own]).out.split() == [":ROBOT"]
    user = written(tmp_path, "(defun main () (print :user))", "user.esl")
    assert call(["run", own, user]).out.split() == [":USER"]


def test_a_dash_is_standard_input() -> None:
    assert call(["run", "-"], stdin="(princ :from-stdin)\n(defun main () (terpri))") == Ended(
        0, "FROM-STDIN\n", ""
    )


def test_an_unanswered_failure_has_the_papers_lines_and_a_report(tmp_path: Path) -> None:
    plan = written(tmp_path, FAILING)
    code, out, err = call(["run", plan])
    assert (code, out) == (1, "Failure :STUCK, no recovery available.\nAborted\n")
    assert err.startswith(f"{plan}:2:3: failure: :STUCK 3\n")
    assert "in repair" in err and f"{plan}:3:1" in err
    assert "Traceback" not in err


def test_quiet_means_no_trace_lines(tmp_path: Path) -> None:
    code, out, err = call(["run", "--quiet", written(tmp_path, FAILING)])
    assert (code, out) == (1, "")
    assert ":STUCK" in err


@pytest.mark.parametrize("text", ["(print 1", "(print 1))", "(if)", "(retry)"])
def test_a_wrong_program_is_refused_with_a_diagnostic(tmp_path: Path, text: str) -> None:
    plan = written(tmp_path, text)
    code, _, err = call(["run", plan])
    assert code == 65
    assert err.startswith(f"{plan}:1:")
    assert "Traceback" not in err


def test_a_wrong_form_on_the_command_line_is_refused() -> None:
    code, _, err = call(["-e", "(print"])
    assert code == 65
    assert err.startswith("-e:1:")


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["nonsense"], "there is no command `nonsense`"),
        (["rnu"], "the nearest is `run`"),
        (["plan.esl"], "esl run plan.esl"),
        (["run"], "needs a file, or -e FORM"),
        (["run", "--bogus"], "no option `--bogus`"),
        (["run", "nowhere.esl"], "cannot read `nowhere.esl`: no such file"),
        (["run", "."], "cannot read `.`"),
        (["run", "--seed", "many", "-e", "1"], "`--seed` is a whole number"),
        (["run", "--clock", "sun", "-e", "1"], "`--clock` is `real` or `virtual`"),
        (["run", "--time-limit", "soon", "-e", "1"], "`--time-limit` is a number of seconds"),
        (["run", "--time-limit", "-1", "-e", "1"], "`--time-limit` is a number of seconds"),
        (["run", "--scenario", "-", "-e", "1"], "`--scenario` names a file"),
        (["run", "--scenario", "w.scenario", "-e", "1"], "cannot read `w.scenario`: no such file"),
        (["run", "--facts", "/nowhere/f.db", "-e", "1"], "kept in `/nowhere/f.db`: there is no such folder"),
        (["run", "--trace", "/nowhere/t.json", "-e", "1"], "cannot write `/nowhere/t.json`"),
        (["test"], "needs a file or a folder"),
        (["check"], "needs a file"),
        (["doc"], "needs a name"),
        (["help", "nonsense"], "there is no command `nonsense`"),
    ],
)
def test_wrong_usage_is_told_and_has_its_own_code(arguments: list[str], complaint: str) -> None:
    code, out, err = call(arguments)
    assert (code, out) == (2, "")
    assert complaint in err


def test_help_and_version() -> None:
    assert call(["--version"]) == Ended(0, f"eslang {__version__}\n", "")
    assert call(["--help"]).out.startswith("usage: esl ")
    assert call(["run", "--help"]).out == call(["help", "run"]).out


def test_a_drawn_seed_is_told() -> None:
    code, _, err = call(["run", "--seed", "random", "-e", "1"])
    assert code == 0
    assert err.startswith("esl: seed ")


def test_events_are_traced_as_json_lines(tmp_path: Path) -> None:
    trace = tmp_path / "trace.jsonl"
    call(["run", "--trace", str(trace), "-e", "(fail :stuck 3)"])
    events = [json.loads(line) for line in trace.read_text(encoding="utf-8").splitlines()]
    kinds = ["trace-begun", "task-started", "failure", "aborted", "task-ended", "trace-ended"]
    assert [event["kind"] for event in events] == kinds
    assert events[2]["form"] == "-e:1:1"
    assert events[2]["failure"] == {"cause": ":STUCK", "arguments": [3]}


@pytest.mark.slow
@pytest.mark.parametrize(
    "form",
    [
        "(loop)",
        "(labels ((f (n) (when (> n 0) (f (- n 1)) (f (- n 1))))) (f 90))",
        "(with-recovery-procedures ((:general-failure :retries :infinite (retry))) (fail :again))",
        "(flet ((f () (labels ((g () (+ 1 (g)))) (g)))) (loop (ignore-errors (f))))",
    ],
    ids=["loop", "recursion", "retries", "exhaustion"],
)
def test_the_time_limit_ends_what_does_not_end_itself(form: str) -> None:
    body = f"(with-cleanup-procedure (princ :cleaned) {form})"
    code, out, err = run("run", "--quiet", "--time-limit", "0.8", "-e", body)
    assert (code, out) == (124, "CLEANED\n")
    assert "the time limit of 0.8 s is over" in err


@pytest.mark.parametrize(
    "form", ["(loop)", "(labels ((f (n) (when (> n 0) (f (- n 1)) (f (- n 1))))) (f 90))"]
)
def test_ctrl_c_ends_a_plan_after_its_cleanups(form: str) -> None:
    body = f"(with-cleanup-procedure (princ :cleaned) (princ :begun) (terpri) {form})"
    with start("run", "--quiet", "-e", body) as running:
        assert running.stdout is not None
        assert running.stdout.readline() == "BEGUN\n"
        running.send_signal(signal.SIGINT)
        out, err = running.communicate(timeout=20)
    assert (running.returncode, out) == (130, "CLEANED\n")
    assert "Traceback" not in err


@pytest.mark.slow
def test_a_cleanup_that_does_not_end_does_not_outlive_the_time_limit() -> None:
    started = time.monotonic()
    ended = run("run", "--time-limit", "0.2", "-e", "(with-cleanup-procedure (loop) (loop))")
    assert ended.code == 124
    assert time.monotonic() - started < 15


def test_a_closed_pipe_ends_the_run_quietly() -> None:
    body = "(with-cleanup-procedure (print :cleanup) (loop (print :line)))"
    with start("run", "-e", body) as running:
        assert running.stdout is not None and running.stderr is not None
        running.stdout.readline()
        running.stdout.close()
        err = running.stderr.read()
        assert running.wait(20) == 0
    assert err == ""


@pytest.mark.parametrize("arguments", [["run", "-"], ["repl"]])
def test_bytes_that_are_no_utf_8_get_a_diagnostic(arguments: list[str]) -> None:
    with start(*arguments, text=False) as running:
        _, err = running.communicate(b'(print "\xff")\n', 20)
    assert running.returncode == 65
    assert b"the byte FF is no UTF-8 here" in err


def test_an_output_that_is_full_is_no_bug() -> None:
    with open("/dev/full", "w") as full, start("run", "-e", "(print 1)", stdout=full) as running:
        _, err = running.communicate(timeout=20)
    assert (running.returncode, err) == (1, "esl: the output cannot be written: no space left on device\n")


def test_a_plan_may_quit_with_a_code_after_its_cleanups() -> None:
    body = "(with-cleanup-procedure (princ :cleaned) (princ :begun) (terpri) (quit 7) (princ :never))"
    assert call(["-e", body]) == Ended(7, "BEGUN\nCLEANED\n", "")
    assert call(["repl"], stdin="1 (quit 3) 2") == Ended(3, "? 1\n1\n? (quit 3)\n", "")


@pytest.mark.slow
def test_output_appears_as_it_happens() -> None:
    with start("run", "-e", "(progn (princ :first) (terpri) (loop))") as running:
        assert running.stdout is not None
        assert running.stdout.readline() == "FIRST\n"
        running.kill()


def test_a_bug_of_ours_asks_to_be_sent(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> int:
        raise RuntimeError("we are wrong")

    monkeypatch.setattr("eslang.tools.run.run", broken)
    code, out, err = call(["-e", "1"])
    assert (code, out) == (70, "")
    assert "This is a bug in eslang" in err and "we are wrong" in err


@pytest.mark.slow
def test_a_plan_that_is_compiled_already_starts_with_few_imports(tmp_path: Path) -> None:
    plan = written(tmp_path, "(princ 1)")
    code = (
        f"import sys; from eslang.tools.cli import main; main(['run', {plan!r}]); "
        "print([m for m in ('prompt_toolkit', 'lark', 'argparse', 'asyncio', 'json') if m in sys.modules])"
    )
    for _ in range(2):
        done = subprocess.run(
            [sys.executable, "-c", code],
            capture_output=True,
            text=True,
            env=environment(XDG_CACHE_HOME=str(tmp_path)),
        )
    assert done.stdout == "1\n[]\n"


@pytest.mark.parametrize("closed", [">&-", "2>&-", "<&-"])
def test_a_stream_that_was_closed_from_the_start_is_no_trouble(closed: str) -> None:
    command = ["sh", "-c", f'exec "$0" "$@" {closed}', *PYTHON, "run", "-e", "(print 1)"]
    ended = subprocess.run(command, env=environment(), capture_output=True, text=True, timeout=30)
    assert (ended.returncode, ended.stderr) == (0, "")
    assert ended.stdout.split() == ([] if closed == ">&-" else ["1", "1"])


def test_a_name_that_a_package_does_not_use_is_found_in_another(tmp_path: Path) -> None:
    path = written(tmp_path, "(defpackage :lab (:use :cl))\n(in-package :lab)\n(fail :stuck)\n")
    assert "let package `lab` use `esl`, where this name means something" in run("run", path).err


@pytest.mark.parametrize(
    "text",
    [
        "(progn (to-achieve (at ?place) (t (print ?place))) (defun at (place) nil) (achieve (at 1)))",
        "(print #?place)",
    ],
)
def test_a_logic_variable_that_is_unbound_gets_a_hint(text: str) -> None:
    assert "hint  `#?place` is its value, in a form that binds it" in call(["run", "-e", text]).err
