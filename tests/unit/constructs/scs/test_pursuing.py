"""Goals are pursued: in turns, again after failures, whenever that is needed (SCS §2; decision 37)."""

from __future__ import annotations

from io import StringIO
from typing import Any

import pytest
from pursuits import BATTERY, LAMPS, SEEDS, changes_of

from eslang import Interpreter
from support import lines_of, run

# --- achieving -----------------------------------------------------------------------


def test_a_goal_that_is_true_already_needs_no_action() -> None:
    states: list[str] = []
    text = "(assert '(lamp hall :on)) (add-goal (achieve (lamp hall :on))) (pursue-goals)"
    run(
        LAMPS + text,
        listeners=[lambda event: states.append(event.data["state"]) if event.kind == "goal" else None],
    )
    assert states == ["no-action"]


def test_an_attempt_that_fails_is_made_again_until_the_condition_holds() -> None:
    text = """
    (defvar *tries* 0)
    (to-achieve (cup held) (t (if (< (incf *tries*) 4) (fail :slipped)) (assert '(cup held))))
    (add-goal (achieve (cup held))) (print (pursue-goals)) (print *tries*) (print (goals))"""
    assert lines_of(text) == ["T", "4", "NIL"]


def test_a_method_that_does_not_bring_it_about_is_tried_again_too() -> None:
    text = """
    (defvar *tries* 0)
    (to-achieve (cup held) (t (if (= (incf *tries*) 3) (assert '(cup held)))))
    (add-goal (achieve (cup held))) (pursue-goals) (print *tries*)"""
    assert lines_of(text) == ["3"]


def test_attempts_that_take_no_time_and_fail_follow_each_other_ever_more_slowly() -> None:
    text = """
    (defvar *tries* 0)
    (to-achieve (never) (t (incf *tries*) (fail :no)))
    (add-goal (achieve (never)))
    (add-goal (achieve (late)) :by (progn (sleep 10) (assert '(late))))
    (pursue-goals :until (late))
    (print (< 15 *tries* 30))"""
    assert lines_of(text) == ["T"]


def test_a_changed_fact_lets_it_try_again_at_once() -> None:
    text = """
    (defvar *tries* 0)
    (to-achieve (door open)
      (t (if (< (incf *tries*) 12) (fail :shut))
         (if (db-query '(key found)) (assert '(door open)) (fail :locked))))
    (add-goal (achieve (door open)))
    (add-goal (achieve (key found)) :by (progn (sleep 4.5) (assert '(key found))))
    (defvar *begun* (get-internal-real-time))
    (pursue-goals)
    (print (/ (- (get-internal-real-time) *begun*) internal-time-units-per-second))"""
    assert lines_of(text) == ["9/2"]


def test_a_step_may_stand_in_place_of_methods() -> None:
    text = """
    (defstep light (where) (princ "walk ") (assert (list 'lamp where :on)))
    (add-goal (achieve (lamp hall :on)) :by (light 'hall)) (pursue-goals) (print (db-query '(lamp ?x :on)))"""
    assert lines_of("(defproperty lamp)" + text)[-1] == "(((?X . HALL)))"


def test_a_method_is_done_to_its_end_though_the_condition_holds_before() -> None:
    text = """
    (to-achieve (cup held) (t (scs:do (assert '(cup held)) (sleep 1) (print :arm-stowed))))
    (add-goal (achieve (cup held))) (pursue-goals)"""
    assert lines_of(text) == [":ARM-STOWED"]


def test_the_end_of_a_goal_tells_under_which_bindings_it_was_achieved() -> None:
    text = """
    (defvar *goal* (add-goal (achieve (seen ?what ?where)) :by (progn (sleep 1) (assert '(seen cup table)))))
    (spawn (print (multiple-value-list (wait-for-events *goal*))))
    (pursue-goals)
    (print (multiple-value-list (wait-for-events *goal*)))"""
    assert lines_of(text) == ["(:ACHIEVED ((?WHAT . CUP) (?WHERE . TABLE)))"] * 2


# --- maintaining ---------------------------------------------------------------------


def test_a_goal_to_maintain_is_active_whenever_it_is_false_and_stays() -> None:
    text = """
    (defvar *keep* (add-goal (maintain (battery :full))))
    (add-goal (achieve (rounds 2)) :by
      (scs:do (dotimes (i 2) (sleep 5) (assert '(battery :low))) (sleep 5) (assert '(rounds 2))))
    (pursue-goals)
    (print (list (goals) (goal-status *keep*)))"""
    assert lines_of(BATTERY + text) == [":CHARGE"] * 2 + ["((#<GOAL (MAINTAIN (BATTERY :FULL))>) :PENDING)"]


