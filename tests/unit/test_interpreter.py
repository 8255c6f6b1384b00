"""The interpreter as Python programs hold it: language reference §10, sentence by sentence."""

from __future__ import annotations

import io
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from eslang import EslError, Failure, Interpreter, Keyword, Symbol


@pytest.fixture
def agent() -> Any:
    """An interpreter on virtual time, whose output is kept."""
    with Interpreter(seed=0, clock="virtual", output=io.StringIO()) as made:
        yield made


# --- eval, call, load ---------------------------------------------------------------


def test_eval_gives_the_value_of_the_last_form(agent: Interpreter) -> None:
    assert agent.eval('(+ 1 1) (list 1 :two "three")') == [1, Keyword("TWO"), "three"]


def test_eval_gives_one_value_of_several(agent: Interpreter) -> None:
    assert agent.eval("(values 1 2)") == 1
    assert agent.eval("(values)") is None
    assert agent.eval("") is None


def test_what_one_eval_defines_the_next_one_knows(agent: Interpreter) -> None:
    agent.eval("(defun twice (n) (* 2 n))")
    assert agent.eval("(twice 21)") == 42


def test_call_takes_the_name_in_lower_case_and_pythons_values(agent: Interpreter) -> None:
    agent.eval("(defun pick-up (thing &key gently) (list :picked thing gently))")
    assert agent.call("pick-up", "cup", Keyword("gently"), True) == [Keyword("PICKED"), "cup", True]


def test_call_takes_a_name_with_its_package(agent: Interpreter) -> None:
    assert agent.call("cl:list", 1, 2) == [1, 2]


def test_call_takes_a_function_that_eval_gave(agent: Interpreter) -> None:
    assert agent.call(agent.eval("(lambda (n) (* n n))"), 7) == 49


def test_call_of_what_is_no_function_fails(agent: Interpreter) -> None:
    with pytest.raises(Failure) as caught:
        agent.call("no-such-plan")
    assert caught.value.cause is Keyword("UNDEFINED-FUNCTION")


def test_load_takes_a_path_and_gives_the_package_back(agent: Interpreter, tmp_path: Path) -> None:
    plan = tmp_path / "grasp.esl"
    plan.write_text("(in-package :cl-user)\n(defun cl-user::grasp (thing) (list :got thing))\n")
    agent.load(plan)
    assert agent.call("cl-user::grasp", "cup") == [Keyword("GOT"), "cup"]
    assert agent.eval("(package-name *package*)") == "ESL-USER"


