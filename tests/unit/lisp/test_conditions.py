"""Conditions as Python sees them: they are failures."""

from __future__ import annotations

import pytest

from eslang.base.failure import Failure
from eslang.base.symbols import Keyword
from eslang.interpreter import Interpreter

DEFINITION = """
(define-condition arm-stuck (error)
  ((joint :initarg :joint :reader stuck-joint))
  (:report (lambda (condition stream) (format stream "joint ~D" (stuck-joint condition)))))
"""


def test_a_condition_that_nothing_answers_is_raised_as_a_failure() -> None:
    with Interpreter() as agent:
        agent.eval(DEFINITION)
        with pytest.raises(Failure) as caught:
            agent.eval("(error 'arm-stuck :joint 4)")
    assert caught.value.cause is Keyword("ARM-STUCK")
    assert caught.value.arguments == (caught.value,)


def test_a_condition_can_be_shown_although_it_is_its_own_argument() -> None:
    with Interpreter() as agent:
        agent.eval(DEFINITION)
        with pytest.raises(Failure, match="failure :ARM-STUCK"):
            agent.eval("(error 'arm-stuck :joint 4)")
        assert agent.eval("(princ-to-string (make-condition 'arm-stuck :joint 4))") == "joint 4"


def test_words_are_the_argument_of_a_simple_error() -> None:
    with Interpreter() as agent, pytest.raises(Failure) as caught:
        agent.eval('(error "joint ~D" 4)')
    assert (caught.value.cause, [str(a) for a in caught.value.arguments]) == (Keyword("ERROR"), ["joint 4"])


def test_two_interpreters_have_condition_types_of_their_own() -> None:
    with Interpreter() as one, Interpreter() as other:
        one.eval(DEFINITION)
        assert one.eval("(typep (make-condition 'arm-stuck) 'arm-stuck)") is True
        with pytest.raises(Failure):
            other.eval("(make-condition 'arm-stuck)")


def test_a_condition_shows_itself_to_python() -> None:
    with Interpreter() as interp, pytest.raises(Failure) as caught:
        interp.eval('(error "arm ~a" 3)')
    assert "SIMPLE-ERROR" in repr(caught.value)
