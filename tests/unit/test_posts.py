"""`signal` and `post`: what other threads and coroutines ask of an interpreter."""

from __future__ import annotations

import io
import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from eslang import Failure, Interpreter, Keyword


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter that waits for the outside, and knows an event."""
    before = set(threading.enumerate())
    with Interpreter(outside=True, output=io.StringIO()) as made:
        made.eval("(defevent go) (defvar *told* nil) (defun note (it) (push it *told*))")
        yield made
    assert set(threading.enumerate()) == before
    assert made.runs.lives.count == 0
    assert made.scheduler.posted.empty()


def when_waiting(agent: Interpreter, action: Callable[[], object]) -> threading.Thread:
    """A thread that does ACTION as soon as a task of AGENT begins to wait."""
    begun = threading.Event()

    def listen(event: Any) -> None:
        if event.kind == "wait":
            begun.set()

    def work() -> None:
        assert begun.wait(10)
        action()

    agent.hooks.listeners.append(listen)
    worker = threading.Thread(target=work)
    worker.start()
    return worker


def test_a_signal_from_another_thread_wakes_who_waits_with_its_arguments(agent: Interpreter) -> None:
    worker = when_waiting(agent, lambda: agent.signal("go", 3.2, "left", [1, None, True]))
    found = agent.eval("(multiple-value-list (wait-for-events go))")
    worker.join()
    assert found == [3.2, "left", [1, None, True]]


def test_a_signal_reaches_a_task_that_never_waits_too(agent: Interpreter) -> None:
    agent.eval("(spawn (note (wait-for-events go))) (yield)")
    agent.primitive(name="alarm")(lambda: agent.signal("go", "now"))
    agent.eval("(progn (alarm) (loop (if *told* (return))))")
    assert agent.value("*told*") == ["now"]


def test_what_is_no_event_is_an_error_at_once(agent: Interpreter) -> None:
    agent.eval("(defvar *speed* 3)")
    for name, cause in (
        ("nobody", "UNBOUND-VARIABLE"),
        ("no-package::go", "UNBOUND-VARIABLE"),
        ("*speed*", "TYPE-ERROR"),
        ("car", "UNBOUND-VARIABLE"),
    ):
        with pytest.raises(Failure) as caught:
            agent.signal(name)
        assert caught.value.cause is Keyword(cause), name
    assert agent.eval('(find-symbol "NOBODY")') is None


def test_an_event_may_be_named_by_its_symbol_or_with_its_package(agent: Interpreter) -> None:
    go = agent.symbol("go")
    assert go is not None
    for name in (go, "esl-user::go", "Go"):
        worker = when_waiting(agent, lambda name=name: agent.signal(name, 1))  # type: ignore[misc]
        assert agent.eval("(wait-for-events go)") == 1
        worker.join()


def test_a_signal_that_nobody_can_wait_for_is_lost_at_once(agent: Interpreter) -> None:
    for _ in range(1000):
        agent.signal("go")
    assert agent.scheduler.posted.empty()


def test_a_signal_before_a_call_reaches_those_who_waited_then(agent: Interpreter) -> None:
    agent.eval("(spawn (progn (wait-for-events go) (note :early))) (yield)")
    agent.signal("go")
    assert agent.eval(
        "(progn (spawn (progn (wait-for-events go) (note :late)) :daemon t) (yield) *told*)"
    ) == [Keyword("EARLY")]


def test_a_thousand_signals_from_ten_threads_all_arrive(agent: Interpreter) -> None:
    agent.eval("""
        (defvar *count* 0)
        (defun listen-for (n)
          (wait-for-events go (lambda () (= (incf *count*) n)))
          *count*)""")

    def ring() -> None:
        for _ in range(100):
            agent.signal("go")

    workers = [when_waiting(agent, ring) for _ in range(10)]
    assert agent.call("listen-for", 1000) == 1000
    for worker in workers:
        worker.join()


def test_without_outside_such_a_wait_is_a_deadlock() -> None:
    with Interpreter() as agent:
        agent.eval("(defevent go)")
        with pytest.raises(Failure) as caught:
            agent.eval("(wait-for-events go)")
        assert caught.value.cause is Keyword("DEADLOCK")


# --- post -------------------------------------------------------------------------------


def test_what_is_posted_is_called_in_the_interpreters_thread_as_a_task(agent: Interpreter) -> None:
    found: list[Any] = []

    def work() -> None:
        found.append(threading.current_thread() is threading.main_thread())
        found.append(agent.eval("(progn (sleep 0) (signal go :posted) :done)"))

    worker = when_waiting(agent, lambda: agent.post(work))
    assert agent.eval("(wait-for-events go)") is Keyword("POSTED")
    worker.join()
    agent.finish()
    assert found == [True, Keyword("DONE")]


def test_what_is_posted_while_nothing_runs_is_called_before_the_next_call(agent: Interpreter) -> None:
    agent.post(lambda: agent.call("note", 1))
    agent.post(lambda: agent.call("note", 2))
    assert agent.eval("*told*") == [2, 1]


def test_an_error_of_what_is_posted_is_a_failure_of_the_run(agent: Interpreter) -> None:
    def broken() -> None:
        raise OSError("no such port")

    agent.post(broken)
    assert agent.eval("(+ 1 1)") == 2
    with pytest.raises(Failure) as caught:
        agent.finish()
    assert isinstance(caught.value.__cause__, OSError)


def test_what_python_raises_to_leave_leaves_the_call_from_what_is_posted(agent: Interpreter) -> None:
    def leave() -> None:
        raise SystemExit(4)

    worker = when_waiting(agent, lambda: agent.post(leave))
    with pytest.raises(SystemExit):
        agent.eval("(unwind-protect (wait-for-events go) (note :clean))")
    worker.join()
    assert agent.value("*told*") == [Keyword("CLEAN")]


def test_nothing_is_posted_to_an_interpreter_that_is_closed() -> None:
    with Interpreter() as agent:
        agent.eval("(defevent go)")
    agent.signal("go")  # nobody can wait for it
    with pytest.raises(Failure):
        agent.post(lambda: None)
    assert agent.scheduler.posted.empty()


def test_a_lisp_function_is_posted_by_its_symbol(agent: Interpreter) -> None:
    note = agent.symbol("note")
    assert note is not None
    agent.post(note, ["a", 1, None])
    assert agent.eval("(progn (yield) *told*)") == [["a", 1, None]]


def test_a_python_function_may_be_posted_with_arguments(agent: Interpreter) -> None:
    seen: list[object] = []
    agent.post(seen.append, 4)
    agent.eval("(yield)")
    assert seen == [4]
