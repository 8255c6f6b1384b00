"""SCS and ESL are one system: each stands inside the other, and nothing of either is lost (issue 6, 7)."""

from __future__ import annotations

import pytest

from eslang.tools.expectations import failure_text
from support import lines_of, run

NOW = "(defun now () (/ (get-internal-real-time) internal-time-units-per-second))"
MODES = "(defproperty mode (number)) (assert '(mode 1))"
POWER = """
(defproperty power (state))
(to-achieve (power ?state) (t (sleep 1) (update '(power ?_) '(power #?state))))
"""


def said(text: str, seed: int = 0) -> str:
    """What TEXT prints, in one line."""
    return " ".join(line.strip() for line in lines_of(NOW + text, seed=seed))


# --- tasks ---------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(3))
def test_constructs_are_tasks_of_a_net(seed: int) -> None:
    text = """(print (multiple-value-list
      (task-net (a (do-any 1 (fail :x))) (b (scs:do 3 4)) (c (repeat :while nil 1)))))"""
    assert said(text, seed) == "(1 4 :DEACTIVATED)"


def test_a_choice_that_fails_in_a_net_fails_it() -> None:
    came = run("(task-net (a (do-any (fail :x) (fail :y 2))) (b (repeat (sleep 1))))")
    assert failure_text(came.failure) == ":ALL-SUBTASKS-FAILED ((:X) (:Y 2))"


def test_a_net_inside_a_construct_that_is_left_is_cleaned_up_first() -> None:
    text = """(assert '(going))
    (print (scs:do :while (going)
      (task-net (a (with-cleanup-procedure (progn (sleep 1) (print :clean)) (sleep 10)))
                (b (sleep 1) (retract '(going)) (sleep 10)))))
    (print (now))"""
    assert said(text) == ":CLEAN :DEACTIVATED 2"


def test_a_child_of_a_net_acts_under_the_conditions_around_the_net() -> None:
    text = """(defvar *on* t)
    (print (scs:do :while *on*
      (task-net (a (scs:do (sleep 1) (setq *on* nil) (print :never)))
                (b (with-cleanup-procedure (print :clean) (sleep 10))))))
    (print (now))"""
    assert said(text) == ":CLEAN :DEACTIVATED 1"


def test_the_losers_of_or_parallel_may_be_constructs() -> None:
    text = """(print (or-parallel (with-cleanup-procedure (print :clean) (repeat (sleep 1)))
                           (scs:do (sleep 3) 7)))"""
    assert said(text) == ":CLEAN 7"


def test_what_a_step_spawns_outlives_it_and_is_under_none_of_its_conditions() -> None:
    text = """(defvar *on* t) (defvar *task* nil)
    (print (scs:do :while *on*
      (setq *task* (spawn (scs:do (sleep 1) (setq *on* nil) (print :goes-on))))
      (sleep 3)
      (print :never)))
    (sleep 1) (print (task-status *task*))"""
    assert said(text) == ":GOES-ON :DEACTIVATED :SUCCEEDED"


def test_what_is_spawned_has_the_bindings_of_the_condition() -> None:
    assert said("(assert '(near cup)) (do-first ((near ?what) (spawn (print #?what))))") == "CUP"


# --- failures ------------------------------------------------------------------------


def test_a_recovery_procedure_around_a_choice_hears_that_all_have_failed() -> None:
    text = """(print (with-recovery-procedures (((:all-subtasks-failed found) (abort found))
                                                ((:x) (abort :x)))
      (do-any (fail :x 1) (fail :y))))"""
    assert said(text) == "((:X 1) (:Y))"


def test_a_recovery_procedure_inside_a_step_answers_first() -> None:
    assert said("(print (do-any (with-recovery-procedures ((:x (abort :inside))) (fail :x))))") == ":INSIDE"


def test_a_failure_that_another_alternative_mends_is_not_heard_around() -> None:
    text = "(print (with-recovery-procedures ((:x (abort :heard))) (do-any (fail :x) :mended)))"
    assert {said(text, seed) for seed in range(5)} == {":MENDED"}