@pytest.mark.slow
def test_a_goal_to_maintain_that_is_violated_by_the_last_action_is_restored_before_the_end() -> None:
    text = """
    (add-goal (maintain (battery :full)))
    (add-goal (achieve (tour done)) :by (progn (assert '(battery :low)) (assert '(tour done))))
    (pursue-goals) (print (db-query '(battery ?x)))"""
    for seed in SEEDS:
        assert lines_of(BATTERY + text, seed=seed)[-1] == "(((?X . :FULL)))"


def test_one_that_asks_lisp_is_looked_at_after_each_step() -> None:
    text = """
    (defvar *charge* 100) (defun charged? () (> *charge* 20))
    (to-achieve (charged?) (t (print :charge) (setq *charge* 100)))
    (add-goal (maintain (charged?)))
    (add-goal (achieve (home)) :by (scs:do (dotimes (i 5) (decf *charge* 30) (sleep 1)) (assert '(home))))
    (pursue-goals) (print *charge*)"""
    assert lines_of(text) == [":CHARGE", "40"]


def test_nobody_asks_a_condition_over_facts_unless_they_change() -> None:
    heard: list[Any] = []
    text = (
        BATTERY
        + """
    (add-goal (maintain (battery :full)))
    (add-goal (achieve (done)) :by (scs:do (dotimes (i 50) (sleep 1)) (assert '(done)))) (pursue-goals)"""
    )
    run(text, listeners=[lambda event: heard.append(event.kind)])
    assert heard.count("resume") < 60


def test_to_maintain_what_nobody_changes_is_a_deadlock() -> None:
    failure = run(BATTERY + "(maintain (battery :full))").failure
    told = failure.report.waiting[0]
    assert told.what == "the condition (not (battery :full))"
    assert told.advice == "end what maintains it by a modifier around it, or abort its task"


def test_maintain_is_a_step_that_lasts_until_a_modifier_ends_it() -> None:
    text = """
    (task-net
      (world (sleep 3) (assert '(battery :low)) (sleep 3) (assert '(battery :low)) (sleep 3)
        (assert '(evening)))
      (keeper (print (scs:do :until (evening) (maintain (battery :full))))))"""
    assert lines_of(BATTERY + text) == [":CHARGE", ":CHARGE", ":DEACTIVATED"]


# --- turns ---------------------------------------------------------------------------

LETTERS = """
(defmacro letters (name)
  `(scs:do ,@(loop for i below 6 collect `(progn (princ ',name) (princ " "))) (assert '(done ,name))))
(defun letters-goal (name))
(add-goal (achieve (done a)) :by (letters a) {a})
(add-goal (achieve (done b)) :by (letters b) {b})
(pursue-goals)
"""


def letters(a: str = "", b: str = "", seed: int = 0) -> str:
    """The order of the actions of two goals."""
    found = " ".join(lines_of(LETTERS.replace("{a}", a).replace("{b}", b), seed=seed))
    return "".join(each for each in found.split() if each in ("A", "B"))


@pytest.mark.slow
def test_goals_are_interleaved_by_action_as_chance_has_it() -> None:
    found = {letters(seed=seed) for seed in SEEDS}
    assert len(found) > 4
    assert all(sorted(each) == list("AAAAAABBBBBB") for each in found)
    assert letters(seed=3) == letters(seed=3)


@pytest.mark.slow
def test_the_goal_that_is_worth_most_goes_on() -> None:
    for seed in SEEDS:
        assert letters(b=":utility 5", seed=seed) == "BBBBBBAAAAAA"
        assert letters(":utility 7", ":utility 5", seed=seed) == "AAAAAABBBBBB"


@pytest.mark.slow
def test_goals_of_the_same_utility_take_turns() -> None:
    assert len({letters(":utility 5", ":utility 5", seed) for seed in SEEDS}) > 4


@pytest.mark.slow
def test_utilities_are_asked_anew_after_each_action() -> None:
    text = """(defvar *done* 0)
    (defmacro letters (name)
      `(scs:do ,@(loop for i below 4 collect `(progn (incf *done*) (princ ',name) (princ " ")))
        (assert '(done ,name))))
    (add-goal (achieve (done a)) :by (letters a) :utility (if (< *done* 2) 9 1))
    (add-goal (achieve (done b)) :by (letters b) :utility 5)
    (pursue-goals)"""
    for seed in SEEDS:
        assert "".join(" ".join(lines_of(text, seed=seed)).split()) == "AABBBBAA"


