"""What goes on outside: coroutines and blocking calls that tasks wait for.

A task that calls an `async def` primitive waits for its coroutine, one that
calls a blocking primitive for a thread; the others go on meanwhile. Coroutines
run in the asyncio loop that runs already (guest.py); where there is none, in
one of our own, which is driven while the interpreter rests. Whoever leaves
such a wait calls the coroutine off, and waits until it has ended; a blocking
call cannot be called off: it is left alone, and its outcome is dropped.
"""

from __future__ import annotations

from contextvars import ContextVar, copy_context

from eslang.base.border import enter
from eslang.base.errors import python_failure
from eslang.base.failure import Failure, control_error
from eslang.base.hints import TYPE_CHECKING, Any, Callable
from eslang.guest import Guest, call_soon, running_loop
from eslang.runtime.events import Wait
from eslang.runtime.tasks import Task

if TYPE_CHECKING:
    from asyncio import AbstractEventLoop, Runner

    from eslang.interpreter import Interpreter

EVERY = 8  # rounds of a busy driver between two looks at our own loop


class Operation:
    """A coroutine or a blocking call, and the wait of a task for it."""

    __slots__ = ("asks", "called_off", "error", "loop", "over", "value", "wait", "work")

    def __init__(self, task: Task, name: str, loop: Any = None) -> None:
        self.wait = Wait(task, "outside", f"the primitive {name.lower()}")
        self.loop = loop  # of a coroutine
        self.work: Any = None  # the asyncio task, or the thread
        self.value: Any = None
        self.error: BaseException | None = None
        self.over = False
        self.asks = 0  # calls of the plan that it awaits in turn
        self.called_off = False  # its task does not wait for the outcome any more


SERVED: ContextVar[Operation | None] = ContextVar("served", default=None)  # the one that a coroutine is of


