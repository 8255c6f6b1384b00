"""WITH-QUERY-BINDINGS: what its bindings mean, which they are, and what comes when there are no more."""

from __future__ import annotations

import pytest
from rounds import NUMBERS, TOOLS, came_to

from support import lines_of, run

# --- the form -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("form", "message"),
    [
        ("(with-query-bindings)", "`with-query-bindings` takes at least 1 argument, found 0"),
        (
            "(with-query-bindings '(n ?x) :inherit-binding 1)",
            "with-query-bindings has no option `:inherit-binding`",
        ),
        ("(with-query-bindings '(n ?x) :retries 3 1)", "with-query-bindings has no option `:retries`"),
    ],
)
def test_a_form_that_is_written_wrongly_is_refused(form: str, message: str) -> None:
    error = run(form).error
    assert error is not None and error.diagnostic.message == message


@pytest.mark.parametrize(
    ("form", "failure"),
    [
        ("(with-query-bindings 5 1)", ":TYPE-ERROR 5 LIST"),
        ("(with-query-bindings 'n 1)", ":TYPE-ERROR N LIST"),
        ("(with-query-bindings (n ?x) 1)", ":UNDEFINED-FUNCTION N"),
        ("(with-query-bindings '(?x 1) 1)", ":TYPE-ERROR ?X RELATION"),
        ("(with-query-bindings '(not (n ?x)) 1)", ":UNBOUND-LOGIC-VARIABLE ?X (NOT (N ?X))"),
        ("(with-query-bindings '(n ?x) 1)", ":NO-BINDINGS (N ?X)"),
        ("(with-query-bindings '(n #?x) 1)", ":UNBOUND-VARIABLE ?X"),
        ("(next-bindings)", ":CONTROL-ERROR NEXT-BINDINGS is called outside WITH-QUERY-BINDINGS"),
        ("(funcall 'next-bindings)", ":CONTROL-ERROR NEXT-BINDINGS is called outside WITH-QUERY-BINDINGS"),
        ("(next-bindings 1)", ':WRONG-NUMBER-OF-ARGUMENTS NEXT-BINDINGS "takes 0 arguments but 1 was given"'),
        ("#?x", ":UNBOUND-VARIABLE ?X"),
    ],
)
def test_a_wrong_query_or_a_wrong_place_is_a_failure_that_names_it(form: str, failure: str) -> None:
    assert came_to(form) == ([], failure)


def test_a_body_may_be_empty_or_a_keyword() -> None:
    text = f"""
    {NUMBERS}
    (print (with-query-bindings '(n ?x)))
    (print (with-query-bindings '(n ?x) :inherit-bindings))
    (print (with-query-bindings '(n ?x) :found))
    """
    assert lines_of(text) == ["NIL", "NIL", ":FOUND"]


def test_the_values_of_the_body_are_those_of_the_form() -> None:
    text = f"""
    {NUMBERS}
    (print (multiple-value-list (with-query-bindings '(n ?x) (values #?x :two))))
    (print (multiple-value-list (with-query-bindings '(n ?x) (if (= #?x 2) (values) (next-bindings)))))
    (print (multiple-value-list (with-query-bindings '(n ?x))))
    """
    assert lines_of(text) == ["(0 :TWO)", "NIL", "(NIL)"]


def test_the_query_is_evaluated_once() -> None:
    text = f"""
    {NUMBERS}
    (print (with-query-bindings (progn (print :asked) '(n ?x))
             (if (= #?x 2) #?x (next-bindings))))
    """
    assert lines_of(text) == [":ASKED", "2"]


def test_a_query_that_holds_without_variables_has_one_solution() -> None:
    text = f"{NUMBERS} (with-query-bindings '(n 1) (print :once) (next-bindings))"
    assert came_to(text) == ([":ONCE"], ":NO-MORE-BINDINGS (N 1)")


# --- what #?X means -------------------------------------------------------------------


def test_bindings_are_seen_by_what_the_body_calls() -> None:
    text = f"""
    {NUMBERS}
    (defun here () #?x)
    (with-query-bindings '(n ?x) (print (here)) (print (mapcar (lambda (y) (+ #?x y)) '(1 2))))
    """
    assert lines_of(text) == ["0", "(1 2)"]


