"""NEXT-BINDINGS: whose continuation it is, and which cleanups run on the way."""

from __future__ import annotations

import pytest
from rounds import NUMBERS, TOOLS, came_to

from support import lines_of, run

# --- whose continuation it is ---------------------------------------------------------


def test_the_innermost_form_counts_even_if_it_has_no_more() -> None:
    text = f"""
    {NUMBERS} (assert '(tool saw))
    (with-query-bindings '(n ?x)
      (with-query-bindings '(tool ?y)
        (print (list #?x #?y))
        (next-bindings)))
    """
    assert came_to(text) == (["(0 SAW)"], ":NO-MORE-BINDINGS (TOOL ?Y)")


def test_in_a_procedure_the_form_around_it_counts() -> None:
    text = f"""
    {NUMBERS} {TOOLS}
    (with-query-bindings '(n ?x)
      (with-recovery-procedures (:bad (print (list :procedure #?x)) (next-bindings))
        (with-query-bindings '(tool ?x)
          (print #?x)
          (fail :bad))))
    """
    assert came_to(text) == (
        ["SAW", "(:PROCEDURE 0)", "SAW", "(:PROCEDURE 1)", "SAW", "(:PROCEDURE 2)"],
        ":NO-MORE-BINDINGS (N ?X)",
    )


def test_a_procedure_outside_of_the_form_has_none_of_its_bindings() -> None:
    text = f"""
    {NUMBERS}
    (with-recovery-procedures ((:bad (next-bindings)))
      (with-query-bindings '(n ?x) (fail :bad)))
    """
    assert came_to(text)[1] == ":CONTROL-ERROR NEXT-BINDINGS is called outside WITH-QUERY-BINDINGS"


def test_a_procedure_of_a_procedure_may_ask_for_the_next() -> None:
    """All combinations of two queries: the inner procedure turns "no more" into the outer one's cause."""
    text = f"""
    {NUMBERS} {TOOLS}
    (with-recovery-procedures ((:no-more-bindings (abort)))
      (with-query-bindings '(n ?x)
        (with-recovery-procedures ((:all-tools-tried (next-bindings)))
          (with-query-bindings '(tool ?y)
            (with-recovery-procedures ((:no-more-bindings (fail :all-tools-tried)))
              (with-recovery-procedures ((:useless (next-bindings)))
                (princ (list #?x #?y))
                (fail :useless)))))))
    """
    assert lines_of(text) == ["(0 SAW)(0 DRILL)(1 SAW)(1 DRILL)(2 SAW)(2 DRILL)"]


def test_a_form_inside_a_procedure_is_its_own() -> None:
    text = f"""
    {NUMBERS} {TOOLS}
    (with-query-bindings '(n ?x)
      (with-recovery-procedures
          ((:bad (with-query-bindings '(tool ?y)
                   (print (list #?x #?y))
                   (when (eq #?y 'saw) (next-bindings)))
                 (abort)))
        (fail :bad)))
    """
    assert lines_of(text) == ["(0 SAW)", "(0 DRILL)"]


def test_an_endless_general_procedure_answers_the_end_of_the_bindings_as_well() -> None:
    text = f"""
    {NUMBERS}
    (with-query-bindings '(n ?x)
      (with-recovery-procedures ((:no-more-bindings (abort (print :all-tried)))
                                 (:general-failure :retries :infinite (next-bindings)))
        (fail :useless #?x)))
    """
    assert lines_of(text) == [":ALL-TRIED"]


def test_a_failform_asks_for_the_next_of_the_form_around_the_guardian() -> None:
    text = f"""
    {NUMBERS} {TOOLS}
    (with-query-bindings '(n ?x)
      (with-guardian (sleep 1) (progn (print (list :guardian #?x)) (next-bindings))
        (with-query-bindings '(tool ?x)
          (print #?x)
          (sleep 5))))
    """
    assert came_to(text) == (
        ["SAW", "(:GUARDIAN 0)", "SAW", "(:GUARDIAN 1)", "SAW", "(:GUARDIAN 2)"],
        ":NO-MORE-BINDINGS (N ?X)",
    )


def test_a_guardian_sees_the_bindings_and_cannot_take_the_next() -> None:
    text = f"""
    {NUMBERS}
    (with-query-bindings '(n ?x)
      (with-guardian (progn (print (list :guardian #?x)) (next-bindings)) (fail :guardian-ended)
        (sleep 1)))
    """
    assert came_to(text) == (["(:GUARDIAN 0)"], ":GUARDIAN-ENDED")