class Outside:
    """What goes on outside one interpreter, and how its tasks hear of it."""

    def __init__(self, session: Interpreter) -> None:
        self.session = session
        self.scheduler = session.scheduler
        self.guest = Guest(session)
        self.operations: dict[Operation, None] = {}  # that a task waits for
        self.left: list[Operation] = []  # blocking calls that were left alone
        self._runner: Runner | None = None  # of our own loop
        self._resting: AbstractEventLoop | None = None  # our own loop, while the driver rests in it
        self._rounds = 0
        self._rest_plainly = self.scheduler.rest
        self.scheduler.rest = self.rest
        self.scheduler.rouse = self.rouse

    # --- operations --------------------------------------------------------------

    def await_coroutine(self, coroutine: Any, name: str) -> Any:
        """What COROUTINE, of the primitive NAME, gives; the current task waits for it."""
        try:
            task = self.scheduler.at_work()
            operation = Operation(task, name, self._loop_for(task, name))
        except BaseException:
            coroutine.close()
            raise
        self._begin(operation, coroutine, name)
        return self._outcome(operation)

    def _begin(self, operation: Operation, coroutine: Any, name: str) -> None:
        """Let COROUTINE run in its loop; nothing that it raises is left to asyncio."""
        import asyncio

        async def follow() -> None:
            SERVED.set(operation)
            try:
                operation.value = await coroutine
            except BaseException as error:
                operation.error = error

        def end(work: Any) -> None:
            if work.cancelled():  # before it began
                operation.error = asyncio.CancelledError()
            coroutine.close()
            self._end(operation)

        operation.work = asyncio.Task(follow(), loop=operation.loop, name=f"eslang {name.lower()}")
        operation.work.add_done_callback(end)

    def await_blocking(self, function: Any, given: list[Any], keywords: dict[str, Any], name: str) -> Any:
        """What FUNCTION, of the primitive NAME, gives, run in a thread; the current task waits for it."""
        from threading import Thread

        operation = Operation(self.scheduler.at_work(), name)

        def work() -> None:
            try:
                operation.value = function(*given, **keywords)
            except BaseException as error:
                operation.error = error
            self._end(operation)

        begin = copy_context().run
        operation.work = Thread(target=begin, args=(work,), name=f"eslang {name.lower()}", daemon=True)
        operation.work.start()
        return self._outcome(operation)

    def _end(self, operation: Operation) -> None:
        """OPERATION has ended; its task is to know. Called in any thread."""
        operation.over = True
        if not self.session.closed:
            self.scheduler.post(lambda: self.scheduler.end_wait(operation.wait, None))

    def _outcome(self, operation: Operation) -> Any:
        """Wait for OPERATION, in the current task; what it gives, or raises."""
        self.operations[operation] = None
        self.scheduler.outside += 1
        try:
            self.scheduler.wait(operation.wait)
        except BaseException:
            self._call_off(operation)
            raise
        finally:
            self.scheduler.outside -= not operation.asks
            del self.operations[operation]
        if operation.loop is None:
            operation.work.join()  # it has nothing left to do
        error, operation.error = operation.error, None
        if error is None:
            return operation.value
        try:
            raise python_failure(error) if is_call_off(error) else error
        finally:
            del error  # which knows this frame

    def _call_off(self, operation: Operation) -> None:
        """The current task leaves OPERATION: call it off and wait for its end, if that can be done."""
        operation.called_off = True
        if operation.loop is None:
            self.left = [each for each in (*self.left, operation) if each.work.is_alive()]
            return
        if operation.over:
            return
        operation.work.cancel()
        task = operation.wait.task
        operation.wait = Wait(task, "outside", operation.wait.of)
        task.dynamic.held += 1
        try:
            self.scheduler.wait(operation.wait)
        finally:
            task.dynamic.held -= 1
        if operation.error is not None and not is_call_off(operation.error):
            self._tell(operation.error)

    def _tell(self, error: BaseException) -> None:
        """Tell of ERROR, which a coroutine raised when it was called off, as of a cleanup's failure."""
        if isinstance(error, Failure):
            enter(error)
        failure = error if isinstance(error, Failure) else python_failure(error)
        self.session.hooks.tell("failure", None, failure=failure)

    def note_call(self) -> Callable[[], None]:
        """A coroutine calls the plan; what is to be called when that has ended.

        If the plan awaits that coroutine, it is not the outside that time waits for meanwhile.
        """
        operation = SERVED.get()
        if operation is None or operation not in self.operations:
            return lambda: None

        def count(calls: int) -> None:
            before, operation.asks = operation.asks, operation.asks + calls
            if operation in self.operations:
                self.scheduler.outside += (not operation.asks) - (not before)

        count(1)
        return lambda: count(-1)

    # --- loops -------------------------------------------------------------------

    def _loop_for(self, task: Task, name: str) -> AbstractEventLoop:
        """The loop in which a coroutine that TASK is to wait for can run."""
        running = running_loop()
        if running is None:
            return self._own_loop()
        if list(task.ancestors())[-1] is self.session.runs.root:
            raise control_error(
                f"the primitive {name.lower()} is an `async def`: "
                "inside a running asyncio loop, `await` a `call_async` instead of a plain call"
            )
        self.attach(running)
        return running

    def _own_loop(self) -> AbstractEventLoop:
        """Our own loop, made when first wanted."""
        if self._runner is None:
            import asyncio

            self._runner = asyncio.Runner(loop_factory=asyncio.new_event_loop)
            self.scheduler.between = self._look_at_own_loop
        return self._runner.get_loop()

    def is_own(self, loop: AbstractEventLoop) -> bool:
        """True if LOOP is our own."""
        return self._runner is not None and loop is self._runner.get_loop()

    def attach(self, loop: AbstractEventLoop) -> None:
        """Let the tasks have their turns within LOOP, which runs."""
        if self.is_own(loop):
            return
        if any(map(self._is_own_operation, self.operations)):
            raise control_error("coroutines of an earlier call are under way outside this asyncio loop")
        self.guest.attach(loop)
        self._end_the_lost()

    def at_call(self) -> Guest:
        """The guest in the loop that runs, for a call from a coroutine. Refused where that cannot be."""
        from asyncio import get_running_loop

        loop, session = get_running_loop(), self.session
        if session.closed:
            raise Failure("interpreter-closed")
        if not session.runs.gate.is_closed():
            session.runs.check_outside()
        elif session.scheduler.current is not None or not self.is_own(loop):
            raise control_error(session.runs.obstacle())
        self.attach(loop)
        return self.guest

    def check_plain(self) -> None:
        """Refuse a plain call that waits for all tasks, if some wait for the very loop that it holds up."""
        loop = running_loop()
        if loop is not None and any(operation.loop is loop for operation in self.operations):
            raise control_error(
                "tasks await coroutines of this asyncio loop: `await` a `finish_async` instead"
            )

    def offer_turns(self) -> None:
        """Let tasks that a call leaves alive go on in the asyncio loop that runs, if there is one."""
        loop = running_loop()
        if loop is not None and not any(map(self._is_own_operation, self.operations)):
            self.attach(loop)
            self.guest.rouse()

    def _is_own_operation(self, operation: Operation) -> bool:
        return operation.loop is not None and self.is_own(operation.loop)

    # --- resting -----------------------------------------------------------------

    def rest(self, seconds: float | None) -> None:
        """Sleep until something is posted, or for SECONDS; coroutines go on in our own loop."""
        if self._end_the_lost(blocked=True):
            return
        scheduler, loop = self.scheduler, None
        if self.operations and not scheduler.is_open and not any(map(self._can_end, self.operations)):
            moment = scheduler.timers.next_moment()
            if moment is None:
                scheduler.end_deadlock()
                return
            if self.session.clock.is_virtual:
                self.session.clock.advance(moment)
                return
        if self._runner is not None and running_loop() is None:
            loop = self._runner.get_loop()
        if loop is None:
            self._rest_plainly(seconds)
        else:
            self._rest_in(loop, seconds)

    def _rest_in(self, loop: AbstractEventLoop, seconds: float | None) -> None:
        """Run LOOP, our own, until something is posted, or for SECONDS."""
        alarm = None if seconds is None else loop.call_later(seconds, loop.stop)
        self._resting = loop
        try:
            if self.scheduler.posted.empty() and self.session.ticks.pending is None:
                loop.run_forever()
        finally:
            self._resting = None
            if alarm is not None:
                alarm.cancel()

    def _look_at_own_loop(self) -> None:
        """Let coroutines go on although tasks are at work."""
        self._rounds += 1
        if self._rounds % EVERY == 0 and self._runner is not None and running_loop() is None:
            loop = self._runner.get_loop()
            loop.call_soon(loop.stop)
            loop.run_forever()

    def _can_end(self, operation: Operation) -> bool:
        """True if OPERATION may end while a plain call goes on."""
        return operation.loop is None or (self.is_own(operation.loop) and running_loop() is None)

    def _end_the_lost(self, blocked: bool = False) -> bool:
        """End the waits for coroutines whose loop was closed; true if there are any.

        The same for those that were called off, if a plain call has BLOCKED their loop.
        """
        found = False
        for operation in self.operations:
            if operation.over or operation.loop is None:
                continue
            closed = operation.loop.is_closed()
            if closed or (blocked and operation.called_off and not self._can_end(operation)):
                if closed:
                    operation.error = RuntimeError("the asyncio loop of this coroutine was closed")
                operation.over = found = True
                self.scheduler.end_wait(operation.wait, None)
        return found

    def rouse(self) -> None:
        """Something was posted: let whoever rests look at it. Called in any thread."""
        loop = self._resting
        if loop is None:
            self.guest.rouse()
        else:
            call_soon(loop, loop.stop)

    # --- the end -----------------------------------------------------------------

    def close(self) -> None:
        """Wait for the blocking calls that were left alone, and close our own loop."""
        self.guest.leave()
        for operation in self.left:
            operation.work.join()
        self.left.clear()
        if self._runner is not None:
            runner, self._runner = self._runner, None
            self.scheduler.between = None
            if running_loop() is None:
                end_loop(runner)
            else:
                call_elsewhere(lambda: end_loop(runner))


def end_loop(runner: Runner) -> None:
    """Close the loop of RUNNER; what should stop it, and came too late for that, is not to stop its end."""
    loop = runner.get_loop()
    loop.call_soon(loop.stop)
    loop.run_forever()
    runner.close()


def is_call_off(error: BaseException) -> bool:
    """True if ERROR says that a coroutine was cancelled."""
    from asyncio import CancelledError

    return isinstance(error, CancelledError)


def call_elsewhere(function: Callable[[], object]) -> None:
    """Call FUNCTION where no asyncio loop runs."""
    from threading import Thread

    worker = Thread(target=function)
    worker.start()
    worker.join()