@pytest.mark.slow
def test_while_the_best_goal_waits_others_go_on_and_give_way_when_it_is_ready() -> None:
    text = """
    (add-goal (achieve (done best)) :utility 9 :by
      (scs:do (princ "b1 ") (sleep 2.5) (princ "b2 ") (princ "b3 ") (assert '(done best))))
    (add-goal (achieve (done other)) :by
      (scs:do (princ "o1 ") (sleep 1) (princ "o2 ") (sleep 1) (princ "o3 ") (sleep 1) (princ "o4 ")
        (assert '(done other))))
    (pursue-goals)"""
    for seed in SEEDS:
        assert " ".join(lines_of(text, seed=seed)).split() == ["b1", "o1", "o2", "o3", "b2", "b3", "o4"]


@pytest.mark.slow
def test_branches_inside_a_goal_count_as_the_goal() -> None:
    text = """
    (add-goal (achieve (done best)) :utility 9 :by
      (scs:do (do-all (scs:do (princ "x ") (princ "x ")) (scs:do (princ "x ") (princ "x ")))
        (assert '(done best))))
    (add-goal (achieve (done other)) :by (scs:do (princ "o ") (princ "o ") (assert '(done other))))
    (pursue-goals)"""
    for seed in SEEDS:
        assert " ".join(lines_of(text, seed=seed)).split() == ["x", "x", "x", "x", "o", "o"]


def test_a_utility_that_is_no_number_is_a_failure_of_the_pursuit() -> None:
    assert (
        str(run(LETTERS.replace("{a}", ":utility 'high").replace("{b}", "")).failure.cause) == ":TYPE-ERROR"
    )


@pytest.mark.slow
def test_a_goal_that_is_added_is_taken_up_before_the_next_action() -> None:
    text = """
    (defmacro many (&rest names) `(scs:do ,@(loop for name in names collect `(progn (princ ',name)
      (princ " ")))))
    (add-goal (achieve (done a)) :by
      (scs:do (princ "a1 ") (add-goal (achieve (done new)) :utility 5 :by (scs:do (princ "new ")
        (assert '(done new))))
              (princ "a2 ") (princ "a3 ") (assert '(done a))))
    (add-goal (achieve (done b)) :by (scs:do (sleep 100) (assert '(done b))))
    (pursue-goals)"""
    for seed in SEEDS:
        assert " ".join(lines_of(text, seed=seed)).split() == ["a1", "new", "a2", "a3"]


# --- pursuing ------------------------------------------------------------------------


def test_without_goals_there_is_nothing_to_do() -> None:
    assert lines_of("(print (pursue-goals))") == ["T"]


def test_goals_are_pursued_by_one_at_a_time() -> None:
    text = """(add-goal (achieve (cup held)) :by (sleep 3) :retries 0)
    (spawn (with-recovery-procedures ((:general-failure (abort 1))) (pursue-goals)))
    (sleep 1) (pursue-goals)"""
    failure = run(text).failure
    assert str(failure.cause) == ":CONTROL-ERROR"
    assert "the goals are being pursued already, by the task" in str(failure)


def test_goals_that_are_left_can_be_pursued_again() -> None:
    text = """
    (defvar *goal* (add-goal (achieve (cup held)) :by (progn (sleep 10) (assert '(cup held)))))
    (print (with-recovery-procedures ((:deadline-expired (abort :late))) (with-deadline (5) (pursue-goals))))
    (print (goal-status *goal*)) (pursue-goals) (print (goal-status *goal*))"""
    assert lines_of(text)[-3:] == [":LATE", ":PENDING", ":ACHIEVED"]


def test_a_modifier_ends_the_pursuit_with_the_cleanups_of_its_attempts() -> None:
    text = """
    (add-goal (achieve (cup held)) :by (with-cleanup-procedure (print :cleaned) (sleep 100)))
    (spawn (progn (sleep 2) (assert '(evening))))
    (print (pursue-goals :until (evening))) (print (goals))"""
    assert lines_of(text) == [":CLEANED", ":DEACTIVATED", "(#<GOAL (ACHIEVE (CUP HELD))>)"]


