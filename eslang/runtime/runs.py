"""Runs: what is entered from outside, and how it ends.

A call from Python, a file that is loaded, a form at the prompt is a root: a
task on the stack of its caller, which the run waits for. What is spawned at
top level belongs to the run, and is there when other roots come and go.
"""

from __future__ import annotations

from eslang.base.control import EndTask, Stop
from eslang.base.failure import Failure, control_error
from eslang.base.hints import TYPE_CHECKING, Any, Callable
from eslang.base.symbols import Keyword, Value
from eslang.runtime import failures
from eslang.runtime.gate import Gate, stack_here
from eslang.runtime.lives import passed_on
from eslang.runtime.scheduler import Scheduler
from eslang.runtime.tasks import ABORTED, FAILED, SUCCEEDED, Interrupt, StandStill, Task
from eslang.runtime.timers import Timers

if TYPE_CHECKING:
    from eslang.runtime.choices import Choices


class Runs:
    """The entrances of one interpreter, and what belongs to its run."""

    def __init__(self, session: Any, *, shuffled: bool, choices: Any = None, is_open: bool) -> None:
        self.session = session
        self.choices: Choices | None = None
        if shuffled or choices is not None:
            from eslang.runtime.choices import make_choices

            self.choices = make_choices(session, shuffled, choices)
        self.scheduler = Scheduler(session, self.choices)
        self.scheduler.end_deadlock = self.end_deadlock
        self.scheduler.end_run = self.stop
        self.lives = self.scheduler.lives
        self.scheduler.is_open = is_open
        self.root: Task | None = None
        self.stopped: Stop | None = None  # what the run is to end with, once all has been aborted
        self.gate = Gate()
        self.errands: dict[Any, bool] = {}  # what other threads left to be done (visits.py)
        self._stack: Any = None  # that of the root

    def run(self, body: Callable[[], Value]) -> Value:
        """Run BODY to its end, as a root or within the task that calls. Raises Failure, Stop."""
        return self.enter(lambda: failures.run_apart(body))

    def enter(self, body: Callable[[], Any], name: str = "main") -> Any:
        """The same; BODY itself sees to what is to be run apart."""
        if self.is_inside():
            return body()
        self.begin()
        try:
            return self._as_root(body, name)
        finally:
            self.leave()

    def _as_root(self, body: Callable[[], Any], name: str) -> Any:
        """What BODY gives, run as a root. What was posted before it begins is done before."""
        scheduler = self.scheduler
        came = not scheduler.posted.empty()
        if came:
            scheduler.take_posts()
        self._stack = stack_here()
        root = self.root = self.lives.create(name, body)
        self.lives.count += 1
        root.is_root = root.seen = True
        scheduler.enter(root)
        scheduler.polls.looked = -1  # it may change what others wait for
        self.lives.tell("task-started", about=root, parent=None, role="main", daemon=False)
        status: Keyword = ABORTED
        try:
            if came:
                scheduler.yield_turn(root)
            result = body()
            if scheduler.settle is not None:
                failures.run_apart(self.settle)
            status = SUCCEEDED
            return result
        except Failure as failure:
            root.failure, status = failure, FAILED
            raise
        except EndTask:
            raise self.aborted() from None
        finally:
            self._leave(root, status)

    def aborted(self) -> Failure:
        """What a call that one of its tasks has aborted fails with."""
        failure = Failure(ABORTED)
        self.session.hooks.tell("aborted", None, failure=failure)
        return failure

    def _leave(self, root: Task, status: Keyword) -> None:
        """ROOT has ended; nothing is on a task's stack any more."""
        self.root = None
        self.lives.end(root, status)
        self.scheduler.calm_down()
        if self.scheduler.settle is not None:
            self.scheduler.settle()

    def is_inside(self) -> bool:
        """True if the stack at hand is that of a task of this interpreter, whose turn it is."""
        current = self.scheduler.current
        if current is None or not self.gate.is_here():
            return False
        return stack_here() is self._stack if current is self.root else self.scheduler.is_on_stack(current)

    def begin(self) -> None:
        """Let the stack at hand be where this is at work, until the gate is opened."""
        gate = self.gate
        if not gate.close():
            raise control_error(self.obstacle())
        if gate.is_here():
            return
        if gate.is_homeless():
            self._forget_all()
        elif self.lives.count:
            self.leave()
            raise control_error(
                "the tasks of this interpreter live in another thread; signal them from there"
            )
        gate.move_here()
        self.scheduler.driver = None
        self.lives.forget_spare()

    def leave(self) -> None:
        """Nothing is at work any more: open the gate, and do what other threads left to be done."""
        self.gate.open()
        self.do_errands()

    def do_errands(self) -> None:
        """Do what other threads left to be done, if nothing is at work: who is will do it."""
        if self.errands:
            from eslang.runtime.visits import serve

            serve(self)

    def alone(self, action: Callable[[], object]) -> None:
        """Do ACTION, which changes tasks from outside of any, while there is no visitor."""
        entered = not self.gate.is_ours() and self.gate.let_in(patient=True)
        try:
            action()
        finally:
            if entered:
                self.gate.let_out()
                self.do_errands()

    def _forget_all(self) -> None:
        """Forget the tasks: their stacks have gone with their thread."""
        from eslang.runtime.deadlock import family

        for task in family(self.lives.tops):
            task.status = ABORTED
        self.lives.tops.clear()
        self.lives.count = self.scheduler.outside = 0
        self.scheduler.ready.clear()
        self.scheduler.polls.waits.clear()
        self.scheduler.timers = Timers()

    def check_outside(self) -> None:
        """Refuse what cannot be done from within, nor in another thread than that of the tasks."""
        self.begin()
        self.leave()

    def obstacle(self) -> str:
        """Why this cannot be entered, now that it is at work."""
        if self.gate.is_ours() and not self.gate.is_closed():
            return "facts are being changed or asked; what is told of that cannot call this interpreter"
        if not self.gate.is_here():
            return "this interpreter is at work in another thread; signal it from there"
        if self.is_inside():
            return "this cannot be done from within a task of the interpreter"
        if self.scheduler.current is None:
            return (
                "this interpreter waits in a call; only `call_async`, in a coroutine, can call it meanwhile"
            )
        return "this interpreter waits for another one, which cannot call it"

    # --- ends --------------------------------------------------------------------

    def finish(self) -> None:
        """Let the run end: wait for what was spawned, and abort the daemons. Raises a failure nobody saw."""
        self.check_outside()
        self.drive_until(lambda: all(task.daemon for task in self.lives.tops))
        self.abort_all()
        self.settle()
        self.raise_unseen()

    def settle(self) -> None:
        """Let what was changed be kept. Raises Failure if it cannot be."""
        settle = self.scheduler.settle
        trouble = settle() if settle is not None else None
        if trouble is not None:
            raise trouble

    def raise_unseen(self) -> None:
        """Raise a failure of the run's own tasks that nobody has looked at."""
        unseen, self.lives.unseen = self.lives.unseen, ()
        for task in unseen:
            if not task.seen:
                raise passed_on(task)

    def abort_all(self) -> None:
        """Abort all that belongs to the run, and wait until it has ended."""
        self.abort_tops()
        self.drive_until(lambda: not self.lives.tops)

    def abort_tops(self) -> None:
        """Abort all that belongs to the run."""

        def abort() -> None:
            for task in list(self.lives.tops):
                self.lives.abort(task, "run")

        self.alone(abort)

    def let_go(self) -> None:
        """Let go of what is kept for tasks to come: nothing comes any more."""
        self.lives.drop_spare()
        while not self.scheduler.posted.empty():
            self.scheduler.posted.get()
        self.do_errands()

    def drive_until(self, done: Callable[[], bool]) -> None:
        """Let tasks run, outside of any, until DONE. Raises Stop if they were stopped, and have all ended."""

        def is_over() -> bool:
            return done() if self.stopped is None else not self.lives.tops

        if not is_over():
            self.begin()
            try:
                self.scheduler.drive(done=is_over)
            finally:
                self.scheduler.calm_down()
                self.leave()
        if self.stopped is not None:
            stop, self.stopped = self.stopped, None
            self.lives.unseen = ()
            raise stop

    def stop(self, stop: Stop) -> None:
        """Let the root end with STOP; where there is none, all that belongs to the run."""
        root, scheduler = self.root, self.scheduler
        if root is not None:
            root.ending = stop
            scheduler.make_ready(root)
            if root.queued:  # its turn is the next: the others might not come to the end of theirs
                scheduler.ready.remove(root)
                scheduler.ready.appendleft(root)
        else:
            self.stopped = stop
            self.abort_tops()

    def end_deadlock(self) -> None:
        """Nothing can wake anything: the task that the run waits for fails with :deadlock."""
        from eslang.runtime.deadlock import deadlock, family, whom_to_tell

        roots = [*([self.root] if self.root is not None else []), *self.lives.tops]
        failure = deadlock(family(roots))
        task = whom_to_tell(next((each for each in roots if not each.daemon), roots[0]))
        self.lives.tell("deadlock", failure=failure, waiting=failure.report.waiting, to=task)

        def fail() -> None:
            failures.signal(failure, continuable=False)

        self.scheduler.interrupt(task, Interrupt("deadlock", fail, StandStill(task), urgent=True))
