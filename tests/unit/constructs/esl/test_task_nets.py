"""Task nets and OR-PARALLEL: what is left open of them by the papers (language reference §4)."""

from __future__ import annotations

from eslang.tools.expectations import failure_text
from support import lines_of, run

AS_PRINTED = """
(task-net
  (t1 (print 1)
      (checkpoint :cp)
      (checkpoint-wait t2 :cp)
      (print 3))
  (t2 (checkpoint-wait t1 :cp)
      (print 2)
      (wait-for-task t1)
      (print 4)))
"""


# --- values -----------------------------------------------------------------------


def test_the_values_of_a_net_are_its_childrens_in_textual_order() -> None:
    text = """
    (print (multiple-value-list
            (task-net (slow (sleep 3) :slow) (pair (values 1 2)) (none (values)) (fast :fast))))
    """
    assert lines_of(text) == ["(:SLOW 1 NIL :FAST)"]


def test_where_failures_are_allowed_a_child_that_did_not_succeed_gives_nil() -> None:
    text = """
    (print (multiple-value-list
            (task-net :allow-failures (a :a) (b (fail :lost)) (c (abort-task (current-task)) 3) (d :d))))
    """
    assert lines_of(text) == ["(:A NIL NIL :D)"]


def test_a_child_that_abort_task_aborts_does_not_fail_its_net() -> None:
    text = """
    (print (multiple-value-list
            (task-net (boss (sleep 1) (abort-task worker) :aborted-it)
                      (worker (with-cleanup-procedure (print :cleaned) (sleep 1000)))
                      (other (sleep 2) :other-goes-on))))
    """
    assert lines_of(text) == [":CLEANED", "(:ABORTED-IT NIL :OTHER-GOES-ON)"]


# --- failures ---------------------------------------------------------------------


def test_the_first_failure_is_the_nets() -> None:
    came = run("(task-net (a (sleep 2) (fail :second)) (b (sleep 1) (fail :first 1 2)))")
    assert failure_text(came.failure) == ":FIRST 1 2"


def test_a_failing_cleanup_of_a_sibling_does_not_replace_the_first_failure() -> None:
    came = run("""
    (task-net (a (with-cleanup-procedure (fail :cleanup-failed) (sleep 100)))
              (b (sleep 1) (fail :first)))
    """)
    assert failure_text(came.failure) == ":FIRST"
    assert "Failure :CLEANUP-FAILED, no recovery available." in came.trace


def test_procedures_around_a_net_are_not_asked_inside_its_children() -> None:
    text = """
    (with-recovery-procedures ((:slipped (print :answered-once) (abort)))
      (task-net (a (sleep 1) (fail :slipped)) (b (with-cleanup-procedure (print :b-left) (sleep 100)))))
    """
    assert lines_of(text) == [":B-LEFT", ":ANSWERED-ONCE"]


def test_a_procedure_that_runs_off_its_end_gives_the_net_its_value() -> None:
    text = """
    (print (with-recovery-procedures ((:lost :instead)) (list :net (task-net (a (fail :lost))))))
    """
    assert lines_of(text) == ["(:NET :INSTEAD)"]


def test_retry_runs_the_whole_net_again_with_new_tasks() -> None:
    text = """
    (defvar *tries* 0)
    (defvar *tasks* nil)
    (print (with-recovery-procedures ((:slipped :retries 5 (retry)))
             (task-net (a (push a *tasks*) (sleep 1) (if (< (incf *tries*) 3) (fail :slipped)) :held))))
    (print (list *tries* (mapcar #'task-status *tasks*)))
    """
    assert lines_of(text) == [":HELD", "(3 (:SUCCEEDED :FAILED :FAILED))"]


def test_a_failure_goes_through_nested_nets() -> None:
    text = """
    (defun note (what) (print what))
    (with-recovery-procedures (((:lost n) (print (list :outside n)) (abort)))
      (task-net (outer (task-net (inner (sleep 1) (fail :lost 7))
                                 (sibling (with-cleanup-procedure (note :sibling) (sleep 100)))))
                (cousin (with-cleanup-procedure (note :cousin) (sleep 100)))))
    """
    assert lines_of(text) == [":SIBLING", ":COUSIN", "(:OUTSIDE 7)"]


# --- ends -------------------------------------------------------------------------


def test_a_net_that_is_aborted_ends_its_children_first() -> None:
    text = """
    (let ((net (spawn (with-cleanup-procedure (print :parent)
                        (task-net (a (with-cleanup-procedure (progn (sleep 3) (print :child))
                                       (sleep 100))))))))
      (sleep 1)
      (abort-task net)
      (wait-for-task net)
      (print (task-status net)))
    """
    assert lines_of(text) == [":CHILD", ":PARENT", ":ABORTED"]


