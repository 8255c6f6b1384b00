"""The types of events and tasks."""

from __future__ import annotations

from support import lines_of


def test_a_task_is_an_event_and_not_the_other_way_round() -> None:
    text = """
    (let ((event (make-event)) (task (current-task)))
      (print (list (type-of event) (type-of task)))
      (print (list (typep event 'event) (typep event 'task) (typep task 'event) (typep task 'task)))
      (print (typecase task (event :event) (t :other)))
      (check-type task task))
    """
    assert lines_of(text) == ["(EVENT TASK)", "(T NIL T T)", ":EVENT"]