def test_a_file_that_is_not_there_is_pythons_error(agent: Interpreter, tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        agent.load(tmp_path / "missing.esl")


def test_variables_are_read_and_set_from_python(agent: Interpreter) -> None:
    agent.eval("(defvar *speed* 1)")
    agent.set_value("*speed*", [1.5, "fast"])
    assert agent.value("*speed*") == [1.5, "fast"]
    with pytest.raises(Failure) as caught:
        agent.value("*nobody*")
    assert caught.value.cause is Keyword("UNBOUND-VARIABLE")


# --- failures and errors ------------------------------------------------------------


def test_a_failure_that_nothing_recovers_is_raised(agent: Interpreter) -> None:
    with pytest.raises(Failure) as caught:
        agent.eval("""(fail :grip-lost 4 "left" '(1 (2)) nil t)""")
    assert caught.value.cause is Keyword("GRIP-LOST")
    assert caught.value.arguments == (4, "left", [1, [2]], None, True)
    assert repr(caught.value) == "Failure(Keyword('GRIP-LOST'), 4, 'left', [1, [2]], None, True)"


def test_a_failure_of_a_loaded_file_is_raised(agent: Interpreter, tmp_path: Path) -> None:
    plan = tmp_path / "fails.esl"
    plan.write_text('(fail :stuck "here")')
    for _ in range(2):
        with pytest.raises(Failure) as caught:
            agent.load(plan)
        assert caught.value.arguments == ("here",)


def test_a_host_error_is_raised_as_the_failure_it_is(agent: Interpreter) -> None:
    with pytest.raises(Failure) as caught:
        agent.eval("(car 5)")
    assert caught.value.cause is Keyword("TYPE-ERROR")
    assert caught.value.arguments[0] == 5


def test_cleanups_run_before_a_failure_reaches_python(agent: Interpreter) -> None:
    agent.eval("(defvar *clean* nil)")
    with pytest.raises(Failure):
        agent.eval("(with-cleanup-procedure (setf *clean* t) (fail :stuck))")
    assert agent.value("*clean*") is True


def test_after_a_failure_the_interpreter_goes_on(agent: Interpreter) -> None:
    with pytest.raises(Failure):
        agent.eval("(with-recovery-procedures ((:other 1)) (let ((*print-base* 2)) (fail :stuck)))")
    assert agent.eval("(list *print-base* (with-recovery-procedures ((:stuck 2)) (fail :stuck)))") == [10, 2]


def test_a_wrong_program_raises_its_diagnostic(agent: Interpreter) -> None:
    with pytest.raises(EslError) as caught:
        agent.eval("(let ((x 1))")
    assert caught.value.diagnostic.name == "unclosed-list"
    with pytest.raises(EslError) as caught:
        agent.eval("\n  (retry)", name="demo.esl")
    assert caught.value.diagnostic.name == "retry-outside-recovery"
    assert str(caught.value).startswith("demo.esl:2:3: error: ")


def test_forms_before_a_mistake_have_run(agent: Interpreter) -> None:
    with pytest.raises(EslError):
        agent.eval("(defvar *reached* t) (let ((x 1))")
    assert agent.value("*reached*") is True


# --- values across the border -------------------------------------------------------

BOTH_WAYS = [
    None,
    True,
    0,
    -(10**40),
    2.5,
    Fraction(1, 3),
    "text",
    "",
    [1, "two", [3.0, None, [True]]],
    Keyword("two"),
    Symbol.intern("CUP", "ESL-USER"),
]


@pytest.mark.parametrize("value", BOTH_WAYS, ids=repr)
def test_a_value_crosses_the_border_both_ways(agent: Interpreter, value: Any) -> None:
    back = agent.call("identity", value)
    assert back == value
    assert type(back) is type(value)


def test_false_and_the_empty_list_are_nil(agent: Interpreter) -> None:
    assert agent.call("identity", False) is None
    assert agent.call("identity", []) is None
    assert agent.call("null", [False]) is None


def test_a_fraction_that_is_whole_is_an_integer(agent: Interpreter) -> None:
    assert agent.call("integerp", Fraction(4, 2)) is True


def test_anything_else_passes_through_untouched(agent: Interpreter) -> None:
    for thing in (object(), (1, 2), {"a": 1}, {3}, b"bytes", print):
        assert agent.call("identity", thing) is thing
        assert agent.eval("(defvar *kept* nil)") is not None
        agent.set_value("*kept*", [thing])
        assert agent.eval("(first *kept*)") is thing


def test_a_list_that_contains_itself_stays_as_it_is(agent: Interpreter) -> None:
    inner, copied = agent.eval("(let ((c (list 1 2))) (setf (cadr c) c) (list c '((1) 1)))")
    assert inner[0] == 1 and str(inner[1]) == "#1=(1 #1#)"
    assert copied == [[1], 1]
    assert agent.eval("(let ((x (list 1 2))) (cons x x))") == [[1, 2], 1, 2]
    with pytest.raises(Failure) as caught:
        agent.eval("(let ((c (list 1 2))) (setf (cadr c) c) (fail :odd c))")
    assert caught.value.arguments[0][0] == 1


def test_a_dotted_list_stays_a_cons(agent: Interpreter) -> None:
    pair = agent.eval("'(1 . 2)")
    assert (pair.car, pair.cdr) == (1, 2)
    assert agent.call("cdr", pair) == 2


def test_symbols_and_keywords_are_interned(agent: Interpreter) -> None:
    assert agent.eval(":two") is Keyword("two") is Keyword("TWO")
    assert agent.eval("'cup") is agent.eval("'CUP")
    assert (str(Keyword("two")), Keyword("two").name) == (":TWO", "TWO")
    assert (str(agent.eval("'cup")), agent.eval("'cup").name) == ("CUP", "CUP")


def test_a_string_is_copied_at_the_border(agent: Interpreter) -> None:
    agent.eval('(defvar *name* "cup")')
    name = agent.value("*name*")
    agent.eval("(setf (char *name* 0) #\\p)")
    assert (name, agent.value("*name*")) == ("cup", "pup")


# --- output, listeners --------------------------------------------------------------


def test_output_goes_where_it_was_told() -> None:
    stream = io.StringIO()
    with Interpreter(output=stream) as agent:
        agent.eval('(princ "hello")')
    assert stream.getvalue() == "hello"


def test_without_a_stream_output_goes_to_standard_output(capsys: pytest.CaptureFixture[str]) -> None:
    with Interpreter() as agent:
        agent.eval('(princ "hello")')
        agent.output.flush()
    assert capsys.readouterr().out == "hello"


def test_listeners_are_told_of_failures_and_goals() -> None:
    heard: list[Any] = []
    with Interpreter(output=io.StringIO(), listeners=[heard.append]) as agent:
        agent.eval("(with-recovery-procedures ((:slipped :retries 2 (abort))) (fail :slipped 1))")
        agent.eval("(defun fine? () t) (achieve (fine?))")
        with pytest.raises(Failure):
            agent.eval("(fail :stuck)")
    told = [event for event in heard if not event.kind.startswith("task-")]
    assert [event.kind for event in told] == ["recovery", "recovery-ended", "goal", "failure", "aborted"]
    recovery = told[0]
    assert (recovery.data["failure"].cause, recovery.data["left"]) == (Keyword("SLIPPED"), 1)
    assert set(recovery._fields) == {"kind", "time", "task", "form", "data"}


def test_a_listener_may_come_and_go() -> None:
    told: list[Any] = []
    with Interpreter(output=io.StringIO()) as agent:
        agent.hooks.listeners.append(told.append)
        agent.eval("(with-recovery-procedures ((:x 1)) (fail :x))")
        agent.hooks.listeners.remove(told.append)
        agent.eval("(with-recovery-procedures ((:x 1)) (fail :x))")
    assert [event.kind for event in told] == [
        "task-started",
        "recovery",
        "recovery-ended",
        "task-ended",
    ]


def test_nothing_is_printed_without_a_listener_that_prints() -> None:
    stream = io.StringIO()
    with Interpreter(output=stream) as agent, pytest.raises(Failure):
        agent.eval("(fail :stuck)")
    assert stream.getvalue() == ""


# --- seeds, two interpreters, the end -----------------------------------------------


def test_the_same_seed_gives_the_same_numbers() -> None:
    def drawn(seed: int) -> Any:
        with Interpreter(seed=seed) as agent:
            return agent.eval("(list (random 1000000) (random 1000000))")

    assert drawn(7) == drawn(7)
    assert drawn(7) != drawn(8)


def test_two_interpreters_never_meet() -> None:
    with Interpreter() as one, Interpreter() as other:
        one.eval("(defvar *who* :one) (defun whoami () *who*) (define-failure :child (:parent))")
        other.eval("(defvar *who* :other) (defun whoami () (list *who*))")
        assert (one.eval("(whoami)"), other.eval("(whoami)")) == (Keyword("ONE"), [Keyword("OTHER")])
        with pytest.raises(Failure):
            other.eval("(with-recovery-procedures ((:parent (abort 1))) (fail :child))")


def test_one_may_call_the_other_from_a_primitive() -> None:
    with Interpreter() as one, Interpreter() as other:
        other.eval('(defun answer () (fail :no-idea "sorry"))')

        @one.primitive
        def ask() -> Any:
            return other.call("answer")

        text = "(with-recovery-procedures (((:no-idea why) (abort (list why :here)))) (ask))"
        assert one.eval(text) == ["sorry", Keyword("HERE")]


def test_a_closed_interpreter_does_nothing_more() -> None:
    agent = Interpreter()
    agent.close()
    agent.close()
    for work in (lambda: agent.eval("1"), lambda: agent.call("list"), lambda: agent.load("plan.esl")):
        with pytest.raises(Failure) as caught:
            work()
        assert caught.value.cause is Keyword("INTERPRETER-CLOSED")


def test_a_primitive_may_use_its_own_interpreter(agent: Interpreter) -> None:
    @agent.primitive
    def square_of_sum(*numbers: int) -> Any:
        return agent.call("expt", agent.call("+", *numbers), 2)

    assert agent.eval("(square-of-sum 1 2 3)") == 36


def test_an_unknown_attribute_is_pythons_error(agent: Interpreter) -> None:
    with pytest.raises(AttributeError, match="has no attribute 'evaluat'"):
        getattr(agent, "evaluat")  # noqa: B009
