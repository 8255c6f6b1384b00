"""`esl graph`: what is drawn of a plan, and what is said where nothing can be."""

from __future__ import annotations

import time
from pathlib import Path

import pytest
from unit.tools.command import ROOT, call
from unit.tools.graphs import NEST, drawn, joined, outline

PLANS = sorted((ROOT / "plans").glob("*/*.esl"))
PAGE = ROOT / "docs/how-to"


def test_a_function_is_its_steps_in_order() -> None:
    assert outline('(defun f (x) "Say." (print x) (sleep 1) (g)) (defun g ())') == [
        "function f (x)",
        "  1 > (print x)",
        "  2 > (sleep 1)",
        "  3 > (g)",
        "function g",
    ]


def test_plain_steps_share_a_box() -> None:
    assert outline("(defun f () (print 1) (print 2) (print 3) (print 4) (print 5))") == [
        "function f",
        "  (print 1) / (print 2) / (print 3) / … 2 more",
    ]


def test_calls_lead_to_the_definition_and_may_be_recursive() -> None:
    graph = drawn("(defun f () (list (g) (f))) (defun g () (mapc #'f '(g)))")
    assert joined(graph) == [
        ("call", "(list (g) (f))", "f"),
        ("call", "(mapc #'f '(g))", "f"),
        ("call", "(list (g) (f))", "g"),
    ]


def test_calls_in_data_are_none() -> None:
    graph = drawn('(defun f () \'(g) "(g)" `(g ,(g))) (defun g ())')
    assert joined(graph) == [("call", "`(g ,(g))", "g")]


def test_the_constructs_of_scs_show_their_conditions_utilities_and_modifiers() -> None:
    assert outline(NEST) == [
        "step work (n)",
        "  :until (> n 3)",
        "  do-first",
        "    1: (< n 1) > (halt)",
        "    2: t > in order",
        "      1 > do-best",
        "        :learn t",
        "        (oddp n) > [utility (* 2 n)] (halt)",
        "        t > [utility 0] repeat",
        "          :while (< n 9)",
        "          (halt)",
        "      2 > do*-all",
        "        do-any",
        "          (halt)",
        "          (work 1)",
        "        with-cycle (10)",
        "          (halt)",
        "action halt",
        "  :halted",
    ]


def test_recovery_procedures_stand_behind_the_body() -> None:
    text = """(defun f ()
      (with-recovery-procedures ((:stuck :retries 2 (print 1) (retry)) ((:lost where) (abort where)))
        (with-cleanup-procedure (print :off) (fail :stuck))))"""
    assert outline(text) == [
        "function f",
        "  with-recovery-procedures",
        "    with-cleanup-procedure",
        "      (fail :stuck)",
        "      cleanup > (print :off)",
        "    recovery :stuck",
        "      retries 2",
        "      1 > (print 1)",
        "      2 > (retry)",
        "    recovery (:lost where)",
        "      (abort where)",
    ]


def test_one_recovery_clause_needs_no_list() -> None:
    assert outline("(defun f () (with-recovery-procedures (:stuck (abort 1)) (fail :stuck)))")[-2:] == [
        "    recovery :stuck",
        "      (abort 1)",
    ]


def test_tasks_wait_for_checkpoints_and_ends_of_one_another() -> None:
    text = """(defun f ()
      (task-net (a (checkpoint :cp)) (b (checkpoint-wait a :cp) (wait-for-task a)))
      (task-net (a (checkpoint :cp)) (b (checkpoint-wait a :other))))"""
    assert joined(drawn(text)) == [
        ("end", "a", "(wait-for-task a)"),
        ("checkpoint", "(checkpoint :cp)", "(checkpoint-wait a :cp)"),
    ]


def test_a_spawned_task_is_known_by_its_variable() -> None:
    graph = drawn("(defun f () (let ((arm (spawn (sleep 1) :name 'arm))) (wait-for-events arm)))")
    assert joined(graph) == [("end", "spawn :name 'arm", "(wait-for-events arm)")]


def test_signals_lead_to_who_waits_for_the_event() -> None:
    text = """(defevent go) (defun f () (signal go 1)) (defun g () (wait-for-events (list go)))
      (defun h () (let ((go2 (make-event))) (signal go2)))
      (defun i () (let ((go2 (make-event))) (wait-for-events go2)))"""
    assert joined(drawn(text)) == [("event", "(signal go 1)", "(wait-for-events (list go))")]


