"""Plan coverage: forms and recovery clauses that did not run."""

from __future__ import annotations

from pathlib import Path

from unit.tools.command import call

from eslang.tools.outline import clauses_of, outline

PLAN = """\
(defun repair (state)
  (with-recovery-procedures
      ((:widget-broken :retries 2
         (attempt-widget-fix state)
         (retry))
       ((:lost where)
         (list where)))
    (operate-widget)))

(defun choose (x)
  (if x
      (list :yes)
      (list :no (list :really))))

(defun never ()
  (list 1)
  (list 2))
"""


def test_the_outline_knows_where_each_list_stands() -> None:
    text = '(a "(" ; (\n  (b #\\( |(|)\n  c)\n(open'
    (top,) = outline(text)
    assert [(node.operator, node.place) for node in top.all()] == [("a", (1, 0, 3, 4)), ("b", (2, 2, 2, 13))]


def test_the_outline_knows_recovery_clauses() -> None:
    form = next(node for node in outline(PLAN)[0].all() if clauses_of(node))
    clauses = clauses_of(form)
    assert [clause.cause for clause in clauses] == [":widget-broken", ":lost"]
    assert [node.text for node in clauses[1].body] == ["(list where)"]


def test_a_clause_may_stand_without_a_list_around_it() -> None:
    (form,) = outline("(esl:with-recovery-procedures (:general-failure (next-bindings)) (f))")
    assert [clause.cause for clause in clauses_of(form)] == [":general-failure"]


def test_what_did_not_run_is_reported(tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text(PLAN)
    tests = tmp_path / "plan-test.esl"
    tests.write_text(
        f'(load "{plan}")\n'
        "(deftest repairs (break-widget) (repair :broken) (expect (eq *widget-status* :ok)))\n"
        "(deftest chooses (expect (choose t) => '(:yes)))\n"
    )
    code, out, err = call(["test", "--coverage", str(tests)])
    assert (code, err) == (0, "")
    lines = out.split("\n")
    assert lines[2] == "2 passed, 0 failed"
    assert lines[3].startswith(f"{plan}: ") and "1 of 2 recovery clauses were invoked" in lines[3]
    assert lines[4:] == [
        f"  {plan}:15:1: `never` was never called",
        f"  {plan}:6:8: the clause for `:lost` was never invoked",
        f"  {plan}:13:7: `(list :no (list :really))` did not run",
        "",
    ]
