"""An interpreter as a guest in somebody's running asyncio loop.

Its tasks have their turns in batches, callbacks of the loop, each of which
ends after a few milliseconds at most; timers are the loop's, and what is
posted from anywhere makes the next batch come. `call_async` starts a task and
waits for its end; if the coroutine that awaits it is cancelled, the task is
aborted, and has ended, cleanups included, before the cancellation goes on.
"""

from __future__ import annotations

import sys

from eslang.base.border import leave, to_python
from eslang.base.control import Stop
from eslang.base.hints import TYPE_CHECKING, Any, Callable
from eslang.base.symbols import Value
from eslang.ctrl_c import CtrlC
from eslang.runtime.tasks import FAILED, SUCCEEDED, Task

if TYPE_CHECKING:
    from asyncio import AbstractEventLoop, Future, Handle, TimerHandle

    from eslang.interpreter import Interpreter

MOST = 64  # rounds of the driver in one batch
LONGEST = 0.005  # seconds after which a batch ends


def running_loop() -> AbstractEventLoop | None:
    """The asyncio loop that runs in this thread, if any does."""
    if "asyncio" not in sys.modules:
        return None
    from asyncio import get_running_loop

    try:
        return get_running_loop()
    except RuntimeError:
        return None


def call_soon(loop: AbstractEventLoop, action: Callable[[], object]) -> bool:
    """Let LOOP do ACTION, soon; false if it is closed. Called in any thread."""
    try:
        loop.call_soon_threadsafe(action)
    except RuntimeError:
        return False
    return True


