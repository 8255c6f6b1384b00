"""Learning which action is good: to whom a reward is due, how it counts, what is kept (SCS Appendix A)."""

from __future__ import annotations

from io import StringIO
from pathlib import Path

import pytest

from eslang import Interpreter
from eslang.tools.expectations import failure_text
from support import lines_of, run

LEARNED = "(print (mapcar (lambda (b) (list (cdar b) (cdadr b))) (db-query '(scs::discount ?a ?f))))"


def said(text: str, seed: int = 0) -> str:
    """What TEXT prints, in one line."""
    return " ".join(line.strip() for line in lines_of(text, seed=seed))


# --- how fast ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("rate", "reward", "factors"),
    [
        ("t", "0", "0.9 0.81"),
        ("t", "1/2", "0.95 0.905"),
        ("t", "1", "1.0 1.0"),
        ("1/2", "0", "0.5 0.25"),
        ("1", "0.3", "0.3 0.3"),
        ("0", "0", "1.0 1.0"),
        ("rate", "0", "0.75 0.5625"),
    ],
)
def test_the_factor_moves_towards_the_reward(rate: str, reward: str, factors: str) -> None:
    text = f"(let ((rate 0.25)) (dotimes (i 2) (print (do-best :learn {rate} (t 5 (reinforce {reward}))))))"
    found = [float(word) for word in said(text).split()]
    assert found == pytest.approx([float(word) for word in factors.split()])


@pytest.mark.parametrize("rate", ["-1", "2", '"x"', ":fast"])
def test_a_rate_is_between_0_and_1(rate: str) -> None:
    came = run(f"(do-best :learn {rate} (t 5 1))")
    assert failure_text(came.failure).startswith(":TYPE-ERROR")


@pytest.mark.parametrize("reward", ["-0.1", "1.5", "t", "nil", '"good"'])
def test_a_reward_is_between_0_and_1(reward: str) -> None:
    step = f"(with-recovery-procedures ((:type-error (abort :no))) (reinforce {reward}))"
    assert said(f"(print (do-best :learn t (t 5 {step}))) {LEARNED}") == ":NO NIL"


@pytest.mark.parametrize("modifiers", ["", ":learn nil"])
def test_nothing_is_learned_unless_that_is_said(modifiers: str) -> None:
    came = run(f"(scs:do (do-best {modifiers} (t 5 1)) (reinforce 0))")
    assert failure_text(came.failure).startswith(":CONTROL-ERROR")


# --- what is chosen --------------------------------------------------------------------


def test_what_was_learned_changes_the_choice_and_is_unlearned_again() -> None:
    text = """(defvar *good* :b)
    (defun try () (do-best :learn 1/2 (t 5 (worth :a)) (t 4 (worth :b))))
    (defun worth (action) (reinforce (if (eq action *good*) 1 0)) action)
    (print (loop repeat 3 collect (try)))
    (setq *good* :a)
    (print (loop repeat 4 collect (try)))"""
    assert said(text) == "(:A :B :B) (:B :A :A :A)"


def test_an_action_is_known_by_its_text_wherever_it_stands() -> None:
    text = """(defstep left () 1)
    (scs:do (do-best :learn t (t 5 (left))) (reinforce 0))
    (scs:do (do-best :learn t ((= 1 1) 7 (left))) (reinforce 0))"""
    assert said(text + LEARNED) == "(((LEFT) 0.81))"


def test_a_choice_without_learning_does_not_look_at_what_was_learned() -> None:
    text = """(scs:do (do-best :learn 1 (t 5 (list :a))) (reinforce 0))
    (print (list (do-best (t 5 (list :a)) (t 4 :b)) (do-best :learn t (t 5 (list :a)) (t 4 :b))))"""
    assert said(text) == "((:A) :B)"


# --- to whom it is due ---------------------------------------------------------------------


