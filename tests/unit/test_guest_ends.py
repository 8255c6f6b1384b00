"""How calls in a running asyncio loop end: cancelled, stopped, finished, closed; and plain ones there."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Iterator
from typing import Any

import pytest

from around import run, turns, whole_agent
from eslang import Failure, Interpreter, Keyword
from eslang.base.control import Stop

PLANS = "(defvar *told* nil) (defun note (it) (push it *told*)) (defevent go) (defevent other)"


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter on virtual time."""
    with whole_agent(PLANS, clock="virtual") as made:
        yield made


# --- cancellation and ends ----------------------------------------------------------------


def test_cancelling_the_awaiting_coroutine_aborts_the_task_with_cleanups_that_wait(
    agent: Interpreter,
) -> None:
    @agent.primitive
    async def put_down() -> None:
        await turns(3)
        agent.set_value("*told*", [*(agent.value("*told*") or []), "put down"])

    agent.eval("""
        (defun hold ()
          (with-cleanup-procedure (progn (put-down) (sleep 3) (note :slept))
            (wait-for-events go)))""")

    async def main() -> None:
        call = asyncio.ensure_future(agent.call_async("hold"))
        await turns()
        call.cancel()
        await asyncio.sleep(0)
        call.cancel()  # more than once changes nothing
        with pytest.raises(asyncio.CancelledError):
            await call
        assert agent.value("*told*") == [Keyword("SLEPT"), "put down"]
        assert not agent.runs.lives.tops

    run(main)


def test_cancelling_ends_the_coroutine_that_the_task_awaits_first(agent: Interpreter) -> None:
    told: list[str] = []

    @agent.primitive
    async def hold() -> None:
        try:
            await asyncio.get_running_loop().create_future()
        finally:
            await turns(3)
            told.append("let go")

    async def main() -> None:
        call = asyncio.ensure_future(agent.call_async("hold"))
        await turns()
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(call, 0)
        assert told == ["let go"]

    run(main)


def test_a_call_may_be_cancelled_at_any_time(agent: Interpreter) -> None:
    agent.eval("(defun hold () (unwind-protect (wait-for-events go) (note :clean)))")

    async def main() -> None:
        for number in range(8):
            call = asyncio.ensure_future(agent.call_async("hold"))
            await turns(number)
            call.cancel()
            await asyncio.wait([call])
            assert call.cancelled()
            assert not agent.runs.lives.tops

    run(main)


def test_the_end_of_asyncio_run_aborts_what_is_awaited(agent: Interpreter) -> None:
    agent.eval(
        "(defun hold () (with-cleanup-procedure (progn (sleep 1) (note :clean)) (wait-for-events go)))"
    )
    kept: list[Any] = []

    async def main() -> None:
        kept.append(asyncio.ensure_future(agent.call_async("hold")))
        await turns()

    asyncio.run(main(), debug=True)
    assert kept[0].cancelled()
    assert agent.value("*told*") == [Keyword("CLEAN")]
    assert not agent.runs.lives.tops


def test_what_a_call_has_spawned_goes_on_in_the_loop_and_finish_async_waits_for_it(
    agent: Interpreter,
) -> None:
    agent.eval("""
        (defun begin ()
          (spawn (progn (sleep 5) (note :spawned)))
          (spawn (unwind-protect (wait-for-events go) (note :daemon)) :daemon t)
          :begun)""")

    async def main() -> None:
        assert await agent.call_async("begin") is Keyword("BEGUN")
        await agent.finish_async()
        assert agent.value("*told*") == [Keyword("DAEMON"), Keyword("SPAWNED")]

    run(main)


def test_finish_async_raises_a_failure_that_nobody_saw(agent: Interpreter) -> None:
    agent.eval("(defun begin () (spawn (fail :no-power 3)))")

    async def main() -> None:
        await agent.call_async("begin")
        with pytest.raises(Failure) as caught:
            await agent.finish_async()
        assert (caught.value.cause, caught.value.arguments) == (Keyword("NO-POWER"), (3,))

    run(main)


