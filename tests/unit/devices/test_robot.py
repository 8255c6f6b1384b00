"""The robot: what it does, what it senses, and what it says when something is in its way."""

from __future__ import annotations

from typing import Any

import pytest

from support import lines_of, run

PLACED = "(place-wall :north -9 3 9 3) (place-robot 0 0 90)"
POSE = "(mapcar (lambda (each) (/ (round each 0.01) 100.0)) (esl::%robot :pose))"


def shows(text: str, **given: Any) -> str:
    """What TEXT prints last, on a line of its own."""
    return lines_of(text, **given)[-1]


def cause_of(text: str, **given: Any) -> str:
    """The failure that TEXT ends with: its cause and its arguments."""
    failure = run(text, **given).failure
    return " ".join(map(str, (failure.cause, *failure.arguments)))


# --- motion --------------------------------------------------------------------------


def test_it_drives_as_far_as_it_is_told_and_takes_the_time_for_it() -> None:
    assert shows(f"(place-robot 0 0 90) (with-deadline (4.2) (robot-advance 2))(print {POSE})") == (
        "(0.0 2.0 90.0)"
    )
    assert cause_of("(place-robot 0 0 90) (with-deadline (3.8) (robot-advance 2))").startswith(
        ":DEADLINE-EXPIRED"
    )


def test_it_turns_as_far_as_it_is_told() -> None:
    text = f"(place-robot 0 0 0) (robot-turn 90) (robot-advance -1) (robot-turn -200) (print {POSE})"
    assert shows(text) == "(0.0 -1.0 -110.0)"


def test_what_is_to_go_no_way_at_all_takes_no_time() -> None:
    assert shows("(place-robot 0 0 0) (print (with-deadline (0.01) (robot-advance 0)))") == "0"


def test_it_drives_until_its_step_is_left() -> None:
    text = f"""{PLACED}
      (do-first ((and (robot-senses :ahead ?far) (< ?far 1)) :near) (t (robot-drive 0.4)))
      (print (list (robot-sense :motion) {POSE}))"""
    assert shows(text) == "(:STILL (0.0 1.84 90.0))"


def test_it_stands_still_when_what_drives_it_is_aborted() -> None:
    text = f"""{PLACED} (with-recovery-procedures ((:deadline-expired (abort)))
      (with-deadline (1) (robot-drive 0.5)))"""
    assert shows(f"{text} (sleep 5) (print {POSE})") == "(0.0 0.5 90.0)"


def test_it_bumps_into_what_is_there_and_names_it() -> None:
    assert cause_of(f"{PLACED} (robot-drive)") == ":BUMPED :NORTH"
    text = f"""{PLACED} (with-recovery-procedures ((:bumped (abort))) (robot-drive))
      (print (db-query '(robot-senses :bumped ?thing))) (robot-advance -0.5)
      (print (list (robot-sense :ahead) (db-query '(robot-senses :bumped ?thing))))"""
    assert lines_of(text)[-2:] == ["(((?THING . :NORTH)))", "(0.51 NIL)"]


def test_things_may_have_names_of_any_kind() -> None:
    text = """(place-robot 0 0 0) (place-wall '(door (2)) 1 -1 1 1) (place-obstacle "box" 3 0)
      (with-recovery-procedures (((:bumped thing) (print thing) (remove-thing thing) (retry)))
        (robot-advance 1))
      (robot-drive)"""
    assert lines_of(text.replace("(robot-drive)", ""))[-1] == "(DOOR (2))"
    assert cause_of(text) == ":BUMPED box"


def test_it_can_turn_and_go_back_where_it_has_bumped() -> None:
    text = f"""{PLACED} (with-recovery-procedures ((:bumped (abort))) (robot-drive))
      (robot-turn 180) (robot-advance 1) (print (< (second {POSE}) 2))"""
    assert shows(text) == "T"


