"""Choices: bindings and utilities, what they idle for, what becomes available again; many alternatives."""

from __future__ import annotations

import pytest

from eslang.tools.expectations import failure_text
from support import lines_of, run

NOW = "(defun now () (/ (get-internal-real-time) internal-time-units-per-second))"


def said(text: str, seed: int = 0) -> str:
    """What TEXT prints, in one line."""
    return " ".join(line.strip() for line in lines_of(NOW + text, seed=seed))


# --- bindings ------------------------------------------------------------------------


def test_variables_of_a_condition_are_bound_in_all_that_is_inside() -> None:
    text = """(assert '(object cup)) (assert '(weight cup 3))
    (defstep lift () (do-best ((weight #?what ?weight) (- #?weight) (list #?what #?weight))))
    (print (do-first ((object ?what) (scs:do :when (weight #?what ?_) (lift)))))
    (do-first ((object ?what) (do-all (princ #?what) (task-net (a (princ #?what))))))"""
    assert said(text) == "(CUP 3) CUPCUP"


def test_a_utility_has_the_bindings_of_its_own_condition() -> None:
    text = """(assert '(far cup 5)) (assert '(far pen 7))
    (print (do-best ((far cup ?d) #?d (list :cup #?d)) ((far pen ?d) #?d (list :pen #?d))))"""
    assert said(text) == "(:PEN 7)"


def test_an_inner_variable_of_the_same_name_hides_the_outer_one() -> None:
    text = "(assert '(a 1)) (assert '(b 2)) (print (scs:do :when (a ?x) (list (do-first ((b ?x) #?x)) #?x)))"
    assert said(text) == "(2 1)"


def test_a_marked_variable_in_a_condition_is_the_outer_one() -> None:
    text = """(assert '(a 1)) (assert '(b 2)) (assert '(b 1))
    (print (scs:do :when (a ?x) (do-first ((b #?x) #?x))))"""
    assert said(text) == "1"


def test_later_modifiers_know_the_variables_of_earlier_ones() -> None:
    text = """(assert '(at robot hall)) (assert '(door hall open))
    (print (scs:do :when (at robot ?room) :while (door #?room ?state) (list #?room #?state)))"""
    assert said(text) == "(HALL OPEN)"


def test_a_step_keeps_the_values_for_which_it_was_chosen() -> None:
    text = """(assert '(target 1)) (assert '(target 2))
    (do-first ((target ?x) (princ #?x) (retract '(target 1)) (princ #?x)))
    (do-first ((target ?x) (princ #?x)))"""
    assert said(text) == "112"


def test_lisp_tests_choose_among_the_values() -> None:
    text = "(assert '(level 3)) (assert '(level 8)) (print (do-first ((and (level ?x) (> ?x 5)) #?x)))"
    assert said(text) == "8"


def test_arguments_of_a_step_come_into_a_condition_by_a_backquote() -> None:
    text = """(assert '(at cup shelf))
    (defstep fetch (thing) (do-first (`(at ,thing ?where) #?where) (t :nowhere)))
    (defstep seek (thing) :when `(at ,thing ?where) #?where)
    (print (list (fetch 'cup) (fetch 'pen) (seek 'cup) (seek 'pen)))"""
    assert said(text) == "(SHELF :NOWHERE SHELF :DEACTIVATED)"


# --- utilities -------------------------------------------------------------------------


@pytest.mark.parametrize("utility", ['"much"', "nil", ":high", "(list 1)"])
def test_a_utility_that_is_no_number_is_a_failure(utility: str) -> None:
    came = run(f"(do-best (t {utility} 1) (t 2 3))")
    assert failure_text(came.failure).startswith(":TYPE-ERROR")


def test_utilities_may_be_of_all_kinds_of_numbers() -> None:
    text = "(print (do-best (t 1/3 :third) (t 0.25 :quarter) (t -5 :less) (nil 100 :never)))"
    assert said(text) == ":THIRD"


def test_a_utility_that_fails_fails_the_choice_and_not_the_step() -> None:
    text = """(print (with-recovery-procedures ((:unknown (abort :outside))
                                                (:all-subtasks-failed (abort :wrong)))
      (do-best (t (fail :unknown) 1) (t 2 3))))"""
    assert said(text) == ":OUTSIDE"


def test_utilities_are_asked_only_where_conditions_hold() -> None:
    text = "(print (do-best ((= 1 2) (fail :asked) 1) (t 2 :other)))"
    assert said(text) == ":OTHER"


def test_equal_utilities_are_chosen_among_by_chance() -> None:
    assert {said("(print (do-best (t 1 :a) (t 1.0 :b) (t 1 :c)))", seed) for seed in range(9)} == {
        ":A",
        ":B",
        ":C",
    }


