"""`esl run --choices` and `--record-choices`: a course that was taken, or is to be taken."""

from __future__ import annotations

from pathlib import Path

import pytest
from unit.tools.command import call

PLAN = """(task-net (a (princ "a1 ") (yield) (princ "a2 ")) (b (princ "b1 ") (yield) (princ "b2 "))
                    (c (princ "c1 ") (yield) (princ "c2 ")))"""


@pytest.fixture
def course(tmp_path: Path) -> str:
    """A file for choices."""
    return str(tmp_path / "course")


def test_a_shuffled_run_can_be_had_again(course: str) -> None:
    for seed in "1234":
        first = call(["run", "--shuffle", "--seed", seed, "--record-choices", course, "-e", PLAN])
        again = call(["run", "--choices", course, "-e", PLAN])
        assert (first.code, first.out) == (again.code, again.out)


def test_a_course_may_be_written_by_hand(course: str) -> None:
    Path(course).write_text("; the last one first\nc\nc\n", encoding="utf-8")
    assert call(["run", "--choices", course, "-e", PLAN]).out.startswith("c1 c2 a1 b1 a2 b2")


def test_an_order_that_nobody_chose_is_written_down_as_well(course: str) -> None:
    call(["run", "--record-choices", course, "-e", PLAN])
    assert Path(course).read_text(encoding="utf-8").split() == ["a", "b", "c", "a", "b"]


def test_a_choice_that_does_not_fit_is_told_with_its_step(course: str) -> None:
    Path(course).write_text("b\nnobody\n", encoding="utf-8")
    ended = call(["run", "--choices", course, "-e", PLAN])
    assert ended.code == 65
    assert "choice 2 is `nobody`, which is not ready; ready are `a`, `c`, `b`" in ended.err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--choices", "no-such-file"], "cannot read `no-such-file`"),
        (["--choices", "x", "--shuffle"], "give one of them"),
    ],
)
def test_what_cannot_be_is_wrong_usage(words: list[str], message: str) -> None:
    ended = call(["run", *words, "-e", "1"])
    assert ended.code == 2
    assert message in ended.err


def test_the_choices_do_not_take_the_place_of_the_plan(tmp_path: Path) -> None:
    plan = tmp_path / "plan.esl"
    plan.write_text(PLAN, encoding="utf-8")
    assert call(["run", "--record-choices", str(plan), str(plan)]).code == 2
    assert plan.read_text(encoding="utf-8") == PLAN
