"""Primitives: Python functions that plans call (language reference §10)."""

from __future__ import annotations

import io
from typing import Any

import pytest

from eslang import EslError, Failure, Interpreter, Keyword


@pytest.fixture
def agent() -> Any:
    """An interpreter whose output is kept."""
    with Interpreter(output=io.StringIO()) as made:
        yield made


# --- names and signatures -----------------------------------------------------------


def test_name_and_signature_come_from_python(agent: Interpreter) -> None:
    @agent.primitive
    def grip_force(sensor: str, *, scale: float = 1.0) -> float:
        """Read SENSOR."""
        return scale * len(sensor)

    assert agent.eval('(list (grip-force "left") (grip-force "left" :scale 0.5))') == [4.0, 2.0]
    definition = agent.definition(agent.symbol("grip-force"))  # type: ignore[arg-type]
    assert definition is not None
    assert (definition.signature, definition.doc()) == ("(grip-force sensor &key scale)", "Read SENSOR.")


def test_the_decorated_function_is_still_pythons(agent: Interpreter) -> None:
    @agent.primitive
    def twice(n: int) -> int:
        return 2 * n

    assert twice(4) == 8


def test_a_name_may_be_given(agent: Interpreter) -> None:
    agent.primitive(name="force-at")(lambda sensor: [sensor, 1])
    assert agent.eval("(force-at :left)") == [Keyword("LEFT"), 1]


def test_a_signature_may_be_given(agent: Interpreter) -> None:
    agent.primitive(signature="(move-to x y &optional speed)")(lambda *numbers: list(numbers))
    assert agent.eval("(list (move-to 1 2) (move-to 1 2 3))") == [[1, 2], [1, 2, 3]]


def test_defaults_are_optional_and_stars_take_the_rest(agent: Interpreter) -> None:
    @agent.primitive
    def shout(word: str, times: int = 2, *more: str) -> str:
        return word * times + "".join(more)

    assert agent.eval('(list (shout "a") (shout "a" 3) (shout "a" 1 "b" "c"))') == ["aa", "aaa", "abc"]


def test_two_stars_take_any_keyword(agent: Interpreter) -> None:
    agent.primitive(name="note")(lambda **facts: sorted(facts.items()))
    assert agent.eval("(note :arm-length 2 :speed 1)") == [("arm_length", 2), ("speed", 1)]


def test_a_method_can_be_a_primitive(agent: Interpreter) -> None:
    class Arm:
        angle = 0

        def turn(self, by: int) -> int:
            """Turn the arm."""
            self.angle += by
            return self.angle

    agent.primitive(Arm().turn)
    assert agent.eval("(turn 30) (turn 15)") == 45


def test_a_later_primitive_takes_the_place_of_an_earlier_function(agent: Interpreter) -> None:
    agent.eval("(defun sense () :lisp) (defun look () (sense))")
    agent.primitive(name="sense")(lambda: 7)
    assert agent.eval("(look)") == 7


def test_common_lisps_functions_stay_what_they_are(agent: Interpreter) -> None:
    with pytest.raises(EslError):
        agent.primitive(name="car")(lambda thing: thing)


def test_a_primitive_is_a_function_like_any_other(agent: Interpreter) -> None:
    agent.primitive(name="double-it")(lambda n: 2 * n)
    assert agent.eval("(mapcar #'double-it '(1 2))") == [2, 4]
    assert agent.eval("(funcall 'double-it 4)") == 8


# --- values -------------------------------------------------------------------------


def test_arguments_and_results_cross_the_border(agent: Interpreter) -> None:
    seen: list[Any] = []

    @agent.primitive
    def look(thing: Any) -> Any:
        seen.append(thing)
        return [False, True, None, "s", [1, 2.5]]

    assert agent.eval('(look (list 1 "two" nil t :five))') == [None, True, None, "s", [1, 2.5]]
    assert seen == [[1, "two", None, True, Keyword("FIVE")]]


def test_a_result_of_false_is_nil(agent: Interpreter) -> None:
    agent.primitive(name="is-open")(lambda: False)
    assert agent.eval("(if (is-open) 1 2)") == 2


# --- failures -----------------------------------------------------------------------


def test_a_failure_that_it_raises_is_a_fail_at_the_call(agent: Interpreter) -> None:
    @agent.primitive
    def grip() -> None:
        raise Failure("grip-lost", 4, "left")

    with pytest.raises(Failure) as caught:
        agent.eval("(grip)")
    assert (caught.value.cause, caught.value.arguments) == (Keyword("GRIP-LOST"), (4, "left"))
    text = "(with-recovery-procedures (((:grip-lost n where) (abort (list n (stringp where))))) (grip))"
    assert agent.eval(text) == [4, True]


def test_a_procedure_that_runs_off_its_end_gives_the_value_of_the_call(agent: Interpreter) -> None:
    agent.primitive(name="measure")(lambda: (_ for _ in ()).throw(Failure("no-reading")))
    assert agent.eval("(with-recovery-procedures ((:no-reading 20)) (+ 1 (measure)))") == 21


def test_a_plan_retries_a_primitive(agent: Interpreter) -> None:
    calls: list[int] = []

    @agent.primitive
    def flaky() -> str:
        calls.append(1)
        if len(calls) < 3:
            raise Failure("slipped")
        return "held"

    assert agent.eval("(with-recovery-procedures ((:slipped :retries 2 (retry))) (flaky))") == "held"


def test_any_other_exception_is_a_python_error(agent: Interpreter) -> None:
    @agent.primitive
    def broken() -> None:
        raise OSError("no such port")

    text = "(with-recovery-procedures (((:python-error kind text) (abort (list kind text)))) (broken))"
    assert agent.eval(text) == ["OSError", "no such port"]
    with pytest.raises(Failure) as caught:
        agent.eval("(broken)")
    assert isinstance(caught.value.__cause__, OSError)
    assert isinstance(caught.value.arguments[2], OSError)


def test_a_python_error_inside_is_not_taken_for_the_plans_own(agent: Interpreter) -> None:
    agent.primitive(name="mean")(lambda numbers: sum(numbers or []) / len(numbers or []))
    with pytest.raises(Failure) as caught:
        agent.eval("(mean nil)")
    assert caught.value.cause is Keyword("PYTHON-ERROR")


def test_a_wrong_number_of_arguments_is_found_at_the_call(agent: Interpreter) -> None:
    agent.primitive(name="one")(lambda only: only)
    for text in ("(one)", "(one 1 2)"):
        with pytest.raises(Failure) as caught:
            agent.eval(text)
        assert caught.value.cause is Keyword("WRONG-NUMBER-OF-ARGUMENTS")


def test_an_unknown_keyword_is_an_error(agent: Interpreter) -> None:
    @agent.primitive
    def grip(*, force: int = 1) -> int:
        return force

    for text in ("(grip :colour 1)", "(grip :force)", '(grip "force" 1)'):
        with pytest.raises(Failure) as caught:
            agent.eval(text)
        assert caught.value.cause is Keyword("ERROR")
    assert agent.eval("(grip :force 2 :force 3)") == 2


def test_what_python_raises_to_leave_goes_through(agent: Interpreter) -> None:
    @agent.primitive
    def leave() -> None:
        raise KeyboardInterrupt

    agent.eval("(defvar *left* nil)")
    with pytest.raises(KeyboardInterrupt):
        agent.eval(
            "(with-recovery-procedures ((:general-failure (abort))) (unwind-protect (leave) (setf *left* t)))"
        )
    assert agent.value("*left*") is True
