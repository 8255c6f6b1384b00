"""The active path: what listeners and traces tell of actions, and of what is left because of a condition."""

from __future__ import annotations

from typing import Any

from unit.tools.traced import told, traced

from eslang.base.shown import shown
from eslang.tools.trace_words import sentence

APPROACH = """
(defvar *distance* 2)
(defaction ahead (&optional (by 1)) (decf *distance* by))
(defstep approach (n) (repeat (ahead n)))
(do-first ((= *distance* 0) (princ "grip")) (t (approach 1)))
"""


def paths(text: str, kind: str = "action") -> list[str]:
    """The events of KIND in a run of TEXT: what is done, or why it is left, and the active path."""
    return [line(event) for event in told(text) if event.kind == kind]


def line(event: Any) -> str:
    """EVENT in a line."""
    first = event.data["action"] if event.kind == "action" else event.data["condition"]
    return f"{shown(first)}: {' '.join(shown(stage) for stage in event.data['path'])}"


def test_an_action_is_told_with_its_arguments_and_the_path_to_it() -> None:
    assert paths(APPROACH) == [
        "(ahead 1): (do-first 2 t) (approach 1) (repeat 1)",
        "(ahead 1): (do-first 2 t) (approach 1) (repeat 1)",
        '(princ "grip"): (do-first 1 (= *distance* 0))',
    ]


def test_what_is_left_is_told_with_the_condition_that_made_it_so() -> None:
    assert paths(APPROACH, "deactivated") == ["(= *distance* 0): (do-first 2 t)"]


def test_each_parallel_step_has_a_path_of_its_own() -> None:
    assert sorted(paths("(do-all (scs:do 1 2) 3)")) == [
        "1: (do-all 1) (do 1)",
        "2: (do-all 1) (do 2)",
        "3: (do-all 2)",
    ]


def test_a_choice_tells_which_alternative_it_tries() -> None:
    heard = paths("(defaction jam () (fail :jam)) (do*-best (t 5 (scs:do* (if nil 1))) (t 2 (jam)))")
    assert heard == ["(if nil 1): (do*-best 1 t) (do* 1)"]


def test_an_action_outside_of_all_constructs_has_no_path() -> None:
    assert paths("(atomic 1)") == ["(atomic 1): "]


def test_of_a_very_long_path_the_nearest_constructs_are_told() -> None:
    down = "(defstep down (n) (if (> n 0) (down (- n 1)) (princ n))) (down 60)"
    deepest = paths(down)[-1]
    assert ": (:outer 11) (down 1)" in deepest and deepest.count("(down 1)") == 50


def test_a_choice_with_nothing_left_says_so() -> None:
    heard = [
        event.data["why"] for event in told("(do-any (scs:do :when nil 1))") if event.kind == "deactivated"
    ]
    assert heard == ["when", "alternatives"]


def test_a_trace_says_it_in_words() -> None:
    found = [sentence(each) for each in traced(APPROACH).records if each.kind in ("action", "deactivated")]
    assert found[1:] == [
        "does (AHEAD 1), in DO-FIRST 2 T › APPROACH 1 › REPEAT 1",
        "leaves DO-FIRST 2 T: (= *DISTANCE* 0) holds",
        'does (PRINC "grip"), in DO-FIRST 1 (= *DISTANCE* 0)',
    ]


def test_each_modifier_says_what_it_means() -> None:
    def said(modifier: str, condition: str) -> str:
        text = f"(defvar *on* t) (scs:do {modifier} {condition} (setq *on* nil) 2)"
        return next(sentence(each) for each in traced(text).records if each.kind == "deactivated")

    assert said(":while", "*on*") == "leaves DO 1: *ON* does not hold"
    assert said(":until", "(not *on*)") == "leaves DO 1: (NOT *ON*) holds"
    assert said(":when", "(not *on*)") == "leaves DO 1: (NOT *ON*) does not hold"
    assert said(":unless", "*on*") == "leaves DO 1: *ON* holds"
