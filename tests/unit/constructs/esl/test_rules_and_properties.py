"""What plans derive by rules, and what DEFPROPERTY makes of a relation."""

from __future__ import annotations

import pytest

from eslang.tools.expectations import failure_text
from support import lines_of, run

# --- properties -----------------------------------------------------------------------


def test_a_new_value_of_a_property_takes_the_place_of_the_old() -> None:
    text = """
    (print (defproperty power-state))
    (assert '(power-state w1 :off)) (assert '(power-state w2 :off)) (assert '(power-state w1 :on))
    (print (mapcar #'cdar (db-query '(power-state w1 ?s))))
    (print (mapcar #'cdar (db-query '(power-state w2 ?s))))
    """
    assert lines_of(text) == ["POWER-STATE", "(:ON)", "(:OFF)"]


def test_a_property_may_be_of_nothing_or_of_several_things() -> None:
    text = """
    (defproperty mode)
    (mapc #'assert '((mode :day) (mode :night) (mode a b 1) (mode a b 2) (mode)))
    (print (list (db-query '(mode ?x)) (db-query '(mode a b ?x)) (db-query '(mode))))
    """
    assert lines_of(text) == ["((((?X . :NIGHT))) (((?X . 2))) (NIL))"]


def test_a_relation_that_becomes_a_property_keeps_the_last_values() -> None:
    text = """
    (assert '(power-state w1 :off)) (assert '(power-state w1 :on)) (assert '(power-state w2 :off))
    (defproperty power-state)
    (print (db-query '(power-state ?x ?s)))
    """
    assert lines_of(text) == ["(((?X . W1) (?S . :ON)) ((?X . W2) (?S . :OFF)))"]


def test_an_update_of_a_property_leaves_one_value() -> None:
    text = """
    (defproperty power-state)
    (assert '(power-state w1 :off)) (assert '(power-state w2 :on))
    (update '(power-state w2 :on) '(power-state w1 :on))
    (print (db-query '(power-state ?x ?s)))
    """
    assert lines_of(text) == ["(((?X . W1) (?S . :ON)))"]


def test_a_declaration_may_have_arguments_and_a_documentation() -> None:
    text = """
    (print (list (defrelation connected "What hangs together.")
                 (defrelation near (thing other) "What is close.")
                 (defproperty charge (device per-cent) "How full it is.")
                 (defproperty mode 1)))
    """
    assert lines_of(text) == ["(CONNECTED NEAR CHARGE MODE)"]


# --- rules ----------------------------------------------------------------------------


def test_a_rule_derives_what_nobody_asserted() -> None:
    text = """
    (print (defrule (usable ?x) "What can be used." (is-a ?x tool) (not (broken ?x))))
    (assert '(is-a saw tool)) (assert '(is-a drill tool)) (assert '(broken saw))
    (print (db-query '(usable ?x)))
    (print (db-query '(usable saw)))
    """
    assert lines_of(text) == ["USABLE", "(((?X . DRILL)))", "NIL"]


def test_a_rule_without_a_body_holds_always() -> None:
    assert lines_of("(defrule (start 1)) (print (db-query '(start ?x)))") == ["(((?X . 1)))"]


def test_a_rule_may_build_terms_and_take_them_apart() -> None:
    text = """
    (defrule (position ?x (?row ?column)) (placed ?x ?row ?column))
    (assert '(placed rook 1 8))
    (print (db-query '(position rook ?where)))
    (print (db-query '(position ?x (1 ?column))))
    """
    assert lines_of(text) == ["(((?WHERE 1 8)))", "(((?X . ROOK) (?COLUMN . 8)))"]


def test_a_rule_may_ask_lisp() -> None:
    text = """
    (defvar *limit* 10)
    (defrule (heavy ?x) (mass ?x ?kilos) (> ?kilos *limit*))
    (assert '(mass a 5)) (assert '(mass b 15))
    (print (db-query '(heavy ?x)))
    (setf *limit* 3)
    (print (db-query '(heavy ?x)))
    """
    assert lines_of(text) == ["(((?X . B)))", "(((?X . A)) ((?X . B)))"]


def test_a_variable_of_the_head_that_the_body_leaves_open_has_to_be_given() -> None:
    text = "(defrule (any ?x) (mass ?y)) (assert '(mass 1)) (print (db-query '(any 5)))"
    assert lines_of(text) == ["(NIL)"]
    failure = run(text + " (db-query '(any ?x))").failure
    assert failure_text(failure) == ":UNBOUND-LOGIC-VARIABLE ?X (ANY ?X)"


@pytest.mark.parametrize(
    ("rules", "around"),
    [
        ("(defrule (r ?x) (s ?x) (not (r ?x)))", "(R R) ((R ?X) (S ?X) (NOT (R ?X)))"),
        (
            "(defrule (r ?x) (s ?x) (not (q ?x))) (defrule (q ?x) (s ?x) (r ?x))",
            "(R Q R) ((Q ?X) (S ?X) (R ?X))",
        ),
    ],
)
def test_rules_that_rest_on_their_own_absence_are_refused(rules: str, around: str) -> None:
    assert failure_text(run(rules).failure) == f":UNSTRATIFIED-RULES {around}"


def test_a_rule_that_was_refused_is_not_there() -> None:
    text = """
    (defrule (free ?x) (seat ?x) (not (taken ?x)))
    (with-recovery-procedures ((:unstratified-rules (abort)))
      (defrule (taken ?x) (seat ?x) (not (free ?x))))
    (assert '(seat 1))
    (print (db-query '(free ?x)))
    """
    assert lines_of(text) == ["(((?X . 1)))"]


def test_the_same_rule_again_changes_nothing() -> None:
    rule = "(defrule (lit ?x) (lamp ?x :on))"
    text = f"{rule} {rule} (assert '(lamp hall :on)) (print (db-query '(lit ?x)))"
    assert lines_of(text) == ["(((?X . HALL)))"]


def test_rules_can_be_forgotten() -> None:
    text = """
    (defrule (lit ?x) (lamp ?x :on))
    (defrule (lit ?x) (window ?x))
    (assert '(lamp hall :on)) (assert '(lit attic))
    (print (forget-rules 'lit))
    (print (forget-rules 'lit))
    (print (db-query '(lit ?x)))
    """
    assert lines_of(text) == ["T", "NIL", "(((?X . ATTIC)))"]


def test_a_rule_may_hold_what_is_bound_where_it_is_defined() -> None:
    text = """
    (assert '(chosen hall))
    (with-query-bindings '(chosen ?room)
      (defrule (mine ?x) (lamp ?x #?room)))
    (assert '(lamp l1 hall)) (assert '(lamp l2 attic))
    (print (db-query '(mine ?x)))
    """
    assert lines_of(text) == ["(((?X . L1)))"]
