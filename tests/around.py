"""What tests of Python's concurrency around the tasks share."""

from __future__ import annotations

import asyncio
import gc
import io
import threading
import traceback
from collections.abc import Callable, Coroutine, Iterator
from contextlib import contextmanager
from typing import Any

from eslang import Interpreter


@contextmanager
def whole_agent(text: str, **given: Any) -> Iterator[Interpreter]:
    """An interpreter that has evaluated TEXT; nothing is left of it, nor of what it started, afterwards."""
    before = set(threading.enumerate())
    with Interpreter(output=io.StringIO(), **given) as agent:
        agent.eval(text)
        yield agent
    assert set(threading.enumerate()) == before
    scheduler = agent.scheduler
    assert (scheduler.current, scheduler.driver, agent.runs.root) == (None, None, None)
    assert (len(scheduler.ready), len(scheduler.timers), scheduler.polls.waits) == (0, 0, [])
    assert (agent.runs.lives.count, dict(agent.runs.lives.tops), scheduler.outside) == (0, {}, 0)
    assert not agent.outside.operations
    assert scheduler.posted.empty()


def run(main: Callable[[], Coroutine[Any, Any, Any]]) -> Any:
    """Run MAIN in a loop that complains of all that is wrong, and leave no asyncio task behind."""
    complaints: list[Any] = []

    async def watched() -> Any:
        asyncio.get_running_loop().set_exception_handler(lambda loop, about: complaints.append(about))
        result = await main()
        await asyncio.sleep(0)
        assert asyncio.all_tasks() == {asyncio.current_task()}
        return result

    result = asyncio.run(watched(), debug=True)
    gc.collect()
    assert complaints == []
    return result


async def turns(number: int = 10) -> None:
    """Let the loop go round a few times."""
    for _ in range(number):
        await asyncio.sleep(0)


def functions_in(error: BaseException | None) -> list[str]:
    """The functions that the traceback of ERROR passes."""
    assert error is not None
    return [frame.name for frame in traceback.extract_tb(error.__traceback__)]


class Worker(threading.Thread):
    """A thread that does some work at once; what came of it is `found`."""

    def __init__(self, work: Callable[[], Any]) -> None:
        super().__init__()
        self.work = work
        self.found: Any = None
        self.start()

    def run(self) -> None:
        """Do it."""
        try:
            self.found = self.work()
        except Exception as error:
            self.found = error

    def end(self) -> Any:
        """What came of it."""
        self.join(20)
        assert not self.is_alive()
        return self.found


def in_thread(work: Callable[[], Any]) -> Any:
    """What WORK gives, or raises, in another thread."""
    return Worker(work).end()