def test_the_procedure_of_a_deadline_asks_for_the_next_of_its_own_form() -> None:
    text = f"""
    {NUMBERS} {TOOLS}
    (with-query-bindings '(n ?x)
      (with-recovery-procedures (:deadline-expired (print (list :late #?x)) (next-bindings))
        (with-deadline (1)
          (with-query-bindings '(tool ?x)
            (sleep (if (eq #?x 'saw) 0 9))
            (next-bindings)))))
    """
    assert came_to(text) == (["(:LATE 0)", "(:LATE 1)", "(:LATE 2)"], ":NO-MORE-BINDINGS (N ?X)")


def test_an_interrupt_asks_for_the_next_where_the_task_stands() -> None:
    text = f"""
    {NUMBERS} {TOOLS}
    (let ((task (current-task)))
      (spawn (progn (sleep 1)
                    (interrupt-task task (lambda () (print #?x) (next-bindings)))))
      (with-query-bindings '(n ?x)
        (with-query-bindings '(tool ?x)
          (sleep 5)
          (print (list :done #?x)))))
    """
    assert lines_of(text) == ["SAW", "(:DONE DRILL)"]


def test_a_test_of_the_query_stands_outside_of_its_form() -> None:
    """Whichever solution is looked for: #?X and NEXT-BINDINGS there are those of the form around."""
    text = f"""
    {NUMBERS}
    (defun test (x)
      (when (= x 1) (print (list :test #?x)) (next-bindings))
      t)
    (with-query-bindings '(n ?x)
      (with-query-bindings '(and (n ?x) (test ?x))
        (print (list :inner #?x))
        (next-bindings)))
    """
    assert came_to(text) == (
        ["(:INNER 0)", "(:TEST 0)", "(:INNER 0)", "(:TEST 1)", "(:INNER 0)", "(:TEST 2)"],
        ":NO-MORE-BINDINGS (N ?X)",
    )


def test_an_interrupt_may_ask_for_the_next_while_it_is_looked_for() -> None:
    """The guardian ends while the body's own NEXT-BINDINGS waits in a test."""
    text = f"""
    {NUMBERS}
    (defun slow (x) (sleep 1) t)
    (with-query-bindings '(and (n ?x) (slow ?x))
      (with-guardian (sleep 1/2) (next-bindings)
        (print #?x)
        (next-bindings)))
    """
    assert came_to(text) == (["0", "1", "2"], ":NO-MORE-BINDINGS (AND (N ?X) (SLOW ?X))")


@pytest.mark.parametrize(
    "form",
    [
        "(task-net (member (next-bindings)))",
        "(or-parallel (next-bindings))",
        "(let ((task (spawn (next-bindings) :name 'member))) (wait-for-task task))",
    ],
)
def test_in_another_task_the_continuation_is_refused(form: str) -> None:
    text = f"""
    {NUMBERS}
    (task-net
      (owner (with-query-bindings '(n ?x)
               (with-recovery-procedures ((:all-subtasks-failed (abort)))
                 {form}))))
    """
    came = run(text)
    story = " ".join(came.trace)
    assert "Failure :CONTROL-ERROR, no recovery available." in story


def test_the_refusal_names_the_task_that_the_bindings_belong_to() -> None:
    text = f"""
    {NUMBERS}
    (task-net (owner (with-query-bindings '(n ?x) (task-net (member (print #?x) (next-bindings))))))
    """
    words = "NEXT-BINDINGS is called in a task that did not enter WITH-QUERY-BINDINGS"
    assert came_to(text) == (["0"], f":CONTROL-ERROR {words}: its bindings belong to the task #<TASK owner>")


def test_a_form_that_the_other_task_enters_is_that_ones() -> None:
    text = f"""
    {NUMBERS} {TOOLS}
    (with-query-bindings '(n ?x)
      (task-net
        (a (with-query-bindings '(tool ?y) (if (eq #?y 'saw) (next-bindings) (print (list #?x #?y)))))
        (b (with-query-bindings '(tool ?y) (sleep 1) (print (list #?x #?y))))))
    """
    assert lines_of(text) == ["(0 DRILL)", "(0 SAW)"]


def test_what_the_body_started_is_ended_before_the_next_round() -> None:
    text = f"""
    {NUMBERS}
    (with-recovery-procedures ((:no-more-bindings (abort)))
      (with-query-bindings '(n ?x)
        (with-recovery-procedures ((:stuck (next-bindings)))
          (task-net
            (a (with-cleanup-procedure (print (list :left #?x)) (sleep 9)))
            (b (sleep 1) (fail :stuck))))))
    """
    assert lines_of(text) == ["(:LEFT 0)", "(:LEFT 1)", "(:LEFT 2)"]


