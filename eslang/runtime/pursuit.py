"""Pursuing the goals of the agenda: one task for each, until nothing is left to be done (SCS §2).

The tasks take turns after each atomic action, as those of DO-ALL do. If a
goal has a utility, whoever has done an action is held, and one of those goes
on that are worth most. Who pursues is told of goals that come meanwhile; they
are begun before anybody does another action.

An attempt that fails is followed by another, unless that is vain; what comes
of an attempt that finds no method is a matter of facts, so it is made again
when facts have changed.
"""

from __future__ import annotations

from eslang.base.failure import ERROR, Failure
from eslang.base.hints import Any, Callable
from eslang.base.running import running
from eslang.base.symbols import Keyword, T, Value
from eslang.runtime import failures
from eslang.runtime.agenda import (
    ACHIEVED,
    ACTIVE,
    BLOCKED,
    DROPPED,
    IMPOSSIBLE,
    INACTIVE,
    PENDING,
    Agenda,
    Goal,
    goal_of,
)
from eslang.runtime.arenas import take_turns
from eslang.runtime.attempts import attempt
from eslang.runtime.circuits import Level, Stage, begin_action, end_of_action
from eslang.runtime.deadlock import DEADLOCK
from eslang.runtime.events import Wait
from eslang.runtime.polls import CONDITION
from eslang.runtime.tasks import Task

NO_METHOD = Keyword("NO-APPLICABLE-METHOD")
UNBOUND = Keyword("UNBOUND-LOGIC-VARIABLE")
VAIN = (IMPOSSIBLE, DEADLOCK, ERROR, UNBOUND)  # causes after which another attempt has no use
SHORTEST, LONGEST = 0.001, 1.0  # seconds between the beginnings of attempts that fail
Subscribe = Callable[[Callable[[object], None]], Callable[[], None]]  # to changes of facts; gives its end


