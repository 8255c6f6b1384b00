"""`call_async`: an interpreter as a guest in a running asyncio loop."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Iterator
from typing import Any

import pytest

from around import run, turns, whole_agent
from eslang import Failure, Interpreter, Keyword

PLANS = "(defvar *told* nil) (defun note (it) (push it *told*)) (defevent go) (defevent other)"


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter on virtual time."""
    with whole_agent(PLANS, clock="virtual") as made:
        yield made


# --- values and failures --------------------------------------------------------------


def test_it_gives_the_value_as_python_has_it(agent: Interpreter) -> None:
    agent.eval("(defun pick-up (thing) (sleep 5) (values (list :got thing) 2))")

    async def main() -> Any:
        return await agent.call_async("pick-up", "cup")

    assert run(main) == [Keyword("GOT"), "cup"]
    assert agent.clock.now() == 5


def test_a_failure_is_raised_where_it_is_awaited(agent: Interpreter) -> None:
    @agent.primitive
    async def sense() -> None:
        await asyncio.sleep(0)
        raise OSError("no such port")

    agent.eval('(defun grip () (fail :grip-lost 4 "left"))')

    async def main() -> None:
        with pytest.raises(Failure) as caught:
            await agent.call_async("grip")
        assert (caught.value.cause, caught.value.arguments) == (Keyword("GRIP-LOST"), (4, "left"))
        with pytest.raises(Failure) as caught:
            await agent.call_async("sense")
        assert isinstance(caught.value.__cause__, OSError)
        with pytest.raises(Failure) as caught:
            await agent.call_async("no-such-plan")
        assert caught.value.cause is Keyword("UNDEFINED-FUNCTION")

    run(main)


def test_many_calls_go_on_at_once(agent: Interpreter) -> None:
    agent.eval("(defun patrol (n) (sleep (- 100 n)) (note n) (wait-for-events go) n)")

    async def main() -> Any:
        calls = [asyncio.ensure_future(agent.call_async("patrol", n)) for n in range(100)]
        while len(agent.value("*told*") or []) < 100:
            await asyncio.sleep(0)
        agent.signal("go")
        return await asyncio.gather(*calls)

    assert run(main) == list(range(100))
    assert agent.value("*told*") == list(range(100))


def test_a_call_that_waits_for_the_outside_is_no_deadlock(agent: Interpreter) -> None:
    agent.eval("(defun patrol () (multiple-value-list (wait-for-events go)))")

    async def main() -> Any:
        call = asyncio.ensure_future(agent.call_async("patrol"))
        await turns()
        assert not call.done()
        threading.Thread(target=agent.signal, args=("go", 1, "two")).start()
        return await call

    assert run(main) == [1, "two"]


def test_async_primitives_run_in_the_callers_loop(agent: Interpreter) -> None:
    @agent.primitive
    async def which_loop() -> Any:
        await asyncio.sleep(0)
        return asyncio.get_running_loop()

    async def main() -> None:
        assert await agent.call_async("which-loop") is asyncio.get_running_loop()

    run(main)
    assert agent.eval("(which-loop)") is not None


def test_blocking_primitives_work_beside_the_loop(agent: Interpreter) -> None:
    gate = threading.Event()
    agent.primitive(name="stare", blocking=True)(lambda: gate.wait(10))

    async def main() -> Any:
        call = asyncio.ensure_future(agent.call_async("stare"))
        await turns()
        gate.set()
        return await call

    assert run(main) is True


def test_a_coroutine_of_a_plan_may_call_the_plan(agent: Interpreter) -> None:
    @agent.primitive
    async def ask(n: int) -> Any:
        return [await agent.call_async("answer", n), agent.call("answer", n + 1)]

    agent.eval("(defun answer (n) (sleep 1) (* n n)) (defun main () (ask 3))")

    async def main() -> Any:
        return await agent.call_async("main")

    assert run(main) == [9, 16]


def test_in_a_plain_call_a_coroutine_may_call_the_plan_by_call_async(agent: Interpreter) -> None:
    @agent.primitive
    async def ask(n: int) -> Any:
        with pytest.raises(Failure, match="only `call_async`"):
            agent.call("answer", n)
        return await agent.call_async("answer", n)

    agent.eval("(defun answer (n) (sleep 1) (* n n))")
    assert agent.eval("(list (ask 3) (ask 4))") == [9, 16]


# --- fairness ---------------------------------------------------------------------------


def test_an_endless_loop_leaves_the_loop_its_turns_and_can_be_cancelled(agent: Interpreter) -> None:
    agent.eval("(defun spin () (unwind-protect (loop) (note :clean)))")

    async def main() -> None:
        call = asyncio.ensure_future(agent.call_async("spin"))
        await turns()
        call.cancel()
        with pytest.raises(asyncio.CancelledError):
            await call

    run(main)
    assert agent.value("*told*") == [Keyword("CLEAN")]


def test_tasks_that_wake_each_other_for_ever_leave_the_loop_its_turns(agent: Interpreter) -> None:
    agent.eval("""
        (defun ping () (task-net (a (loop (signal other) (yield)))
                                 (b (loop (wait-for-events other)))))""")

    async def main() -> None:
        call = asyncio.ensure_future(agent.call_async("ping"))
        await turns(50)
        call.cancel()
        await asyncio.wait([call])
        assert call.cancelled()

    run(main)


def test_real_timers_are_those_of_the_loop() -> None:
    with Interpreter() as agent:
        agent.eval("(defun nap () (list (progn (sleep 0.01) :rested)))")

        async def main() -> Any:
            return await asyncio.gather(agent.call_async("nap"), asyncio.sleep(0.01, "slept"))

        assert run(main) == [[Keyword("RESTED")], "slept"]
