"""Tasks one by one: whom they belong to, what they begin with."""

from __future__ import annotations

from support import lines_of, run


def test_a_spawned_task_belongs_to_the_task_that_spawned_it() -> None:
    text = """
    (task-net (owner (spawn (progn (sleep 3) (print :spawned-ends))) (print :owner-body-ends))
              (other (wait-for-task owner) (print :owner-ends)))
    """
    assert lines_of(text) == [":OWNER-BODY-ENDS", ":SPAWNED-ENDS", ":OWNER-ENDS"]


def test_what_a_task_has_spawned_is_aborted_with_it() -> None:
    text = """
    (task-net :allow-failures
      (owner (spawn (with-cleanup-procedure (print :cleaned) (sleep 100)))
             (sleep 1)
             (fail :lost)))
    """
    assert lines_of(text) == [":CLEANED"]


def test_an_unseen_failure_is_the_owners() -> None:
    came = run("(task-net (owner (spawn (fail :lost 7)) (sleep 1)))")
    assert str(came.failure) == "failure :LOST 7"


def test_a_failure_that_was_seen_is_not_the_owners() -> None:
    text = """
    (task-net (owner (let ((child (spawn (fail :lost))))
                       (wait-for-task child)
                       (print (task-status child)))))
    """
    assert lines_of(text) == [":FAILED"]


def test_a_task_begins_with_a_copy_of_the_bindings_in_force() -> None:
    text = """
    (defvar *speed* 1)
    (let ((*speed* 2))
      (task-net (fast (setq *speed* 3) (yield) (print (list :fast *speed*)))
                (slow (yield) (print (list :slow *speed*))))
      (print (list :parent *speed*)))
    (print (list :global *speed*))
    """
    assert lines_of(text) == ["(:FAST 3)", "(:SLOW 2)", "(:PARENT 2)", "(:GLOBAL 1)"]


def test_a_jump_out_of_a_task_is_its_failure() -> None:
    came = run("(block nil (task-net (a (return 1))))")
    assert str(came.failure.cause) == ":CONTROL-ERROR"


def test_an_interrupt_may_ask_for_a_retry_where_a_retry_ends_the_time_slice() -> None:
    text = """
    (let* ((answered 0) (never (make-event))
           (sleeper (spawn (with-recovery-procedures ((:nudged :retries :infinite (incf answered) (retry)))
                             (wait-for-events never)))))
      (yield)
      (dotimes (round 2500)
        (interrupt-task sleeper (lambda () (fail :nudged)))
        (yield))
      (print answered)
      (abort-task sleeper))
    """
    assert lines_of(text)[-1] == "2500"
