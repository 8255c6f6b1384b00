"""Threads of execution: SUSPEND and RESUME, cycles, and tasks, events and interrupts in branches (SCS §3)."""

from __future__ import annotations

import pytest

from eslang.tools.expectations import failure_text
from support import lines_of, run

NOW = "(defun now () (/ (get-internal-real-time) internal-time-units-per-second))"


def said(text: str, seed: int = 0) -> str:
    """What TEXT prints, in one line."""
    return " ".join(line.strip() for line in lines_of(NOW + text, seed=seed))


# --- suspend and resume ------------------------------------------------------------------


def test_resume_hands_its_values_over_each_time() -> None:
    text = """(let ((task (spawn (dotimes (i 2) (print (multiple-value-list (suspend)))))))
      (yield) (print (resume task 1 2)) (print (resume task 3)) (yield) (print (resume task)) (yield)
      (print (task-status task)))"""
    assert said(text) == "T NIL (1 2) T NIL :SUCCEEDED"


@pytest.mark.parametrize(
    "task", ["(current-task)", "(spawn 1)", "(spawn (sleep 1) :daemon t)", "(spawn (fail :x))"]
)
def test_only_who_is_suspended_is_resumed(task: str) -> None:
    text = f"(let ((task {task})) (yield) (print (with-recovery-procedures ((:x 1)) (resume task))))"
    assert run(text).output.split()[-1] == "NIL"


@pytest.mark.parametrize("wrong", ["3", "nil", "(make-event)", ":main"])
def test_what_is_no_task_cannot_be_resumed(wrong: str) -> None:
    assert failure_text(run(f"(resume {wrong})").failure).startswith(":TYPE-ERROR")


def test_a_resume_before_the_suspend_is_lost() -> None:
    text = """(let ((task (spawn (progn (sleep 1) (print (suspend))))))
      (yield) (print (resume task :early)) (sleep 2) (print (resume task :late)))"""
    assert said(text) == "NIL T :LATE"


def test_whoever_is_never_resumed_is_in_a_deadlock() -> None:
    assert failure_text(run("(scs:do (suspend))").failure).startswith(":DEADLOCK")


def test_a_suspended_step_is_left_when_its_condition_ends() -> None:
    text = """(assert '(going)) (spawn (progn (sleep 1) (retract '(going))))
    (print (scs:do :while (going) (suspend) (print :never))) (print (now))"""
    assert said(text) == ":DEACTIVATED 1"


def test_a_suspended_task_can_be_aborted_and_times_out() -> None:
    text = """(let ((task (spawn (with-cleanup-procedure (print :clean) (suspend)))))
      (yield) (abort-task task) (sleep 1) (print (task-status task)))
    (print (with-recovery-procedures ((:deadline-expired (abort :late))) (with-deadline (1) (suspend))))"""
    assert said(text) == ":CLEAN :ABORTED :LATE"


def test_branches_hand_the_turn_to_one_another() -> None:
    text = """(let (ping)
      (do-all (scs:do (setq ping (current-task)) (princ (suspend)) (princ (suspend)))
              (scs:do (wait-until ping) (sleep 1) (resume ping :a) (sleep 1) (resume ping :b))))"""
    assert {said(text, seed) for seed in range(4)} == {"AB"}


# --- cycles ------------------------------------------------------------------------------


def test_a_cycle_that_lasts_too_long_is_followed_by_the_next_that_is_due() -> None:
    text = """(let ((n 0))
      (with-cycle (10) :while (< n 4) (princ (* 10 (now))) (princ " ") (if (= (incf n) 2) (sleep 0.35))))"""
    assert said(text) == "0 1 5 6"


def test_an_overrun_is_told() -> None:
    heard: list[str] = []
    run(
        "(let ((n 0)) (with-cycle (10) :while (< n 3) (if (= (incf n) 2) (sleep 0.35))))",
        listeners=[lambda event: heard.append(event.kind)],
    )
    assert heard.count("period-missed") == 1


@pytest.mark.parametrize("hz", ["10", "1/10"])
def test_a_cycle_is_left_between_two_rounds_when_a_fact_changes(hz: str) -> None:
    text = f"""(assert '(going)) (spawn (progn (sleep 0.25) (retract '(going))))
    (print (with-cycle ({hz}) :while (going) 1)) (print (now))"""
    assert said(text) == ":DEACTIVATED 1/4"


@pytest.mark.parametrize("hz", ["0", "-1", '"fast"', "nil", ":often"])
def test_a_frequency_is_above_zero(hz: str) -> None:
    assert failure_text(run(f"(with-cycle ({hz}) 1)").failure).startswith(":TYPE-ERROR")


def test_a_failing_step_ends_its_cycle() -> None:
    text = "(let ((n 0)) (with-cycle (2) (if (= (incf n) 3) (fail :broken n))))"
    assert failure_text(run(text).failure) == ":BROKEN 3"


# --- branches ------------------------------------------------------------------------------


def test_signals_reach_branches() -> None:
    text = """(let ((ready (make-event)))
      (do-all (scs:do (princ :a) (wait-for-events ready) (princ :c))
              (scs:do (sleep 1) (princ :b) (signal ready))))"""
    assert {said(text, seed) for seed in range(4)} == {"ABC"}


