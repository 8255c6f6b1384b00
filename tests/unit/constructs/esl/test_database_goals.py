"""Goals of the database: patterns with variables, what is achieved, and methods that ask it."""

from __future__ import annotations

from eslang.tools.expectations import failure_text
from support import lines_of, run

POWER = """
(defproperty power-state)
(to-achieve (power-state ?device ?state)
  (t (print (list #?device #?state))
     (assert '(power-state #?device #?state))))
"""


def test_a_goal_of_the_database_is_achieved_by_the_method_of_its_pattern() -> None:
    text = f"""
    {POWER}
    (print (achieve (power-state camera :on)))
    (print (achieve (power-state camera :on)))
    (print (db-query '(power-state camera ?state)))
    """
    assert lines_of(text) == ["(CAMERA :ON)", "T", "NIL", "(((?STATE . :ON)))"]


def test_a_goal_may_be_computed_or_hold_bindings() -> None:
    text = f"""
    {POWER}
    (defun switch (device state) (achieve `(power-state ,device ,state)))
    (switch 'camera :off)
    (achieve '(power-state camera :off))
    (assert '(is-a radio device))
    (with-query-bindings '(is-a ?x device)
      (achieve (power-state #?x :on)))
    (print (db-query '(power-state ?x ?state)))
    """
    assert lines_of(text) == [
        "(CAMERA :OFF)",
        "(RADIO :ON)",
        "(((?X . CAMERA) (?STATE . :OFF)) ((?X . RADIO) (?STATE . :ON)))",
    ]


def test_the_pattern_of_a_goal_reaches_into_terms() -> None:
    text = """
    (to-achieve (at robot (?room ?spot)) (t (assert '(at robot (#?room #?spot))) (print #?spot)))
    (achieve (at robot (kitchen sink)))
    (print (db-query '(at robot ?where)))
    """
    assert lines_of(text) == ["SINK", "(((?WHERE KITCHEN SINK)))"]


def test_a_goal_that_its_method_does_not_bring_about_has_failed() -> None:
    text = "(to-achieve (lit ?room) (t (print #?room))) (achieve (lit hall))"
    assert failure_text(run(text).failure) == ":CONDITION-NOT-ACHIEVED (LIT HALL)"


def test_a_test_of_a_method_may_ask_the_database() -> None:
    text = """
    (defrelation lit)
    (to-achieve (lit ?room)
      ((db-query '(window #?room)) (assert '(lit #?room)) (print (list :open-shutters #?room)))
      ((db-query '(lamp #?room)) (assert '(lit #?room)) (print (list :switch-on #?room))))
    (assert '(lamp cellar)) (assert '(window attic))
    (achieve (lit cellar)) (achieve (lit attic))
    (achieve (lit cave))
    """
    came = run(text)
    assert came.output.split("\n")[1:] == ["(:SWITCH-ON CELLAR) ", "(:OPEN-SHUTTERS ATTIC) "]
    assert failure_text(came.failure) == ":NO-APPLICABLE-METHOD (LIT CAVE)"


def test_a_method_may_have_subgoals_and_alternatives_from_the_database() -> None:
    """To light a room take a lamp that works: each is tried, and may have goals of its own."""
    text = """
    (defproperty power)
    (to-achieve (power ?lamp :on)
      ((db-query '(broken #?lamp)) (fail :lamp-broken))
      (t (assert '(power #?lamp :on))))
    (defrule (lit ?room) (lamp ?room ?lamp) (power ?lamp :on))
    (to-achieve (lit ?room)
      (t (with-query-bindings '(lamp #?room ?lamp)
           (with-recovery-procedures (:lamp-broken (next-bindings))
             (achieve (power #?lamp :on))
             (print #?lamp)))))
    (assert '(lamp hall l1)) (assert '(lamp hall l2)) (assert '(broken l1))
    (print (achieve (lit hall)))
    """
    assert lines_of(text) == ["L2", "T"]


def test_goals_may_be_made_of_goals() -> None:
    text = f"""
    {POWER}
    (to-achieve (and ?first ?second) (t (achieve #?first) (achieve #?second)))
    (print (achieve (and (power-state a :on) (power-state b :on))))
    (print (achieve (and (power-state a :on) (power-state b :on))))
    """
    assert lines_of(text) == ["(A :ON)", "(B :ON)", "T", "NIL"]


def test_a_goal_in_a_variable_is_put_in_by_a_backquote() -> None:
    text = f"""
    {POWER}
    (to-achieve (and . ?goals) (t (dolist (goal #?goals) (achieve `,goal))))
    (print (achieve (and (power-state a :on) (power-state b :on))))
    (let ((goal '(power-state a :off))) (print (achieve `,goal)))
    """
    assert lines_of(text) == ["(A :ON)", "(B :ON)", "T", "(A :OFF)", "T"]