def test_a_guardian_an_or_parallel_and_locks() -> None:
    text = """(defun f ()
      (with-guardian (sleep 9) (fail :late)
        (or-parallel (sleep 1) (progn (sleep 2) (print 1))))
      (with-maintained-properties ((power x :on)) (without-property-lock-failures (print 1))))"""
    assert outline(text) == [
        "function f",
        "  1 > with-guardian",
        "    or-parallel",
        "      (sleep 1)",
        "      in order",
        "        1 > (sleep 2)",
        "        2 > (print 1)",
        "    guardian > (sleep 9)",
        "    when it ends > (fail :late)",
        "  2 > with-maintained-properties ((power x :on))",
        "    without-property-lock-failures",
        "      (print 1)",
    ]


def test_goals_that_are_given_and_maintained_lead_to_their_methods() -> None:
    text = """(to-achieve (lamp ?where ?state) (t (assert '(lamp #?where #?state))))
      (defvar *light* (scs:add-goal (achieve (lamp hall :on)) :utility 3))
      (defun f () (scs:maintain (lamp hall :on)) (scs:add-goal (maintain (lamp hall :on)) :retries 2 :by (f))
        (scs:pursue-goals :until (oddp 1)))"""
    assert outline(text)[1:] == [
        "  t > (assert '(lamp #?where #?state))",
        "function f",
        "  1 > (scs:maintain (lamp hall :on))",
        "  2 > scs:add-goal (maintain (lamp hall :on))",
        "    :retries 2",
        "    by > (f)",
        "  3 > scs:pursue-goals",
        "    :until (oddp 1)",
        "when loaded plan.esl",
        "  (defvar *light* (scs:add-goal (achieve (lamp …",
    ]
    assert [source for kind, source, _ in joined(drawn(text)) if kind == "achieve"] == [
        "(scs:maintain (lamp hall :on))",
        "(defvar *light* (scs:add-goal (achieve (lamp …",
    ]


def test_options_of_a_construct_stand_in_its_box() -> None:
    text = """(define-resource wheels :capacity 2)
      (defun f () (with-resource (wheels 1) :priority 10 (print 1)))
      (defun g () (with-query-bindings '(at ?x) :inherit-bindings (next-bindings)))"""
    assert outline(text) == [
        "function f",
        "  with-resource (wheels 1)",
        "    :priority 10",
        "    (print 1)",
        "function g",
        "  with-query-bindings '(at ?x) :inherit-bindings",
        "    (next-bindings)",
    ]


def test_goals_lead_to_the_methods_that_may_apply() -> None:
    text = """(to-achieve (power ?device :on) (t (print 1)))
      (to-achieve (power lamp ?state) ((oddp 1) (sleep 1) (print 2)) (t (fail :no)))
      (defun f () (achieve (power lamp :on)) (achieve (and (power fan :off) (power #?x :on))))"""
    graph = drawn(text)
    assert [definition.name for definition in graph.definitions] == ["power", "power", "f"]
    assert [(source, sink) for _, source, sink in joined(graph)] == [
        ("(achieve (power lamp :on))", "(power ?device :on)"),
        ("(achieve (and (power fan :off) (power #?x :on…", "(power ?device :on)"),
        ("(achieve (power lamp :on))", "(power lamp ?state)"),
        ("(achieve (and (power fan :off) (power #?x :on…", "(power lamp ?state)"),
    ]


def test_lisp_shows_where_it_holds_a_step() -> None:
    text = """(defun f (x)
      (if (oddp x) (f 1) (print 2))
      (cond ((evenp x) (print 3)) (t (fail :no)))
      (when x (dolist (y x) (f y)))
      (if x 1 2))"""
    assert outline(text) == [
        "function f (x)",
        "  1 > if (oddp x)",
        "    then > (f 1)",
        "    else > (print 2)",
        "  2 > cond",
        "    (evenp x) > (print 3)",
        "    t > (fail :no)",
        "  3 > when x",
        "    dolist (y x)",
        "      (f y)",
        "  4 > (if x 1 2)",
    ]


def test_local_functions_have_calls_of_their_own() -> None:
    graph = drawn("(defun g ()) (defun f () (labels ((g (x) (sleep x) (g 1))) (g 2)))")
    assert joined(graph) == [
        ("call", "(g 2)", "g (x)"),
        ("call", "(g 1)", "g (x)"),
    ]


def test_macros_of_the_plan_are_expanded() -> None:
    text = """(defmacro twice (form) `(scs:do ,form ,form))
      (defmacro define-stop (name) `(defun ,name () (fail :stop)))
      (define-stop halt) (defun f () (twice (halt)))"""
    assert outline(text) == [
        "function halt",
        "  (fail :stop)",
        "function f",
        "  do",
        "    1 > (halt)",
        "    2 > (halt)",
    ]


def test_what_is_done_when_the_file_is_loaded_comes_last() -> None:
    lines = outline("(defvar *x* 1) (f) (let ((y 1)) (defun f () y)) (print 1) (spawn (sleep 1))")
    assert lines == ["function f", "  y", "when loaded plan.esl", "  1 > (f)", "  2 > spawn", "    (sleep 1)"]


