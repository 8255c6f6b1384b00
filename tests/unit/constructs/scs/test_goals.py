"""Top-level goals: given, dropped, impossible (SCS §2; decision 37)."""

from __future__ import annotations

import pytest
from pursuits import LAMPS, SEEDS, changes_of

from support import lines_of, run

# --- giving --------------------------------------------------------------------------


def test_a_goal_is_shown_listed_and_waits_to_be_pursued() -> None:
    text = (
        "(print (add-goal (achieve (lamp hall :on)))) (print (goals)) (print (mapcar 'goal-status (goals)))"
    )
    assert lines_of(LAMPS + text) == [
        "#<GOAL (ACHIEVE (LAMP HALL :ON))>",
        "(#<GOAL (ACHIEVE (LAMP HALL :ON))>)",
        "(:PENDING)",
    ]


def test_a_goal_that_is_there_already_is_not_added_again() -> None:
    text = """
    (defvar *first* (add-goal (achieve (lamp hall :on))))
    (print (eq *first* (add-goal (achieve (lamp hall :on)))))
    (print (eq (add-goal (achieve (lamp ?where :on))) (add-goal (achieve (lamp ?place :on)))))
    (print (eq *first* (add-goal (maintain (lamp hall :on)))))
    (print (length (goals)))"""
    assert lines_of(LAMPS + text) == ["T", "T", "NIL", "3"]


def test_a_goal_that_is_over_can_be_given_again() -> None:
    text = """(add-goal (achieve (lamp hall :on))) (pursue-goals)
    (retract '(lamp hall :on))
    (add-goal (achieve (lamp hall :on))) (pursue-goals) (print (db-query '(lamp hall ?x)))"""
    assert lines_of(LAMPS + text) == ["(((?X . :ON)))"]


def test_a_goal_may_be_computed() -> None:
    text = """
    (dolist (where '(hall attic)) (add-goal (achieve `(lamp ,where :on))))
    (let ((goal '(maintain (lamp cellar :off)))) (add-goal goal))
    (add-goal `(achieve (lamp ,(car '(door)) :on)))
    (print (goals)) (pursue-goals)
    (print (length (db-query '(lamp ?where ?state))))"""
    lines = lines_of(LAMPS + text)
    assert lines == [
        (
            "(#<GOAL (ACHIEVE (LAMP HALL :ON))> #<GOAL (ACHIEVE (LAMP ATTIC :ON))> "
            "#<GOAL (MAINTAIN (LAMP CELLAR :OFF))> #<GOAL (ACHIEVE (LAMP DOOR :ON))>)"
        ),
        "4",
    ]


def test_local_variables_that_a_condition_is_called_with_make_goals_differ() -> None:
    text = """
    (defvar *level* 0) (defun full? (n) (>= *level* n))
    (to-achieve (full? ?n) (t (setq *level* #?n)))
    (dolist (n '(2 5)) (add-goal (achieve (full? n))))
    (print (goals)) (pursue-goals) (print *level*)"""
    assert lines_of(text) == ["(#<GOAL (ACHIEVE (FULL? 2))> #<GOAL (ACHIEVE (FULL? 5))>)", "5"]


def test_a_condition_asks_global_variables_anew() -> None:
    text = """
    (defvar *charge* 10) (to-achieve (> *charge* 20) (t (incf *charge* 5)))
    (add-goal (achieve (> *charge* 20))) (pursue-goals) (print *charge*)"""
    assert lines_of(text) == ["25"]


def test_a_goal_keeps_the_bindings_of_the_place_where_it_is_given() -> None:
    text = """(assert '(is-a hall room))
    (with-query-bindings '(is-a ?room room) (add-goal (achieve (lamp #?room :on)) :by
      (assert '(lamp #?room :on))))
    (print (goals)) (pursue-goals) (print (db-query '(lamp ?x :on)))"""
    assert lines_of(LAMPS + text) == ["(#<GOAL (ACHIEVE (LAMP HALL :ON))>)", "(((?X . HALL)))"]


