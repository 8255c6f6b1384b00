"""What wakes a task that waits for a condition over facts, and how often it asks (decision 19)."""

from __future__ import annotations

from io import StringIO
from typing import Any

import pytest

from eslang import Interpreter
from support import lines_of, run


class Questions:
    """How often the database was asked whether a condition holds, by the waits of a plan."""

    def __init__(self, text: str) -> None:
        self.count = 0
        output = StringIO()
        with Interpreter(clock="virtual", output=output) as agent:
            ask = agent.database.ask

            def counted(*given: Any) -> Any:
                self.count += 1
                return ask(*given)

            agent.database.ask = counted  # type: ignore[method-assign]
            agent.eval(text)
        self.lines = output.getvalue().split()


FAR = "(defrule (far ?x) (is-a ?x agent) (not (at ?x lab)))"
MOVES = "(dotimes (i 5) (sleep 1) (assert (list 'temperature i)))"


@pytest.mark.parametrize(
    ("condition", "before", "changes", "count"),
    [
        # condition, what is there, what is done one second after the other, questions
        ("(at robot lab)", "", "((assert (at robot lab)))", 2),
        ("(at robot lab)", "", "((assert (at cup lab)) (assert (at robot dock)) (assert (at robot lab)))", 2),
        ("(at ?who lab)", "", "((assert (at cup dock)) (assert (at robot lab)))", 2),
        (
            "(not (at robot ?_))",
            "(assert '(at robot lab))",
            "((assert (at cup lab)) (retract (at robot lab)))",
            2,
        ),
        # another fact keeps it false: that has to be looked at
        (
            "(not (at robot ?_))",
            "(assert '(at robot lab)) (assert '(at robot dock))",
            "((retract (at robot lab)) (retract (at robot dock)))",
            3,
        ),
        (
            "(near robot)",
            "(defrule (near ?x) (at ?x lab))",
            "((assert (at cup lab)) (assert (at robot lab)))",
            2,
        ),
        ("(near robot)", "", "((assert (at robot lab)) (defrule))", 2),
        ("(and (a ?x) (b ?x))", "(assert '(a 1))", "((assert (b 2)) (assert (c 1)) (assert (b 1)))", 2),
        (
            "(far robot)",
            FAR,
            "((assert (is-a robot agent)))",
            2,
        ),
        (
            "(far robot)",
            f"{FAR} (assert '(is-a robot agent)) (assert '(at robot lab))",
            "((retract (at cup lab)) (assert (at cup lab)) (retract (at robot lab)))",
            2,
        ),
    ],
)
def test_a_condition_is_asked_again_when_what_it_rests_on_has_changed(
    condition: str, before: str, changes: str, count: int
) -> None:
    text = f"""
    {before}
    (task-net
      (waiter (wait-until {condition}) (print :woken))
      (world {MOVES}
             (dolist (change '{changes})
               (sleep 1)
               (if (eq (first change) 'defrule)
                   (defrule (near ?x) (at ?x lab))
                   (apply (first change) (rest change))))))
    """
    asked = Questions(text)
    assert (asked.lines, asked.count) == ([":WOKEN"], count)


STEADY = """
(defvar *limit* 15)
(defun big (x) (> x 15))
(defrule (high ?x) (n ?x) (> ?x 15))
(assert '(n 1))
"""


@pytest.mark.parametrize(
    ("condition", "count"),
    [
        ("(and (n ?x) (> ?x 15))", 2),
        ("'(and (n ?x) (> ?x 15))", 2),
        ("(high ?x)", 2),
        ("(and (n ?x) (not (< ?x 15)))", 2),
        ("(and (n ?x) (eql ?x '20))", 2),
        ("(and (n ?x) (member ?x '(20 30)))", 2),
        ("'(and (n ?x) (> ?x (+ 5 10)))", 2),
        ("(and (n ?x) (not (= ?x 1)) (big ?x))", 2),  # BIG was not asked before there was another N
        # what these ask may change at any step
        ("(and (n ?x) (> ?x *limit*))", 8),
        ("'(and (n ?x) (> ?x *limit*))", 8),
        ("(and (n ?x) (big ?x))", 8),
        ("'(and (n ?x) (member ?x '(20) :test 'same))", 8),
    ],
)
def test_a_comparison_does_not_ask_lisp(condition: str, count: int) -> None:
    text = f"""
    {STEADY}
    (defun same (a b) (= a b))
    (task-net
      (waiter (wait-until {condition}) (print :woken))
      (world {MOVES} (sleep 1) (assert '(n 20))))
    """
    asked = Questions(text)
    assert (asked.lines, asked.count) == ([":WOKEN"], count)


def test_of_many_waiting_tasks_only_the_one_concerned_asks_again() -> None:
    text = """
    (let ((tasks (loop for i from 0 below 100
                       collect (let ((i i)) (spawn (wait-until `(arrived ,i)))))))
      (yield)
      (assert '(arrived 42))
      (yield)
      (print (task-status (nth 42 tasks)))
      (print (count :waiting (mapcar #'task-status tasks)))
      (mapc #'abort-task tasks))
    """
    asked = Questions(text)
    assert (asked.lines, asked.count) == ([":SUCCEEDED", "99"], 101)