def test_what_a_plain_call_in_a_loop_has_spawned_goes_on_by_itself(agent: Interpreter) -> None:
    async def main() -> None:
        agent.eval("(spawn (progn (sleep 1) (note :done)))")
        while agent.value("*told*") is None:
            await asyncio.sleep(0)

    run(main)


def test_a_closed_loop_leaves_tasks_for_the_next_one(agent: Interpreter) -> None:
    agent.eval("(defun begin () (spawn (progn (wait-for-events go) (note :went))))")

    async def begin() -> None:
        await agent.call_async("begin")

    async def end() -> None:
        agent.signal("go")
        await agent.finish_async()

    run(begin)
    run(end)
    assert agent.value("*told*") == [Keyword("WENT")]


def test_a_coroutine_whose_loop_has_gone_is_a_python_error(agent: Interpreter) -> None:
    @agent.primitive
    async def hold() -> None:
        await asyncio.get_running_loop().create_future()

    agent.eval("(defun begin () (spawn (hold)) (yield))")

    async def main() -> None:
        await agent.call_async("begin")
        await turns()

    asyncio.run(main())
    with pytest.raises(Failure) as caught:
        agent.finish()
    assert caught.value.cause is Keyword("PYTHON-ERROR")


# --- plain calls inside the loop ------------------------------------------------------------


def test_a_plain_call_works_while_async_tasks_are_alive(agent: Interpreter) -> None:
    agent.eval("(defun patrol () (wait-for-events go) (note :patrolled))")

    async def main() -> None:
        call = asyncio.ensure_future(agent.call_async("patrol"))
        await turns()
        assert agent.eval("(progn (sleep 2) (signal go) (yield) *told*)") == [Keyword("PATROLLED")]
        await call

    run(main)


def test_a_plain_call_that_needs_the_loop_fails_at_once(agent: Interpreter) -> None:
    @agent.primitive
    async def fetch() -> int:
        await asyncio.sleep(0)
        return 7

    agent.eval("(defvar *fetching* nil) (defun begin () (setq *fetching* (spawn (fetch))) (yield))")

    async def main() -> None:
        with pytest.raises(Failure, match="`await` a `call_async`"):
            agent.eval("(fetch)")
        with pytest.raises(Failure, match="`await` a `call_async`"):
            agent.eval("(task-net (a (fetch)))")
        await agent.call_async("begin")
        with pytest.raises(Failure) as caught:
            agent.eval("(wait-for-task *fetching*)")
        assert caught.value.cause is Keyword("DEADLOCK")
        assert "the primitive fetch" in str(caught.value.arguments)
        with pytest.raises(Failure, match="`finish_async`"):
            agent.finish()
        await agent.finish_async()
        assert agent.eval("(wait-for-task *fetching*)") == 7

    run(main)


def test_a_plain_call_in_the_loop_may_wait_for_the_clock_and_for_threads(agent: Interpreter) -> None:
    @agent.primitive
    async def fetch() -> int:
        await asyncio.sleep(0)
        return 7

    agent.primitive(name="work", blocking=True)(lambda: 8)
    agent.eval("(defvar *fetching* nil) (defun begin () (setq *fetching* (spawn (fetch))) (yield))")

    async def main() -> None:
        await agent.call_async("begin")
        assert agent.eval("(list (progn (sleep 5) (work)) (task-status *fetching*))") == [
            8,
            Keyword("WAITING"),
        ]
        await agent.finish_async()

    run(main)


def test_closing_inside_the_loop_does_not_wait_for_what_the_loop_would_do(agent: Interpreter) -> None:
    told: list[str] = []

    @agent.primitive
    async def hold() -> None:
        try:
            await asyncio.get_running_loop().create_future()
        finally:
            told.append("let go")

    agent.eval("(defun begin () (spawn (unwind-protect (hold) (note :clean))) (yield))")

    async def main() -> None:
        await agent.call_async("begin")
        await turns()
        agent.close()
        assert agent.value("*told*") == [Keyword("CLEAN")]
        await turns()
        assert told == ["let go"]

    run(main)