class Guest:
    """The turns of one interpreter's tasks within a loop that is not ours."""

    def __init__(self, session: Interpreter) -> None:
        self.session = session
        self.scheduler = session.scheduler
        self.loop: AbstractEventLoop | None = None
        self._next: Handle | TimerHandle | None = None  # the next batch
        self._roused = False  # it will come soon
        self._rounds = 0
        self._until = 0.0
        self._resting = False  # nobody is ready
        self._pause: float | None = None  # seconds until the next timer
        self._expected: list[tuple[Callable[[], bool], Future[None]]] = []

    # --- batches -----------------------------------------------------------------

    def attach(self, loop: AbstractEventLoop) -> None:
        """Be a guest in LOOP from now on."""
        if loop is not self.loop:
            self.leave()
            self.loop = loop

    def leave(self) -> None:
        """Be a guest nowhere."""
        if self._next is not None:
            self._next.cancel()
        self.loop, self._next, self._roused = None, None, False

    def rouse(self) -> None:
        """Let a batch come soon. Called in any thread."""
        loop = self.loop
        if loop is not None and not self._roused:
            self._roused = True
            if not call_soon(loop, self._batch):
                self._roused = False

    def _batch(self) -> None:
        """Give out turns for a while."""
        runs, scheduler = self.session.runs, self.scheduler
        self._roused = False
        if self.loop is None or runs.gate.is_closed():
            return  # whoever is at work rouses this when that is over
        if self._next is not None:
            self._next.cancel()
        runs.begin()
        before = scheduler.rest, scheduler.between, scheduler.is_open
        scheduler.rest, scheduler.between, scheduler.is_open = self._rest, self._count, True
        self._rounds, self._resting, self._until = 0, False, self.loop.time() + LONGEST
        try:
            with CtrlC(lambda: None), self.session.at_work():
                scheduler.drive(done=self._is_enough)
        finally:
            scheduler.rest, scheduler.between, scheduler.is_open = before
            scheduler.calm_down()
            runs.leave()
            self._look_ahead()

    def _count(self) -> None:
        self._rounds += 1

    def _rest(self, seconds: float | None) -> None:
        self._resting, self._pause = True, seconds

    def _is_enough(self) -> bool:
        """True if the loop should have its turn."""
        if self._resting or not self._rounds:
            return self._resting
        assert self.loop is not None
        return self._is_idle() or self._rounds >= MOST or self.loop.time() > self._until

    def _is_idle(self) -> bool:
        return not self.scheduler.ready and self.scheduler.posted.empty()

    def _look_ahead(self) -> None:
        """Let the next batch come when there is something to do, and tell who expected what came about."""
        runs, stop = self.session.runs, None
        if runs.stopped is not None and not runs.lives.tops:
            stop, runs.stopped = runs.stopped, None
        expected, self._expected = self._expected, []
        for done, future in expected:
            if future.done():
                continue
            if stop is not None:
                future.set_exception(Stop(stop.reason, stop.code))
            elif done():
                future.set_result(None)
            else:
                self._expected.append((done, future))
        if self.loop is None or self.loop.is_closed():
            return
        if not self._resting:
            if not self._is_idle() or self.scheduler.timers or self.scheduler.polls.waits:
                self._next = self.loop.call_soon(self._batch)
        elif self._pause is not None:
            self._next = self.loop.call_later(self._pause, self._batch)

    # --- calls -------------------------------------------------------------------

    async def call(self, name: str, body: Callable[[], Value]) -> Any:
        """What BODY gives, run to its end as a task called NAME. Raises Failure, Stop."""
        from asyncio import get_running_loop

        lives, runs = self.scheduler.lives, self.session.runs
        ended: Future[BaseException | None] = get_running_loop().create_future()

        note_end = self.session.outside.note_call()

        def settle(task: Task) -> None:
            note_end()
            crash: BaseException | None
            crash, lives.crash = lives.crash, None
            if runs.stopped is not None:
                crash = Stop(runs.stopped.reason, runs.stopped.code)
            if not ended.get_loop().is_closed():
                ended.set_result(crash)

        task = lives.create(name, body)
        task.is_root = task.seen = True
        task.on_end = settle
        runs.alone(lambda: lives.start(task, "main"))
        self.session.outside.rouse()
        await self._firmly(ended, task)
        return self._outcome(task, ended.result())

    async def _firmly(self, ended: Future[Any], task: Task) -> None:
        """Wait until TASK has ENDED. If this is cancelled, abort it first, and then go on with that."""
        from asyncio import CancelledError, shield

        leaving: CancelledError | None = None
        while not ended.done():
            try:
                await shield(ended)
            except CancelledError as error:
                leaving = leaving or error
                self.session.runs.alone(lambda: self.scheduler.lives.abort(task, "caller"))
                self.session.outside.rouse()
        if leaving is not None:
            try:
                raise leaving
            finally:
                del leaving  # which knows this frame

    def _outcome(self, task: Task, crash: BaseException | None) -> Any:
        """What TASK, which has ended, gave or failed with."""
        if crash is not None:
            raise crash
        if task.status is SUCCEEDED:
            self.session.runs.settle()
            return to_python(task.value)
        failure = task.failure
        if failure is None or task.status is not FAILED:
            raise self.session.runs.aborted()
        self.session.hooks.tell("aborted", None, failure=failure)
        leave(failure)
        raise failure

    async def finish(self) -> None:
        """Wait for what was spawned, and abort the daemons. Raises a failure nobody saw."""
        runs, tops = self.session.runs, self.scheduler.lives.tops
        runs.check_outside()
        await self._expect(lambda: all(task.daemon for task in tops))
        await self._abort_all()
        with self.session.door():
            runs.raise_unseen()

    async def close(self) -> None:
        """Abort all, and wait until it has ended."""
        self.session.runs.check_outside()
        await self._abort_all()

    async def _abort_all(self) -> None:
        self.session.runs.abort_tops()
        await self._expect(lambda: not self.scheduler.lives.tops)

    async def _expect(self, done: Callable[[], bool]) -> None:
        """Wait until DONE is true after a batch. Raises Stop if the run was stopped."""
        from asyncio import get_running_loop

        if not done():
            expected = get_running_loop().create_future()
            self._expected.append((done, expected))
            self.session.outside.rouse()
            await expected
