"""Guardians: what is left open of them by the papers (language reference §4)."""

from __future__ import annotations

from eslang.tools.expectations import failure_text
from support import lines_of, run


def test_a_guarded_body_has_its_values() -> None:
    assert lines_of(
        "(print (multiple-value-list (with-guardian (sleep 9) (fail :guarded) (sleep 1) (values 1 2))))"
    ) == ["(1 2)"]


def test_the_failure_of_a_guardian_is_not_that_of_the_body() -> None:
    came = run("(with-guardian (fail :sensor-dead 3) (fail :unguarded) (sleep 9))")
    assert failure_text(came.failure) == ":UNGUARDED"


def test_procedures_inside_the_body_answer_before_those_outside() -> None:
    text = """
    (with-recovery-procedures ((:guarded (print :outside) (abort)))
      (with-guardian (sleep 1) (fail :guarded)
        (with-recovery-procedures ((:guarded (print :inside) (abort)))
          (sleep 9))))
    """
    assert lines_of(text) == [":INSIDE"]


def test_a_body_that_goes_on_is_unguarded() -> None:
    text = """
    (defvar *alarms* 0)
    (print (with-guardian (sleep 1) (incf *alarms*) (dotimes (i 5) (sleep 1)) (list :done *alarms*)))
    """
    assert lines_of(text) == ["(:DONE 1)"]


def test_an_interrupted_wait_goes_on_for_what_is_left_of_it() -> None:
    text = """
    (defun seconds () (/ (get-internal-real-time) internal-time-units-per-second))
    (with-guardian (sleep 1) (print (list :warning (seconds)))
      (sleep 5))
    (print (seconds))
    """
    assert lines_of(text) == ["(:WARNING 1)", "5"]


def test_retry_inside_failforms_answer_guards_anew() -> None:
    text = """
    (defvar *tries* 0)
    (print (with-recovery-procedures ((:guarded :retries 5 (retry)))
             (with-guardian (sleep 2) (fail :guarded)
               (incf *tries*)
               (sleep (if (< *tries* 3) 10 1))
               (list :done-at *tries*))))
    """
    assert lines_of(text) == ["(:DONE-AT 3)"]


def test_a_guardian_that_ends_before_its_body_goes_on_is_heard_first() -> None:
    """What the body waits for has come in the same moment, but its task has not had its turn."""
    text = """
    (let ((end (make-event)))
      (spawn (progn (sleep 1) (signal end)))
      (with-guardian (sleep 1) (fail :guarded)
        (wait-for-events end)
        (print :never)))
    """
    came = run(text)
    assert (failure_text(came.failure), came.output) == (":GUARDED", "")


def test_a_body_that_does_not_wait_is_over_before_its_guardian_begins() -> None:
    text = """
    (print (with-guardian (print :never) (fail :guarded) :done))
    """
    assert lines_of(text) == [":DONE"]


def test_of_nested_guardians_each_interrupts_its_own_body() -> None:
    text = """
    (print (with-recovery-procedures ((:outer (abort :outer-answered)))
             (with-guardian (sleep 2) (fail :outer)
               (with-recovery-procedures ((:inner (print :inner-answered) (abort)))
                 (with-guardian (sleep 1) (fail :inner) (sleep 9)))
               (sleep 9)
               :never)))
    """
    assert lines_of(text) == [":INNER-ANSWERED", ":OUTER-ANSWERED"]


def test_an_outer_guardian_reaches_into_an_inner_body_and_ends_both_guardians() -> None:
    text = """
    (print (with-recovery-procedures ((:outer (abort :left)))
             (with-guardian (sleep 1) (fail :outer)
               (with-guardian (with-cleanup-procedure (print :inner-guardian-ended) (sleep 99)) (fail :inner)
                 (sleep 9)))))
    """
    assert lines_of(text) == [":INNER-GUARDIAN-ENDED", ":LEFT"]


def test_the_form_ends_only_when_the_guardian_has_ended() -> None:
    text = """
    (with-guardian (with-cleanup-procedure (progn (sleep 3) (print :guardian-ended)) (sleep 99))
        (fail :guarded)
      (sleep 1)
      (print :body-ended))
    (print :form-ended)
    """
    assert lines_of(text) == [":BODY-ENDED", ":GUARDIAN-ENDED", ":FORM-ENDED"]