def test_close_async_waits_for_cleanups_that_need_the_loop() -> None:
    told: list[str] = []

    async def main() -> None:
        async with Interpreter() as agent:

            @agent.primitive
            async def put_down() -> None:
                await turns(3)
                told.append("put down")

            agent.eval(
                "(defevent go) (defun hold () (with-cleanup-procedure (put-down) (wait-for-events go)))"
            )
            call = asyncio.ensure_future(agent.call_async("hold"))
            await turns()
        assert told == ["put down"]
        with pytest.raises(Failure) as caught:
            await call
        assert caught.value.cause is Keyword("ABORTED")
        with pytest.raises(Failure):
            await agent.call_async("hold")

    run(main)


def test_two_interpreters_live_in_one_loop(agent: Interpreter) -> None:
    with Interpreter(clock="virtual") as other:
        other.eval("(defun answer (n) (sleep 5) (* 2 n))")

        @agent.primitive
        async def ask(n: int) -> Any:
            return await other.call_async("answer", n)

        agent.primitive(name="ask-plainly")(lambda n: other.call("answer", n))
        agent.eval("(defun asks (n) (list (ask n) (ask-plainly n)))")

        async def main() -> Any:
            return await asyncio.gather(
                agent.call_async("asks", 1), other.call_async("answer", 2), agent.call_async("asks", 3)
            )

        assert run(main) == [[2, 2], 4, [6, 6]]


# --- stops and what leaves everything -------------------------------------------------------


def test_an_interrupt_stops_every_call(agent: Interpreter) -> None:
    agent.eval("(defun hold () (unwind-protect (wait-for-events go) (note :clean)))")

    async def main() -> Any:
        calls = [asyncio.ensure_future(agent.call_async("hold")) for _ in range(2)]
        await turns()
        agent.interrupt("enough")
        return await asyncio.gather(*calls, return_exceptions=True)

    stops = run(main)
    assert [(type(stop), stop.reason) for stop in stops] == [(Stop, "enough")] * 2
    assert agent.value("*told*") == [Keyword("CLEAN")] * 2


def test_what_python_raises_to_leave_arrives_at_the_call_it_came_from(agent: Interpreter) -> None:
    class Leave(BaseException):
        """Leaves everything."""

    @agent.primitive
    def leave() -> None:
        raise Leave

    agent.eval("""
        (defun hold () (wait-for-events go) :held)
        (defun main () (with-cleanup-procedure (note :main) (task-net (a (sleep 1) (leave)) (b (hold)))))""")

    async def main() -> None:
        call = asyncio.ensure_future(agent.call_async("hold"))
        with pytest.raises(Leave):
            await agent.call_async("main")
        agent.signal("go")
        assert await call is Keyword("HELD")

    run(main)
    assert agent.value("*told*") == [Keyword("MAIN")]


def test_a_task_that_aborts_itself_ends_its_call_with_a_failure(agent: Interpreter) -> None:
    agent.eval("(defun give-up () (abort-task (current-task)))")

    async def main() -> None:
        with pytest.raises(Failure) as caught:
            await agent.call_async("give-up")
        assert caught.value.cause is Keyword("ABORTED")

    run(main)


def test_without_a_loop_or_in_another_thread_it_is_refused(agent: Interpreter) -> None:
    call = agent.call_async("list")
    with pytest.raises(RuntimeError, match="no running event loop"):
        call.send(None)
    agent.eval("(spawn (wait-for-events go)) (yield)")
    found: list[BaseException] = []

    def elsewhere() -> None:
        try:
            asyncio.run(agent.call_async("list"))
        except Failure as failure:
            found.append(failure)

    worker = threading.Thread(target=elsewhere)
    worker.start()
    worker.join()
    assert "another thread" in str(found)