def test_a_reward_is_due_to_the_choice_that_is_under_way_or_to_the_last() -> None:
    text = """(scs:do (do-best :learn t (t 5 (scs:do (do-best :learn t (t 1 (list :inner))) (reinforce 0)))))
    (scs:do (do-best :learn t (t 5 (list :last))) (reinforce 0))
    (defun choose () (do-best :learn t (t 5 (list :called))))
    (progn (choose) (reinforce 0))"""
    assert said(text + LEARNED) == "(((LIST :INNER) 0.9) ((LIST :LAST) 0.9) ((LIST :CALLED) 0.9))"


def test_each_branch_has_its_own_last_choice() -> None:
    text = """(do-all (scs:do (do-best :learn t (t 5 (list :a))) (yield) (reinforce 0))
                   (scs:do (do-best :learn t (t 5 (list :b))) (yield) (reinforce 0.5)))
    (print (db-query '(scs::discount (list :a) ?f))) (print (db-query '(scs::discount (list :b) ?f)))"""
    for seed in range(4):
        assert said(text, seed) == "(((?F . 0.9))) (((?F . 0.95)))"


def test_subtasks_of_the_chosen_step_may_tell_what_it_was_worth() -> None:
    text = "(do-best :learn t (t 5 (task-net (a (reinforce 0)))))"
    assert said(text + LEARNED) == "(((TASK-NET (A (REINFORCE 0))) 0.9))"


def test_what_a_step_spawns_is_no_part_of_it() -> None:
    text = """(do-best :learn t (t 5 (spawn (progn (sleep 1)
      (print (with-recovery-procedures ((:control-error (abort :nothing))) (reinforce 0)))))))"""
    assert said(text) == ":NOTHING"


def test_a_recovery_procedure_inside_the_step_may_tell() -> None:
    text = "(do-best :learn t (t 5 (with-recovery-procedures ((:x (abort (reinforce 0)))) (fail :x))))"
    assert "0.9" in said(text + LEARNED)


# --- it is facts -----------------------------------------------------------------------------


def test_what_was_learned_is_one_fact_for_each_action() -> None:
    text = "(dotimes (i 3) (scs:do (do-best :learn t (t 5 (list :a))) (reinforce 0)))"
    assert len(run(text + LEARNED).output.split("LIST")) == 2


def test_what_was_learned_can_be_forgotten() -> None:
    text = """(defun try () (do-best :learn 1 (t 5 (list :a)) (t 4 (list :b))))
    (progn (try) (reinforce 0)) (print (try)) (retract '(scs::discount ?_ ?_)) (print (try))"""
    assert said(text) == "(:B) (:A)"


def test_a_plan_may_be_told_what_was_learned_elsewhere() -> None:
    text = (
        "(assert '(scs::discount (list :a) 0.5)) (print (do-best :learn t (t 5 (list :a)) (t 4 (list :b))))"
    )
    assert said(text) == "(:B)"


def test_what_was_learned_is_saved_and_loaded_with_the_facts(tmp_path: Path) -> None:
    path = tmp_path / "learned.facts"
    choice = """(do-best :learn 0.5 (t 5 (scs:do (reinforce 0) (list :steep)))
                                    (t 4 (scs:do (reinforce 1) (list :flat))))"""
    with Interpreter(clock="virtual", output=StringIO()) as first:
        assert str(first.eval(f"(car {choice})")) == ":STEEP"
        first.call("save-facts", str(path))
    with Interpreter(clock="virtual", output=StringIO()) as second:
        assert str(second.eval(f"(car {choice})")) == ":STEEP"
    with Interpreter(clock="virtual", output=StringIO()) as third:
        third.call("load-facts", str(path))
        assert [str(third.eval(f"(car {choice})")) for _ in range(2)] == [":FLAT", ":FLAT"]
        assert third.eval("(length (db-query '(scs::discount ?a ?f)))") == 2


def test_a_cleanup_may_tell_what_the_choice_was_worth() -> None:
    text = "(unwind-protect (setq *done* t) (reinforce 0))"
    assert said(f"(defvar *done* nil) (print (do-best :learn 0.5 (t 5 {text}))) {LEARNED}").endswith("0.5))")
