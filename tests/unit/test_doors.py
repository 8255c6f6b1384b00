"""Entrances and ends: threads, Ctrl-C, callbacks, other interpreters, `finish` and `close`."""

from __future__ import annotations

import asyncio
import gc
import io
import signal
import threading
import traceback
from collections.abc import Callable, Iterator
from typing import Any

import greenlet
import pytest

from eslang import Failure, Interpreter, Keyword
from eslang.base.control import Stop


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter that knows how to note things; nothing is left of it afterwards."""
    before = set(threading.enumerate())
    with Interpreter(output=io.StringIO()) as made:
        made.eval("(defevent go) (defvar *told* nil) (defun note (it) (push it *told*))")
        yield made
    assert set(threading.enumerate()) == before
    scheduler = made.scheduler
    assert (scheduler.current, scheduler.driver, made.runs.root) == (None, None, None)
    assert (len(scheduler.ready), len(scheduler.timers), made.runs.lives.count) == (0, 0, 0)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def in_thread(work: Callable[[], Any]) -> Any:
    """What WORK gives, or the failure that it raises, done in another thread."""
    found: list[Any] = []

    def do() -> None:
        try:
            found.append(work())
        except Failure as failure:
            found.append(failure)

    worker = threading.Thread(target=do)
    worker.start()
    worker.join()
    return found[0]


# --- threads ----------------------------------------------------------------------------


def test_an_idle_interpreter_may_move_from_thread_to_thread(agent: Interpreter) -> None:
    @agent.primitive
    async def fetch() -> int:
        await asyncio.sleep(0)
        return 7

    text = "(multiple-value-list (task-net (a (fetch)) (b (sleep 0.001) 8)))"
    assert agent.eval(text) == [7, 8]
    assert in_thread(lambda: agent.eval(text)) == [7, 8]
    assert in_thread(lambda: agent.eval(text)) == [7, 8]
    assert agent.eval(text) == [7, 8]


def test_a_call_from_a_second_thread_while_it_is_at_work_is_refused(agent: Interpreter) -> None:
    agent.primitive(name="elsewhere")(lambda: str(in_thread(lambda: agent.eval("1"))))
    assert "at work in another thread; signal it from there" in agent.eval("(elsewhere)")


def test_tasks_that_are_alive_keep_it_in_their_thread(agent: Interpreter) -> None:
    agent.eval("(spawn (progn (wait-for-events go) (note :went))) (yield)")
    assert "live in another thread" in str(in_thread(lambda: agent.eval("1")))
    assert "live in another thread" in str(in_thread(agent.close))
    in_thread(lambda: agent.signal("go"))
    agent.finish()
    assert agent.value("*told*") == [Keyword("WENT")]


def test_tasks_whose_thread_is_gone_are_gone_too(agent: Interpreter) -> None:
    in_thread(lambda: agent.eval("(defvar *it* (spawn (progn (sleep 5) (wait-for-events go)))) (yield)"))
    assert agent.eval("(list (task-status *it*) (task-net (a (sleep 0)) (b 7)))") == [
        Keyword("ABORTED"),
        None,
    ]
    agent.finish()


def test_threads_that_call_at_once_are_each_served_or_refused(agent: Interpreter) -> None:
    agent.eval("(defun work (n) (task-net (a (yield) n) (b (yield))))")
    found: list[Any] = []
    meeting = threading.Barrier(4)

    def work() -> None:
        meeting.wait(10)
        for number in range(200):
            try:
                found.append(agent.call("work", number) == number)
            except Failure as failure:
                found.append("another thread" in str(failure))

    workers = [threading.Thread(target=work) for _ in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert found == [True] * 800


def test_two_interpreters_are_at_work_in_two_threads() -> None:
    meeting = threading.Barrier(2)

    def work(number: int) -> Any:
        with Interpreter() as agent:
            agent.primitive(name="meet")(lambda: meeting.wait(10) is not None)
            agent.eval(f"(defvar *mine* {number})")
            return agent.eval("(list (meet) *mine* (meet))")

    found: list[Any] = []
    workers = [threading.Thread(target=lambda n=n: found.append(work(n))) for n in range(2)]  # type: ignore[misc]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert sorted(found) == [[True, 0, True], [True, 1, True]]


# --- callbacks and other interpreters -----------------------------------------------------


def test_a_callback_from_a_primitive_inside_a_task_may_wait(agent: Interpreter) -> None:
    agent.primitive(name="through-python")(lambda name: agent.call(name))
    agent.eval("(defun wait-here () (multiple-value-list (wait-for-events go)))")
    text = "(multiple-value-list (task-net (a (through-python 'wait-here)) (b (yield) (signal go 1 2))))"
    assert agent.eval(text) == [[1, 2], None]


def test_aborting_a_task_passes_the_python_code_in_between(agent: Interpreter) -> None:
    told: list[str] = []

    @agent.primitive
    def through_python(name: str) -> Any:
        try:
            return agent.call(name)
        except Exception:
            told.append("seen")
        finally:
            told.append("left")

    agent.eval("(defun wait-here () (unwind-protect (wait-for-events go) (note :clean)))")
    with pytest.raises(Failure) as caught:
        agent.eval('(task-net (a (through-python "wait-here")) (b (yield) (fail :enough)))')
    assert caught.value.cause is Keyword("ENOUGH")
    assert (told, agent.value("*told*")) == (["left"], [Keyword("CLEAN")])


def test_an_error_that_crosses_several_borders_keeps_its_traceback(agent: Interpreter) -> None:
    with Interpreter(output=io.StringIO()) as other:

        @other.primitive
        def read_port() -> None:
            raise OSError("no such port")

        @agent.primitive
        def ask_the_other() -> Any:
            return other.call("sense")

        @agent.primitive
        async def ask_slowly() -> Any:
            await asyncio.sleep(0)
            return agent.to_python(None) or other.call("sense")

        agent.primitive(name="ask-elsewhere", blocking=True)(lambda: other.call("sense"))
        agent.primitive(name="through-python")(lambda name: agent.call(name))
        other.eval("(defun sense () (task-net (a (read-port))))")
        for name in ("ask-the-other", "ask-slowly", "ask-elsewhere"):
            agent.eval(f"(defun ask () (task-net (a (through-python '{name}))))")
            with pytest.raises(Failure) as caught:
                agent.eval("(task-net (a (through-python 'ask)))")
            cause = caught.value.__cause__
            assert isinstance(cause, OSError), name
            assert traceback.extract_tb(cause.__traceback__)[-1].name == "read_port"
            assert caught.value.arguments[:2] == ("OSError", "no such port")


def test_an_interpreter_that_waits_for_another_cannot_be_called_by_it(agent: Interpreter) -> None:
    with Interpreter(output=io.StringIO()) as other:
        agent.primitive(name="ask-the-other")(lambda: other.eval("(back)"))
        other.primitive(name="back")(lambda: agent.eval("(progn (yield) (ask-too))"))
        agent.primitive(name="ask-too")(lambda: other.eval("(list 1)"))
        assert agent.eval("(ask-the-other)") == [1]
        agent.primitive(name="back-and-wait")(lambda: other.eval("(back-to-wait)"))
        other.primitive(name="back-to-wait")(lambda: agent.eval("(progn (wait-for-events go) :went)"))
        agent.primitive(name="ask-meanwhile")(lambda: other.eval("1"))
        text = """
            (task-net (a (back-and-wait))
                      (b (yield)
                         (with-recovery-procedures (((:control-error why) (note why) (abort)))
                           (ask-meanwhile))
                         (signal go)))"""
        assert agent.eval(text) is Keyword("WENT")
        assert agent.value("*told*") == ["this interpreter waits for another one, which cannot call it"]


# --- Ctrl-C -----------------------------------------------------------------------------


def press() -> None:
    """Press Ctrl-C."""
    signal.raise_signal(signal.SIGINT)


@pytest.mark.parametrize("busy", ["(loop)", "(sleep 1000)", "(wait-forever)", "(stare)", "(ping)"])
def test_ctrl_c_ends_a_call_with_all_cleanups(agent: Interpreter, busy: str) -> None:
    @agent.primitive
    async def wait_forever() -> None:
        await asyncio.get_running_loop().create_future()

    left = threading.Event()
    agent.primitive(name="stare", blocking=True)(lambda: left.wait(10))
    agent.primitive(name="press", blocking=True)(press)
    agent.eval("(defun ping () (signal go) (yield) (ping))")
    agent.eval("(defun main () (unwind-protect (task-net (a (work)) (b (press) (sleep 1000))) (note :main)))")
    agent.eval(f"(defun work () (with-cleanup-procedure (progn (sleep 0.001) (note :work)) {busy}))")
    with pytest.raises(KeyboardInterrupt):
        agent.call("main")
    left.set()
    assert agent.value("*told*") == [Keyword("MAIN"), Keyword("WORK")]
    assert agent.eval("(+ 1 1)") == 2


def test_ctrl_c_in_the_python_code_of_a_primitive_is_raised_there(agent: Interpreter) -> None:
    told: list[str] = []

    @agent.primitive
    def ponder() -> None:
        try:
            press()
            told.append("not reached")
        finally:
            told.append("left")

    agent.eval("(defun main () (task-net (a (ponder)) (b (with-cleanup-procedure (note :clean) (sleep 9)))))")
    with pytest.raises(KeyboardInterrupt):
        agent.call("main")
    assert (told, agent.value("*told*")) == (["left"], [Keyword("CLEAN")])


def test_ctrl_c_while_one_interpreter_calls_another_ends_both_calls(agent: Interpreter) -> None:
    with Interpreter() as other:
        other.primitive(name="press", blocking=True)(press)
        agent.primitive(name="ask")(lambda: other.eval("(task-net (a (loop)) (b (press)))"))
        with pytest.raises(KeyboardInterrupt):
            agent.eval("(with-cleanup-procedure (note :clean) (ask))")
    assert agent.value("*told*") == [Keyword("CLEAN")]


def test_ctrl_c_in_a_loop_that_leaves_it_to_python_leaves_the_tasks_whole(agent: Interpreter) -> None:
    agent.primitive(name="press", blocking=True)(press)
    agent.eval("(defun main () (unwind-protect (progn (spawn (press)) (loop)) (note :clean)))")
    loop = asyncio.new_event_loop()
    call = loop.create_task(agent.call_async("main"))
    with pytest.raises(KeyboardInterrupt):
        loop.run_until_complete(call)
    assert agent.value("*told*") is None
    call.cancel()
    with pytest.raises(asyncio.CancelledError):
        loop.run_until_complete(call)
    loop.close()
    assert agent.value("*told*") == [Keyword("CLEAN")]


def test_a_program_that_sees_to_ctrl_c_itself_is_left_alone(agent: Interpreter) -> None:
    pressed: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, frame: pressed.append(number))
    try:
        agent.primitive(name="press")(press)
        assert agent.eval("(progn (press) :on)") is Keyword("ON")
    finally:
        signal.signal(signal.SIGINT, before)
    assert pressed == [signal.SIGINT]


def test_an_interrupt_from_another_thread_stops_the_call(agent: Interpreter) -> None:
    agent.primitive(name="stop-it", blocking=True)(lambda: agent.interrupt("enough", 3))
    with pytest.raises(Stop) as caught:
        agent.eval("(task-net (a (unwind-protect (loop) (note :clean))) (b (stop-it)))")
    assert (caught.value.reason, caught.value.code) == ("enough", 3)
    assert agent.value("*told*") == [Keyword("CLEAN")]


def test_an_interrupt_while_nothing_runs_stops_nothing(agent: Interpreter) -> None:
    agent.interrupt()
    assert agent.eval("(dotimes (i 5000 :done))") is Keyword("DONE")


def test_an_interrupt_reaches_what_runs_outside_of_any_task(agent: Interpreter, tmp_path: Any) -> None:
    plan = tmp_path / "plan.esl"
    agent.primitive(name="press")(agent.interrupt)
    plan.write_text("(defmacro endless () (press) (loop)) (defun main () (endless))")
    with pytest.raises(Stop):
        agent.check([plan])


# --- finish and close -------------------------------------------------------------------


def test_finish_waits_for_what_was_spawned_and_aborts_the_daemons(agent: Interpreter) -> None:
    agent.eval("(spawn (progn (sleep 0.001) (note :spawned)))")
    agent.eval("(spawn (unwind-protect (wait-for-events go) (note :daemon)) :daemon t)")
    agent.finish()
    assert agent.value("*told*") == [Keyword("DAEMON"), Keyword("SPAWNED")]
    agent.finish()
    assert agent.eval("1") == 1


def test_finish_raises_a_failure_that_nobody_saw_once(agent: Interpreter) -> None:
    agent.eval('(spawn (fail :no-power "left")) (yield)')
    with pytest.raises(Failure) as caught:
        agent.finish()
    assert (caught.value.cause, caught.value.arguments) == (Keyword("NO-POWER"), ("left",))
    agent.finish()


def test_close_aborts_what_runs_with_cleanups_that_may_wait(agent: Interpreter) -> None:
    @agent.primitive
    async def put_down() -> str:
        await asyncio.sleep(0)
        return "put down"

    agent.eval("""
        (spawn (with-cleanup-procedure (progn (sleep 0.001) (note (put-down))) (wait-for-events go)))
        (spawn (with-cleanup-procedure (note :loop) (loop)))
        (yield)""")
    agent.close()
    agent.close()
    assert agent.value("*told*") == ["put down", Keyword("LOOP")]
    with pytest.raises(Failure) as caught:
        agent.eval("1")
    assert caught.value.cause is Keyword("INTERPRETER-CLOSED")


def test_a_cleanup_may_call_the_interpreter_that_is_being_closed(agent: Interpreter) -> None:
    agent.primitive(name="call-back")(lambda: agent.call("note", 7))
    agent.eval("(spawn (with-cleanup-procedure (call-back) (wait-for-events go))) (yield)")
    agent.close()
    assert agent.value("*told*") == [7]


def test_close_and_finish_from_within_are_refused(agent: Interpreter) -> None:
    @agent.primitive
    async def close_slowly() -> None:
        agent.close()

    agent.primitive(name="close-it")(agent.close)
    agent.primitive(name="finish-it")(agent.finish)
    for text in ("(close-it)", "(finish-it)", "(task-net (a (close-it)))", "(close-slowly)"):
        with pytest.raises(Failure) as caught:
            agent.eval(text)
        assert caught.value.cause is Keyword("CONTROL-ERROR"), text
    assert agent.eval("1") == 1


def test_a_cleanup_that_waits_in_vain_does_not_keep_close_waiting(agent: Interpreter) -> None:
    agent.eval(
        "(spawn (unwind-protect (unwind-protect (wait-for-events go) (wait-for-events go)) (note 1))) (yield)"
    )
    agent.scheduler.is_open = True  # as with Interpreter(outside=True)
    agent.close()
    assert agent.value("*told*") == [1]


def test_no_stack_is_left_of_a_closed_interpreter() -> None:
    def stacks() -> int:
        gc.collect()
        return sum(1 for thing in gc.get_objects() if isinstance(thing, greenlet.greenlet) and not thing.dead)

    before = stacks()
    with Interpreter(clock="virtual") as agent:
        agent.eval("(defevent go) (dotimes (i 100) (spawn (wait-for-events go))) (yield)")
        agent.eval("(dotimes (i 100) (spawn (sleep i))) (yield)")
        assert stacks() > before + 150
    assert stacks() == before


def test_what_a_failed_with_block_leaves_alive_is_aborted() -> None:
    told: list[str] = []
    with pytest.raises(ZeroDivisionError), Interpreter() as agent:
        agent.primitive(name="note")(told.append)
        agent.eval('(defevent go) (spawn (unwind-protect (wait-for-events go) (note "clean"))) (yield)')
        1 // 0  # noqa: B018
    assert told == ["clean"]
