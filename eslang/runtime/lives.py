"""The lives of tasks: how they begin, what interrupts them, how they end.

A task has a stack of its own, a greenlet. Stacks are dear to make, so that of
a task that has ended serves the next. A task ends after all that it has
spawned; what is then known of it stays: status, values, failure, checkpoints.
"""

from __future__ import annotations

import sys
from _weakref import ref

from eslang.base.control import EndTask, Failed, Stop, Unwind
from eslang.base.failure import STACK_EXHAUSTED, Failure, control_error
from eslang.base.hints import TYPE_CHECKING, Any, Callable
from eslang.base.running import running
from eslang.base.symbols import Keyword, Value
from eslang.runtime import failures
from eslang.runtime.events import Event, Wait
from eslang.runtime.story import place_here
from eslang.runtime.tasks import ABORTED, ANYWHERE, FAILED, SUCCEEDED, Interrupt, Task

if TYPE_CHECKING:
    from greenlet import greenlet as Stack

    from eslang.runtime.scheduler import Scheduler

SPARE = 64  # stacks that are kept for tasks to come
NESTED = 20_000  # tasks inside one another; it is found out now and then only, and before memory is used up
OBEYING = 500  # interrupts of one task inside one another: the ends of time slices use the stack of C
UNSEEN = 16  # failed tasks that an owner remembers until somebody looks at them
SPAWNED = "spawned"  # the role of a task that outlives the form that it stands in
LEAVING = "leaving"  # the kind of a wait for the end of one that was aborted, which nothing cuts short