# --- cleanups -------------------------------------------------------------------------


def test_cleanups_run_on_the_jump_that_answers_a_failure() -> None:
    text = f"""
    {NUMBERS}
    (with-query-bindings '(n ?x)
      (with-recovery-procedures (:bad (print :procedure) (next-bindings))
        (with-cleanup-procedure (print (list :outer #?x))
          (with-cleanup-procedure (print (list :inner #?x))
            (when (= #?x 0) (fail :bad))
            (print #?x)))))
    """
    assert lines_of(text) == [":PROCEDURE", "(:INNER 0)", "(:OUTER 0)", "1"]


def test_no_cleanup_runs_when_the_body_itself_asks_for_the_next() -> None:
    text = f"""
    {NUMBERS}
    (with-query-bindings '(n ?x)
      (with-cleanup-procedure (print :never)
        (if (= #?x 2) (print #?x) (next-bindings))))
    """
    assert lines_of(text) == ["2"]


def test_cleanups_run_when_there_are_no_more() -> None:
    text = f"""
    {NUMBERS}
    (with-query-bindings '(n ?x)
      (with-cleanup-procedure (print (list :left #?x))
        (next-bindings)))
    """
    assert came_to(text) == (["(:LEFT 2)"], ":NO-MORE-BINDINGS (N ?X)")


def test_a_cleanup_may_go_through_solutions_of_its_own() -> None:
    text = f"""
    {NUMBERS} {TOOLS}
    (with-query-bindings '(n ?x)
      (with-recovery-procedures (:bad (next-bindings))
        (with-cleanup-procedure (with-query-bindings '(tool ?y)
                                  (print (list #?x #?y))
                                  (when (eq #?y 'saw) (next-bindings)))
          (if (= #?x 0) (fail :bad) (print #?x)))))
    """
    assert lines_of(text) == ["(0 SAW)", "(0 DRILL)", "1"]


def test_unwind_protect_is_done_on_every_jump() -> None:
    text = f"""
    {NUMBERS}
    (with-query-bindings '(n ?x)
      (unwind-protect (when (< #?x 2) (next-bindings))
        (print #?x)))
    """
    assert lines_of(text) == ["0", "1", "2"]


# --- what stands around the rounds ---------------------------------------------------


def test_a_deadline_inside_is_set_anew_in_each_round_and_one_outside_is_not() -> None:
    round_trip = "(sleep 2) (print #?x) (when (< #?x 2) (next-bindings))"
    inside = f"{NUMBERS} (with-query-bindings '(n ?x) (with-deadline (3) {round_trip}))"
    outside = f"{NUMBERS} (with-deadline (3) (with-query-bindings '(n ?x) {round_trip}))"
    assert came_to(inside) == (["0", "1", "2"], "no failure")
    printed, failure = came_to(outside)
    assert (printed, failure.split()[0]) == (["0"], ":DEADLINE-EXPIRED")


def test_a_guardian_inside_guards_each_round_anew() -> None:
    text = f"""
    {NUMBERS}
    (with-query-bindings '(n ?x)
      (with-guardian (wait-until (stop #?x)) (print (list :stopped #?x))
        (sleep 1)
        (assert '(stop #?x))
        (sleep 1)
        (when (< #?x 1) (next-bindings))))
    """
    assert came_to(text) == (["(:STOPPED 0)", "(:STOPPED 1)"], "no failure")


def test_a_net_that_fails_is_answered_by_the_task_that_runs_it() -> None:
    text = f"""
    {NUMBERS}
    (with-query-bindings '(n ?x)
      (with-recovery-procedures ((:small (next-bindings)))
        (task-net
          (judge (sleep 1) (when (< #?x 2) (fail :small)))
          (clerk (with-cleanup-procedure (print (list :drop #?x)) (sleep 2) (print (list :file #?x)))))))
    """
    assert came_to(text) == (["(:DROP 0)", "(:DROP 1)", "(:FILE 2)"], "no failure")


def test_what_an_interrupt_enters_leaves_the_bindings_of_the_task_alone() -> None:
    text = f"""
    {NUMBERS} {TOOLS}
    (let ((task (spawn (with-query-bindings '(n ?x) (sleep 5) (print #?x)))))
      (sleep 1)
      (interrupt-task task (lambda ()
                             (with-query-bindings '(tool ?x)
                               (print #?x)
                               (when (eq #?x 'saw) (next-bindings)))))
      (wait-for-task task))
    """
    assert came_to(text) == (["SAW", "DRILL", "0"], "no failure")