def test_retry_enters_the_choice_anew() -> None:
    text = """(let ((tries 0))
      (print (with-recovery-procedures ((:all-subtasks-failed :retries 3 (retry)))
               (do-any (if (< (incf tries) 3) (fail :x) tries) (fail :y)))))"""
    assert said(text) == "3"


def test_retry_begins_a_sequence_from_its_first_step() -> None:
    text = """(let ((tries 0))
      (with-recovery-procedures ((:x (retry)))
        (scs:do (princ :a) (if (= (incf tries) 1) (fail :x)) (princ :b))))"""
    assert said(text) == "AAB"


def test_a_procedure_that_gives_a_value_lets_the_step_go_on() -> None:
    assert said("(print (with-recovery-procedures ((:x 7)) (scs:do (list (fail :x)))))") == "(7)"


def test_a_recovery_procedure_inside_runs_under_the_conditions_around_it() -> None:
    text = """(print (do-first ((mode 2) :two)
      ((mode 1) (with-recovery-procedures ((:x (update '(mode ?_) '(mode 2)) (scs:do (print :never))))
                  (fail :x)))))"""
    assert said(MODES + text) == ":TWO"


def test_a_recovery_procedure_outside_is_under_none_of_the_conditions_inside() -> None:
    text = """(print (with-recovery-procedures ((:x (retract '(mode 1))
                                                    (scs:do (print :in) (print :out))
                                                    :on))
      (scs:do :while (mode 1) (fail :x) (print :never))))"""
    assert said(MODES + text) == ":IN :OUT :DEACTIVATED"


def test_the_failure_of_a_step_in_parallel_is_signalled_where_the_construct_stands() -> None:
    text = """(print (with-recovery-procedures (((:x . given) (print :answering) (abort given)))
      (do-all (scs:do (sleep 1) (fail :x 1))
              (with-cleanup-procedure (print :clean) (repeat (sleep 0.3))))))"""
    assert said(text) == ":CLEAN :ANSWERING (1)"


@pytest.mark.parametrize("form", ['(error "x")', "(car 5)", "(fail :x)", "(undefined-thing)", "(throw 'x 1)"])
def test_every_failure_of_lisp_is_one_of_the_step(form: str) -> None:
    assert said(f"(let ((tries 0)) (print (scs:do* (if (< (incf tries) 3) {form} tries))))") == "3"


def test_a_warning_is_no_failure() -> None:
    assert said('(print (do-any (progn (warn "x") (cl:signal "y") 2)))') == "2"


def test_a_condition_object_is_a_value_like_others() -> None:
    text = '(print (do-any (handler-case (error "x") (error (found) found))))'
    assert said(text) == '#<SIMPLE-ERROR "x">'


def test_next_bindings_starts_the_construct_around_anew() -> None:
    text = """(dolist (number '(1 2 3)) (assert `(box ,number)))
    (print (with-query-bindings '(box ?b) (do-any (scs:do (if (< #?b 3) (next-bindings)) #?b))))"""
    assert said(text) == "3"


# --- guardians, deadlines, locks, goals ------------------------------------------------


def test_a_guardian_interrupts_a_loop() -> None:
    text = """(let ((turns 0))
      (print (with-recovery-procedures ((:low (abort (list :stopped turns))))
               (with-guardian (wait-until (battery low)) (fail :low)
                 (repeat (if (= (incf turns) 5) (assert '(battery low))) (yield))))))"""
    assert said(text) == "(:STOPPED 5)"


def test_a_guardian_inside_a_loop_guards_each_round() -> None:
    text = """(let ((rounds 0))
      (print (repeat :while (< rounds 3) (incf rounds) (with-guardian (sleep 2) (fail :slow) (sleep 1))))
      (print (now)))"""
    assert said(text) == ":DEACTIVATED 2"


def test_a_deadline_around_a_choice_is_none_of_its_failures() -> None:
    text = """(print (with-recovery-procedures ((:deadline-expired (abort (now))))
      (with-deadline (1) (do*-any (sleep 5) (sleep 6)))))"""
    assert said(text) == "1"