class Pursuit:
    """One entrance of PURSUE-GOALS, which WAITS for goals and facts from others, or does not."""

    def __init__(self, agenda: Agenda, subscribe: Subscribe, waits: bool, stage: Stage) -> None:
        self.agenda = agenda
        self.subscribe = subscribe
        self.waits = waits
        self.stage = stage
        self.session = running.session
        self.scheduler = agenda.scheduler
        self.task: Task = self.scheduler.at_work()
        self.members: dict[Task, Goal] = {}  # the tasks at work, and what for
        self.held: dict[Task, Wait] = {}  # those that have done an action, and are not to go on yet
        self.resting: dict[Wait, Goal] = {}  # the waits of those that have failed
        self.doomed: dict[Goal, Failure] = {}  # those that are being left because of that
        self.given_up: list[tuple[Goal, Failure]] = []
        self.is_fresh = True  # there may be goals that nobody has begun
        self.is_ranked = False  # one of the goals has a utility
        self.is_noted = False  # something was changed since it was looked after
        self.wait: Wait | None = None
        self.hear_no_more: Callable[[], None] | None = None
        self.level = Level(self.task, self.task.dynamic.logical, lambda: True)
        self.level.open(self.take_turns)

    # --- who pursues -------------------------------------------------------------

    def run(self) -> list[tuple[Goal, Failure]]:
        """See to the goals until nothing is left to be done; those that had to be given up, and why."""
        dynamic = self.task.dynamic
        outer, dynamic.logical = dynamic.logical, dynamic.logical._replace(circuit=self.level)
        self.agenda.pursuit = self
        try:
            while True:
                self.is_noted = False
                self.begin_fresh()
                self.let_go_on()
                if self.is_over():
                    break
                self.rest()
            for goal in list(self.members.values()):
                if goal.status is BLOCKED and goal.failure is not None:
                    self.give_up(goal, goal.failure)
            return self.given_up
        finally:
            self.level.end()
            dynamic.logical = outer
            self.agenda.pursuit = None
            for wait in self.held.values():
                self.scheduler.end_wait(wait, None)
            self.scheduler.lives.abort_all(self.task, list(self.members), "net")

    def is_over(self) -> bool:
        """True if no goal can be brought nearer: each is inactive, or blocked, and stays so."""
        if self.is_fresh or self.waits:
            return False
        goals = list(self.members.values())
        if any(goal.is_leaving or goal.status not in (INACTIVE, BLOCKED) for goal in goals):
            return False
        return all(goal.means.holds() for goal in goals if goal.status is INACTIVE)

    def begin_fresh(self) -> None:
        """Let a task begin for each goal that has none."""
        if not self.is_fresh:
            return
        self.is_fresh = False
        goals = self.agenda.goals()
        at_work = set(self.members.values())
        leaving = [goal for goal in at_work if goal.is_leaving]
        self.is_ranked = any(goal.utility is not None for goal in goals)
        begun = []
        for number, goal in enumerate(goals, 1):
            if goal not in at_work and not any(self.agenda.are_same(goal, other) for other in leaving):
                begun.append(self.begin(goal, number))
        self.session.chance.shuffle(begun)
        for task in begun:
            self.scheduler.lives.start(task, "goal")

    def begin(self, goal: Goal, number: int) -> Task:
        """A task that pursues GOAL."""
        stage = Stage(self.stage.operator, self.stage.around, number)
        stage.condition = [goal.spec]
        task: Task = self.scheduler.lives.create(
            goal.name_of_task(), lambda: self.live(goal, stage), self.task, self.left
        )
        task.seen = True
        goal.status = ACTIVE
        self.members[task] = goal
        return task

    def left(self, task: Task) -> None:
        """TASK has ended. What is not over by then was dropped, unless the whole is being left."""
        goal = self.members.pop(task)
        if goal in self.doomed:
            self.give_up(goal, self.doomed[goal])
        elif self.agenda.pursuit is self or goal.is_leaving:
            self.agenda.end(goal, DROPPED)
        elif not goal.is_over:
            goal.status = PENDING
        self.take_note(goal if goal.is_leaving else None)  # the same one, given again, may wait for that

    def give_up(self, goal: Goal, failure: Failure) -> None:
        """GOAL is impossible, as FAILURE shows."""
        goal.failure = failure
        self.given_up.append((goal, failure))
        self.agenda.end(goal, IMPOSSIBLE, failure)

    def task_of(self, goal: Goal) -> Task | None:
        """The task that pursues GOAL."""
        return next((task for task, other in self.members.items() if other is goal), None)

    # --- turns -------------------------------------------------------------------

    def take_note(self, goal: Goal | None = None) -> None:
        """Something may be to be done: GOAL has come, or gone, or something was changed."""
        self.is_noted = True
        if goal is not None:
            self.is_fresh = True
        if self.wait is not None:
            self.scheduler.end_wait(self.wait, None)

    def rest(self) -> None:
        """Wait until something is to be done; while somebody is held, until nobody else goes on."""
        if self.is_noted:
            return
        wait = Wait(self.task, "goals", "goals to pursue")
        if self.held:
            said = self.stage.operator
            wait = Wait(self.task, CONDITION, said, (), lambda: None if self.is_somebody_on() else T)
        self.wait = wait
        failure = attempt(self.task, lambda: self.scheduler.wait(wait))
        self.wait = None
        if wait.kind == CONDITION:
            self.scheduler.polls.forget(wait)
        if failure is not None:
            self.break_deadlock(failure)

    def break_deadlock(self, failure: Failure) -> None:
        """Of the goals that wait for what cannot come, give up the one that was given last."""
        stuck = [task for task, goal in self.members.items() if goal.status is ACTIVE and not goal.is_leaving]
        if failure.cause is DEADLOCK and stuck:
            self.doomed[self.members[stuck[-1]]] = failure
            self.agenda.drop(self.members[stuck[-1]])
        elif failure.cause is not DEADLOCK or self.waits:
            failures.signal(failure, continuable=False)

    def take_turns(self, session: Any) -> bool:
        """An action of a goal has ended: let any go on, or those that are to. True if others went on."""
        task = self.scheduler.at_work()
        is_ours = self.agenda.pursuit is self and task is not self.task
        if not (is_ours and (self.is_ranked or self.is_fresh)):
            return take_turns(session)
        wait = self.held[task] = Wait(task, "turn", "its turn")
        self.take_note()
        try:
            self.scheduler.wait(wait)
        finally:
            self.held.pop(task, None)
        return True

    def is_somebody_ready(self, looks: bool = False) -> bool:
        """True if a task that is at work for a goal is about to go on; or only LOOKS again at a condition."""
        return any(is_looking(task) is looks and goal_of(task, self.members) for task in self.scheduler.ready)

    def is_somebody_on(self) -> bool:
        """True if a task at work for a goal is about to go on, or at an action, whose end gives turns."""
        arena = self.level.arena
        acting = None if arena is None else arena.acting
        return (acting is not None and goal_of(acting, self.members) is not None) or self.is_somebody_ready()

    def let_go_on(self) -> None:
        """Let those go on that are held; only one of the best, if goals have utilities."""
        if self.held and self.is_ranked and self.is_somebody_ready(looks=True):
            self.scheduler.yield_turn(self.task)  # one of them may see what it waits for
        if not self.held or (self.is_ranked and self.is_somebody_on()):
            return
        chosen = list(self.held)
        if self.is_ranked:
            ranks = {task: self.rank(goal_of(task, self.members)) for task in self.held}
            highest = max(ranks.values())
            best = [task for task, rank in ranks.items() if rank == highest]
            chosen = [best[0] if len(best) == 1 else best[self.session.chance.randrange(len(best))]]
        for task in chosen:
            self.scheduler.end_wait(self.held.pop(task), None)

    def rank(self, goal: Goal | None) -> Any:
        """What GOAL is worth now."""
        return 0 if goal is None or goal.utility is None else goal.utility()

    # --- a goal ------------------------------------------------------------------

    def live(self, goal: Goal, stage: Stage) -> Value:
        """Pursue GOAL, in a task of its own, until it is over."""
        task, dynamic = self.scheduler.at_work(), running.session.dynamic
        dynamic.logical = dynamic.logical.entered(stage)
        if self.is_ranked:
            self.take_turns(self.session)
        while not goal.is_over:
            begun = self.session.clock.now()
            failure = attempt(task, lambda: self.bring_about(goal))
            if failure is not None:
                self.answer(goal, failure, begun)
            else:
                if not goal.is_maintained:
                    self.agenda.end(goal, ACHIEVED)
                self.hear()
            if not goal.is_over:
                end_of_action()
                next(task.source)
        return T

    def bring_about(self, goal: Goal) -> None:
        """Make GOAL true, when it is not."""
        means = goal.means
        if goal.is_maintained and means.holds():
            goal.failed, goal.status = 0, INACTIVE
            self.agenda.announce("inactive", goal)
            self.take_note()
            means.await_need()
            goal.status = ACTIVE
        self.agenda.announce("pursued", goal)
        begin_action(goal.spec)
        means.attempt()
        if not goal.is_maintained:
            goal.bindings = means.solution()
        goal.failed = 0

    def answer(self, goal: Goal, failure: Failure, begun: float) -> None:
        """An attempt at GOAL, BEGUN then, has ended with FAILURE: wait until it is time for the next."""
        goal.failure = failure
        if failure.cause is NO_METHOD:
            goal.status = BLOCKED
            self.agenda.announce("blocked", goal, failure)
            self.take_note()
            self.wait_for_news(goal, None)
            return
        goal.failed += 1
        used_up = goal.retries is not None and goal.failed > goal.retries
        if used_up or any(self.session.causes.answers(cause, failure.cause) for cause in VAIN):
            self.give_up(goal, failure)
            return
        self.agenda.announce("failed", goal, failure)
        if goal.failed > 1:
            pause = min(LONGEST, SHORTEST * 2 ** min(goal.failed - 2, 16))
            self.wait_for_news(goal, pause - (self.session.clock.now() - begun))

    def wait_for_news(self, goal: Goal, seconds: float | None) -> None:
        """Wait until facts have changed, or another goal was reached; SECONDS at most, if that is told."""
        if seconds is not None and seconds <= 0:
            return
        scheduler, timer = self.scheduler, None
        wait = Wait(scheduler.at_work(), "retry", goal.spec)
        self.resting[wait] = goal
        if self.hear_no_more is None:
            self.hear_no_more = self.subscribe(self.hear)
        if seconds is not None:
            timer = scheduler.set_timer(seconds, lambda: scheduler.end_wait(wait, None))
        try:
            scheduler.wait(wait)
        finally:
            del self.resting[wait]
            if timer is not None:
                scheduler.timers.call_off(timer)
            if not self.resting and self.hear_no_more is not None:
                self.hear_no_more()
                self.hear_no_more = None

    def hear(self, change: object = None) -> None:
        """There is news: who has failed may try again."""
        for wait, goal in self.resting.items():
            goal.status = ACTIVE
            self.scheduler.end_wait(wait, None)


def is_looking(task: Task) -> bool:
    """True if TASK, which is ready, is to look at the condition that it waits for, and may wait on."""
    wait = task.wait
    return wait is not None and wait.kind == CONDITION and not wait.done and not task.interrupts