def test_a_closure_sees_the_bindings_where_it_is_called() -> None:
    text = f"""
    {NUMBERS} {TOOLS}
    (with-query-bindings '(n ?x)
      (let ((closure (lambda () #?x)))
        (with-query-bindings '(tool ?x)
          (print (funcall closure)))))
    """
    assert lines_of(text) == ["SAW"]


def test_bindings_end_with_the_form_however_it_is_left() -> None:
    text = f"""
    {NUMBERS}
    (defun bound ()
      (with-recovery-procedures ((:unbound-variable (abort :unbound))) #?x))
    (with-query-bindings '(n ?x) 1)
    (print (bound))
    (block out (with-query-bindings '(n ?x) (return-from out 1)))
    (print (bound))
    (with-recovery-procedures ((:bad (abort))) (with-query-bindings '(n ?x) (fail :bad)))
    (print (bound))
    (with-query-bindings '(n ?x)
      (with-recovery-procedures ((:no-more-bindings (abort)))
        (with-query-bindings '(n ?x) (next-bindings)))
      (print #?x))
    """
    assert lines_of(text) == [":UNBOUND", ":UNBOUND", ":UNBOUND", "0"]


def test_a_binding_cannot_be_changed() -> None:
    failure = run(f"{NUMBERS} (with-query-bindings '(n ?x) (setf #?x 5))").failure
    assert str(failure.cause) == ":UNDEFINED-FUNCTION"


def test_the_inner_query_is_free_of_the_bindings_around_it() -> None:
    text = f"""
    {NUMBERS}
    (with-query-bindings '(n ?x)
      (when (= #?x 0) (next-bindings))
      (with-query-bindings '(n ?x) (print #?x))
      (with-query-bindings '(n ?x) :inherit-bindings (print #?x))
      (with-query-bindings '(n #?x) (print #?x)))
    """
    assert lines_of(text) == ["0", "1", "1"]


def test_inherited_bindings_are_those_of_all_forms_around() -> None:
    text = f"""
    {NUMBERS}
    (with-recovery-procedures ((:no-more-bindings (abort)))
      (with-query-bindings '(n ?x)
        (with-recovery-procedures ((:no-more-bindings (abort)))
          (with-query-bindings '(n ?y)
            (with-recovery-procedures ((:no-bindings (next-bindings)))
              (with-query-bindings '(and (n ?z) (< ?x ?y ?z)) :inherit-bindings
                (print (list #?x #?y #?z))
                (fail :no-bindings)))))
        (next-bindings)))
    """
    assert lines_of(text) == ["(0 1 2)"]


def test_inherited_bindings_may_be_what_makes_a_query_answerable() -> None:
    text = f"""
    {NUMBERS}
    (with-query-bindings '(n ?x)
      (print (with-query-bindings '(not (tool ?x)) :inherit-bindings (list :no-tool #?x))))
    """
    assert lines_of(text) == ["(:NO-TOOL 0)"]


# --- no more --------------------------------------------------------------------------


def test_the_end_of_the_bindings_can_be_answered_where_it_is_noticed() -> None:
    text = f"""
    {NUMBERS}
    (print (with-query-bindings '(n ?x)
             (list #?x (with-recovery-procedures ((:no-more-bindings :goes-on))
                         (next-bindings)))))
    """
    assert lines_of(text) == ["(2 :GOES-ON)"]


def test_no_bindings_at_all_is_a_failure_outside_of_the_body() -> None:
    text = """
    (print (with-recovery-procedures ((:no-bindings (assert '(n 7)) (retry)))
             (with-query-bindings '(n ?x)
               (with-recovery-procedures ((:no-bindings (abort :never)))
                 #?x))))
    (print (with-recovery-procedures ((:no-bindings :in-its-place))
             (with-query-bindings '(m ?x) #?x)))
    """
    assert lines_of(text) == ["7", ":IN-ITS-PLACE"]


def test_when_the_end_was_answered_it_comes_again() -> None:
    text = f"""
    {NUMBERS}
    (print (with-query-bindings '(n ?x)
             (list (with-recovery-procedures ((:no-more-bindings :first)) (next-bindings))
                   (with-recovery-procedures ((:no-more-bindings :second)) (next-bindings)))))
    """
    assert lines_of(text) == ["(:FIRST :SECOND)"]


# --- the moment of entrance -----------------------------------------------------------


