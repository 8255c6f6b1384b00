"""What SCS leaves to chance: over many seeds all comes up that may, and with one seed always the same."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest

from eslang.tools.expectations import squeezed
from support import lines_of, run

SEEDS = range(30)
MANY = range(60)  # for what has many outcomes


def outcomes(text: str, seeds: Iterable[int] = SEEDS) -> set[str]:
    """What TEXT prints, on one line, with each of SEEDS."""
    return {" ".join(lines_of(text, seed=seed)) for seed in seeds}


# claim SCS-C-x: Whose turn it is, is chance: three steps come in all six orders.
@pytest.mark.slow
def test_do_all_takes_its_steps_in_any_order() -> None:
    assert outcomes("(do-all (princ 1) (princ 2) (princ 3))") == {"123", "132", "213", "231", "312", "321"}


# claim SCS-C-x: The choice is made anew after each action.
@pytest.mark.slow
def test_do_all_interleaves_in_any_way() -> None:
    text = "(do-all (scs:do (princ 1) (princ 2)) (scs:do (princ 'a) (princ 'b)))"
    assert outcomes(text, MANY) == {"12AB", "1A2B", "1AB2", "A12B", "A1B2", "AB12"}


# claim SCS-C-aa: When a failed substep is tried again, and what comes in between, is chance.
@pytest.mark.slow
def test_do_star_all_retries_at_any_time() -> None:
    text = """(defvar *tries* 0)
              (do*-all (progn (princ 'f) (if (< (incf *tries*) 2) (fail :no)))
                       (scs:do (princ 1) (princ 2)))"""
    assert outcomes(text, MANY) == {"FF12", "F1F2", "F12F", "1FF2", "1F2F", "12FF"}


# claim SCS-C-ab: Each of the steps may be the one.
@pytest.mark.slow
def test_do_any_may_choose_any() -> None:
    assert outcomes("(princ (do-any 1 2 3))") == {"1", "2", "3"}


# claim SCS-C-ac: Of the others, any may be tried next.
@pytest.mark.slow
def test_do_any_tries_the_others_in_any_order() -> None:
    text = "(defun no (n) (princ n) (fail :no)) (do-any (no 1) (no 2) (no 3))"
    found = {"".join(squeezed(run(text, seed=seed).output.split("\n"))) for seed in SEEDS}
    assert found == {"123", "132", "213", "231", "312", "321"}


# claim SCS-C-af: A step that has failed may be the next that is tried, and need not be.
@pytest.mark.slow
def test_do_star_any_may_repeat_itself() -> None:
    text = """(defvar *tries* 0)
              (defun act (n) (princ n) (if (< (incf *tries*) 2) (fail :no)))
              (do*-any (act 1) (act 2))"""
    assert outcomes(text) == {"11", "12", "21", "22"}


# claim SCS-C-am: Of those that are equally good, each may be selected; the worse never.
@pytest.mark.slow
def test_do_best_may_select_any_of_the_best() -> None:
    assert outcomes("(princ (do-best (t 2 1) (t 1 2) (t 2 3) (t 2.0 4)))") == {"1", "3", "4"}


# claim SCS-3-j: Nothing is preferred for where it stands.
@pytest.mark.slow
def test_chance_is_fair_enough() -> None:
    firsts = [lines_of("(princ (do-any 1 2))", seed=seed)[0] for seed in range(200)]
    assert 70 < firsts.count("1") < 130


# claim LR-7-u: The same seed makes the same choices; another one, others.
@pytest.mark.slow
def test_choices_come_from_the_seed() -> None:
    text = """(dotimes (i 10) (princ (do-any 1 2 3)) (princ (do-best (t 1 4) (t 1 5))))
              (do-all (scs:do (princ 'a) (princ 'b)) (scs:do (princ 'c) (princ 'd)))"""
    assert len(outcomes(text)) > 25
    for seed in range(5):
        assert len(outcomes(text, [seed] * 3)) == 1


# claim SCS-2-z: At the beginning of each action it is known which steps are active, and what is next.
def test_listeners_hear_which_steps_are_active() -> None:
    heard: list[str] = []

    def hear(event: Any) -> None:
        if event.kind == "action":
            heard.append(str(event.data["path"]))

    run("(scs:do 1 (do-any (do-first (nil 2) (t 3 (atomic 4)))))", listeners=[hear])
    assert len(heard) == 3
    assert heard[0].count("DO") == 1
    assert all("DO-ANY" in path and "DO-FIRST" in path for path in heard[1:])


# claim SCS-2-z: And when one is left, because of which condition.
def test_listeners_hear_what_is_left() -> None:
    heard: list[str] = []

    def hear(event: Any) -> None:
        if event.kind == "deactivated":
            heard.append(f"{event.data['why']} {event.data['condition']}")

    run(
        """(defvar *n* 0)
           (scs:do :when (> *n* 5) 1)
           (scs:do :until (= *n* 2) (do-first ((= *n* 0) (incf *n*)) (t (incf *n*))))""",
        listeners=[hear],
    )
    assert [line.split()[0] for line in heard] == ["when", "condition", "until"]
