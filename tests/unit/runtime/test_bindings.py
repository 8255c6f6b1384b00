"""Dynamic bindings of special variables: made, undone, and unbound again."""

from __future__ import annotations

import pytest

from eslang.base.image import Image
from eslang.base.lists import lisp_list
from eslang.base.symbols import Symbol
from eslang.runtime.bindings import Bindings
from support import lines_of

SPEED, POWER = (Symbol.intern(name, "ESL-USER") for name in ("*SPEED*", "*POWER*"))


def test_a_binding_hides_the_value_until_it_is_undone() -> None:
    image = Image()
    bindings, cell = Bindings(image), image.cell(SPEED)
    cell.value = 1
    bindings.bind(cell, 2)
    bindings.bind(cell, 3)
    assert cell.value == 3
    bindings.unbind(2)
    assert (cell.value, bindings.hidden) == (1, None)


def test_a_variable_without_a_value_is_unbound_again_afterwards() -> None:
    image = Image()
    bindings, cell = Bindings(image), image.cell(SPEED)
    bindings.bind(cell, 2)
    bindings.unbind(1)
    assert not hasattr(cell, "value")


def test_progv_makes_a_variable_without_a_value_unbound() -> None:
    image = Image()
    bindings, speed, power = Bindings(image), image.cell(SPEED), image.cell(POWER)
    power.value = 5
    count = bindings.bind_all(lisp_list(SPEED, POWER), lisp_list(7))
    assert (count, speed.value, hasattr(power, "value")) == (2, 7, False)
    bindings.unbind(count)
    assert (hasattr(speed, "value"), power.value) == (False, 5)


LEAVES = {
    "its end": "(let ((*speed* 2)) (princ *speed*))",
    "a return": "(block b (let ((*speed* 2)) (princ *speed*) (return-from b nil)))",
    "a throw": "(catch 'b (let ((*speed* 2)) (princ *speed*) (throw 'b nil)))",
    "a failure": "(with-recovery-procedures ((:b (abort))) (let ((*speed* 2)) (princ *speed*) (fail :b)))",
    "an error": "(ignore-errors (let ((*speed* 2)) (princ *speed*) (car 5)))",
    "progv": "(progv '(*speed*) '(2) (princ *speed*))",
    "a parameter": "(funcall (lambda (*speed*) (princ *speed*)) 2)",
    "an optional parameter": "(funcall (lambda (&optional (*speed* 2)) (princ *speed*)))",
}


@pytest.mark.parametrize("way", LEAVES)
def test_a_binding_ends_with_its_form_however_that_is_left_by(way: str) -> None:
    assert lines_of(f"(defvar *speed* 1) {LEAVES[way]} (princ *speed*)") == ["21"]


def test_a_closure_does_not_keep_a_dynamic_binding() -> None:
    text = "(defvar *speed* 1) (princ (funcall (let ((*speed* 2)) (lambda () *speed*))))"
    assert lines_of(text) == ["1"]
