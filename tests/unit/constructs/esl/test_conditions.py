"""Conditions: what one means wherever it stands, and how they are waited for."""

from __future__ import annotations

from io import StringIO

import pytest

from eslang import Interpreter
from eslang.tools.expectations import failure_text
from support import lines_of, run

AT_LAB = "(spawn (progn (sleep 1) (assert '(at robot lab))))"


def came_to(text: str) -> str:
    """How TEXT fails."""
    failure = run(text).failure
    return "no failure" if failure is None else failure_text(failure)


def holds(condition: str, before: str = "") -> bool:
    """Whether CONDITION holds after what was done BEFORE."""
    text = f"""
    {before}
    (print (with-recovery-procedures ((:no-applicable-method (abort :no)))
             (achieve {condition})))
    """
    (line,) = lines_of(text)
    return line == "NIL"


# --- what a condition means -----------------------------------------------------------


FACTS = """
(assert '(a 1)) (assert '(a 2)) (assert '(b 2)) (assert '(reading left 20)) (assert '(reading right 80))
(assert '(at robot (3 4)))
(defrelation c)
(defvar *limit* 50)
(defun two () 2)
(defun big (x) (> x *limit*))
"""


@pytest.mark.parametrize(
    ("condition", "expected"),
    [
        ("(a 1)", True),
        ("(a 3)", False),
        ("(a ?x)", True),
        ("(c ?x)", False),
        ("(unknown ?x)", False),
        ("(a (two))", False),
        ("`(a ,(two))", True),
        ("'(a 2)", True),
        ("'(and (a ?x) (b ?x))", True),
        ("(not (c ?x))", True),
        ("(not (a ?x))", False),
        ("(not '(a ?x))", False),
        ("(and)", True),
        ("(or)", False),
        ("(and (a ?x) (b ?x))", True),
        ("(and (b ?x) (reading ?x ?y))", False),
        ("(and (a ?x) (not (b ?x)))", True),
        ("(and (not (b ?x)) (a ?x))", True),
        ("(and (a ?x) (or (b ?x) (c ?x)))", True),
        ("(and (a ?x) (or '(b 1) (c ?x)))", False),
        ("(and (a ?x) (or '(b 2) (c ?x)))", True),
        ("(at robot (3 4))", True),
        ("(at robot (3 ?y))", True),
        ("(at robot (4 ?y))", False),
        ("(at robot (4 . 3))", False),
        ("(and (a ?x) (at robot (?x ?y)))", False),
        ("(and (a 1) (a 2) (> 3 2))", True),
        ("(and (a 1) (> 2 3))", False),
        ("(or (a 7) (and (a ?x) (b ?x)))", True),
        ("(or (c ?x) (> 3 2))", True),
        ("(not (and (a ?x) (c ?x)))", True),
        ("(not (or (c ?x) (a ?y)))", False),
        ("(and (reading ?s ?r) (> ?r *limit*))", True),
        ("(and (reading ?s ?r) (big ?r))", True),
        ("(and (reading ?s ?r) (big (+ ?r 1)) (eq ?s 'left))", False),
        ("(and (reading ?s ?r) (not (big ?r)))", True),
        ("(and (reading ?s ?r) (if (eq ?s 'left) (big ?r) nil))", False),
        ("(and (reading ?s ?r) (when (eq ?s 'right) (big ?r)))", True),
        ("(big 51)", True),
        ("(big 50)", False),
        ("t", True),
        ("nil", False),
        ("*limit*", True),
    ],
)
def test_a_condition_is_a_query_or_a_call_or_made_of_them(condition: str, expected: bool) -> None:
    assert holds(condition, FACTS) is expected
    assert holds(f"(not {condition})", FACTS) is not expected


def test_a_call_among_queries_stands_in_the_scope_of_the_condition() -> None:
    text = """
    (assert '(reading left 3)) (assert '(reading right 9))
    (defun watch-for (limit)
      (flet ((big (x) (> x limit)))
        (macrolet ((bigger (x) `(> ,x (+ limit 1))))
          (symbol-macrolet ((side 'right))
            (whenever (and (reading ?s ?r) (big ?r) (bigger ?r) (eq ?s side))
              (return (list #?s #?r)))))))
    (print (watch-for 5))
    """
    assert lines_of(text) == ["(RIGHT 9)"]


def test_a_local_function_is_called_even_if_a_relation_has_its_name() -> None:
    text = """
    (flet ((lamp (name) (print name) t))
      (print (achieve (lamp :hall))))
    """
    assert lines_of(text) == [":HALL", "NIL"]


def test_a_name_that_is_both_is_a_relation_from_its_declaration_on() -> None:
    text = """
    (defun lamp (name) (print (list :called name)) t)
    (defun look () (with-recovery-procedures ((:no-applicable-method (abort :dark))) (achieve (lamp :hall))))
    (print (look))
    (defrelation lamp)
    (print (look))
    (assert '(lamp :hall))
    (print (look))
    (print (lamp :attic))
    """
    assert lines_of(text) == ["(:CALLED :HALL)", "NIL", ":DARK", "NIL", "(:CALLED :ATTIC)", "T"]


