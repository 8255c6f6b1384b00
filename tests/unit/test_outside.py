"""Primitives whose coroutines are awaited, in plain calls from Python."""

from __future__ import annotations

import asyncio
import contextvars
import functools
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


# --- coroutines -------------------------------------------------------------------------


def test_a_plain_call_awaits_an_async_primitive(agent: Interpreter) -> None:
    @agent.primitive
    async def fetch(thing: str, *, times: int = 1) -> list[str]:
        """Fetch THING."""
        await asyncio.sleep(0)
        return [thing] * times

    assert agent.eval('(fetch "cup" :times 2)') == ["cup", "cup"]
    assert agent.call("fetch", "cup") == ["cup"]


def test_it_works_while_a_file_is_loaded(agent: Interpreter, tmp_path: Any) -> None:
    @agent.primitive
    async def fetch() -> int:
        await asyncio.sleep(0)
        return 7

    plan = tmp_path / "plan.esl"
    plan.write_text("(defvar *got* (fetch))")
    agent.load(plan)
    assert agent.value("*got*") == 7


def test_while_a_task_awaits_a_coroutine_others_run(agent: Interpreter) -> None:
    arrived: list[asyncio.Event] = []

    @agent.primitive
    async def wait_for_delivery() -> str:
        arrived.append(asyncio.Event())
        await arrived[0].wait()
        return "cup"

    @agent.primitive
    def deliver() -> bool:
        if arrived:
            arrived[0].set()
        return bool(arrived)

    text = "(task-net (a (wait-for-delivery)) (b (loop (if (deliver) (return :delivered)) (yield))))"
    assert agent.eval(f"(multiple-value-list {text})") == ["cup", Keyword("DELIVERED")]


def test_coroutines_of_several_tasks_meet_each_other(agent: Interpreter) -> None:
    places: dict[str, asyncio.Queue[str]] = {}

    @agent.primitive
    async def swap(mine: str, other: str) -> str:
        for name in (mine, other):
            places.setdefault(name, asyncio.Queue())
        await places[other].put(mine)
        return await places[mine].get()

    text = '(task-net (a (swap "one" "two")) (b (swap "two" "one")))'
    assert agent.eval(f"(multiple-value-list {text})") == ["two", "one"]


def test_a_coroutine_can_be_awaited_inside_a_sort_predicate(agent: Interpreter) -> None:
    @agent.primitive
    async def less(one: int, other: int) -> bool:
        await asyncio.sleep(0)
        return one < other

    assert agent.eval("(sort (list 3 1 2) #'less)") == [1, 2, 3]


def test_a_failure_that_a_coroutine_raises_is_a_fail_at_the_call(agent: Interpreter) -> None:
    calls: list[int] = []

    @agent.primitive
    async def grip() -> str:
        calls.append(1)
        await asyncio.sleep(0)
        if len(calls) < 3:
            raise Failure("slipped", len(calls), "left")
        return "held"

    text = "(with-recovery-procedures (((:slipped n side) :retries 5 (retry))) (grip))"
    assert agent.eval(text) == "held"
    calls.clear()
    assert agent.eval("(with-recovery-procedures (((:slipped n side) n)) (list :got (grip)))") == [
        Keyword("GOT"),
        1,
    ]


def test_another_exception_keeps_its_python_traceback(agent: Interpreter) -> None:
    async def read_port() -> None:
        await asyncio.sleep(0)
        raise OSError("no such port")

    @agent.primitive
    async def sense() -> None:
        await read_port()

    text = "(with-recovery-procedures (((:python-error kind text) (abort (list kind text)))) (sense))"
    assert agent.eval(text) == ["OSError", "no such port"]
    with pytest.raises(Failure) as caught:
        agent.eval("(task-net (a (sense)))")
    assert isinstance(caught.value.__cause__, OSError)
    assert caught.value.arguments[2] is caught.value.__cause__
    assert functions_in(caught.value.__cause__)[-2:] == ["sense", "read_port"]