def test_checkpoints_are_those_of_the_branch() -> None:
    text = """(let (first)
      (do-all (scs:do (setq first (current-task)) (sleep 1) (checkpoint :there) (princ :a))
              (scs:do (sleep 0.5) (checkpoint-wait first :there) (princ :b) (sleep 1) (princ :c))))"""
    assert {said(text, seed) for seed in range(4)} <= {"ABC", "BAC"}


def test_each_branch_has_special_variables_of_its_own() -> None:
    text = """(defvar *speed* 0)
    (let ((*speed* 5))
      (do-all (scs:do (setq *speed* 6) (sleep 1) (print *speed*)) (scs:do (sleep 0.5) (print *speed*)))
      (print *speed*))"""
    assert said(text) == "5 6 5"


def test_branches_share_the_local_variables_around_them() -> None:
    assert said("(let ((n 0)) (do-all (scs:do (incf n) (incf n)) (incf n)) (print n))") == "3"


def test_a_branch_that_is_aborted_has_ended() -> None:
    text = """(let (branch)
      (print (do-all (scs:do (setq branch (current-task)) (sleep 5) (print :never))
                     (scs:do (sleep 1) (abort-task branch) (print :aborted)))))"""
    assert said(text) == ":ABORTED T"


def test_actions_of_branches_do_not_interleave() -> None:
    text = "(do-all (atomic (princ 1) (princ 2) (princ 3)) (atomic (princ 4) (princ 5) (princ 6)))"
    assert {said(text, seed) for seed in range(8)} == {"123456", "456123"}


# --- interrupts ------------------------------------------------------------------------------


def test_an_abort_waits_for_the_end_of_an_action() -> None:
    text = """(let ((task (spawn (with-cleanup-procedure (princ :c)
                                 (atomic (sleep 2) (princ :b))
                                 (princ :never)))))
      (sleep 1) (abort-task task) (princ :a) (sleep 3) (print (task-status task)))"""
    assert said(text) == "ABC :ABORTED"


def test_all_branches_of_an_aborted_task_are_cleaned_up() -> None:
    text = """(let ((task (spawn (do-all (with-cleanup-procedure (princ :x) (repeat (sleep 1)))
                                         (with-cleanup-procedure (princ :x) (repeat (sleep 1)))))))
      (sleep 3.5) (abort-task task) (sleep 1) (print (task-status task)))"""
    assert said(text) == "XX :ABORTED"


def test_an_interrupt_may_end_the_condition_of_the_step_that_it_finds() -> None:
    text = """(assert '(going))
    (let ((task (spawn (print (scs:do :while (going) (sleep 2) (print :never))))))
      (sleep 1) (interrupt-task task (lambda () (retract '(going)))) (wait-for-events task) (print (now)))"""
    assert said(text) == ":DEACTIVATED 1"


def test_what_an_interrupt_fails_with_is_no_failure_of_the_step() -> None:
    text = """(let ((task (spawn (do*-any (sleep 2) (sleep 3)))))
      (sleep 1) (interrupt-task task (lambda () (fail :kicked))) (yield) (yield)
      (print (task-status task)))"""
    assert run(text).output.split() == [":FAILED"]


# --- one action at a time ----------------------------------------------------------------------

SLOW = "(defaction slow (x) (princ x) (sleep 1) (princ x))"


@pytest.mark.parametrize(
    "form",
    [
        "(do-all (slow 1) (slow 2) (slow 3))",
        "(do-all (do-all (slow 1) (slow 2)) (slow 3))",
        "(do-all (scs:do (slow 1) (slow 2)) (progn (slow 3)))",
        "(do-all (atomic (do-all (slow 1) (slow 2))) (slow 3))",
    ],
)
def test_an_action_that_waits_keeps_its_turn(form: str) -> None:
    for seed in range(4):
        words = said(f"{SLOW} {form} (print (now))", seed)
        assert words.endswith(" 3")
        assert sorted(words[i : i + 2] for i in (0, 2, 4)) == ["11", "22", "33"]


def test_a_step_that_is_no_action_lets_others_act_while_it_waits() -> None:
    assert said("(do-all (scs:do (sleep 1) 1) (scs:do (sleep 1) 2)) (print (now))") == "1"


def test_an_action_that_fails_or_is_jumped_out_of_gives_its_turn_on() -> None:
    text = (
        SLOW
        + """(defaction try () (sleep 1) (fail :bad))
    (do-all (do-any (try) 0) (block out (atomic (return-from out 1))) (slow 1))"""
    )
    assert {said(text, seed) for seed in range(4)} == {"11"}


def test_a_branch_that_is_left_between_its_actions_cleans_up_when_it_is_its_turn() -> None:
    text = (
        SLOW
        + """(assert '(going))
    (do-all (scs:do :while (going) (with-cleanup-procedure (slow :c) (sleep 10)))
            (scs:do (sleep 0.5) (retract '(going)) (slow :a)))"""
    )
    assert {said(text, seed) for seed in range(4)} <= {"AACC", "CCAA"}


def test_an_action_that_waits_for_another_branch_is_a_deadlock() -> None:
    text = "(do-all (atomic (wait-until (ready ?_))) (scs:do (sleep 1) (assert '(ready 1))))"
    assert failure_text(run(text).failure).startswith(":DEADLOCK")


def test_separate_constructs_do_not_share_a_turn() -> None:
    text = SLOW + "(task-net (a (do-all (slow 1) (slow 1))) (b (do-all (slow 2) (slow 2)))) (print (now))"
    assert said(text).endswith(" 2")