def test_a_macro_may_be_a_condition() -> None:
    text = """
    (defmacro warm-p () '(> *degrees* 20))
    (defvar *degrees* 10)
    (task-net (a (wait-until (warm-p)) (print :warm))
              (b (setf *degrees* 25)))
    """
    assert lines_of(text) == [":WARM"]


def test_a_marked_variable_in_a_condition_is_its_binding() -> None:
    text = """
    (assert '(is-a hall room)) (assert '(is-a attic room))
    (spawn (progn (sleep 1) (assert '(lit hall)) (sleep 1) (assert '(lit attic))
                  (sleep 1) (retract '(lit ?_))))
    (with-recovery-procedures ((:no-more-bindings (abort)))
      (with-query-bindings '(is-a ?room room)
        (wait-until (lit #?room))
        (wait-until (and (lit #?room) (is-a #?room ?type)))
        (print #?room)
        (next-bindings)))
    (with-query-bindings '(is-a ?room room)
      (wait-until (not (lit #?room)))
      (print :dark))
    """
    assert lines_of(text) == ["HALL", "ATTIC", ":DARK"]


def test_a_condition_may_be_the_binding_of_a_variable() -> None:
    text = """
    (assert '(wanted (lit hall)))
    (spawn (progn (sleep 1) (assert '(lit hall))))
    (with-query-bindings '(wanted ?goal)
      (wait-until (not #?goal))
      (print :dark)
      (wait-until (and #?goal (lit ?room)))
      (print (db-query '(lit ?room))))
    """
    assert lines_of(text) == [":DARK", "(((?ROOM . HALL)))"]


def test_a_binding_stands_for_its_value_in_a_quoted_condition_too() -> None:
    text = """
    (assert '(wanted hall))
    (to-achieve (lit ?room) (t (assert '(lit #?room))))
    (spawn (progn (sleep 1) (assert '(dark hall))))
    (with-query-bindings '(wanted ?room)
      (wait-until '(dark #?room))
      (wait-until (and '(dark #?room) (not '(lit #?room))))
      (achieve '(lit #?room))
      (print (db-query '(lit ?x))))
    """
    assert lines_of(text) == ["(((?X . HALL)))"]
    assert came_to("(wait-until '(dark #?room))") == ":UNBOUND-VARIABLE ?ROOM"


def test_a_condition_with_a_function_that_is_not_yet_defined_is_a_call_later() -> None:
    text = """
    (defun look () (achieve (big (let ((y 2)) (+ y 1)))))
    (defun big (x) (print x))
    (print (look))
    """
    assert lines_of(text) == ["3", "NIL"]


@pytest.mark.parametrize(
    ("form", "failure"),
    [
        ("(wait-until '5)", ":TYPE-ERROR 5 LIST"),
        ("(wait-until '(?x 1))", ":TYPE-ERROR ?X RELATION"),
        ("(wait-until (and (a ?x) (> 'b ?x)))", ":TYPE-ERROR B NUMBER >"),
        ("(wait-until (and (a ?x) (> ?y 1)))", ":UNBOUND-LOGIC-VARIABLE ?Y"),
        ("(wait-until (and (a ?x) (fail :sensor-dead ?x)))", ":SENSOR-DEAD 1"),
        ("(wait-until (c #?x))", ":UNBOUND-VARIABLE ?X"),
        ("(with-query-bindings '(a ?x) (wait-until #?x))", ":TYPE-ERROR 1 LIST"),
        ("(wait-until (at robot . 3))", ":TYPE-ERROR"),
        ("(wait-until (and (a ?x) (c #?x)))", ":UNBOUND-VARIABLE ?X"),
        ("(wait-until `(c ,(fail :no-place)))", ":NO-PLACE"),
        ("(whenever '5 1)", ":TYPE-ERROR 5 LIST"),
        ("(achieve '5)", ":TYPE-ERROR 5 LIST"),
    ],
)
def test_what_is_wrong_in_a_condition_is_a_failure_of_the_one_who_asks(form: str, failure: str) -> None:
    assert came_to(f"{FACTS} {form}").startswith(failure)


# --- waiting --------------------------------------------------------------------------


def test_a_condition_that_holds_is_not_waited_for() -> None:
    assert lines_of("(assert '(a 1)) (print (wait-until (a ?x) :timeout 0))") == ["T"]


def test_wait_until_binds_nothing_and_whenever_binds_for_its_body() -> None:
    text = f"""
    {AT_LAB}
    (wait-until (at ?who lab))
    (print (with-recovery-procedures ((:unbound-variable (abort :unbound))) #?who))
    (print (whenever (at ?who lab) (return #?who)))
    (print (with-recovery-procedures ((:unbound-variable (abort :unbound))) #?who))
    """
    assert lines_of(text) == [":UNBOUND", "ROBOT", ":UNBOUND"]