def test_wheels_that_are_stuck_are_told() -> None:
    assert cause_of("(place-robot 0 0 0) (break-robot :stuck) (robot-advance 1)") == ":WHEELS-STUCK"
    assert cause_of("(place-robot 0 0 0) (break-robot :stuck) (robot-spin)") == ":WHEELS-STUCK"


def test_two_tasks_cannot_drive_it_at_once() -> None:
    text = "(place-robot 0 0 0) (task-net (a (robot-advance 1)) (b (robot-turn 9)))"
    assert cause_of(text) == ":ROBOT-BUSY :DRIVING"


def test_all_that_ends_a_motion_is_of_one_kind() -> None:
    for setting in ("(break-robot :stuck)", "(place-obstacle 'box 0.6 0)"):
        text = f"""(place-robot 0 0 0) {setting}
          (print (with-recovery-procedures ((:motion-failed (abort :seen))) (robot-advance 1)))"""
        assert shows(text) == ":SEEN"


def test_a_robot_that_was_not_placed_does_nothing() -> None:
    assert [cause_of("(robot-drive)"), cause_of("(robot-sense :x)")] == [":NO-ROBOT"] * 2


def test_driving_empties_the_battery_and_a_charger_fills_it() -> None:
    text = "(place-robot 0 0 0) (robot-advance 390 100)"
    assert shows(f"{text} (robot-turn 360) (print (robot-sense :battery))") == "2"
    assert cause_of(f"{text} (robot-advance 20)") == ":BATTERY-FLAT"
    assert cause_of(f"{text} (robot-charge)") == ":NO-CHARGER"
    text += " (place-charger 390 0) (robot-charge) (print (list (robot-sense :battery)"
    assert shows(f"{text} (round (get-internal-real-time) 1000000)))") == "(100 23)"


# --- the bar -------------------------------------------------------------------------


def test_it_grabs_a_bar_that_is_in_reach_and_can_lay_it_down() -> None:
    text = """(place-bar 0.4 0 90) (place-robot 0 0 0) (print (robot-grab))
      (print (list (robot-sense :holds) (robot-sense :bar-distance)))
      (robot-turn 90) (print (list (robot-release) (robot-release)))
      (print (mapcar 'robot-sense '(:holds :bar-distance :bar-offset)))"""
    assert lines_of(text) == [":BAR", "(:BAR NIL)", "(:BAR NIL)", "(NIL 0.0 0.0)"]


@pytest.mark.parametrize("bar", ["0.6 0 90", "0.4 0 0", "-0.4 0 90", "0.4 0.2 90"])
def test_it_grabs_nothing_that_is_out_of_reach_or_askew(bar: str) -> None:
    assert cause_of(f"(place-bar {bar}) (place-robot 0 0 0) (robot-grab)").startswith(":NOTHING-TO-GRAB")
    assert cause_of("(place-robot 0 0 0) (robot-grab)") == ":NOTHING-TO-GRAB"


def test_it_grabs_one_bar_at_a_time() -> None:
    text = "(place-bar 0.4 0 90) (place-robot 0 0 0) (robot-grab) (robot-grab)"
    assert cause_of(text) == ":GRIPPER-FULL :BAR"


# --- sensors -------------------------------------------------------------------------


def test_ranges_look_to_four_sides() -> None:
    text = f"{PLACED} (place-obstacle 'box 2 0 0.5)"
    assert shows(f"{text} (print (mapcar 'robot-sense '(:ahead :left :behind :right)))") == (
        "(2.8 4.0 4.0 1.3)"
    )


def test_facts_and_functions_tell_the_same_without_noise() -> None:
    text = """(place-bar 3 3 0) (place-robot 1 0 0)
      (print (every (lambda (found) (eql (robot-sense (cdr (assoc '?s found))) (cdr (assoc '?v found))))
                    (db-query '(robot-senses ?s ?v))))
      (print (mapcar 'robot-sense '(:bar-distance :bar-bearing :bar-offset :midline-bearing)))"""
    assert lines_of(text) == ["T", "(3.61 56.3 -2.0 45.0)"]