# --- idling ------------------------------------------------------------------------------


def test_a_choice_waits_for_a_fact_a_variable_a_rule_or_a_relation_to_come() -> None:
    text = """(defvar *up* nil) (defrelation warm)
    (spawn (progn (sleep 1) (setq *up* t) (sleep 1) (defrule (warm) (= 1 1))
                  (sleep 1) (assert '(new-thing 1))))
    (print (list (do-first (*up* (now))) (do-best ((warm) 1 (now))) (do-first ((new-thing ?_) (now)))))"""
    assert said(text) == "(1 2 3)"


def test_a_choice_waits_for_a_local_variable_that_a_branch_sets() -> None:
    text = "(let ((ready nil)) (do-all (scs:do (sleep 1) (setq ready t)) (do-first (ready (print (now))))))"
    assert said(text) == "1"


@pytest.mark.parametrize("condition", ["*on*", "(going)"])
def test_what_stands_around_an_idle_choice_is_asked_meanwhile(condition: str) -> None:
    text = f"""(defvar *on* t) (assert '(going))
    (spawn (progn (sleep 1) (setq *on* nil) (retract '(going)) (sleep 1)))
    (print (scs:do :while {condition} (do-first ((never 1) 2)))) (print (now))"""
    assert said(text) == ":DEACTIVATED 1"


def test_a_choice_that_nothing_can_wake_is_a_deadlock_that_can_be_recovered() -> None:
    text = "(print (with-recovery-procedures ((:deadlock (abort :dead))) (do-first ((going) 1))))"
    assert said(text) == ":DEAD"


def test_conditions_that_read_lisp_see_each_change_of_it() -> None:
    text = """(defvar *limit* 3) (assert '(level 5))
    (defun above (x) (> x *limit*)) (defrule (hot) (level ?x) (above ?x))
    (print (scs:do :while (hot) 1 (setq *limit* 10) (print :never)))
    (setq *limit* 3)
    (print (scs:do :while (and (level ?x) (> ?x *limit*)) 1 (setq *limit* 10) (print :never)))"""
    assert said(text) == ":DEACTIVATED :DEACTIVATED"


def test_a_condition_over_facts_alone_is_not_asked_after_each_action() -> None:
    text = """(defvar *asked* 0) (defun look () (incf *asked*) t) (assert '(going))
    (scs:do :while (or (going) (look)) 1 2 3) (print *asked*)
    (scs:do :while (and (going) (look)) 1 2 3) (print *asked*)"""
    assert said(text) == "0 4"


# --- outcomes ------------------------------------------------------------------------------


def test_a_deactivated_alternative_is_available_again_when_another_was_tried() -> None:
    text = """(defvar *open* nil)
    (print (do-best (t 2 (scs:do :when *open* (list :through)))
                    (t 1 (progn (setq *open* t) (fail :knocked)))))"""
    assert said(text) == "(:THROUGH)"


@pytest.mark.parametrize("name", ["do-any", "do-best", "do-first"])
def test_a_choice_of_nothing_fails(name: str) -> None:
    assert failure_text(run(f"({name})").failure) == ":ALL-SUBTASKS-FAILED NIL"


@pytest.mark.parametrize("name", ["scs:do", "scs:do*", "atomic"])
def test_a_sequence_of_nothing_succeeds(name: str) -> None:
    assert said(f"(print ({name}))") == "NIL"


@pytest.mark.parametrize("name", ["do-all", "do*-all"])
def test_nothing_in_parallel_succeeds(name: str) -> None:
    assert said(f"(print ({name}))") == "T"


def test_a_clause_may_have_no_steps() -> None:
    assert said("(print (list (do-first (t)) (do-best (t 1)) (scs:do :when t)))") == "(NIL NIL NIL)"


@pytest.mark.slow
def test_a_loop_of_nothing_can_be_left() -> None:
    text = (
        "(print (with-recovery-procedures ((:deadline-expired (abort :late))) (with-deadline (1) (repeat))))"
    )
    assert said(text) == ":LATE"


@pytest.mark.slow
def test_there_may_be_hundreds_of_alternatives() -> None:
    text = """
    (print (eval `(do-any ,@(loop for i from 1 to 300 collect (if (= i 300) :last '(fail :x))))))
    (print (eval `(do-first ,@(loop for i from 1 to 300 collect `((n ,i) ,i)) (t :none))))
    (print (eval `(do-best ,@(loop for i from 1 to 300 collect `(t ,i ,i)))))
    (print (eval `(do-all ,@(loop for i from 1 to 300 collect 1))))"""
    assert said(text) == ":LAST :NONE 300 T"
