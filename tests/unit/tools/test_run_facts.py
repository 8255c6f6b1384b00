"""`esl run --facts`: the facts of a command, kept in a file."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from unit.tools.command import PYTHON, ROOT, call, run

from eslang import Interpreter

COUNT = "(let ((n (length (db-query '(run ?n))))) (assert (list 'run n)) (list :run n))"


def test_each_run_begins_with_the_facts_of_the_last(tmp_path: Path) -> None:
    path = str(tmp_path / "agent.db")
    for number in range(3):
        assert call(["run", "--facts", path, "-e", COUNT]).out == f"(:RUN {number})\n"
    assert call(["run", "-e", COUNT]).out == "(:RUN 0)\n"


def test_the_prompt_keeps_its_facts_too(tmp_path: Path) -> None:
    path = str(tmp_path / "agent.db")
    call(["repl", "--facts", path], stdin="(assert '(a b))\n")
    assert "(((?X . B)))" in call(["repl", "--facts", path], stdin="(db-query '(a ?x))\n").out


def test_what_a_run_that_fails_has_found_out_is_kept(tmp_path: Path) -> None:
    path = str(tmp_path / "agent.db")
    assert call(["run", "-q", "--facts", path, "-e", "(progn (assert '(a b)) (fail :oops))"]).code == 1
    assert call(["run", "-q", "--facts", path, "-e", "(progn (assert '(a c)) (quit 3))"]).code == 3
    assert call(["run", "--facts", path, "-e", "(length (db-query '(a ?x)))"]).out == "2\n"


def test_a_file_that_cannot_be_had_is_wrong_usage(tmp_path: Path) -> None:
    path = tmp_path / "notes.txt"
    path.write_text("some notes\n")
    code, out, err = call(["run", "--facts", str(path), "-e", "(print 1)"])
    assert (code, out) == (2, "")
    assert err == f"esl: facts cannot be kept in `{path}`: it is no SQLite file\nTry `esl --help`.\n"
    assert path.read_text() == "some notes\n"


def test_the_trace_cannot_take_the_place_of_the_facts(tmp_path: Path) -> None:
    path = str(tmp_path / "agent.db")
    code, _, err = call(["run", "--facts", path, "--trace", path, "-e", "1"])
    assert code == 2 and "would take the place" in err


@pytest.mark.slow
def test_a_second_command_on_the_same_file_is_refused(tmp_path: Path) -> None:
    path = str(tmp_path / "agent.db")
    with Interpreter(facts=path):
        second = run("run", "--facts", path, "-e", "1")
    assert second.code == 2
    assert "another interpreter, or another program, has it open" in second.err
    assert run("run", "--facts", path, "-e", "1").code == 0


SMALL = """
import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, 60_000))
from eslang.tools.cli import main
sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="the size of files is limited as POSIX does it")
def test_a_full_disk_ends_the_run_with_a_failure_and_the_file_keeps_its_steps(tmp_path: Path) -> None:
    path = str(tmp_path / "agent.db")
    plan = "(dotimes (i 100000) (assert (list 'n i)) (yield))"
    arguments = [PYTHON[0], "-c", SMALL, "run", "--facts", path, "-e", plan]
    ended = subprocess.run(arguments, cwd=ROOT, capture_output=True, text=True)
    assert ended.returncode == 1
    assert f"facts cannot be kept in `{path}`: the disk" in ended.stderr
    assert "Traceback" not in ended.stderr
    found = call(["run", "--facts", path, "-e", "(mapcar #'cdar (db-query '(n ?n)))"]).out
    numbers = [int(word) for word in found.strip("()\n").split()]
    assert numbers == list(range(len(numbers))) and len(numbers) > 3