def test_facts_change_while_it_moves_and_wake_who_waits() -> None:
    text = f"""{PLACED} (spawn (robot-advance 2))
      (wait-until (and (robot-senses :ahead ?far) (< ?far 2))) (print (robot-sense :motion))"""
    assert shows(text) == ":DRIVING"


def test_a_blind_robot_senses_nothing_around_it() -> None:
    text = f"""{PLACED} (break-robot :blind)
      (print (list (robot-sense :ahead) (db-query '(robot-senses :ahead ?far)) (robot-sense :x)))
      (break-robot :ok) (print (db-query '(robot-senses :ahead ?far)))"""
    assert lines_of(text)[-2:] == ["(NIL NIL 0.0)", "(((?FAR . 2.8)))"]


def test_noise_is_that_of_the_seed() -> None:
    text = "(place-robot 0 0 0 0.05) (robot-advance 3) (print (list (esl::%robot :pose) (robot-sense :x)))"
    assert shows(text, seed=5) == shows(text, seed=5) != shows(text, seed=6)


def test_a_place_has_a_distance_and_a_bearing() -> None:
    text = "(place-robot 1 1 90) (print (list (robot-sense :distance 1 4) (robot-sense :bearing 0 1)))"
    assert shows(text) == "(3.0 90.0)"
    assert cause_of("(place-robot 1 1 90) (robot-sense :bearing 1)") == ":NO-PLACE :BEARING (1.0)"


# --- the world -----------------------------------------------------------------------


def test_obstacles_move_on_the_clock_and_are_seen() -> None:
    text = """(place-robot 0 0 0) (place-obstacle 'cart 3 3) (move-obstacle 'cart 3 0 1)
      (wait-until (and (robot-senses :ahead ?far) (< ?far 3)))
      (print (round (/ (get-internal-real-time) 100000)))"""
    assert shows(text) == "19"


def test_a_door_can_be_opened_before_one_gets_there() -> None:
    text = f"{PLACED} (spawn (progn (sleep 2) (remove-thing :north))) (robot-advance 4) (print {POSE})"
    assert shows(text) == "(0.0 4.0 90.0)"


def test_nothing_that_stands_keeps_a_run_from_being_stuck() -> None:
    assert cause_of("(place-robot 0 0 0) (wait-until (robot-senses :holds :bar))").startswith(":DEADLOCK")


@pytest.mark.parametrize(
    ("form", "cause"),
    [
        ('(place-robot 0 "x" 0)', ":TYPE-ERROR"),
        ("(robot-sense :ahaed)", ":UNKNOWN-SENSOR :AHAED :AHEAD"),
        ("(robot-sense 7)", ":UNKNOWN-SENSOR 7"),
        ("(robot-advance :far)", ":TYPE-ERROR"),
        ("(break-robot :drunk)", ":UNKNOWN-STATE :DRUNK"),
        ("(move-obstacle 'cart 1 1)", ":UNKNOWN-THING CART"),
        ("(place-wall 'north 1 1)", ":NO-WALL (1 1)"),
        ("(place-wall 'north 1 1 2 2 3)", ":NO-WALL"),
        ("(robot-charge)", ":NO-CHARGER"),
    ],
)
def test_what_cannot_be_is_a_failure_that_says_so(form: str, cause: str) -> None:
    assert cause_of(f"(place-robot 0 0 0) {form}").startswith(cause)


def test_taking_away_what_is_not_there_changes_nothing() -> None:
    assert lines_of("(place-wall 'a 0 0 1 1) (print (list (remove-thing 'a) (remove-thing 'a)))") == [
        "(A NIL)"
    ]


def test_a_robot_belongs_to_its_interpreter() -> None:
    assert cause_of("(robot-sense :x)") == ":NO-ROBOT"