def test_aborting_the_task_cancels_its_coroutine_and_waits_for_its_end(agent: Interpreter) -> None:
    told: list[str] = []

    @agent.primitive
    async def hold() -> None:
        told.append("held")
        try:
            await asyncio.get_running_loop().create_future()
        finally:
            await asyncio.sleep(0)
            told.append("let go")

    agent.primitive(name="note")(told.append)
    agent.eval("""
        (let ((task (spawn (unwind-protect (hold) (note "cleanup")))))
          (sleep 0)
          (loop (if (eq (task-status task) :waiting) (return)) (sleep 0))
          (abort-task task)
          (wait-for-task task)
          (note "ended"))""")
    assert told in (["held", "let go", "cleanup", "ended"], ["cleanup", "ended"])


def test_a_deadline_that_leads_out_cancels_the_coroutine(agent: Interpreter) -> None:
    told: list[str] = []

    @agent.primitive
    async def hold() -> None:
        try:
            await asyncio.get_running_loop().create_future()
        except asyncio.CancelledError:
            told.append("cancelled")
            raise

    @agent.primitive
    async def settle() -> None:
        for _ in range(3):
            await asyncio.sleep(0)

    text = """
        (with-recovery-procedures ((:enough (abort :late)))
          (with-guardian (settle) (fail :enough) (hold)))"""
    assert agent.eval(text) is Keyword("LATE")
    assert told == ["cancelled"]


def test_an_interrupt_that_returns_leaves_the_coroutine_alone(agent: Interpreter) -> None:
    go: list[asyncio.Event] = []

    @agent.primitive
    async def hold() -> str:
        go.append(asyncio.Event())
        await go[0].wait()
        return "done"

    @agent.primitive
    async def settle() -> None:
        while not go:
            await asyncio.sleep(0)

    agent.primitive(name="release")(lambda: go[0].set())
    text = "(let ((seen nil)) (list (with-guardian (settle) (progn (setq seen t) (release)) (hold)) seen))"
    assert agent.eval(text) == ["done", True]


def test_an_error_of_a_coroutine_that_is_cancelled_is_told_and_the_first_failure_kept() -> None:
    told: list[Any] = []

    def listen(event: Any) -> None:
        if event.kind == "failure":
            told.append(event.data["failure"].cause)

    with Interpreter(clock="virtual", listeners=[listen]) as agent:
        begun: list[bool] = []

        @agent.primitive
        async def hold() -> None:
            begun.append(True)
            try:
                await asyncio.get_running_loop().create_future()
            finally:
                raise OSError("the arm is stuck")

        @agent.primitive
        async def settle() -> None:
            while not begun:
                await asyncio.sleep(0)

        with pytest.raises(Failure) as caught:
            agent.eval("(task-net (a (hold)) (b (settle) (fail :enough)))")
    assert caught.value.cause is Keyword("ENOUGH")
    assert told == [Keyword("ENOUGH"), Keyword("PYTHON-ERROR"), Keyword("ENOUGH")]


def test_a_coroutine_that_others_cancel_is_a_python_error(agent: Interpreter) -> None:
    @agent.primitive
    async def hold() -> None:
        running = asyncio.current_task()
        assert running is not None
        asyncio.get_running_loop().call_soon(running.cancel)
        await asyncio.get_running_loop().create_future()

    text = "(with-recovery-procedures (((:python-error kind text) (abort kind))) (hold))"
    assert agent.eval(text) == "CancelledError"


def test_virtual_time_stands_still_while_a_coroutine_is_under_way(agent: Interpreter) -> None:
    times: list[float] = []

    @agent.primitive
    async def fetch() -> None:
        for _ in range(5):
            await asyncio.sleep(0)
        times.append(agent.clock.now())

    agent.eval("(task-net (a (fetch)) (b (sleep 3600)))")
    assert times == [0.0]
    assert agent.clock.now() == 3600