def test_a_deadline_inside_a_step_is_a_failure_of_the_step() -> None:
    text = "(print (do-best (t 2 (with-deadline (1) (sleep 5))) (t 1 (list :other (now)))))"
    assert said(text) == "(:OTHER 1)"


def test_an_idle_choice_can_be_guarded() -> None:
    text = """(print (with-recovery-procedures ((:bored (abort (now))))
      (with-guardian (sleep 4) (fail :bored) (do-first ((alarm ?_) 1)))))"""
    assert said(text) == "4"


def test_a_step_that_is_left_gives_its_property_locks_back() -> None:
    text = """(print (do-first
      ((mode 2) (with-maintained-properties ((power :off)) (db-query '(power ?state))))
      ((mode 1) (with-maintained-properties ((power :on))
                  (scs:do (print (db-query '(power ?state)))
                          (update '(mode ?_) '(mode 2))
                          (print :never))))))"""
    assert said(POWER + MODES + text) == "(((?STATE . :ON))) (((?STATE . :OFF)))"


def test_an_owner_that_is_left_while_it_achieves_leaves_that_to_the_next() -> None:
    text = """
    (to-achieve (power ?state) (t (print :begins) (sleep 10) (update '(power ?_) '(power #?state))))
    (task-net
      (a (print (scs:do :while (mode 1) (with-maintained-properties ((power :on)) (print :never)))))
      (b (sleep 1) (with-maintained-properties ((power :on)) (print (now))))
      (c (sleep 3) (retract '(mode 1))))"""
    assert said(POWER + MODES + text) == ":BEGINS :DEACTIVATED :BEGINS 13"


def test_a_violation_is_a_failure_of_the_step() -> None:
    text = """(print (do-any (with-maintained-properties ((power :on))
                       (scs:do (update '(power ?_) '(power :off)) (sleep 1) (print :never)))))"""
    came = run(POWER + text)
    assert failure_text(came.failure) == ":ALL-SUBTASKS-FAILED ((:MAINTAINED-PROPERTY-VIOLATION (POWER :ON)))"


def test_a_method_may_be_a_construct_and_a_step_a_goal() -> None:
    text = """(defproperty at (place)) (assert '(at 0))
    (to-achieve (at ?place) (t (repeat :until (at #?place) (step-on))))
    (defaction step-on () (assert `(at ,(1+ (cdr (caar (db-query '(at ?x))))))))
    (print (do-best (t 1 (fail :lazy)) (t 2 (achieve (at 3)))))
    (print (db-query '(at ?x)))"""
    assert said(text) == "T (((?X . 3)))"


# --- cleanup -------------------------------------------------------------------------


def test_cleanup_procedures_may_be_constructs() -> None:
    text = """(print (scs:do :while (mode 1)
      (with-cleanup-procedure
          (scs:do (princ 1) (do*-any (fail :x) (princ 2)) (do-all (princ 3) (princ 3)))
        (scs:do (retract '(mode 1)) (print :never)))))"""
    assert said(MODES + text) == "1233 :DEACTIVATED"


def test_a_cleanup_procedure_that_fails_fails_instead() -> None:
    text = """(print (with-recovery-procedures ((:stuck (abort :recovered)))
      (scs:do :while (mode 1)
        (with-cleanup-procedure (fail :stuck) (scs:do (retract '(mode 1)) (print :never))))))"""
    assert said(MODES + text) == ":RECOVERED"


def test_a_cleanup_that_makes_the_condition_true_again_is_asked_for_a_new_choice() -> None:
    text = """(spawn (progn (sleep 1) (update '(mode ?_) '(mode 2))))
    (print (do-first ((mode 2) :two)
                     ((mode 1) (with-cleanup-procedure (update '(mode ?_) '(mode 1)) (sleep 10) (now)))))"""
    assert said(MODES + text) == "11"


def test_unwind_protect_and_special_bindings_are_undone() -> None:
    text = """(defvar *speed* 1)
    (scs:do :while (mode 1)
      (let ((*speed* 2)) (unwind-protect (scs:do (retract '(mode 1)) (print :never)) (print *speed*))))
    (print *speed*)"""
    assert said(MODES + text) == "2 1"