def test_cleanups_of_the_body_are_not_interrupted() -> None:
    text = """
    (print (with-recovery-procedures ((:lost (abort :left)))
             (with-guardian (sleep 2) (print :never)
               (with-cleanup-procedure (progn (sleep 5) (print :cleaned))
                 (sleep 1)
                 (fail :lost)))))
    """
    assert lines_of(text) == [":CLEANED", ":LEFT"]


def test_without_interrupts_holds_a_guardian_off() -> None:
    text = """
    (with-recovery-procedures ((:guarded (abort (print :guarded))))
      (with-guardian (sleep 1) (fail :guarded)
        (without-interrupts (sleep 5) (print :not-interrupted))
        (print :never)))
    """
    assert lines_of(text) == [":NOT-INTERRUPTED", ":GUARDED"]


def test_a_guardian_that_is_aborted_raises_no_alarm() -> None:
    text = """
    (defvar *guardian* nil)
    (print (with-guardian (progn (setq *guardian* (current-task)) (sleep 99)) (fail :guarded)
             (sleep 1)
             (abort-task *guardian*)
             (sleep 1)
             (list :done (task-status *guardian*))))
    """
    assert lines_of(text) == ["(:DONE :ABORTED)"]


def test_a_jump_of_failform_cleans_the_body_up() -> None:
    text = """
    (print (block out
             (with-guardian (sleep 1) (return-from out :jumped)
               (with-cleanup-procedure (print :cleaned) (sleep 9)))))
    """
    assert lines_of(text) == [":CLEANED", ":JUMPED"]


def test_a_guardian_may_be_a_net_of_its_own() -> None:
    text = """
    (print (with-recovery-procedures (((:trouble what) (abort (list :trouble what))))
             (let ((seen nil))
               (with-guardian (or-parallel (progn (sleep 4) (setq seen :heat))
                                           (progn (sleep 2) (setq seen :dust)))
                   (fail :trouble seen)
                 (sleep 9)))))
    """
    assert lines_of(text) == ["(:TROUBLE :DUST)"]


def test_a_guarded_task_may_be_deadlocked_with_its_guardian() -> None:
    came = run("(with-guardian (wait-for-events (make-event 'alarm)) (fail :guarded) (wait-until nil))")
    assert failure_text(came.failure) == (
        ':DEADLOCK ("main" "the condition nil")'
        ' ("wait-for-events" "event alarm" "no task that is left signals it by name")'
    )


def test_a_procedure_outside_the_body_is_not_interrupted_by_the_guardian_inside() -> None:
    text = """
    (print (with-recovery-procedures ((:low (sleep 5) (abort :home)))
             (with-guardian (sleep 3) (fail :guard) (sleep 1) (fail :low))))
    (print (with-recovery-procedures ((:low (sleep 5) (abort :home)))
             (with-deadline (3) (sleep 1) (fail :low))))
    """
    assert lines_of(text) == [":HOME", ":HOME"]


def test_the_interrupt_comes_when_the_body_goes_on() -> None:
    text = """
    (print (with-recovery-procedures ((:guard (abort :guarded)) (:low (sleep 5) :mended))
             (with-guardian (sleep 3) (fail :guard)
               (sleep 1)
               (print (fail :low))
               (sleep 1))))
    """
    assert lines_of(text) == [":MENDED", ":GUARDED"]


def test_guardians_around_the_form_and_inside_the_procedure_do_interrupt_it() -> None:
    text = """
    (print (with-recovery-procedures ((:late (abort :late)))
             (with-guardian (sleep 3) (fail :late)
               (with-recovery-procedures ((:low (sleep 5) (abort :home))) (sleep 1) (fail :low)))))
    (print (with-recovery-procedures
               ((:low (with-recovery-procedures ((:late (abort :on-the-way)))
                        (with-guardian (sleep 1) (fail :late) (sleep 5)))))
             (with-guardian (sleep 3) (fail :guard) (fail :low))))
    """
    assert lines_of(text) == [":LATE", ":ON-THE-WAY"]
