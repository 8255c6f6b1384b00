"""Stories: where a failure was raised, who was asked, and the Lisp stack."""

from __future__ import annotations

from io import StringIO

import pytest

from eslang import Failure, Interpreter
from eslang.base.spans import Source
from eslang.runtime.story import Story


def story_of(text: str) -> Story:
    """The story of the failure that TEXT ends with."""
    with Interpreter(clock="virtual", output=StringIO()) as interp, pytest.raises(Failure) as caught:
        for reading in interp.readings(Source("plan.esl", text)):
            interp.evaluate(reading)
    story = caught.value.story
    assert isinstance(story, Story)
    return story


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("(list 1\n  (car\n     5)\n  2)", 2, 3),
        ("(list 1\n  (nosuch\n     5\n  )\n  2)", 2, 3),
        ('(print\n  (+ 1\n     (quote\n  "a")\n  2))', 2, 3),
        ("(list 1\n  nosuch)", 2, 3),
        ("(list\n 1)\n(setf (svref\n   5 1)\n 2)", 3, 1),
        ('(list "äöü😀" (car 5))', 1, 14),
    ],
)
def test_a_form_of_many_lines_stands_where_it_begins(text: str, line: int, column: int) -> None:
    place = story_of(text).place
    assert place is not None
    assert (place.file, place.line, place.column) == ("plan.esl", line, column)


def test_the_stack_is_told_innermost_first() -> None:
    story = story_of("(defun f (x) (car x))\n(defun g (x)\n (list (f x)))\n(g 5)")
    assert [(frame.name, frame.place.line) for frame in story.stack] == [("F", 1), ("G", 3), ("top level", 4)]


def test_every_active_procedure_was_asked_innermost_first() -> None:
    inner = "(with-recovery-procedures ((:b 1) (:a :retries 2 (retry))) (fail :a))"
    story = story_of(f"(with-recovery-procedures ((:c 1))\n {inner})")
    found = [(str(one.cause), one.takes, one.used, one.left) for one in story.asked]
    assert found == [(":B", False, 0, 1), (":A", True, 2, 0), (":C", False, 0, 1)]


def test_procedures_of_the_form_that_is_answering_are_those_asked() -> None:
    """While a procedure of a form runs, those inside the form's body are not active."""
    inner = "(with-recovery-procedures ((:b 1)) (fail :a))"
    story = story_of(f"(with-recovery-procedures ((:a (fail :z)))\n {inner})")
    assert [str(one.cause) for one in story.asked] == [":A"]


def test_of_a_deep_stack_only_the_innermost_part_is_told() -> None:
    story = story_of("(defun f (n) (if (= n 0) (car 1) (+ 1 (f (- n 1)))))\n(f 5000)")
    assert 10 <= len(story.stack) <= 60
    assert {frame.name for frame in story.stack[:9]} == {"F"}


def test_a_place_is_written_as_file_line_and_column() -> None:
    assert str(story_of("\n  (car 5)").place) == "plan.esl:2:3"
