"""Checkpoints: what is left open of them by the papers (language reference §4)."""

from __future__ import annotations

from eslang.tools.expectations import failure_text
from support import lines_of, run


def test_ids_are_the_same_if_they_are_equal() -> None:
    text = """
    (task-net (walker (checkpoint "Hall") (checkpoint '(room 7)) (checkpoint 1/2) (sleep 9))
              (guest (checkpoint-wait walker (list 'room 7)) (print :list)
                     (checkpoint-wait walker (concatenate 'string "Ha" "ll")) (print :string)
                     (checkpoint-wait walker (/ 2 4)) (print :ratio)))
    """
    assert lines_of(text) == [":LIST", ":STRING", ":RATIO"]


def test_strings_of_other_case_are_other_ids() -> None:
    came = run('(task-net (a (checkpoint "Hall")) (b (checkpoint-wait a "hall")))')
    assert failure_text(came.failure) == (
        ':DEADLOCK ("main" "the end of b") ("b" "checkpoint \\"hall\\" of a" "a has ended without it")'
    )


def test_a_checkpoint_may_be_passed_again() -> None:
    text = """
    (task-net (walker (dotimes (i 3) (checkpoint :lap) (sleep 1)) (print :three-laps))
              (guest (checkpoint-wait walker :lap) (checkpoint-wait walker :lap) (print :at-once)))
    """
    assert lines_of(text) == [":AT-ONCE", ":THREE-LAPS"]


def test_the_main_task_has_checkpoints_like_any_other() -> None:
    text = """
    (let* ((main (current-task))
           (other (spawn (progn (checkpoint-wait main :loaded) (print :loaded)))))
      (sleep 1)
      (print :loading)
      (checkpoint :loaded)
      (wait-for-task other))
    """
    assert lines_of(text) == [":LOADING", ":LOADED"]


def test_a_checkpoint_in_a_recovery_procedure_is_of_the_task_that_failed() -> None:
    text = """
    (task-net (walker (with-recovery-procedures ((:slipped (checkpoint :slipped) (abort)))
                        (sleep 1)
                        (fail :slipped)))
              (guest (checkpoint-wait walker :slipped) (print :seen)))
    """
    assert lines_of(text) == [":SEEN"]


def test_a_checkpoint_is_passed_before_who_waits_goes_on() -> None:
    """CHECKPOINT and CHECKPOINT-WAIT have no value of their own."""
    assert lines_of("(print (list (checkpoint :a) (checkpoint-wait (current-task) :a)))") == ["(NIL NIL)"]


def test_waiting_for_the_end_gives_all_values() -> None:
    text = """
    (let ((task (spawn (values 1 2 3))))
      (print (multiple-value-list (wait-for-task task)))
      (print (multiple-value-list (wait-for-task task))))
    """
    assert lines_of(text) == ["(1 2 3)", "(1 2 3)"]


def test_a_task_that_failed_or_was_aborted_has_ended_without_a_value() -> None:
    text = """
    (let ((failing (spawn (fail :lost))) (endless (spawn (loop (sleep 1)))))
      (print (list (wait-for-task failing) (task-status failing)))
      (abort-task endless)
      (print (list (wait-for-task endless) (task-status endless))))
    """
    assert lines_of(text) == ["(NIL :FAILED)", "(NIL :ABORTED)"]


def test_the_end_comes_after_the_cleanups() -> None:
    text = """
    (let ((task (spawn (with-cleanup-procedure (progn (sleep 5) (print :cleaned)) (sleep 1000)))))
      (sleep 1)
      (abort-task task)
      (wait-for-task task)
      (print :ended))
    """
    assert lines_of(text) == [":CLEANED", ":ENDED"]


def test_the_report_tells_a_checkpoint_that_its_task_has_missed() -> None:
    came = run("(task-net (a (if nil (checkpoint :cp)) :ended) (b (checkpoint-wait a :cp)))")
    assert [each.why for each in came.failure.report.waiting if each.task == "b"] == [
        "a has ended without it"
    ]


def test_the_report_tells_a_checkpoint_that_still_stands_ahead() -> None:
    came = run("""(task-net (a (checkpoint-wait b :b) (checkpoint :a))
                            (b (checkpoint-wait a :a) (checkpoint :b)))""")
    assert [(each.task, each.why) for each in came.failure.report.waiting[1:]] == [
        ("a", "b has not come to its (checkpoint :b)"),
        ("b", "a has not come to its (checkpoint :a)"),
    ]