@pytest.mark.parametrize(
    ("form", "message", "hint"),
    [
        ("(add-goal (lamp hall :on))", "`(lamp hall :on)` is no goal", "write `(achieve condition)` or"),
        ("(add-goal 5)", "`5` is no goal", "write `(achieve condition)` or `(maintain condition)`"),
        ("(add-goal (achieve))", "a goal has one condition, found none", "write `(achieve condition)` or"),
        ("(add-goal (maintain a b))", "a goal has one condition, found 2", "join them by `and`"),
        ("(add-goal (achieve (a)) :utilty 3)", "add-goal has no option `:utilty`", "write `:utility form`"),
        ("(add-goal (achieve (a)) :by)", "`:by` has no value", "write `:utility form`"),
        ("(drop-goal (achieve))", "a goal has one condition, found none", "write `(achieve condition)` or"),
        ("(pursue-goals (go-home))", "pursue-goals has no steps", "give goals with `add-goal`"),
        ("(pursue-goals :whil t)", "`:whil` is no modifier of a step", "write `:while`"),
    ],
)
def test_what_is_no_goal_is_told_where_it_stands(form: str, message: str, hint: str) -> None:
    error = run(f"\n  {form}").error
    assert error.diagnostic.message == message
    assert error.diagnostic.hint.startswith(hint)
    assert error.diagnostic.labels[0].span.line == 2


@pytest.mark.parametrize(
    "form",
    [
        "(let ((goal '(lamp hall :on))) (add-goal goal))",
        "(add-goal '(achieve (lamp hall :on) twice))",
        "(add-goal (achieve (lamp hall :on)) :retries -1)",
        "(drop-goal :lamp)",
        "(goal-status '(achieve (lamp hall :on)))",
    ],
)
def test_what_turns_out_to_be_no_goal_is_a_type_error(form: str) -> None:
    assert str(run(LAMPS + form).failure.cause) == ":TYPE-ERROR"


def test_to_wait_for_a_goal_that_nobody_pursues_is_a_deadlock() -> None:
    failure = run("(wait-for-events (add-goal (achieve (lamp on))))").failure
    told = failure.report.waiting[0]
    assert told.what == "the end of the goal (achieve (lamp on))"
    assert (told.why, told.advice) == (
        "no task that is left pursues goals",
        "let another task `(pursue-goals)`",
    )


# --- dropping ------------------------------------------------------------------------


def test_a_goal_that_is_dropped_leaves_its_attempt_with_cleanups() -> None:
    text = """
    (defvar *goal*
      (add-goal (achieve (cup held)) :by (with-cleanup-procedure (progn (sleep 1) (print :cleaned))
        (sleep 100))))
    (spawn (progn (sleep 5) (print (drop-goal *goal*)) (print (drop-goal *goal*)) (print (goals))
                  (print (multiple-value-list (wait-for-events *goal*)))))
    (print (pursue-goals))"""
    assert lines_of(text) == ["T", "NIL", "NIL", ":CLEANED", "(:DROPPED)", "T"]


def test_a_goal_may_be_dropped_by_what_it_says() -> None:
    text = """(add-goal (achieve (lamp hall :on))) (add-goal (maintain (lamp ?x :off)))
    (print (list (drop-goal (achieve (lamp hall :on))) (drop-goal (achieve (lamp hall :on)))
                 (let ((place 'hall)) (drop-goal `(achieve (lamp ,place :on))))
                 (drop-goal '(maintain (lamp ?where :off))) (goals)))"""
    assert lines_of(LAMPS + text) == ["(T NIL NIL T NIL)"]


@pytest.mark.slow
def test_a_goal_may_drop_itself() -> None:
    text = """(add-goal (achieve (cup held)) :by (scs:do (drop-goal (achieve (cup held))) (print :never)))
    (add-goal (achieve (lamp hall :on)))
    (print (pursue-goals)) (print (goals))"""
    for seed in SEEDS:
        assert lines_of(LAMPS + text, seed=seed) == ["T", "NIL"]


def test_the_same_goal_given_again_begins_when_the_attempt_that_is_dropped_has_ended() -> None:
    text = """
    (add-goal (achieve (cup held)) :by (with-cleanup-procedure (progn (sleep 2) (print :cleaned))
      (sleep 100)))
    (spawn (progn (sleep 1) (drop-goal (achieve (cup held)))
                  (add-goal (achieve (cup held)) :by (progn (print :again) (assert '(cup held))))))
    (pursue-goals) (print (goals))"""
    assert lines_of(text) == [":CLEANED", ":AGAIN", "NIL"]