def test_recursive_rules_wake_as_well() -> None:
    text = """
    (defrule (reaches ?x ?y) (way ?x ?y))
    (defrule (reaches ?x ?z) (reaches ?x ?y) (way ?y ?z))
    (assert '(way a b)) (assert '(way c d)) (assert '(way b a))
    (task-net
      (there (wait-until (reaches a d)) (print :there))
      (cut-off (wait-until (and (way c d) (not (reaches a c)) (reaches a d2))) (print :never))
      (world (sleep 1) (assert '(way x y)) (sleep 1) (assert '(way b c)) (sleep 1) (abort-task cut-off)))
    """
    asked = Questions(text)
    assert asked.lines == [":THERE"]


def test_a_condition_that_asks_lisp_as_well_is_woken_by_facts_and_looked_at_after_steps() -> None:
    text = """
    (defvar *ready* nil)
    (task-net
      (by-fact (wait-until (or (at robot lab) *ready*)) (print :by-fact))
      (by-lisp (wait-until (or (at cup lab) *ready*)) (print :by-lisp))
      (world (sleep 1) (assert '(at robot lab)) (sleep 1) (setf *ready* t)))
    """
    assert lines_of(text) == [":BY-FACT", ":BY-LISP"]


def test_parts_without_variables_are_asked_before_the_others() -> None:
    text = """
    (defvar *order* nil)
    (defun ready () (push :ready *order*) t)
    (defun note (x) (push x *order*) t)
    (assert '(a 1))
    (achieve (and (a ?x) (note ?x) (ready)))
    (print (reverse *order*))
    """
    assert lines_of(text) == ["(:READY 1)"]


def test_what_changes_while_a_test_of_the_condition_waits_is_not_lost() -> None:
    text = """
    (defun slow-p (x) (sleep 1) t)
    (assert '(cup 1)) (assert '(cup 2))
    (spawn (progn (sleep 3.5) (assert '(clean 2))))
    (sleep 1)
    (print (wait-until (and (cup ?x) (slow-p ?x) (clean ?x)) :timeout 100))
    """
    asked = Questions(text)
    assert asked.lines == ["T"]
    assert asked.count < 6


def test_parts_of_a_condition_that_are_true_one_after_the_other_are_not_true(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("eslang.facts.views.SLICE", 1)  # queries give way after every row
    text = """
    (dotimes (i 20) (assert (list 'row i)))
    (assert '(last 19)) (assert '(on a))
    (spawn (progn (wait-until '(begin)) (sleep 0) (update '(on ?_) '(on b))) :daemon t)
    (spawn (progn (sleep 1) (assert '(begin))) :daemon t)
    (print (with-recovery-procedures (:timeout (abort :never))
      (wait-until (and (begin) '(and (on a) (row ?y) (last ?y)) (on b)) :timeout 100)))
    """
    assert lines_of(text)[-1] == ":NEVER"


def test_what_stands_under_a_backquote_is_computed_once() -> None:
    text = """
    (defvar *computed* 0)
    (defun which () (incf *computed*) 3)
    (spawn (dotimes (i 5) (sleep 1) (assert `(at cup ,i))))
    (wait-until (and `(at cup ,(which)) (not `(at cup ,(1+ (which))))))
    (print *computed*)
    (whenever `(at cup ,(1+ (which))) (return))
    (print *computed*)
    (to-achieve (lit ?n) (t (assert '(lit #?n))))
    (achieve `(lit ,(which)))
    (print *computed*)
    """
    asked = Questions(text)
    assert asked.lines == ["2", "3", "4"]
    assert asked.count < 10


# --- whenever there are solutions -----------------------------------------------------


def test_whenever_serves_each_solution_once() -> None:
    text = """
    (task-net (server (whenever (order ?x)
                        (print #?x) (sleep 2) (retract '(order #?x)) (if (eq #?x 'last) (return))))
              (client (dolist (each '(soup tea)) (assert `(order ,each)))
                      (sleep 20) (assert '(order bill)) (sleep 3) (assert '(order last))))
    """
    assert lines_of(text) == ["SOUP", "TEA", "BILL", "LAST"]


def test_whenever_serves_a_solution_again_only_when_it_was_none_in_between() -> None:
    text = """
    (assert '(p 1)) (assert '(p 2))
    (let ((n 0))
      (task-net (server (whenever (p ?x) (print #?x) (if (= (incf n) 3) (return))))
                (other (sleep 1) (assert '(q)) (retract '(p 1)) (sleep 1) (print :back) (assert '(p 1)))))
    """
    assert lines_of(text) == ["1", "2", ":BACK", "1"]


def test_whenever_takes_a_query_that_is_data_and_parts_that_are_lisp() -> None:
    text = """
    (defvar *least* 5)
    (task-net (a (whenever '(n ?x) (return (print #?x))))
              (b (whenever (and (n ?x) (> ?x *least*)) (return (print (list :large #?x)))))
              (c (assert '(n 3)) (sleep 1) (assert '(n 4)) (sleep 1) (setq *least* 3)))
    """
    assert lines_of(text) == ["3", "(:LARGE 4)"]


def test_whenever_that_waits_for_more_is_a_deadlock_when_there_is_nobody() -> None:
    came = run("(assert '(p 1)) (whenever (p ?x) (print #?x))")
    assert (came.output.strip(), str(came.failure.cause)) == ("1", ":DEADLOCK")
