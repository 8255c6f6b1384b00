"""Blocking primitives, which run in a thread while other tasks go on."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import pytest

from around import functions_in, whole_agent
from eslang import Failure, Interpreter, Keyword


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter on virtual time."""
    with whole_agent("nil", clock="virtual") as made:
        yield made


# --- blocking calls ---------------------------------------------------------------------


def test_a_blocking_primitive_runs_in_a_thread_while_others_go_on(agent: Interpreter) -> None:
    gate = threading.Event()

    @agent.primitive(blocking=True)
    def type_line(prompt: str) -> list[Any]:
        assert gate.wait(10)
        return [prompt, threading.current_thread() is threading.main_thread()]

    agent.primitive(name="type-it")(gate.set)
    text = '(task-net (a (type-line "> ")) (b (yield) (type-it) (sleep 3600) :typed))'
    assert agent.eval(f"(multiple-value-list {text})") == [["> ", None], Keyword("TYPED")]


def test_after_a_blocking_call_its_thread_is_gone(agent: Interpreter) -> None:
    agent.primitive(name="work", blocking=True)(lambda: 1)
    before = threading.enumerate()
    assert agent.eval("(work)") == 1
    assert threading.enumerate() == before


def test_failures_and_errors_of_a_blocking_call_arrive_at_the_call(agent: Interpreter) -> None:
    @agent.primitive(blocking=True)
    def grip(force: int) -> None:
        if force > 3:
            raise Failure("crushed", force)
        raise OSError("no arm")

    assert agent.eval("(with-recovery-procedures (((:crushed n) (abort n))) (grip 4))") == 4
    with pytest.raises(Failure) as caught:
        agent.eval("(grip 1)")
    assert isinstance(caught.value.__cause__, OSError)
    assert functions_in(caught.value.__cause__)[-1] == "grip"


def test_a_blocking_call_that_is_left_is_not_waited_for_and_its_outcome_dropped(agent: Interpreter) -> None:
    gate, begun, ended = threading.Event(), threading.Event(), threading.Event()

    @agent.primitive(blocking=True)
    def stare() -> str:
        begun.set()
        assert gate.wait(10)
        ended.set()
        return "never seen"

    agent.primitive(name="has-begun", blocking=True)(lambda: begun.wait(10))
    text = """
        (with-recovery-procedures ((:enough (abort :left)))
          (with-guardian (has-begun) (fail :enough) (stare)))"""
    assert agent.eval(text) is Keyword("LEFT")
    assert not ended.is_set()
    assert agent.eval("(+ 1 1)") == 2
    gate.set()
    agent.close()  # which waits for it
    assert ended.is_set()


def test_many_blocking_calls_go_on_at_once(agent: Interpreter) -> None:
    meeting = threading.Barrier(20)
    agent.primitive(name="meet", blocking=True)(lambda: meeting.wait(10) is not None)
    tasks = " ".join(f"(t{number} (meet))" for number in range(20))
    assert agent.eval(f"(multiple-value-list (task-net {tasks}))") == [True] * 20


def test_a_blocking_call_cannot_call_the_interpreter_but_can_signal_it(agent: Interpreter) -> None:
    @agent.primitive(blocking=True)
    def call_back() -> str:
        try:
            agent.eval("(+ 1 1)")
        except Failure as failure:
            agent.signal("arrived", str(failure.arguments[0]))
        return "done"

    agent.eval("(defevent arrived)")
    text = "(multiple-value-list (task-net (a (wait-for-events arrived)) (b (call-back))))"
    found, done = agent.eval(text)
    assert found == "this interpreter is at work in another thread; signal it from there"
    assert done == "done"