def test_solutions_are_those_of_the_moment_of_entrance() -> None:
    text = f"""
    {NUMBERS}
    (with-recovery-procedures ((:no-more-bindings (abort)))
      (with-query-bindings '(n ?x)
        (princ #?x)
        (retract '(n 1)) (assert '(n 9)) (retract '(n 2)) (assert '(n 2))
        (next-bindings)))
    (print (mapcar #'cdar (db-query '(n ?x))))
    """
    assert lines_of(text) == ["012", "(0 9 2)"]


def test_what_rules_derive_is_that_of_the_moment_too() -> None:
    text = """
    (defrule (reaches ?x ?y) (way ?x ?y))
    (defrule (reaches ?x ?z) (way ?x ?y) (reaches ?y ?z))
    (assert '(way a b)) (assert '(way b c)) (assert '(way c d))
    (with-recovery-procedures ((:no-more-bindings (abort)))
      (with-query-bindings '(reaches a ?x)
        (princ #?x)
        (retract '(way ?_ ?_)) (assert '(way b x)) (defrule (reaches ?x ?y) (assumed ?x ?y))
        (next-bindings)))
    """
    assert lines_of(text) == ["BCD"]


def test_tests_are_made_when_the_solution_is_wanted() -> None:
    text = f"""
    (defun test (x) (print (list :test x)) (/= x 1))
    {NUMBERS}
    (with-query-bindings '(and (n ?x) (test ?x))
      (print #?x)
      (when (= #?x 0) (next-bindings)))
    """
    assert lines_of(text) == ["(:TEST 0)", "0", "(:TEST 1)", "(:TEST 2)", "2"]


def test_a_test_that_fails_can_be_answered_and_the_search_goes_on() -> None:
    text = f"""
    (defvar *known* nil)
    (defun test (x) (or *known* (/= x 1) (fail :unknown x)))
    {NUMBERS}
    (with-query-bindings '(and (n ?x) (test ?x))
      (print #?x)
      (with-recovery-procedures (((:unknown what) (print (list :learn what)) (setf *known* t) (retry)))
        (when (< #?x 2) (next-bindings))))
    """
    assert lines_of(text) == ["0", "(:LEARN 1)", "1", "2"]


def test_other_tasks_may_change_the_facts_meanwhile() -> None:
    text = f"""
    {NUMBERS}
    (task-net
      (a (with-query-bindings '(n ?x) (sleep 1) (princ #?x) (when (< #?x 2) (next-bindings))))
      (b (sleep 1.5) (retract '(n ?_)) (assert '(n 7)))
      (c (sleep 2.5) (with-query-bindings '(n ?x) (princ (list #?x)))))
    """
    assert lines_of(text) == ["01(7)2"]


# --- turns ----------------------------------------------------------------------------


MANY = "(dotimes (i 10000) (assert (list 'n i)))"


def test_a_round_through_many_solutions_gives_turns_away() -> None:
    text = f"""
    {MANY}
    (defvar *seen* 0)
    (task-net
      (a (with-query-bindings '(n ?x) (setf *seen* #?x) (when (< #?x 9999) (next-bindings))))
      (b (print (< 0 *seen* 9999))))
    (print *seen*)
    """
    assert lines_of(text) == ["T", "9999"]


def test_a_round_through_many_solutions_can_be_aborted() -> None:
    text = f"""
    {MANY}
    (defvar *seen* 0)
    (let ((task (spawn (with-cleanup-procedure (print :cleaned-up)
                         (with-query-bindings '(n ?x) (incf *seen*) (next-bindings))))))
      (yield)
      (abort-task task)
      (wait-for-task task)
      (print (list (task-status task) (< 0 *seen* 10000))))
    """
    assert lines_of(text) == [":CLEANED-UP", "(:ABORTED T)"]


def test_a_round_through_many_solutions_obeys_a_deadline() -> None:
    text = f"""
    {MANY}
    (print (with-recovery-procedures ((:deadline-expired (abort :late)))
             (with-deadline (1/200)
               (with-query-bindings '(n ?x) (next-bindings)))))
    """
    assert lines_of(text) == [":LATE"]


def test_the_stack_does_not_grow_from_round_to_round() -> None:
    text = f"""
    {MANY}
    (print (with-query-bindings '(n ?x)
             (with-recovery-procedures ((:small (next-bindings)))
               (if (< #?x 9999) (fail :small) #?x))))
    """
    assert lines_of(text) == ["9999"]
