"""The logical database as plans see it: what is held, derived and found, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from eslang.tools.expectations import failure_text
from support import lines_of, run

MASSES = "(dotimes (i 6) (assert (list 'mass i)))"
REFUSED = {
    "(defrelation)": "`defrelation` takes 1 to 3 arguments, found 0",
    "(defproperty p 2 3 4)": "`defproperty` takes 1 to 3 arguments, found 4",
    "(defrule)": "`defrule` takes at least 1 argument, found 0",
}
FAILING = {
    "(assert 5)": ":TYPE-ERROR 5 LIST",
    "(assert nil)": ":TYPE-ERROR NIL LIST",
    "(assert 'lamp)": ":TYPE-ERROR LAMP LIST",
    "(assert '(5 3))": ":TYPE-ERROR 5 RELATION",
    "(assert '((lamp) hall))": ":TYPE-ERROR (LAMP) RELATION",
    "(assert '(?x hall))": ":TYPE-ERROR ?X RELATION",
    "(assert '(lamp . hall))": ":TYPE-ERROR (LAMP . HALL) LIST",
    "(assert '(and (lamp hall)))": ":TYPE-ERROR AND RELATION",
    "(assert '(not (lamp hall)))": ":TYPE-ERROR NOT RELATION",
    "(assert '(lamp ?x))": ":UNBOUND-LOGIC-VARIABLE ?X (LAMP ?X)",
    "(assert '(lamp ?_))": ":UNBOUND-LOGIC-VARIABLE ?_ (LAMP ?_)",
    "(assert '(lamp (hall ?x)))": ":UNBOUND-LOGIC-VARIABLE ?X (LAMP (HALL ?X))",
    "(assert '(lamp #?x))": ":UNBOUND-VARIABLE ?X",
    "(retract 5)": ":TYPE-ERROR 5 LIST",
    "(retract '(lamp . ?x))": ":TYPE-ERROR ?X LIST",
    "(retract '(lamp #?x))": ":UNBOUND-VARIABLE ?X",
    "(update '(lamp ?x) '(lamp ?x))": ":UNBOUND-LOGIC-VARIABLE ?X (LAMP ?X)",
    "(update 5 '(lamp hall))": ":TYPE-ERROR 5 LIST",
    "(update '(lamp hall) 5)": ":TYPE-ERROR 5 LIST",
    "(db-query 5)": ":TYPE-ERROR 5 LIST",
    "(db-query nil)": ":TYPE-ERROR NIL LIST",
    "(db-query 'lamp)": ":TYPE-ERROR LAMP LIST",
    "(db-query '(?x hall))": ":TYPE-ERROR ?X RELATION",
    "(db-query '(lamp . ?x))": ":TYPE-ERROR ?X LIST",
    "(db-query '(and lamp))": ":TYPE-ERROR LAMP LIST",
    "(db-query '(lamp #?x))": ":UNBOUND-VARIABLE ?X",
    "(db-query '(not (lamp ?x)))": ":UNBOUND-LOGIC-VARIABLE ?X (NOT (LAMP ?X))",
    "(db-query '(> ?x 3))": ":UNBOUND-LOGIC-VARIABLE ?X (> ?X 3)",
    "(db-query '(not (a 1) (b 2)))": ":ERROR NOT takes one query, found (NOT (A 1) (B 2))",
    '(defrelation "lamp")': ':TYPE-ERROR "lamp" SYMBOL',
    "(defrelation and (a b))": ":TYPE-ERROR AND RELATION",
    "(defrelation equal 2)": ":TYPE-ERROR EQUAL RELATION",
    "(assert '(> 1 2))": ":TYPE-ERROR > RELATION",
    "(retract '(> ?x 2))": ":TYPE-ERROR > RELATION",
    "(defrule (= ?x ?y) (same ?x ?y))": ":TYPE-ERROR = RELATION",
    "(defproperty not)": ":TYPE-ERROR NOT RELATION",
    "(defproperty ?x)": ":TYPE-ERROR ?X RELATION",
    "(defrelation lamp -1)": ":TYPE-ERROR -1 LIST",
    "(defrelation lamp (room &optional state))": ":TYPE-ERROR (ROOM &OPTIONAL STATE) LIST",
    '(defrelation lamp ("x"))': ':TYPE-ERROR ("x") LIST',
    "(defproperty 5)": ":TYPE-ERROR 5 SYMBOL",
    "(defrule lit (lamp ?x))": ":TYPE-ERROR LIT LIST",
    "(defrule (lit ?x) lamp)": ":TYPE-ERROR LAMP LIST",
    "(defrule ((lit ?x) (lamp ?x)))": ":TYPE-ERROR (LIT ?X) RELATION",
    '(forget-rules "lit")': ':TYPE-ERROR "lit" SYMBOL FORGET-RULES',
}


def came_to(text: str) -> str:
    """How TEXT fails."""
    failure = run(text).failure
    return "no failure" if failure is None else failure_text(failure)


@pytest.mark.parametrize("form", REFUSED)
def test_a_declaration_that_is_written_wrongly_is_refused(form: str) -> None:
    error = run(form).error
    assert error is not None and error.diagnostic.message == REFUSED[form]


@pytest.mark.parametrize("form", FAILING)
def test_what_is_no_fact_and_no_query_is_a_failure_that_names_it(form: str) -> None:
    assert came_to(form) == FAILING[form]


# --- facts ----------------------------------------------------------------------------


def test_assert_gives_the_fact() -> None:
    assert lines_of("(print (assert '(lamp hall))) (print (assert '(lamp hall)))") == [
        "(LAMP HALL)",
        "(LAMP HALL)",
    ]


def test_a_fact_is_a_copy_of_what_was_given() -> None:
    text = """
    (let ((fact (list 'mass 5)) (name (copy-seq "ab")))
      (assert fact)
      (assert (list 'name name))
      (setf (cadr fact) 6 (char name 0) #\\x))
    (print (db-query '(mass ?x)))
    (print (db-query '(name "ab")))
    """
    assert lines_of(text) == ["(((?X . 5)))", "(NIL)"]


def test_what_a_query_gives_is_the_askers_own() -> None:
    text = """
    (assert '(mass 5))
    (setf (cdr (first (first (db-query '(mass ?x))))) 6)
    (print (db-query '(mass ?x)))
    """
    assert lines_of(text) == ["(((?X . 5)))"]


def test_anything_may_be_an_argument_of_a_fact() -> None:
    text = """
    (dolist (each '(#\\a nil t 1/2 :k "s" (a b)))
      (assert (list 'known each)))
    (defvar *bell* (make-event))
    (assert `(event ,*bell*))
    (print (mapcar #'cdar (db-query '(known ?x))))
    (print (eq *bell* (cdaar (db-query '(event ?x)))))
    (print (db-query '(known nil)))
    """
    assert lines_of(text) == ['(#\\a NIL T 1/2 :K "s" (A B))', "T", "(NIL)"]


def test_a_fact_may_have_no_arguments() -> None:
    assert lines_of("(print (assert '(ready))) (print (db-query '(ready))) (print (retract '(ready)))") == [
        "(READY)",
        "(NIL)",
        "1",
    ]


def test_the_name_of_a_relation_may_be_that_of_an_operator() -> None:
    text = """
    (assert '(if hall)) (assert '(car hall))
    (print (db-query '(and (if ?x) (car ?x))))
    (print (car '(1)))
    """
    assert lines_of(text) == ["(((?X . HALL)))", "1"]


def test_facts_of_one_name_may_have_different_numbers_of_arguments() -> None:
    text = """
    (assert '(lamp hall)) (assert '(lamp hall :on))
    (print (db-query '(lamp ?x))) (print (db-query '(lamp ?x ?y)))
    """
    assert lines_of(text) == ["(((?X . HALL)))", "(((?X . HALL) (?Y . :ON)))"]


def test_retract_counts_what_went() -> None:
    text = f"{MASSES} (print (retract '(mass 3))) (print (retract '(mass 3))) (print (retract '(mass ?_)))"
    assert lines_of(text) == ["1", "0", "5"]


def test_retract_takes_patterns_in_which_a_variable_stands_twice() -> None:
    text = """
    (assert '(edge a b)) (assert '(edge c c))
    (print (retract '(edge ?x ?x)))
    (print (db-query '(edge ?x ?y)))
    """
    assert lines_of(text) == ["1", "(((?X . A) (?Y . B)))"]


def test_an_update_that_is_refused_changes_nothing() -> None:
    text = """
    (assert '(lamp hall :on))
    (with-recovery-procedures ((:unbound-logic-variable (abort)))
      (update '(lamp ?x ?y) '(lamp ?x :off)))
    (print (db-query '(lamp ?x ?y)))
    """
    assert lines_of(text) == ["(((?X . HALL) (?Y . :ON)))"]


def test_an_update_gives_the_fact_and_may_change_the_relation() -> None:
    text = """
    (assert '(planned trip))
    (print (update '(planned trip) '(done trip)))
    (print (db-query '(or (planned ?x) (done ?x))))
    """
    assert lines_of(text) == ["(DONE TRIP)", "(((?X . TRIP)))"]


def test_a_marked_variable_in_data_is_its_binding() -> None:
    text = """
    (assert '(is-a camera device))
    (with-query-bindings '(is-a ?x device)
      (print (assert '(lamp (of #?x) #?x)))
      (print (db-query '(lamp (of #?x) ?y)))
      (print (update '(lamp ?_ #?x) '(done #?x)))
      (print (retract '(done #?x))))
    """
    assert lines_of(text) == ["(LAMP (OF CAMERA) CAMERA)", "(((?Y . CAMERA)))", "(DONE CAMERA)", "1"]


# --- queries --------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("query", "found"),
    [
        ("(mass ?x)", "(0 1 2 3 4 5)"),
        ("(and (mass ?x) (> ?x 3))", "(4 5)"),
        ("(and (> ?x 3) (mass ?x))", "(4 5)"),
        ("(and (mass ?x) (> ?x (+ 1 2)))", "(4 5)"),
        ("(and (mass ?x) (heavy ?x))", "(5)"),
        ("(and (mass ?x) (not (heavy ?x)))", "(0 1 2 3 4)"),
        ("(and (mass ?x) (> ?x *limit*))", "(3 4 5)"),
        ("(and (mass ?x) (member ?x '(1 3 9)))", "(1 3)"),
        ("(and (mass ?x) (funcall #'evenp ?x))", "(0 2 4)"),
        ("(and (mass ?x) (funcall 'heavy ?x))", "(5)"),
        ("(and (mass ?x) (eq ?x widget))", "NIL"),
        ("(or (and (mass ?x) (heavy ?x)) (and (mass ?x) (< ?x 2)))", "(5 0 1)"),
        ("(or (mass ?x) (mass ?x))", "(0 1 2 3 4 5)"),
        ("(and (mass ?x) (or (= ?x 2) (= ?x 4)))", "(2 4)"),
        ("(and (mass ?x) (not (or (< ?x 2) (> ?x 2))))", "(2)"),
        ("(and (mass ?x) (not (not (= ?x 2))))", "(2)"),
        ("(and (mass ?x) (no-such-relation ?x))", "NIL"),
        ("(or (and (mass ?x) (= ?x 9)))", "NIL"),
    ],
)
def test_a_query_joins_patterns_and_tests(query: str, found: str) -> None:
    text = f"""
    (defvar *limit* 2)
    (defun heavy (kilos) (when (> kilos 4) :heavy))
    {MASSES}
    (print (mapcar #'cdar (db-query '{query})))
    """
    assert lines_of(text) == [found]


def test_a_ground_query_has_one_empty_solution_or_none() -> None:
    text = f"{MASSES} (print (mapcar #'db-query '((mass 3) (mass 9) (and) (or))))"
    assert lines_of(text) == ["((NIL) NIL (NIL) NIL)"]


def test_the_variables_of_one_branch_only_are_in_its_solutions_only() -> None:
    text = "(assert '(a 1)) (assert '(b 2)) (print (db-query '(or (a ?x) (b ?y))))"
    assert lines_of(text) == ["(((?X . 1)) ((?Y . 2)))"]


def test_numbers_and_strings_match_if_they_are_equal() -> None:
    text = """
    (assert '(size "box" 3)) (assert '(size "Box" 3.0)) (assert '(size #(1) 6/2))
    (print (db-query '(size "box" ?n)))
    (print (db-query '(size ?x 3)))
    (print (db-query '(size #(1) ?n)))
    """
    assert lines_of(text) == ["(((?N . 3)))", '(((?X . "box")) ((?X . #(1))))', "NIL"]


def test_patterns_reach_into_terms() -> None:
    text = """
    (assert '(at cup (shelf 3 "left"))) (assert '(at pan (stove . 1)))
    (print (db-query '(at ?x (?where . ?rest))))
    (print (db-query '(at ?x (shelf ?n ?_))))
    (print (db-query '(at ?x ?y)))
    """
    assert lines_of(text) == [
        '(((?X . CUP) (?WHERE . SHELF) (?REST 3 "left")) ((?X . PAN) (?WHERE . STOVE) (?REST . 1)))',
        "(((?X . CUP) (?N . 3)))",
        '(((?X . CUP) (?Y SHELF 3 "left")) ((?X . PAN) (?Y STOVE . 1)))',
    ]


def test_a_test_that_fails_is_a_failure_of_the_one_who_asks() -> None:
    text = """
    (assert '(mass 1)) (assert '(mass :unknown))
    (print (with-recovery-procedures (((:type-error what) (abort (list :no-mass what))))
             (db-query '(and (mass ?x) (> ?x 0)))))
    """
    assert lines_of(text) == ["(:NO-MASS :UNKNOWN)"]


def test_a_test_may_wait_and_other_tasks_go_on() -> None:
    text = """
    (defun slow (x) (sleep 1) (evenp x))
    (dotimes (i 4) (assert (list 'n i)))
    (task-net
      (asker (print (db-query '(and (n ?x) (slow ?x)))))
      (other (sleep 2) (print :meanwhile) (retract '(n ?_))))
    """
    assert lines_of(text) == [":MEANWHILE", "(((?X . 0)) ((?X . 2)))"]


def test_a_test_may_ask_and_change_the_database() -> None:
    text = """
    (defun first-time (x)
      (unless (db-query `(seen ,x))
        (assert `(seen ,x))))
    (assert '(n 1)) (assert '(n 2)) (assert '(seen 1))
    (print (db-query '(and (n ?x) (first-time ?x))))
    (print (db-query '(and (n ?x) (first-time ?x))))
    """
    assert lines_of(text) == ["(((?X . 2)))", "NIL"]


def test_a_function_that_becomes_a_relation_is_asked_no_more() -> None:
    text = """
    (defun lamp (x) (print :called) t)
    (assert '(n 1))
    (print (db-query '(and (n ?x) (lamp ?x))))
    (assert '(lamp 2))
    (print (db-query '(and (n ?x) (lamp ?x))))
    (print (lamp 3))
    """
    assert lines_of(text) == [":CALLED", "(((?X . 1)))", "NIL", ":CALLED", "T"]


# --- many facts, and files ------------------------------------------------------------


# claim LR-5-q: They are asserted one by one, and each is found at once.
@pytest.mark.slow
def test_a_hundred_thousand_facts_are_ordinary() -> None:
    text = """
    (dotimes (i 100000) (assert (list 'mass i (mod i 1000))))
    (print (length (db-query '(mass ?x 7))))
    (dotimes (i 10000) (db-query (list 'mass (* i 10) '?kilos)))
    (print (db-query '(and (mass 77777 ?kilos) (mass 777 ?kilos))))
    """
    assert lines_of(text) == ["100", "(((?KILOS . 777)))"]


# claim LR-5-p: What was saved in one run is there in another.
def test_facts_can_be_saved_and_loaded(tmp_path: Path) -> None:
    file = tmp_path / "kitchen.facts"
    save = f"""
    (assert '(at cup (shelf 3 "left"))) (assert '(mass cup 0.25)) (assert '(:ready))
    (print (save-facts "{file}"))
    """
    load = f"""
    (print (load-facts "{file}"))
    (print (db-query '(and (at ?x ?where) (mass ?x ?kilos) (:ready))))
    """
    assert lines_of(save) == ["3"]
    assert lines_of(load) == ["3", '(((?X . CUP) (?WHERE SHELF 3 "left") (?KILOS . 0.25)))']
