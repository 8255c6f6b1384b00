"""Structures as Python sees them."""

from __future__ import annotations

import pytest

from eslang.base.diagnostics import EslError
from eslang.base.failure import Failure
from eslang.base.symbols import Keyword
from eslang.interpreter import Interpreter


def test_a_structure_passes_through_python_untouched() -> None:
    with Interpreter() as agent:
        agent.eval("(defstruct point (x 0) y)")
        point = agent.eval("(make-point :y 2)")
        assert agent.call("point-y", point) == 2
        assert agent.call("point-p", point) is True


def test_an_accessor_refuses_what_is_of_another_type() -> None:
    with Interpreter() as agent:
        agent.eval("(defstruct point x) (defstruct box x)")
        with pytest.raises(Failure) as caught:
            agent.eval("(point-x (make-box))")
    assert caught.value.cause is Keyword("TYPE-ERROR")
    assert [str(a) for a in caught.value.arguments[1:]] == ["POINT", "POINT-X"]


def test_a_type_defined_again_as_it_was_keeps_its_structures() -> None:
    with Interpreter() as agent:
        agent.eval("(defstruct point x)")
        point = agent.eval("(make-point :x 1)")
        agent.eval("(defstruct point (x 5))")
        assert agent.call("point-x", point) == 1
        agent.eval("(defstruct point x y)")
        with pytest.raises(Failure):
            agent.call("point-x", point)


@pytest.mark.parametrize(("name", "owner"), [("task", "ESL"), ("event", "ESL"), ("vector", "Common Lisp")])
def test_a_structure_does_not_take_the_name_of_a_type_that_is_there(name: str, owner: str) -> None:
    with Interpreter() as agent, pytest.raises(EslError, match=f"{name.upper()} is a type of {owner}"):
        agent.eval(f"(defstruct {name} x)")


def test_a_name_that_is_shadowed_is_free_for_a_structure() -> None:
    with Interpreter() as agent:
        agent.eval("(defpackage :mine (:use :cl :esl) (:shadow #:task)) (in-package :mine)")
        agent.eval("(defstruct task x)")
        assert agent.eval("(typep (make-task) 'task)") is True
        assert agent.eval("(typep (esl:current-task) 'esl:task)") is True