def test_who_aborts_the_task_of_a_goal_drops_it() -> None:
    text = """(add-goal (achieve (cup held)) :by (scs:do (abort-task (current-task)) (sleep 1)))
    (print (pursue-goals)) (print (goals))"""
    assert lines_of(text) == ["T", "NIL"]
    assert changes_of(text)[-1] == "dropped (achieve (cup held))"


# --- when goals are impossible -------------------------------------------------------


def test_a_goal_for_which_there_is_no_method_is_impossible_when_nothing_else_goes_on() -> None:
    text = "(progn (defvar *goal* (add-goal (achieve (at robot moon)))) (pursue-goals))"
    assert (
        str(run(text).failure)
        == "failure :IMPOSSIBLE-GOALS (((ACHIEVE (AT ROBOT MOON)) :NO-APPLICABLE-METHOD (AT ROBOT MOON)))"
    )
    text = f"(with-recovery-procedures ((:impossible-goals (abort 1))) {text})"
    assert lines_of(f"{text} (print (list (goal-status *goal*) (goals)))") == ["(:IMPOSSIBLE NIL)"]


def test_a_goal_that_finds_no_method_waits_for_facts_while_others_are_pursued() -> None:
    text = """
    (to-achieve (at robot ?place) ((db-query '(door open)) (assert '(at robot #?place))))
    (add-goal (achieve (at robot hall)))
    (add-goal (achieve (door open)) :by (progn (sleep 5) (assert '(door open))))
    (pursue-goals) (print (db-query '(at robot ?x)))"""
    assert lines_of(text) == ["(((?X . HALL)))"]
    assert "blocked (achieve (at robot hall)) :no-applicable-method" in changes_of(text)


def test_it_waits_for_facts_of_others_where_pursue_goals_waits() -> None:
    text = """
    (to-achieve (at robot ?place) ((db-query '(door open)) (assert '(at robot #?place))))
    (add-goal (achieve (at robot hall)))
    (spawn (progn (sleep 9) (assert '(door open))))
    (pursue-goals :wait t :until (at robot hall)) (print :there)"""
    assert lines_of(text) == [":THERE"]


@pytest.mark.parametrize(
    ("failing", "cause"),
    [
        ("(fail :impossible :too-heavy)", ":impossible"),
        ("(fail :too-heavy)", ":too-heavy"),
        ("(car 5)", ":type-error"),
        ("(wait-until (nobody knows))", ":deadlock"),
    ],
)
def test_a_plan_can_say_that_a_goal_is_impossible(failing: str, cause: str) -> None:
    text = f"""(define-failure :too-heavy :impossible)
    (defvar *goal* (add-goal (achieve (cup held)) :by {failing}))
    (add-goal (achieve (lamp hall :on)))
    (with-recovery-procedures (((:impossible-goals goals) (abort goals))) (pursue-goals))
    (print (db-query '(lamp ?x :on)))
    (print (car (multiple-value-list (wait-for-events *goal*))))"""
    assert lines_of(LAMPS + text)[-2:] == ["(((?X . HALL)))", ":IMPOSSIBLE"]
    heard = changes_of(LAMPS + text)
    assert f"impossible (achieve (cup held)) {cause}" in heard
    assert heard.count("pursued (achieve (cup held))") == 1


def test_retries_limit_the_attempts() -> None:
    text = """(defvar *tries* 0)
    (add-goal (achieve (cup held)) :by (progn (incf *tries*) (fail :slipped)) :retries 2)
    (print (with-recovery-procedures (((:impossible-goals goals) (abort goals))) (pursue-goals)))
      (print *tries*)"""
    assert lines_of(text)[-2:] == ["(((ACHIEVE (CUP HELD)) :SLIPPED))", "3"]


def test_of_goals_in_a_deadlock_the_last_one_is_given_up_and_the_others_go_on() -> None:
    text = """
    (defevent free)
    (add-goal (achieve (one)) :by (progn (wait-for-events free) (assert '(one))))
    (add-goal (achieve (two)) :by
      (with-cleanup-procedure (signal free) (wait-until (nobody knows))))
    (print (with-recovery-procedures (((:impossible-goals goals) (abort (mapcar 'car goals))))
      (pursue-goals)))
    (print (db-query '(one)))"""
    assert lines_of(text)[-2:] == ["((ACHIEVE (TWO)))", "(NIL)"]
