"""The prompt: the papers' transcripts from a pipe and at a terminal, and what else is said there."""

from __future__ import annotations

import re
import signal
from pathlib import Path

import pytest
from unit.tools.command import PYTHON, ROOT, call, start
from unit.tools.terminal import Terminal

from eslang.tools.transcript import Entry, comparable, read_transcript

TRANSCRIPTS = sorted((ROOT / "tests" / "transcripts").glob("*.transcript"))


def entries(path: Path) -> list[Entry]:
    """The entries of a transcript of the papers."""
    return read_transcript(path.read_text(encoding="utf-8"))


def lines(text: str) -> list[str]:
    """TEXT as transcripts compare it."""
    return [line for _, line in comparable(text.split("\n"))]


@pytest.mark.parametrize("path", TRANSCRIPTS, ids=lambda path: path.stem)
def test_from_a_pipe_the_output_is_the_transcript_itself(path: Path) -> None:
    told = entries(path)
    code, out, err = call(["repl", "--clock", "virtual"], stdin="".join(entry.form + "\n" for entry in told))
    expected = [(entry.form, lines("\n".join(entry.expected))) for entry in told]
    came = [(entry.form, lines("\n".join(entry.expected))) for entry in read_transcript(out)]
    assert (code, err) == (0, "")
    assert came == expected


@pytest.mark.slow
@pytest.mark.parametrize("path", TRANSCRIPTS, ids=lambda path: path.stem)
def test_at_a_terminal_each_form_is_answered_as_in_the_transcript(path: Path, tmp_path: Path) -> None:
    with Terminal([*PYTHON, "repl", "--clock", "virtual"], XDG_STATE_HOME=str(tmp_path)) as terminal:
        terminal.until(r"\n\?")
        for entry in entries(path):
            terminal.type("\x1b[200~" + entry.form + "\x1b[201~\r")  # pasted, so that nothing is indented
            answer = [re.escape(line) + " *\n" for line in lines("\n".join(entry.expected))]
            terminal.until(r"\n" + "".join(answer) + r"\?")
        terminal.type("\x04")
        assert terminal.wait() == 0


def test_several_forms_on_one_line_and_one_form_on_several() -> None:
    out = call(["repl"], stdin="1 (list 2\n  3) ; remark\n\n;; only a remark\n4").out
    assert out == "? 1\n1\n? (list 2\n  3)\n(2 3)\n? 4\n4\n? \n"


def test_a_mistake_is_told_and_the_prompt_returns() -> None:
    code, out, err = call(["repl"], stdin="(car\n'(1)))\n(if)\n:after\n")
    assert code == 65
    assert out.endswith("? :after\n:AFTER\n? \n")
    assert err.startswith("<prompt>:") and "error: " in err and "Traceback" not in err


@pytest.mark.parametrize("text", ['(print "unfinished', "(list 1", "'", "#|"])
def test_input_that_ends_inside_a_form_is_a_mistake(text: str) -> None:
    code, _, err = call(["repl"], stdin=f":first\n{text}")
    assert code == 65
    assert err.startswith("<prompt>:")


def test_a_failure_is_an_answer_and_no_mistake() -> None:
    code, out, err = call(["repl"], stdin="(fail :stuck)\n(car 5)\n:on")
    assert (code, err) == (0, "")
    assert out.count("Aborted\n") == 2
    assert out.endswith("? :on\n:ON\n? \n")


def test_the_prompt_remembers_values_and_forms() -> None:
    out = call(["repl"], stdin="(values 1 2)\n*\n(list * ** /)\n+\n(fail :x)\n*\n").out
    assert [line for line in out.split("\n") if not line.startswith("? ")] == [
        "1", "2", "1", "(1 1 (1))", "(LIST * ** /)",
        "Failure :X, no recovery available.", "Aborted", "(LIST * ** /)", "",
    ]  # fmt: skip


def test_why_tells_where_and_who_was_asked() -> None:
    plan = (
        "(defun demo () (with-recovery-procedures ((:stuck :retries 2 (retry)) (:other 1)) (fail :stuck 3)))"
    )
    out = call(["repl", "--quiet"], stdin=f":why\n{plan}\n(demo)\n:why\n").out
    assert "Nothing has failed yet." in out
    story = out[out.rindex("? :why") :]
    assert ":STUCK 3 was raised at <prompt>:1:" in story
    assert "was invoked 2 times, its retries are used up" in story
    assert "is for another cause" in story
    assert "in demo" in story


