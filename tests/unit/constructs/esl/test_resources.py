"""Resources: who has how much of what, who waits, and who makes room."""

from __future__ import annotations

import pytest

from eslang import EslError
from support import lines_of, run

NOW = "(defun now () (/ (get-internal-real-time) internal-time-units-per-second))"
POWER = "(define-resource power :capacity 100)"
USE = """
(defun use (name amount seconds &rest options)
  (with-recovery-procedures ((:resource-preempted (abort (print (list name :gave-way (now))))))
    (if options
        (with-resource (power amount) :priority (first options) (spend name seconds))
        (with-resource (power amount) (spend name seconds)))))
(defun spend (name seconds)
  (print (list name :from (now)))
  (with-cleanup-procedure (progn (sleep 1) (print (list name :shut-down (now)))) (sleep seconds))
  (print (list name :to (now))))
"""
WORLD = NOW + POWER + USE


def test_what_is_held_comes_back_however_the_body_is_left() -> None:
    text = """
    (block away (with-resource (power 60) (return-from away)))
    (print (resource-left 'power))
    (with-recovery-procedures ((:bad (abort))) (with-resource (power 60) (fail :bad)))
    (print (resource-left 'power))
    (let ((v (spawn (with-resource (power 60) (sleep 100)))))
      (yield) (print (resource-left 'power)) (abort-task v) (wait-for-task v))
    (print (resource-left 'power))
    (print (multiple-value-list (with-resource (power 60) (values 1 2))))
    """
    assert lines_of(WORLD + text) == ["100", "100", "40", "100", "(1 2)"]


def test_who_comes_first_is_served_first_and_nobody_overtakes() -> None:
    text = "(task-net (a (use :a 80 2)) (b (use :b 50 1)) (c (use :c 10 1)))"
    assert lines_of(WORLD + text) == [
        *("(:A :FROM 0)", "(:A :TO 2)", "(:B :FROM 2)", "(:C :FROM 2)", "(:B :TO 3)", "(:C :TO 3)")
    ]


def test_the_more_important_wait_before_the_less() -> None:
    text = """
    (task-net (a (use :a 100 2 9)) (b (sleep 0.5) (use :b 100 1)) (c (sleep 1) (use :c 100 1 1)))
    """
    assert [line.split()[0] for line in lines_of(WORLD + text)][::2] == ["(:A", "(:C", "(:B"]


def test_who_is_less_important_gives_way_with_its_cleanup() -> None:
    text = "(task-net (a (use :a 80 9)) (b (sleep 2) (use :b 50 1 5)))"
    assert lines_of(WORLD + text) == [
        *("(:A :FROM 0)", "(:A :GAVE-WAY 2)", "(:A :SHUT-DOWN 3)"),
        *("(:B :FROM 3)", "(:B :TO 4)"),
    ]


def test_only_as_many_give_way_as_it_takes_the_least_important_and_latest_first() -> None:
    text = """
    (task-net (a (use :a 30 9)) (b (sleep 0.5) (use :b 30 9)) (c (use :c 40 9 1))
              (d (sleep 2) (use :d 25 1 5)))
    """
    assert [line for line in lines_of(WORLD + text) if "GAVE-WAY" in line] == ["(:B :GAVE-WAY 2)"]


def test_nobody_gives_way_if_that_is_not_enough() -> None:
    text = """
    (task-net (a (use :a 30 9)) (b (use :b 60 9 7)) (d (sleep 2) (use :d 80 1 5)))
    """
    said = lines_of(WORLD + text)
    assert not [line for line in said if "GAVE-WAY" in line]
    assert said[-2:] == ["(:D :FROM 9)", "(:D :TO 10)"]


def test_who_holds_is_not_interrupted_for_its_own_child() -> None:
    text = "(use :outer 80 0) (with-resource (power 80) (task-net (inner (sleep 1) (use :inner 50 1 9))))"
    came = run(WORLD + text)
    assert str(came.failure.cause) == ":DEADLOCK"


def test_who_gave_up_waiting_interrupts_nobody() -> None:
    text = """
    (task-net (a (with-resource (power 80) (without-interrupts (sleep 3)) (print :undisturbed)))
              (b (sleep 1)
                 (with-recovery-procedures ((:deadline-expired (abort)))
                   (with-deadline (1) (with-resource (power 50) :priority 1 (print :never))))))
    """
    assert lines_of(WORLD + text) == [":UNDISTURBED"]


def test_a_procedure_inside_may_answer_and_keep_what_it_holds() -> None:
    text = """
    (task-net (a (with-resource (power 80)
                   (with-recovery-procedures ((:resource-preempted (print (failure-arguments)))) (sleep 5))
                   (print (list :done (now)))))
              (b (sleep 1) (with-resource (power 50) :priority 1 (print (now)))))
    """
    assert lines_of(WORLD + text) == ["(POWER #<TASK b>)", "(:DONE 5)", "5"]


def test_what_can_never_be_had_is_refused_at_once() -> None:
    came = run(WORLD + "(with-resource (power 101) 1)")
    assert (str(came.failure.cause), *map(str, came.failure.arguments)) == (
        *(":RESOURCE-EXHAUSTED", "POWER", "101", "100"),
    )


def test_who_does_not_wait_is_refused_when_others_are_before_it() -> None:
    text = """
    (task-net (a (use :a 60 2)) (b (use :b 50 1))
              (c (sleep 1)
                 (with-recovery-procedures ((:resource-exhausted (abort (print :later))))
                   (with-resource (power 10) :wait nil (print :now)))))
    """
    assert ":LATER" in lines_of(WORLD + text)


def test_what_is_consumable_does_not_come_back() -> None:
    text = """
    (define-resource fuel :capacity 50 :kind :consumable)
    (with-resource (fuel 20) (print (resource-left 'fuel)))
    (print (resource-left 'fuel))
    (print (consume 'fuel 25))
    (with-recovery-procedures (((:resource-exhausted &rest said) (print said)))
      (consume 'fuel 6))
    (print (replenish 'fuel 100))
    """
    assert lines_of(text) == ["30", "30", "5", "(FUEL 6 5)", "50"]


def test_wrong_resources_are_named() -> None:
    for form, said in {
        "(with-resource (pwer 1) 1)": "perhaps it is power",
        "(consume 'power 1)": "is renewable",
        "(with-resource (power -1) 1)": "-1",
        "(with-resource (power 1) :priority :high 1)": ":HIGH",
        "(define-resource fuel)": "POSITIVE-REAL",
        "(define-resource fuel :capacity 3 :kind :other)": ":OTHER",
        "(with-resource (power 1) (define-resource power :capacity 3))": "it is held",
    }.items():
        came = run(POWER + form)
        assert came.failure is not None and said in str(came.failure), (form, str(came.failure))


@pytest.mark.parametrize("options", [":prioritiy 3", ":priority 3 :waits nil"])
def test_an_option_that_there_is_not_is_refused(options: str) -> None:
    came = run(f"(defun f () (with-resource (power 30) {options} 1))")
    assert isinstance(came.error, EslError)
    assert "is no option" in str(came.error)


def test_a_keyword_that_is_the_body_is_its_value() -> None:
    assert lines_of(POWER + "(print (with-resource (power 30) :priority 3 :held))") == [":HELD"]
