"""Laws of what goes on around the tasks: however it is cut short, nothing is left, and all is cleaned up."""

from __future__ import annotations

import asyncio
import io
import threading
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from eslang import Failure, Interpreter

LEAVES = (
    "(nap {n})",
    "(nap {n})",
    "(grind)",
    "(sleep {n})",
    "(yield)",
    "(fail :oops)",
    "(nap-and-fail {n})",
    "(ask {n})",
    "(dotimes (i {n}00) (incf *sum*))",
    "(wait-for-events go)",
)
NODES = (
    "(task-net (a {x}) (b {y}))",
    "(task-net :allow-failures (a {x}) (b {y}))",
    "(or-parallel {x} {y})",
    "(with-guardian {x} (fail :guarded) {y})",
    "(with-guardian {x} nil {y})",
    "(with-deadline ({n}) {x} {y})",
    "(with-recovery-procedures ((:general-failure (abort :recovered))) {x} {y})",
    "(with-recovery-procedures ((:oops :retries {n} (nap {n}) (retry))) {x})",
    "(with-cleanup-procedure (nap {n}) {x})",
    "(spawn {x})",
    "(spawn {x} :daemon t)",
    "(let ((it (spawn {x}))) {y} (abort-task it))",
)


def node(parts: tuple[str, int, str, str]) -> str:
    """A form, and a count of how often it is entered and left."""
    text, n, x, y = parts
    return f"(progn (note-entry) (unwind-protect {text.format(n=n, x=x, y=y)} (note-exit)))"


small = st.integers(1, 4)
leaves = st.builds(lambda text, n: text.format(n=n), st.sampled_from(LEAVES), small)
forms = st.recursive(
    leaves, lambda inner: st.tuples(st.sampled_from(NODES), small, inner, inner).map(node), max_leaves=8
)

Interpreter().close()  # it raises the limit of recursion, which Hypothesis would notice in a test


class World:
    """An interpreter with primitives that take time, and what was counted."""

    def __init__(self, form: str) -> None:
        self.entries = self.exits = self.naps = 0
        self.agent = agent = Interpreter(clock="virtual", output=io.StringIO())
        agent.primitive(self.note_entry)
        agent.primitive(self.note_exit)
        agent.primitive(self.nap)
        agent.primitive(self.nap_and_fail)
        agent.primitive(self.ask)
        agent.primitive(name="grind", blocking=True)(lambda: None)
        agent.eval(f"(defevent go) (defvar *sum* 0) (defun answer () (sleep 1) 7) (defun main () {form})")

    def note_entry(self) -> None:
        """Something begins that is to be cleaned up."""
        self.entries += 1

    def note_exit(self) -> None:
        """It is cleaned up."""
        self.exits += 1

    async def nap(self, turns: int) -> None:
        """Sleep for some rounds of the loop, and clean up for one more."""
        self.naps += 1
        try:
            for _ in range(turns):
                await asyncio.sleep(0)
        finally:
            try:
                await asyncio.sleep(0)
            finally:
                self.naps -= 1

    async def nap_and_fail(self, turns: int) -> None:
        """Sleep, and fail."""
        await self.nap(turns)
        raise Failure("oops")

    async def ask(self, turns: int) -> Any:
        """Call the plan."""
        await asyncio.sleep(0)
        return await self.agent.call_async("answer")

    def check(self) -> None:
        """All is over."""
        agent, scheduler = self.agent, self.agent.scheduler
        assert self.entries == self.exits
        assert self.naps == 0
        assert agent.runs.lives.count == scheduler.outside == len(scheduler.timers) == 0
        assert not (
            agent.runs.lives.tops or scheduler.ready or scheduler.polls.waits or agent.outside.operations
        )
        assert (scheduler.current, scheduler.driver, agent.runs.root) == (None, None, None)
        assert [thread for thread in threading.enumerate() if thread.name.startswith("eslang")] == []


@pytest.mark.slow
@given(forms)
def test_nothing_is_left_of_a_plain_call(form: str) -> None:
    world = World(form)
    with world.agent as agent:
        try:
            agent.call("main")
            agent.signal("go")
            agent.finish()
        except Failure:
            pass
    world.check()


@pytest.mark.slow
@given(st.lists(forms, min_size=1, max_size=2), st.integers(0, 25), st.booleans())
def test_nothing_is_left_of_calls_that_are_cancelled(texts: list[str], when: int, closing: bool) -> None:
    world = World(" ".join(texts))
    complaints: list[Any] = []

    async def main() -> None:
        asyncio.get_running_loop().set_exception_handler(lambda loop, about: complaints.append(about))
        async with world.agent as agent:
            calls = [asyncio.ensure_future(agent.call_async("main")) for _ in texts]
            for _ in range(when):
                await asyncio.sleep(0)
            agent.signal("go")
            for call in calls:
                call.cancel()
            if closing:
                await agent.close_async()
            for result in await asyncio.gather(*calls, return_exceptions=True):
                assert not isinstance(result, BaseException) or isinstance(
                    result, Failure | asyncio.CancelledError
                ), result
        assert asyncio.all_tasks() == {asyncio.current_task()}

    asyncio.run(main())
    assert complaints == []
    world.check()


@pytest.mark.slow
@given(forms, st.integers(0, 25))
def test_nothing_is_left_when_asyncio_run_ends_in_the_middle(form: str, when: int) -> None:
    world = World(form)

    async def main() -> None:
        call = asyncio.ensure_future(world.agent.call_async("main"))
        for _ in range(when):
            await asyncio.sleep(0)
        if call.done() and not call.cancelled():
            call.exception()

    asyncio.run(main())
    world.agent.close()
    world.check()