def test_a_wait_beside_a_coroutine_is_no_deadlock_and_one_after_it_is(agent: Interpreter) -> None:
    @agent.primitive
    async def fetch() -> int:
        await asyncio.sleep(0)
        return 1

    agent.eval("(defevent arrived)")
    text = "(task-net (a (wait-for-events arrived)) (b (fetch) (signal arrived)))"
    agent.eval(text)
    with pytest.raises(Failure) as caught:
        agent.eval("(task-net (a (wait-for-events arrived)) (b (fetch)))")
    assert caught.value.cause is Keyword("DEADLOCK")


def test_a_busy_task_does_not_keep_coroutines_from_going_on(agent: Interpreter) -> None:
    seen: list[int] = []

    @agent.primitive
    async def settle() -> None:
        for _ in range(3):
            await asyncio.sleep(0)
        seen.append(1)

    agent.primitive(name="is-settled")(lambda: bool(seen))
    agent.eval("(progn (spawn (settle)) (loop (if (is-settled) (return))))")
    agent.finish()
    assert seen == [1]


def test_all_coroutines_of_an_interpreter_share_one_loop_which_closes_with_it() -> None:
    loops: list[Any] = []
    ended: list[str] = []

    async def background() -> None:
        try:
            await asyncio.get_running_loop().create_future()
        finally:
            ended.append("background")

    with Interpreter() as agent:

        @agent.primitive
        async def connect() -> None:
            loops.append(asyncio.get_running_loop())
            loops.append(asyncio.create_task(background()))
            await asyncio.sleep(0)

        agent.eval("(connect)")
        agent.call("connect")
        assert loops[0] is loops[2]
    assert loops[0].is_closed()
    assert ended == ["background", "background"]


def test_what_python_raises_to_leave_leaves_from_a_coroutine_too(agent: Interpreter) -> None:
    @agent.primitive
    async def leave() -> None:
        await asyncio.sleep(0)
        raise SystemExit(3)

    agent.eval("(defvar *clean* nil)")
    with pytest.raises(SystemExit):
        agent.eval("""
            (with-recovery-procedures ((:general-failure (abort)))
              (task-net (a (with-cleanup-procedure (push :a *clean*) (leave)))
                        (b (with-cleanup-procedure (push :b *clean*) (sleep 5)))))""")
    assert agent.value("*clean*") == [Keyword("B"), Keyword("A")]


def test_what_gives_a_coroutine_when_called_is_awaited(agent: Interpreter) -> None:
    async def add(one: int, other: int) -> int:
        await asyncio.sleep(0)
        return one + other

    agent.primitive(name="add-two", signature="(add-two n)")(functools.partial(add, 2))
    assert agent.eval("(add-two 3)") == 5


def test_a_coroutine_sees_the_context_variables_of_the_caller(agent: Interpreter) -> None:
    who: contextvars.ContextVar[str] = contextvars.ContextVar("who", default="nobody")

    @agent.primitive
    async def ask() -> str:
        return who.get()

    agent.primitive(name="ask-in-a-thread", blocking=True)(lambda: who.get())
    who.set("me")
    assert agent.eval("(list (ask) (ask-in-a-thread))") == ["me", "me"]


@pytest.mark.parametrize("blocking", [False, True])
def test_what_cannot_be_a_primitive_is_refused(agent: Interpreter, blocking: bool) -> None:
    async def count() -> Any:
        yield 1

    async def wait() -> None:
        """Wait for something."""

    with pytest.raises(TypeError, match="count yields"):
        agent.primitive(blocking=blocking)(count)
    if blocking:
        with pytest.raises(TypeError, match="wait is an `async def`"):
            agent.primitive(blocking=True)(wait)


def test_a_task_begins_with_the_context_variables_where_it_is_started(agent: Interpreter) -> None:
    who: contextvars.ContextVar[str] = contextvars.ContextVar("who", default="nobody")
    agent.primitive(name="who")(lambda: who.get())
    agent.primitive(name="become")(lambda name: who.set(name) and None)
    who.set("me")
    text = """
        (multiple-value-list
          (task-net (a (become "another") (yield) (list (who) (nth-value 0 (task-net (c (who))))))
                    (b (yield) (who))))"""
    assert agent.eval(text) == [["another", "another"], "me"]
    assert agent.eval("(list (who) (task-net (a (who))))") == ["me", "me"]
