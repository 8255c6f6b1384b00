"""`esl test`: test files, transcripts, pages, doubles."""

from __future__ import annotations

from pathlib import Path

from unit.tools.command import Ended, call


def written(folder: Path, name: str, text: str) -> str:
    """The path of a new file with TEXT."""
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_each_deftest_is_run_in_an_interpreter_of_its_own(tmp_path: Path) -> None:
    path = written(
        tmp_path,
        "t.esl",
        "(defvar *n* 0)"
        "(deftest first-one (expect (incf *n*) => 1))"
        "(deftest second-one (expect (incf *n*) => 1))",
    )
    assert call(["test", path]) == Ended(
        0,
        f"ok      {path}: first-one\nok      {path}: second-one\n2 passed, 0 failed\n",
        "",
    )


def test_a_failed_expectation_says_what_was_expected_and_found(tmp_path: Path) -> None:
    path = written(tmp_path, "t.esl", "(deftest sums\n  (expect (+ 1 2) => 4))\n(deftest b (fail :stuck 1))")
    code, out, err = call(["test", path])
    assert (code, err) == (1, "")
    assert "`(+ 1 2)`\n      expected  4\n      found     3\n" in out
    assert f"{path}:2:3: `(+ 1 2)`" in out
    assert "failed with `:STUCK 1`" in out
    assert out.endswith("0 passed, 2 failed\n")


def test_a_failure_can_be_expected(tmp_path: Path) -> None:
    path = written(
        tmp_path,
        "t.esl",
        "(define-failure :slipped (:lost))"
        "(deftest a (expect (fail :stuck) :fails :stuck))"
        "(deftest b (expect (fail :slipped) :fails :lost))"
        "(deftest c (expect (car 5) :fails :type-error))"
        "(deftest d (expect (fail :other) :fails :stuck))"
        "(deftest e (expect 1 :fails :stuck))",
    )
    out = call(["test", path]).out
    assert [line.split()[0] for line in out.split("\n") if ".esl: " in line] == ["ok"] * 3 + ["FAILED"] * 2
    assert "expected  (:FAILS :STUCK)\n      found     (:FAILS :OTHER)" in out
    assert "expected  (:FAILS :STUCK)\n      found     1" in out


def test_a_plan_is_held_to_its_comments(tmp_path: Path) -> None:
    good = written(tmp_path, "good.esl", "(print 1) ; expect: 1\n(fail :x 2)\n; expect failure: :X 2")
    bad = written(tmp_path, "bad.esl", "(print 1)\n; expect: 2\n; expect error: unclosed-list")
    code, out, _ = call(["test", good, bad])
    assert code == 1
    assert f"ok      {good}: as expected\n" in out
    assert "expected the error `unclosed-list`, but the program was accepted" in out
    assert "expected  2\n      found     1\n" in out


def test_folders_are_searched_for_what_holds_tests(tmp_path: Path) -> None:
    written(tmp_path, "plan.esl", "(never-run)")
    written(tmp_path, "a.esl", "(deftest a (expect t))")
    written(tmp_path, "b.transcript", "? (+ 1 2)\n3\n")
    written(tmp_path, "c.md", "```esl\n? (list)\nNIL\n```\n```esl\n(princ 1) ; expect: 1\n```\n")
    written(tmp_path, "d.md", "no blocks here")
    code, out, _ = call(["test", str(tmp_path)])
    assert code == 0
    assert out.endswith("4 passed, 0 failed\n")


def test_a_transcript_that_differs_is_reported(tmp_path: Path) -> None:
    path = written(tmp_path, "t.transcript", "? (+ 1 2)\n4\n")
    code, out, _ = call(["test", path])
    assert code == 1
    assert f"{path}:2: `(+ 1 2)` was answered differently\n      expected  4\n      found     3\n" in out


def test_a_wrong_program_fails_its_tests_with_its_diagnostic(tmp_path: Path) -> None:
    path = written(tmp_path, "t.esl", "(deftest a (expect t))\n(print 1")
    code, out, _ = call(["test", path])
    assert code == 1
    assert f"{path}:2:1: error: " in out


def test_no_tests_are_no_success(tmp_path: Path) -> None:
    assert call(["test", str(tmp_path)]) == Ended(1, "0 passed, 0 failed\n", "esl: no tests found\n")


def test_doubles_from_a_file_stand_in_for_devices(tmp_path: Path) -> None:
    plan = written(
        tmp_path,
        "grasp.esl",
        "(defun grasp () (with-recovery-procedures ((:grip-lost :retries 2 (retry))) (grip-force :left)))",
    )
    doubles = written(tmp_path, "doubles.esl", "(double grip-force (:fails :grip-lost 4) (:returns 3.5))")
    path = written(
        tmp_path,
        "t.esl",
        f'(load "{plan}")\n(deftest grasps\n  (expect (grasp) => 3.5)\n'
        "  (expect (double-calls 'grip-force) => '((:left) (:left))))",
    )
    assert call(["test", "--doubles", doubles, path]).out.endswith("1 passed, 0 failed\n")
    assert call(["test", path]).code == 1


def test_tasks_that_a_test_has_spawned_end_before_it_does(tmp_path: Path) -> None:
    plan = written(
        tmp_path,
        "tasks.esl",
        "(spawn (progn (sleep 5) (princ :late)))\n; expect: LATE\n"
        "(deftest one (spawn (progn (sleep 1) (fail :unseen 3))) (expect t))\n"
        "(deftest two (spawn (sleep 5) :daemon t) (spawn (sleep 1)) (expect t))",
    )
    code, out, _ = call(["test", plan])
    assert code == 1
    assert "failed with `:UNSEEN 3`" in out and out.endswith("2 passed, 1 failed\n")
    lost = written(
        tmp_path, "lost.esl", "(spawn (fail :lost))\n(print 1)\n; expect: 1\n; expect failure: :LOST\n"
    )
    assert call(["test", lost]).out.endswith("1 passed, 0 failed\n")