def test_the_bindings_of_whenever_lie_over_those_around() -> None:
    text = """
    (assert '(is-a robot agent)) (assert '(at cup lab))
    (with-query-bindings '(is-a ?x agent)
      (whenever (at ?y lab)
        (print (list #?x #?y))
        (return))
      (whenever (at ?x lab)
        (print #?x)
        (return))
      (print #?x))
    """
    assert lines_of(text) == ["(ROBOT CUP)", "CUP", "ROBOT"]


def test_next_bindings_in_the_body_of_whenever_is_of_the_form_around() -> None:
    text = """
    (assert '(n 1)) (assert '(n 2)) (assert '(at cup lab))
    (with-query-bindings '(n ?n)
      (whenever (at ?x lab)
        (print (list #?n #?x))
        (if (= #?n 1) (next-bindings) (return))))
    """
    assert lines_of(text) == ["(1 CUP)", "(2 CUP)"]


def test_a_timeout_is_a_failure_with_its_seconds() -> None:
    text = "(task-net (a (wait-until (at robot lab) :timeout 3)) (b (sleep 1) (assert '(at robot dock))))"
    assert came_to(text) == ":TIMEOUT 3"


def test_a_fact_that_comes_before_the_timeout_is_in_time() -> None:
    assert lines_of(f"{AT_LAB} (print (wait-until (at robot lab) :timeout 2))") == ["T"]


def test_a_condition_that_nobody_can_change_is_a_deadlock_that_names_it() -> None:
    assert came_to("(wait-until (at robot lab))").startswith(
        ':DEADLOCK ("main" "the condition (at robot lab)"'
    )


def test_a_condition_that_came_and_went_within_a_step_is_not_seen() -> None:
    text = """
    (task-net
      (a (wait-until (alarm)) (print :alarm))
      (b (sleep 1) (assert '(alarm)) (retract '(alarm)) (print :over) (sleep 1) (assert '(alarm))))
    """
    assert lines_of(text) == [":OVER", ":ALARM"]


def test_a_change_while_the_condition_is_asked_is_not_lost() -> None:
    """The test of the condition waits; meanwhile the fact that it has looked at goes, and comes back."""
    text = """
    (defun slow () (sleep 2) t)
    (defrelation open)
    (task-net
      (a (wait-until (and (not (open door)) (slow))) (print :closed))
      (b (sleep 1) (assert '(open door)) (sleep 5) (retract '(open door))))
    """
    assert lines_of(text) == [":CLOSED"]


def test_whenever_runs_each_time_that_the_condition_becomes_true_and_for_each_solution() -> None:
    text = """
    (spawn (whenever (or (alarm fire) (alarm flood) (alarm storm)) (print :alarm)) :daemon t)
    (spawn (whenever (alarm ?what) (print #?what)) :daemon t)
    (dolist (step '((assert (alarm fire)) (assert (alarm flood)) (retract (alarm ?_)) (assert (alarm storm))))
      (sleep 1)
      (apply (first step) (rest step)))
    (sleep 1)
    """
    assert lines_of(text) == [":ALARM", "FIRE", "FLOOD", ":ALARM", "STORM"]


def test_whenever_is_woken_by_a_property() -> None:
    text = """
    (defproperty mode)
    (assert '(mode camera :idle))
    (spawn (whenever (mode camera :busy) (print (get-internal-real-time))) :daemon t)
    (dolist (mode '(:idle :busy :busy :idle :busy))
      (sleep 1)
      (assert `(mode camera ,mode)))
    (sleep 1)
    (print internal-time-units-per-second)
    """
    first, second, unit = map(int, lines_of(text))
    assert (first / unit, second / unit) == (2, 5)


def test_a_guardian_may_wait_for_a_fact() -> None:
    text = """
    (assert '(battery :ok))
    (print (with-recovery-procedures ((:battery-low (abort :home)))
             (with-guardian (wait-until (not (battery :ok))) (fail :battery-low)
               (sleep 2)
               (update '(battery ?_) '(battery :low))
               (sleep 2)
               :never)))
    """
    assert lines_of(text) == [":HOME"]


def test_who_stops_waiting_is_not_woken_any_more() -> None:
    text = """
    (defun look ()
      (with-recovery-procedures ((:timeout (abort))) (wait-until (at robot lab) :timeout 1)))
    (dotimes (i 3) (look))
    (let ((task (spawn (wait-until (at robot lab)) :daemon t)))
      (sleep 1)
      (abort-task task)
      (wait-for-task task))
    (or-parallel (wait-until (at robot lab)) (sleep 1))
    """
    with Interpreter(clock="virtual", output=StringIO()) as agent:
        agent.eval(text)
        assert [relation.watched for relation in agent.database.relations.values()] == [{}]