def test_help_and_quit() -> None:
    code, out, _ = call(["repl"], stdin=":help\n:quit\n:never")
    assert code == 0
    assert ":why" in out and ":NEVER" not in out


def test_doc_prints_signature_and_documentation() -> None:
    out = call(["repl"], stdin="(doc with-recovery-procedures)\n(doc 'car)\n").out
    assert "(with-recovery-procedures " in out and "\n(car " in out
    assert "\nNIL\n" not in out


def test_files_are_loaded_first(tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text("(defun f () :loaded)")
    assert call(["repl", str(plan)], stdin="(f)").out == "? (f)\n:LOADED\n? \n"


def test_a_quiet_prompt_tells_of_failures_that_nobody_answers() -> None:
    form = "(with-recovery-procedures ((:a (abort 1))) (fail :a)) (fail :b)"
    out = call(["repl", "--quiet"], stdin=form).out
    assert "recovery available. (" not in out
    assert "Failure :B, no recovery available.\nAborted\n" in out


@pytest.mark.slow
def test_ctrl_c_ends_a_form_from_a_pipe() -> None:
    with start("repl") as running:
        assert running.stdin is not None and running.stdout is not None
        running.stdin.write("(with-cleanup-procedure (princ :cleaned) (princ :begun) (terpri) (loop))\n")
        running.stdin.flush()
        while "BEGUN" not in running.stdout.readline():
            pass
        running.send_signal(signal.SIGINT)
        out, err = running.communicate(timeout=20)
    assert "CLEANED" in out
    assert "Traceback" not in err
    assert running.returncode == 130


@pytest.mark.slow
def test_at_a_terminal_ctrl_c_returns_to_the_prompt(tmp_path: Path) -> None:
    with Terminal([*PYTHON, "repl"], XDG_STATE_HOME=str(tmp_path)) as terminal:
        terminal.until(r"\n\?")
        terminal.type("(with-cleanup-procedure (princ :cleaned) (princ :begun) (terpri) (loop))\r")
        terminal.until(r"BEGUN\n")
        terminal.type("\x03")
        terminal.until(r"CLEANED\nAborted\n\?")
        terminal.type("(progn (princ :here) (terpri) (loop)) :never\r")
        terminal.until(r"HERE\n")
        terminal.type("\x03")
        assert "NEVER" not in terminal.until(r"Aborted\n\?")
        terminal.type("(not-finished\x03")
        terminal.until(r"\n\?")
        terminal.type("(prnt 1)\r")
        terminal.until(
            r"Aborted\n; the function PRNT is undefined; the nearest name .* `print`; :why tells more\n\?"
        )
        terminal.type("(list\r:still\r:there)\r")
        terminal.until(r"\(:STILL :THERE\)\n\?")
        terminal.type(":quit\r")
        assert terminal.wait() == 0
    assert "(list" in (tmp_path / "eslang" / "history").read_text()


@pytest.mark.slow
def test_a_history_that_cannot_be_kept_is_no_harm(tmp_path: Path) -> None:
    (tmp_path / "eslang").write_text("a file where the folder should be")
    with Terminal([*PYTHON, "repl"], XDG_STATE_HOME=str(tmp_path)) as terminal:
        terminal.until(r"\n\?")
        terminal.type("(+ 1 2)\r")
        terminal.until(r"\n3\n\?")
        terminal.type("\x04")
        assert terminal.wait() == 0


@pytest.mark.slow
def test_a_terminal_without_a_screen_has_a_prompt_too(tmp_path: Path) -> None:
    with Terminal(["env", "TERM=dumb", *PYTHON, "repl"], XDG_STATE_HOME=str(tmp_path)) as terminal:
        terminal.until(r"\? ")
        terminal.type("(list 1\r2)\r")
        assert terminal.until(r"\(1 2\)\n\? ") == "(list 1\n2)\n(1 2)\n? "
        terminal.type("(progn (princ :here) (terpri) (loop)) :never\r")
        terminal.until(r"HERE\n")
        terminal.type("\x03")
        assert "NEVER" not in terminal.until(r"Aborted\n\? ")
        terminal.type("(dropped\r\x03")
        terminal.until(r"\? ")
        terminal.type("(list 3)\r")
        terminal.until(r"\n\(3\)\n\? ")
        terminal.type("\x04")
        assert terminal.wait() == 0
