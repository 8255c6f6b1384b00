"""The scheduler: whose turn it is.

One task runs at a time, on its own stack, until it waits, its time slice is
over, or it ends. The ready take turns first in, first out, or as somebody
chooses. Whoever waits hands over to the next that is ready; when
there is none, the driver has the word: the stack from which the interpreter
was entered. It sees to timers and to what comes from outside, and begins new
tasks, whose stacks would else stand on one another. A task that runs on the
driver's stack, because it was called from Python, drives while it waits.

The order is a matter of the program, its inputs and the seed alone.
"""

from __future__ import annotations

from _collections import deque  # type: ignore[import-not-found]  # without the rest of collections
from _queue import SimpleQueue

from eslang.base.calls import depth
from eslang.base.control import Stop
from eslang.base.failure import Failure, control_error
from eslang.base.hints import TYPE_CHECKING, Any, Callable, Iterable, Sequence
from eslang.base.stack import require_room
from eslang.runtime import failures
from eslang.runtime.bindings import Bindings
from eslang.runtime.events import Arguments, Event, Wait
from eslang.runtime.idling import idle, rest
from eslang.runtime.lives import Lives
from eslang.runtime.polls import CONDITION, Polls
from eslang.runtime.story import place_here
from eslang.runtime.tasks import Interrupt, Task
from eslang.runtime.ticks import Ticks
from eslang.runtime.timers import Timer, Timers

if TYPE_CHECKING:
    from greenlet import greenlet as Stack

TURNS = 64  # hand-overs from task to task before the driver looks at clock and posts


