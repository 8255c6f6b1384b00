"""Choices: a run takes the course that it is told, and tells which it took."""

from __future__ import annotations

from collections.abc import Sequence
from io import StringIO
from typing import Any

import pytest

from eslang import Interpreter
from eslang.base.control import Stop
from eslang.runtime.choices import choices_text, read_choices

PLAN = """(task-net (a (princ "a1 ") (yield) (princ "a2 ")) (b (princ "b1 ") (yield) (princ "b2 "))
                    (c (princ "c1 ") (yield) (princ "c2 ")))"""


def course(**given: Any) -> tuple[str, list[str]]:
    """What PLAN prints, and the choices that were made."""
    written = StringIO()
    with Interpreter(clock="virtual", output=written, **given) as interp:
        interp.eval(PLAN)
        interp.finish()
        assert interp.runs.choices is not None
        return written.getvalue().strip(), interp.runs.choices.made


def test_a_list_of_names_says_who_has_the_turn() -> None:
    assert course(choices=["c", "c", "b", "a"])[0] == "c1 c2 b1 a1 b2 a2"


def test_behind_the_end_of_the_list_the_ready_take_turns() -> None:
    assert course(choices=[])[0] == "a1 b1 c1 a2 b2 c2"
    assert course(choices=["b"])[0] == "b1 a1 c1 b2 a2 c2"


def test_a_function_is_given_the_ready_and_gives_an_index() -> None:
    seen: list[list[str]] = []

    def last(ready: Sequence[Any]) -> int:
        seen.append([task.name for task in ready])
        return len(ready) - 1

    assert course(choices=last)[0] == "c1 c2 b1 b2 a1 a2"
    assert seen == [["a", "b", "c"], ["a", "b", "c"], ["a", "b"], ["a", "b"]]


def test_a_step_without_a_choice_is_not_noted() -> None:
    assert course(choices=["c", "c", "b", "b"])[1] == ["c", "c", "b", "b"]


def test_any_run_can_be_had_again_from_what_it_noted() -> None:
    for seed in range(10):
        printed, made = course(shuffle=True, seed=seed)
        assert course(choices=made) == (printed, made)


@pytest.mark.parametrize(
    ("choices", "reason"),
    [
        (["a", "nobody"], "choice 2 is `nobody`, which is not ready; ready are `b`, `c`, `a`"),
        (lambda ready: 7, "choice 1 is number 7, which is not ready; ready are `a`, `b`, `c`"),
        (lambda ready: -1, "choice 1 is number -1, which is not ready; ready are `a`, `b`, `c`"),
    ],
)
def test_a_choice_that_does_not_fit_stops_the_run_and_tells_the_step(choices: Any, reason: str) -> None:
    with pytest.raises(Stop) as stopped:
        course(choices=choices)
    assert (stopped.value.reason, stopped.value.code) == (reason, 65)


def test_a_run_that_is_stopped_so_cleans_up() -> None:
    written = StringIO()
    with Interpreter(clock="virtual", output=written, choices=["a", "x"]) as interp, pytest.raises(Stop):
        interp.eval("(task-net (a (unwind-protect (sleep 1) (princ :clean))) (b (sleep 1)) (c (sleep 1)))")
    assert written.getvalue() == "CLEAN"


def test_a_file_of_choices_has_a_name_a_line() -> None:
    assert read_choices("; how it went wrong\nmain\n\n recovery.2 \n") == ["main", "recovery.2"]
    assert read_choices(choices_text(["a", "b.2"])) == ["a", "b.2"]