def test_a_net_that_a_deadline_leaves_ends_its_children_first() -> None:
    text = """
    (print (with-recovery-procedures ((:deadline-expired (abort :left)))
             (with-deadline (2)
               (task-net (a (with-cleanup-procedure (print :cleaned) (sleep 100)))))))
    """
    assert lines_of(text) == [":CLEANED", ":LEFT"]


def test_a_task_that_aborts_itself_leaves_its_siblings_alone() -> None:
    text = """
    (print (multiple-value-list
            (task-net (a (with-cleanup-procedure (print :cleaned) (abort-task a) (print :never)))
                      (b (sleep 1) (task-status a)))))
    """
    assert lines_of(text) == [":CLEANED", "(NIL :ABORTED)"]


def test_a_net_of_no_tasks_is_over_at_once() -> None:
    assert lines_of("(print (multiple-value-list (task-net)))") == ["NIL"]
    assert lines_of("(print (multiple-value-list (task-net :allow-failures)))") == ["NIL"]


# --- deadlock ---------------------------------------------------------------------


def test_the_example_as_printed_is_a_deadlock_and_the_report_tells_the_slip() -> None:
    """ESL-4.3-k: T2 never signals what T1 waits for, and the report says just that."""
    came = run(AS_PRINTED)
    assert came.output.split() == ["1", "2"]
    assert [(each.task, each.what, each.why) for each in came.failure.report.waiting] == [
        ("main", "the end of t1, t2", ""),
        (
            "t1",
            "checkpoint :cp of t2",
            "t2 never signals it: no (checkpoint :cp) stands in its body",
        ),
        ("t2", "the end of t1", ""),
    ]


def test_the_report_of_a_deadlock_tells_where_each_task_waits() -> None:
    came = run(AS_PRINTED, name="net.esl")
    places = [(each.place.line, each.place.column) for each in came.failure.report.waiting]
    assert places == [(2, 1), (5, 7), (9, 7)]


def test_a_deadlock_is_raised_where_the_run_waits_and_can_be_recovered_from() -> None:
    text = """
    (print (with-recovery-procedures ((:deadlock (abort :freed)))
             (task-net (a (with-cleanup-procedure (print :a-cleaned) (wait-for-task b)))
                       (b (with-cleanup-procedure (print :b-cleaned) (wait-for-task a))))))
    (print :goes-on)
    """
    assert lines_of(text) == [":A-CLEANED", ":B-CLEANED", ":FREED", ":GOES-ON"]


# --- or-parallel --------------------------------------------------------------------


def test_or_parallel_has_all_values_of_the_first_that_succeeds() -> None:
    text = """
    (print (multiple-value-list (or-parallel (progn (sleep 2) :late) (progn (sleep 1) (values 1 2 3)))))
    """
    assert lines_of(text) == ["(1 2 3)"]


def test_or_parallel_ends_only_when_all_it_started_has_ended() -> None:
    text = """
    (print (or-parallel (progn (sleep 1) :first)
                        (with-cleanup-procedure (progn (sleep 5) (print :second-cleaned)) (sleep 100))))
    """
    assert lines_of(text) == [":SECOND-CLEANED", ":FIRST"]


def test_or_parallel_lists_all_failures_in_textual_order() -> None:
    text = """
    (with-recovery-procedures (((:all-subtasks-failed failures) (print failures) (abort)))
      (or-parallel (progn (sleep 3) (fail :third 3)) (fail :first) (progn (sleep 1) (fail :second "2" 'b))))
    """
    assert lines_of(text) == ['((:THIRD 3) (:FIRST) (:SECOND "2" B))']


def test_or_parallel_of_nothing_has_nothing_that_could_succeed() -> None:
    assert failure_text(run("(or-parallel)").failure) == ":ALL-SUBTASKS-FAILED NIL"


def test_what_or_parallel_aborts_is_no_failure() -> None:
    text = """
    (defvar *other* nil)
    (print (or-parallel (progn (sleep 1) :first) (progn (setq *other* (current-task)) (loop (sleep 1)))))
    (print (task-status *other*))
    """
    assert lines_of(text) == [":FIRST", ":ABORTED"]


def test_identifiers_may_be_special_variables() -> None:
    text = """
    (defvar t2 nil)
    (task-net (t1 (checkpoint-wait t2 :cp) (print :t1))
              (t2 (checkpoint :cp) (print :t2)))
    """
    assert lines_of(text) == [":T2", ":T1"]