class Scheduler:
    """Whose turn it is among the tasks of one interpreter."""

    def __init__(self, session: Any, choose: Callable[[Sequence[Task]], int] | None = None) -> None:
        self.session = session
        self.bindings: Bindings = session.bindings
        self.choose = choose  # which of the ready is next; None: the first
        self.current: Task | None = None
        self.ready: deque[Task] = deque()
        self.timers = Timers()
        self.posted: SimpleQueue[Callable[[], None]] = SimpleQueue()
        self.driver: Stack | None = None
        self.granted = 0  # how many turns were given out, those to come among them
        self.turns = 0  # how many may go from task to task before the driver is to look at clock and posts
        self.polls = Polls(self)
        self.outside = 0  # operations that go on outside, and will end a wait
        self.is_open = False  # anything may come from outside
        self.end_deadlock: Callable[[], None] = lambda: None
        self.end_run: Callable[[Stop], None] = lambda stop: None
        self.rest: Callable[[float | None], None] = lambda seconds: rest(self, seconds)
        self.between: Callable[[], None] | None = None  # what else the driver sees to, between two rounds
        self.settle: Callable[[], Failure | None] | None = None  # keeps what a step has changed, at its end
        self.rouse: Callable[[], None] | None = None  # what tells whoever rests that something was posted
        self.stirs = 0  # how often something came about that a circuit is to look at
        self.lives = Lives(self)
        self.ticks = Ticks(self.safepoint)
        self.calm = session.dynamic  # what is on no task's stack
        self.calm_source = self.ticks.source

    @property
    def steps(self) -> int:
        """How many steps were made: each turn of a task is one."""
        return self.granted - self.turns

    # --- turns -----------------------------------------------------------------

    def make_ready(self, task: Task) -> None:
        """Let TASK have a turn."""
        if not task.queued and task is not self.current and task.status is None:
            task.queued = True
            self.ready.append(task)

    def pause(self, task: Task) -> None:
        """Let others have their turns, until it is that of TASK, the current one, again; all switch here."""
        if self.bindings.hidden is not None or depth[0]:
            self._take_off(task)
        ready = self.ready
        if task.switch is None:
            self._drive_for(task)
        elif self.turns and ready and (switch := ready[0].switch) is not None:
            self.turns -= 1
            ready.popleft()
            switch()  # to another task's stack, or to the one at hand
        else:
            self.current = None
            try:
                self.driver.switch()  # type: ignore[union-attr]
            finally:  # the stack may be full
                self.current = task
        self.current = task  # as `enter` does, which would be one call more
        task.queued = False
        self.session.dynamic = task.dynamic
        self.ticks.source = task.source
        if task.kept is not None:
            self._put_on(task)

    def enter(self, task: Task) -> None:
        """Put in force what belongs to TASK, whose turn it is."""
        self.current = task
        task.queued = False
        self.session.dynamic = task.dynamic
        self.ticks.source = task.source
        if task.kept is not None:
            self._put_on(task)

    def _take_off(self, task: Task) -> None:
        """Let none of the dynamic bindings of TASK, and of its calls through C, be in force."""
        require_room()
        task.kept = self.bindings.take_off(), depth[0]
        depth[0] = 0

    def _put_on(self, task: Task) -> None:
        """Put them in force again."""
        bindings, depth[0] = task.kept  # type: ignore[misc]
        task.kept = None
        self.bindings.put_on(bindings)

    def _drive_for(self, task: Task) -> None:
        """Drive until it is the turn of TASK, which runs on the driver's stack."""
        require_room()
        self.current = None
        try:
            self.drive(task)
        except BaseException:  # what no task could answer
            self.enter(task)
            raise

    def drive(self, task: Task | None = None, done: Callable[[], bool] | None = None) -> None:
        """Give out turns until it is that of TASK, which runs on this stack, or DONE says so."""
        if self.driver is None:
            self._take_the_wheel(task)
        ready, posted, timers = self.ready, self.posted, self.timers
        if self.settle is not None:
            self.settle()
        if self.polls.waits:
            self.polls.look_again()
        while done is None or not done():
            if not posted.empty():
                self.take_posts()
            if self.ticks.pending is not None:
                self.stop_run()
            if self.between is not None:
                self.between()
            if timers.heap and timers.fire(self.session.clock.now()):
                continue
            if not ready:
                idle(self)
                continue
            turns = 0 if self.choose is not None or self.polls.waits else TURNS
            self.granted += 1 + turns - self.turns
            self.turns = turns
            other = ready.popleft() if self.choose is None or len(ready) == 1 else self._pick(self.choose)
            if other is task:
                return
            self.lives.step(other)
            if self.settle is not None:
                self.settle()
            if self.polls.waits:
                self.polls.look_again()

    def _take_the_wheel(self, task: Task | None) -> None:
        from greenlet import getcurrent

        self.driver = getcurrent()
        if task is not None:
            task.stack = self.driver

    def calm_down(self) -> None:
        """Nothing is on a task's stack any more."""
        self.current = None
        self.driver = None
        self.session.dynamic = self.calm
        self.ticks.source = self.calm_source

    def is_on_stack(self, task: Task) -> bool:
        """True if the stack at hand is that of TASK."""
        if self.driver is None:
            return True
        from greenlet import getcurrent

        return getcurrent() is task.stack

    def _pick(self, choose: Callable[[Sequence[Task]], int]) -> Task:
        """Take the one of the ready that CHOOSE says."""
        index = choose(self.ready)
        task: Task = self.ready[index]
        del self.ready[index]
        return task

    def hand_back(self) -> None:
        """Let the driver have its turn next: it looks at clock, posts and conditions."""
        self.granted, self.turns = self.granted - self.turns, 0

    def safepoint(self) -> None:
        """A time slice is over: let others have their turn, and take what came for the current task."""
        task = self.current
        if task is None:
            stop = self.ticks.take()
            if stop is not None:
                raise stop
            return
        task.source = self.ticks.source
        self.session.clock.use_slice()
        if self.ticks.pending is not None:
            stop = self.stop_run()
            if task.dynamic.masked:
                task.ending = stop
        self.hand_back()
        if self.settle is not None and not task.dynamic.masked:
            self.settle()
        if not task.dynamic.masked and (
            self.ready or self.polls.waits or self.timers or self.between or not self.posted.empty()
        ):
            self.yield_turn(task)
        else:
            self.attend(task)

    def yield_turn(self, task: Task) -> None:
        """Let the others that are ready have their turns before TASK, the current one, goes on."""
        if self.polls.waits:
            self.polls.look_again()
        task.queued = True
        self.ready.append(task)
        self.pause(task)
        if task.interrupts or task.ending is not None:
            self.attend(task)

    def at_work(self) -> Task:
        """The current task. Fails with :control-error where there is none that could wait."""
        if self.current is None:
            raise control_error("nothing can wait here: no task is running")
        return self.current

    # --- waits -----------------------------------------------------------------

    def wait(self, wait: Wait) -> Any:
        """Wait until WAIT, the current task's, is over; its result."""
        task = wait.task
        outer, task.wait, again = task.wait, wait, False
        hooks = self.session.hooks
        try:
            if hooks.listeners:
                hooks.tell("wait", place_here(), on=wait.kind, of=wait.of)
            while True:
                if task.interrupts or task.ending is not None:
                    again = not self.attend(task) and again
                if wait.done or (wait.test is not None and self.considers(wait, again)):
                    return wait.result
                self.pause(task)
                again = True
        finally:
            task.wait = outer
            if not wait.done:
                wait.withdraw()
            if hooks.listeners:
                hooks.tell("resume", on=wait.kind, of=wait.of, how=wait.how)

    def wait_for(self, event: Event) -> Arguments:
        """Wait until EVENT is signalled; what came with the signal. It is the commonest of waits."""
        task = self.current or self.at_work()
        wait = task.spare
        if wait is None:
            wait = Wait(task, "events", (event,), (event,))
        else:
            wait.again(event)
        task.spare = None
        arguments: Arguments = self.wait(wait)
        task.spare = wait
        return arguments

    def signal(self, event: Event, arguments: Arguments) -> Iterable[Wait]:
        """Signal EVENT: end all waits for it, and let their tasks go on; those waits."""
        wait = event.waits
        if wait is None:
            return ()
        if not isinstance(wait, Wait) or not wait.plain:
            waits = event.signal(arguments)
            self.wake(waits)
            return waits
        task = wait.task  # the rest is the same for one plain wait, in a third of the time
        if task.wait is wait and not task.queued and task is not self.current:
            self.ready.append(task)  # first, since the stack may be full
            task.queued = True
        event.waits = None
        wait.done = True
        wait.result = arguments
        return (wait,)

    def attend(self, task: Task) -> bool:
        """Do what interrupts ask of TASK, the current one, if nothing holds them off; true if any did."""
        obeyed = False
        while task.interrupts or task.ending is not None:
            if task.ending is not None and task.may_end():
                raise task.ending
            interrupt = task.next_interrupt()
            if interrupt is None:
                break
            obeyed = True
            self.lives.obey(task, interrupt)
        return obeyed

    def wake(self, waits: Iterable[Wait]) -> None:
        """Make the tasks of WAITS ready, in their order."""
        for wait in waits:
            task = wait.task
            if task.wait is wait and not task.queued and task is not self.current:
                self.ready.append(task)
                task.queued = True

    def considers(self, wait: Wait, again: bool) -> bool:
        """Ask the test of WAIT, in its task; true if that ends it. A condition is looked at AGAIN later."""
        if wait.kind != CONDITION:
            return wait.consider()
        touched = self.session.touched
        if failures.guarded(wait.test) is not None:  # type: ignore[arg-type]
            wait.end(True)
        elif not wait.done:
            wait.outside = self.session.touched != touched
            if wait.polls:
                self.polls.add(wait, again)
        return wait.done

    def sleep(self, seconds: float, kind: str = "sleep") -> None:
        """Let the current task wait until SECONDS have passed."""
        task = self.at_work()
        wait = Wait(task, kind, seconds)
        timer = self.set_timer(seconds, lambda: self.end_wait(wait, None))
        try:
            self.wait(wait)
        finally:
            self.timers.call_off(timer)

    def end_wait(self, wait: Wait, result: Any) -> None:
        """End WAIT with RESULT, and wake its task."""
        if not wait.done:
            wait.end(result)
            self.wake([wait])

    def set_timer(self, seconds: float, action: Callable[[], None]) -> Timer:
        """Let ACTION happen in SECONDS from now."""
        return self.timers.set(self.session.clock.now() + seconds, action)

    # --- interrupts ------------------------------------------------------------

    def interrupt(self, task: Task, interrupt: Interrupt) -> None:
        """Let TASK do what INTERRUPT says, where it stands, at its next step."""
        if task.status is None:
            interrupt.by = interrupt.by or self.current
            if self.session.hooks.listeners:
                self.lives.tell("interrupt-sent", to=task, why=interrupt.kind, by=interrupt.by)
            if task.interrupts:
                task.interrupts.append(interrupt)
            else:
                task.interrupts = [interrupt]
            self.make_ready(task)

    # --- what comes from outside -------------------------------------------------

    def post(self, action: Callable[[], None]) -> None:
        """Let ACTION happen between two steps, soon; safe from any thread and from signal handlers."""
        self.posted.put(action)
        if self.rouse is not None:
            self.rouse()

    def take_posts(self) -> None:
        """Do what was posted."""
        while not self.posted.empty():
            self.posted.get()()
        self.polls.look_at_once()

    def stop_run(self) -> Stop | None:
        """See to a pending stop: the run is to end with it."""
        stop = self.ticks.take()
        if stop is not None:
            self.lives.tell("run-stopped", reason=stop.reason, code=stop.code)
            self.end_run(stop)
        return stop