class Lives:
    """The tasks of one scheduler that are alive."""

    def __init__(self, scheduler: Scheduler) -> None:
        self.scheduler = scheduler
        self.session = scheduler.session
        self.tops: dict[Task, None] = {}  # those that belong to the run, not to another task
        self.count = 0  # how many are alive
        self.crash: BaseException | None = None  # what no task could answer
        self.unseen: tuple[Task, ...] = ()  # those of the run's own that failed while nobody looked
        self.recent: Any = None  # where those that have ended are noted, if anybody wants to know
        self._names: dict[str, int] = {}
        self._spare: list[Stack] = []
        self._make_stack: Callable[[], Stack] | None = None
        self._next: Task | None = None  # the one that is to begin

    # --- beginning -------------------------------------------------------------

    def create(
        self,
        name: str,
        body: Callable[[], Value],
        parent: Task | None = None,
        on_end: Callable[[Task], None] | None = None,
    ) -> Task:
        """A new task. Fails with :stack-exhausted if tasks stand too deep inside one another."""
        if self.count >= NESTED and not self.count & 1023 and parent is not None and parent.is_deep(NESTED):
            raise Failure(STACK_EXHAUSTED)
        known = self._names.get(name, 0) + 1
        self._names[name] = known
        task = Task(name if known == 1 else f"{name}.{known}", body, parent)
        task.on_end = on_end
        task.source = self.scheduler.ticks.make()
        variables = sys.modules.get("_contextvars")
        if variables is not None:  # Python's, for the primitives
            task.surroundings = variables.copy_context()
        return task

    def start(self, task: Task, role: str) -> None:
        """Let TASK, which belongs to its parent or else to the run, have its first turn.

        It begins with the dynamic bindings of the current task. What is
        spawned outlives the form that it stands in, and so is in no circuit.
        """
        logical = self.session.dynamic.logical
        task.dynamic.logical = logical.outside_circuits() if role == SPAWNED else logical
        if self.session.bindings.hidden is not None:
            task.kept = self.session.bindings.copy(), 0
        owner = task.parent
        self.count += 1
        if owner is None:
            self.tops[task] = None
        elif owner.children is None:
            owner.children = {task: None}
        else:
            owner.children[task] = None
        if self.session.hooks.listeners:
            self.tell("task-started", about=task, parent=owner, role=role, daemon=task.daemon)
        self.scheduler.make_ready(task)
        if task.ending is not None and task.status is None:
            self._end_unborn(task)

    def step(self, task: Task) -> None:
        """Let TASK have its turn, from the driver."""
        if task.status is not None:
            return
        if task.stack is None:
            self._next = task
            task.stack = self._spare.pop() if self._spare else self._stack()
            task.switch = task.stack.switch
            if task.surroundings is not None:
                task.stack.gr_context = task.surroundings
        task.stack.switch()
        if self.crash is not None:
            crash, self.crash = self.crash, None
            raise crash

    def _stack(self) -> Stack:
        if self._make_stack is None:
            self._make_stack = maker_of_stacks(ref(self))
        return self._make_stack()

    def serve(self) -> bool:
        """Let the task that is to begin live on the stack at hand; true if that is kept afterwards."""
        task, self._next = self._next, None
        if task is None:
            return False
        stack: Any = task.stack
        self._live(task)
        stack.parent = self.scheduler.driver
        if len(self._spare) >= SPARE:
            return False
        self._spare.append(stack)
        return True

    def forget_spare(self) -> None:
        """Forget the stacks that are kept: they belong to a thread that is gone."""
        self._spare.clear()

    def drop_spare(self) -> None:
        """Let the stacks go that are kept for tasks to come."""
        if not self._spare:
            return
        from greenlet import getcurrent

        for stack in self._spare:
            stack.parent = getcurrent()
            stack.throw()
        self._spare.clear()

    # --- living ----------------------------------------------------------------

    def _live(self, task: Task) -> None:
        """Run the body of TASK to its end, whatever that is."""
        self.scheduler.enter(task)
        status = ABORTED
        try:
            task.values = self._with_children(task)
            status = SUCCEEDED
        except Failed as jump:
            task.failure, status = jump.value, FAILED
        except Stop as stop:
            if stop is not task.ending:
                self.scheduler.end_run(stop)
        except EndTask:
            pass
        except Unwind:
            task.failure, status = self._lost(), FAILED
        except BaseException as crash:
            self._pass_on_crash(task, crash)
        self.end(task, status)

    def _pass_on_crash(self, task: Task, crash: BaseException) -> None:
        """What Python raised to leave everything goes on in the owner of TASK; else in the driver."""

        def leave() -> None:
            raise crash

        if task.parent is None:
            self.crash = crash
        else:
            self.scheduler.interrupt(task.parent, Interrupt("crash", leave, level=ANYWHERE, urgent=True))

    def _with_children(self, task: Task) -> Value:
        """The values of the body of TASK, once all that it has spawned has ended."""
        assert task.body is not None
        try:
            if task.interrupts or task.ending is not None:
                self.scheduler.attend(task)
            values = failures.guarded(task.body)
            if task.children or task.unseen:
                self._await_children(task)
            return values
        finally:
            if task.children:
                self.abort_all(task, list(task.children), "owner")

    def _await_children(self, task: Task) -> None:
        """Wait for those that TASK has spawned; then daemons are aborted. An unseen failure is TASK's own."""
        while task.children:
            children = [child for child in task.children if not child.daemon]
            if not children:
                children = list(task.children)
                for child in children:
                    self.abort(child, "owner")
            for child in children:
                self.await_end(task, child)
        for child in task.unseen:
            if not child.seen:
                failures.signal(passed_on(child), continuable=True)

    def _lost(self) -> Failure:
        """The failure of a task that was left by a jump whose target is in another."""
        failure = control_error("this jump leads out of the task that makes it")
        self.session.hooks.tell("failure", None, failure=failure)
        return failure

    def end(self, task: Task, status: Keyword) -> None:
        """TASK, the current one, has ended: wake who waits for that."""
        task.status = status
        if self.session.hooks.listeners:
            self.tell("task-ended", about=task, status=status, failure=task.failure)
        self.session.bindings.take_off()
        self.count -= 1
        if task in self.tops:
            del self.tops[task]
        elif task.parent is not None and task.parent.children is not None:
            task.parent.children.pop(task, None)
        if status is FAILED and not task.seen:
            self._note_unseen(task)
        if self.recent is not None and not task.is_root:
            self.recent.append(task)
        task.body = task.source = task.spare = None
        task.interrupts = ()
        task.stack = task.switch = task.ending = task.surroundings = None
        task.queued, task.unseen = False, ()
        self.scheduler.current = None
        if task.over is not None:
            self.scheduler.signal(task.over, ())
        if task.waits:
            self.scheduler.wake(task.signal(task.given()))
        if task.on_end is not None:
            on_end, task.on_end = task.on_end, None
            on_end(task)

    def _note_unseen(self, task: Task) -> None:
        """TASK has failed; its owner is to know, if nobody else looks at it. Of many, a few are enough."""
        owner: Lives | Task = task.parent if task.parent is not None else self
        owner.unseen = (*[other for other in owner.unseen if not other.seen], task)[:UNSEEN]

    # --- interrupting ------------------------------------------------------------

    def obey(self, task: Task, interrupt: Interrupt) -> None:
        """Do what INTERRUPT asks of TASK, the current one, on top of its stack."""
        if len(task.obeying) >= OBEYING:
            raise RecursionError("too many interrupts inside one another")
        hooks, left = self.session.hooks, True
        if hooks.listeners:
            self.tell("interrupt", why=interrupt.kind, by=interrupt.by)
        outer, task.obeying = task.obeying, (*task.obeying, interrupt)
        try:
            failures.guarded(interrupt.action)
            left = False
        except Unwind as jump:
            jump.failed = True  # what it leaves is cleaned up
            raise
        finally:
            task.obeying = outer
            if hooks.listeners:
                self.tell("interrupt-ended", why=interrupt.kind, left=left)

    def abort(self, task: Task, why: str, by: Task | None = None) -> None:
        """Let TASK leave everything, with its cleanups; once is enough. BY whom, and WHY, is told."""
        if task.status is not None or task.ending is not None:
            return
        self.tell("abort", of=task, why=why, by=by or self.scheduler.current)
        task.ending = EndTask(task)
        if task.stack is not None or task is self.scheduler.current or task.wait is not None:
            self.scheduler.make_ready(task)
        elif task.queued:
            self._end_unborn(task)

    def _end_unborn(self, task: Task) -> None:
        """End TASK, which has not begun."""
        scheduler = self.scheduler
        task.queued = False
        scheduler.ready.remove(task)
        current, kept = scheduler.current, self.session.bindings.take_off()
        self.end(task, ABORTED)
        scheduler.current = current
        self.session.bindings.put_on(kept)

    # --- waiting for ends --------------------------------------------------------

    def await_end(self, task: Task, other: Task, kind: str = "end") -> None:
        """Let TASK, the current one, wait until OTHER has ended."""
        if other.status is None:
            if other.over is None:
                other.over = Event()
            self.scheduler.wait(Wait(task, kind, other, (other.over,)))

    def abort_all(self, task: Task, others: list[Task], why: str) -> None:
        """Abort OTHERS, and let TASK, the current one, wait until they have ended; nothing holds it up."""
        for other in others:
            self.abort(other, why)
        crash: BaseException | None = None
        task.dynamic.held += 1
        try:
            for other in others:
                while other.status is None:
                    try:
                        self.await_end(task, other, LEAVING)
                    except BaseException as another:  # what Python raised to leave everything
                        crash = another
        finally:
            task.dynamic.held -= 1
        if crash is not None:
            raise crash

    def tell(self, kind: str, **told: Any) -> None:
        """Tell the listeners, if there are any, where the current task stands."""
        hooks = self.session.hooks
        if hooks.listeners:
            hooks.tell(kind, place_here() if self.scheduler.current is not None else None, **told)


def passed_on(task: Task) -> Failure:
    """The failure of TASK as it is to be signalled in another: it knows where it came from."""
    first = task.failure
    assert first is not None
    failure = Failure(first.cause, *first.arguments)
    failure.condition = first.condition
    failure.origin, failure.__cause__ = task, first.__cause__
    task.seen = True
    running.session.scheduler.lives.tell("failure-passed", failure=failure, of=task)
    return failure


def maker_of_stacks(lives: Callable[[], Lives | None]) -> Callable[[], Stack]:
    """What makes stacks for the tasks of LIVES, which it does not keep alive."""
    from greenlet import getcurrent, greenlet

    def serve() -> None:
        """Run tasks on this stack, one after the other, as long as it is kept.

        While it waits it holds nothing: what a stack holds, Python's collector of garbage cannot see.
        """
        while True:
            owner = lives()
            if owner is None or not owner.serve():
                return
            del owner
            getcurrent().parent.switch()

    return lambda: greenlet(serve)