def test_with_wait_it_waits_for_more_goals() -> None:
    text = (
        LAMPS
        + """
    (spawn (progn (sleep 5) (add-goal (achieve (lamp hall :on)))
                  (sleep 5) (add-goal (achieve (lamp attic :on)))
                  (sleep 5) (assert '(evening))))
    (print (pursue-goals :until (evening) :wait t)) (print (length (db-query '(lamp ?x :on))))"""
    )
    assert lines_of(text) == [":DEACTIVATED", "2"]


def test_to_wait_for_goals_that_nobody_can_give_is_a_deadlock() -> None:
    assert str(run("(pursue-goals :wait t)").failure.cause) == ":DEADLOCK"
    assert str(
        run(BATTERY + "(add-goal (maintain (battery :full))) (pursue-goals :wait t)").failure.cause
    ) == (":DEADLOCK")


def test_a_goal_to_maintain_may_be_pursued_beside_other_tasks() -> None:
    text = """(add-goal (maintain (battery :full)))
    (spawn (pursue-goals :wait t) :daemon t)
    (sleep 1) (assert '(battery :low)) (sleep 5) (print (db-query '(battery ?x)))"""
    assert lines_of(BATTERY + text) == [":CHARGE", "(((?X . :FULL)))"]


def test_the_active_path_names_the_goal() -> None:
    heard: list[Any] = []
    text = "(add-goal (achieve (done a)) :by (scs:do (princ 1) (assert '(done a)))) (pursue-goals)"
    run(text, listeners=[lambda event: heard.append(event) if event.kind == "action" else None])
    assert next(str(step) for step in heard[-1].data["path"]) == "(PURSUE-GOALS 1 (ACHIEVE (DONE A)))"


def test_listeners_hear_of_each_change() -> None:
    text = """
    (add-goal (achieve (done a)) :by (if (db-query '(tried)) (assert '(done a)) (progn (assert '(tried))
      (fail :once))))
    (pursue-goals)"""
    assert changes_of(text) == [
        "added (achieve (done a))",
        "pursued (achieve (done a))",
        "failed (achieve (done a)) :once",
        "pursued (achieve (done a))",
        "achieved (achieve (done a))",
    ]


# --- with the rest of ESL ------------------------------------------------------------


@pytest.mark.slow
def test_a_goal_whose_lock_another_one_holds_is_tried_until_it_is_free() -> None:
    text = (
        LAMPS
        + """
    (add-goal (achieve (shown)) :by
      (with-maintained-properties ((lamp hall :on)) (sleep 5) (assert '(shown)) (print :shown)))
    (add-goal (achieve (rested)) :by
      (with-maintained-properties ((lamp hall :off)) (sleep 5) (assert '(rested)) (print :rested)))
    (print (pursue-goals))"""
    )
    for seed in SEEDS:
        lines = lines_of(text, seed=seed)
        assert sorted(lines) == [":RESTED", ":SHOWN", "T"]


def test_a_goal_to_maintain_and_a_lock_do_not_disturb_each_other_s_property() -> None:
    text = (
        LAMPS
        + """
    (assert '(lamp hall :on))
    (add-goal (maintain (lamp hall :on)))
    (add-goal (achieve (slept)) :by
      (with-maintained-properties ((lamp bedroom :off)) (sleep 5) (assert '(slept))))
    (pursue-goals) (print (length (db-query '(lamp ?x ?y))))"""
    )
    assert lines_of(text) == ["2"]


def test_recovery_procedures_around_the_pursuit_are_not_asked_by_goals() -> None:
    text = """
    (defvar *tries* 0)
    (add-goal (achieve (done)) :by (if (= (incf *tries*) 2) (assert '(done)) (fail :once)))
    (print (with-recovery-procedures ((:once (print :asked) (abort :left))) (pursue-goals)))"""
    assert lines_of(text)[-1] == "T"


def test_nothing_is_left_of_a_pursuit() -> None:
    text = """
    (add-goal (maintain (battery :full))) (add-goal (achieve (a)) :by (fail :impossible))
    (add-goal (achieve (b)))
    (with-recovery-procedures ((:impossible-goals (abort 1))) (pursue-goals))"""
    with Interpreter(clock="virtual", output=StringIO()) as agent:
        agent.eval(BATTERY + text)
        assert [str(goal) for goal in agent.goals] == ["(maintain (battery :full))"]
        assert agent.agenda is not None and agent.agenda.pursuit is None
        assert (agent.runs.lives.count, len(agent.scheduler.timers)) == (0, 0)
        assert (agent.scheduler.polls.waits, agent.database.subscribers) == ([], [])