def test_a_definition_is_chosen_by_its_name(tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text("(defun f () (g)) (defun g () (f)) (to-achieve (at ?x) (t (f)))", encoding="utf-8")
    ended = call(["graph", "--of", "F", "--of", "at", str(plan)])
    assert ended.code == 0
    assert [line.strip() for line in ended.out.split("\n") if '["' in line] == [
        'n1["function f"]:::definitionBox',
        'n2["(g)"]:::callBox',
        'n3["to achieve (at ?x)"]:::goalBox',
        'n4["(f)"]:::callBox',
    ]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "`esl graph` needs a file"),
        (["missing.esl"], "cannot read `missing.esl`: no such file or directory"),
        (["--of", "patrl", "plans/esl/11-patrol.esl"], "called `patrl`; the nearest is `patrol`"),
        (["-o", "no/such/x.svg", "plans/esl/11-patrol.esl"], "cannot write `no/such/x.svg`"),
        (["-o", "plans/esl/11-patrol.esl", "plans/esl/11-patrol.esl"], "is the plan itself"),
    ],
)
def test_wrong_use_is_said(arguments: list[str], said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    ended = call(["graph", *arguments])
    assert (ended.code, ended.out) == (2, "")
    assert said in ended.err


@pytest.mark.parametrize("text", ["(defun f (", "(do-best (t))", "(defun f () (sleep 1)) (task-net x)"])
def test_a_wrong_plan_is_told_as_the_check_tells_it(text: str, tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text(text, encoding="utf-8")
    check, graph = call(["check", str(plan)]), call(["graph", str(plan)])
    assert (graph.code, graph.out) == (check.code, "") == (65, "")
    assert graph.err == check.err.replace("1 error, 0 warnings", "1 error, nothing is drawn")


def test_a_plan_that_can_be_read_is_drawn_though_it_is_wrong() -> None:
    ended = call(["graph", "-"], "(defun f () (g))")
    assert (ended.code, "function f" in ended.out) == (65, True)
    assert "there is no function `g`" in ended.err
    assert ended.err.endswith("\n1 error\n")


def test_the_check_reads_standard_input_too() -> None:
    ended = call(["check", "-"], "(foo)")
    assert (ended.code, ended.err.split("\n")[0]) == (65, "<stdin>:1:2: error: there is no function `foo`")


@pytest.mark.parametrize("text", ["", "; nothing\n", "(defvar *x* 1) (print *x*) (defrule (a ?x) (b ?x))"])
@pytest.mark.parametrize("options", [[], ["--svg"]])
def test_a_plan_that_defines_nothing_is_drawn_as_nothing(
    text: str, options: list[str], tmp_path: Path
) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text(text, encoding="utf-8")
    ended = call(["graph", *options, str(plan)])
    assert (ended.code, ended.err) == (0, "")
    assert "nothing here is defined" in ended.out


def test_the_plan_comes_from_standard_input_too() -> None:
    ended = call(["graph", "-"], "(defun f () (sleep 1))")
    assert (ended.code, ended.out.split("\n")[0]) == (0, "%% Structure of standard input")


def test_the_ending_of_the_file_says_what_is_drawn(tmp_path: Path) -> None:
    plan, picture, text = tmp_path / "plan.esl", tmp_path / "a.svg", tmp_path / "a.mmd"
    plan.write_text("(defun f () (sleep 1))", encoding="utf-8")
    assert call(["graph", "-o", str(picture), str(plan)]).out == f"{picture}\n"
    assert call(["graph", "-o", str(text), str(plan)]).code == 0
    assert picture.read_text(encoding="utf-8") == call(["graph", "--svg", str(plan)]).out
    assert text.read_text(encoding="utf-8") == call(["graph", str(plan)]).out


def test_the_picture_in_the_docs_is_current(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    ended = call(["graph", "--svg", "plans/esl/13-ways.esl"])
    assert (PAGE / "draw-a-plan.svg").read_text(encoding="utf-8") == ended.out


@pytest.mark.slow
def test_five_thousand_lines_are_drawn_in_little_more_time_than_they_are_checked(tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    piece = NEST.replace("work", "work-N").replace("halt", "halt-N").replace(")\n", ")\n\n")
    lines = 0
    with plan.open("w", encoding="utf-8") as file:
        while lines < 5000:
            file.write("(in-package :scs-user)\n" + piece.replace("-N", f"-{lines}"))
            lines += piece.count("\n") + 1
    begun = time.process_time()
    assert call(["check", str(plan)]).code == 0
    checked = time.process_time()
    assert call(["graph", "--svg", str(plan)]).code == 0
    assert time.process_time() - checked < 3 * (checked - begun) + 1
