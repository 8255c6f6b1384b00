"""`after`: what Python code lets happen later, on the interpreter's clock."""

from __future__ import annotations

from collections.abc import Iterator
from io import StringIO

import pytest

from eslang import Failure, Interpreter


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter on virtual time."""
    with Interpreter(clock="virtual", output=StringIO()) as made:
        yield made


def test_a_function_is_called_at_its_moment_in_no_task(agent: Interpreter) -> None:
    seen: list[object] = []
    agent.after(5, lambda: seen.append((agent.clock.now(), agent.scheduler.current)))
    agent.eval("(sleep 4)")
    assert seen == []
    agent.eval("(sleep 2)")
    assert seen == [(5.0, None)]


def test_a_run_does_not_wait_for_it(agent: Interpreter) -> None:
    agent.after(5, lambda: pytest.fail("it is called"))
    agent.eval("(sleep 4)")
    agent.finish()
    assert agent.clock.now() == 4.0


def test_it_comes_before_a_task_that_was_to_sleep_as_long(agent: Interpreter) -> None:
    agent.eval("(defvar *lamp* :off)")
    agent.primitive(name="switch-on")(lambda: agent.after(3, lambda: agent.set_value("*lamp*", "on")))
    assert agent.eval("(progn (switch-on) (sleep 3) *lamp*)") == "on"


def test_what_it_changes_wakes_who_waits_for_a_condition(agent: Interpreter) -> None:
    agent.eval("(defvar *lamp* nil)")
    agent.after(3, lambda: agent.set_value("*lamp*", "on"))
    agent.eval("(wait-until *lamp*)")
    assert agent.clock.now() == 3.0


def test_it_may_ask_for_another(agent: Interpreter) -> None:
    moments: list[float] = []

    def again() -> None:
        moments.append(agent.clock.now())
        agent.after(2, again)

    agent.after(2, again)
    agent.eval("(sleep 7)")
    assert moments == [2.0, 4.0, 6.0]


def test_if_it_fails_the_run_has_failed(agent: Interpreter) -> None:
    def fall() -> None:
        raise Failure("dome-fell", 3)

    agent.after(1, fall)
    agent.eval("(sleep 2)")
    with pytest.raises(Failure, match="DOME-FELL 3"):
        agent.finish()
