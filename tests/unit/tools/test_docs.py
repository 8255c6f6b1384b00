"""`esl doc`, `esl check`, `esl explain`: what is known without running."""

from __future__ import annotations

from pathlib import Path

from unit.tools.command import Ended, call


def test_doc_prints_what_the_registry_knows() -> None:
    code, out, err = call(["doc", "with-recovery-procedures", "let", "*widget-status*"])
    assert (code, err) == (0, "")
    assert out.startswith("(with-recovery-procedures clauses &body body)\n  macro of ESL\n\nRun BODY;")
    assert "\n\n(let bindings &body forms)\n  special form of COMMON-LISP\n" in out


def test_doc_finds_names_of_other_packages() -> None:
    assert call(["doc", "esl:fail"]).out == call(["doc", "FAIL"]).out


def test_doc_offers_the_nearest_name() -> None:
    code, out, err = call(["doc", "with-recovery-procedure"])
    assert (code, out) == (1, "")
    assert "nothing is called `with-recovery-procedure`" in err
    assert "the nearest is `with-recovery-procedures`" in err


def test_a_right_plan_is_checked_in_silence(tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text("(defun f (x) (g x)) (defun g (x) (* x x))")
    assert call(["check", str(plan)]) == Ended(0, "", "")


def test_a_wrong_plan_is_told_where(tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text("(defun f (x)\n  (if x))\n")
    code, out, err = call(["check", str(plan)])
    assert (code, out) == (65, "")
    assert err.startswith(f"{plan}:2:3: error: ")
    assert err.endswith("1 error, 0 warnings\n")


def test_a_diagnostic_is_explained() -> None:
    code, out, _ = call(["explain", "unclosed-list"])
    assert code == 0
    assert "unclosed-list" in out
    assert call(["explain", "unclosed-lists"]).code == 1
