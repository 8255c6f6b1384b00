"""Forms of plans that hold no other forms: what tasks do to one another, and to themselves."""

from __future__ import annotations

from trees.words import CAUSES, EVENTS, SECONDS, VARIABLES, Scope, Words

LEAVES = (
    *("note", "note", "sleep", "sleep", "give_way", "spin", "signal", "signal", "wait", "wait"),
    *("reach", "await_checkpoint", "await_task", "fail", "fail", "host_error", "assign", "abort"),
    *("condition", "show", "look", "own_end"),
)


class Leaves(Words):
    """Writes forms that hold no others."""

    def leaf(self, scope: Scope) -> str:
        """Any of them."""
        kind = self.one(*LEAVES)
        return self.note() if kind == "note" else str(getattr(self, kind)(scope))

    def sleep(self, scope: Scope) -> str:
        """Some time."""
        return f"(sleep {self.one(*SECONDS)})"

    def give_way(self, scope: Scope) -> str:
        """A turn for the others."""
        return "(yield)"

    def spin(self, scope: Scope) -> str:
        """A loop of a few time slices."""
        return "(dotimes (i 2500) i)"

    def signal(self, scope: Scope) -> str:
        """A signal."""
        return f"(signal {self.one(*EVENTS)} {self.number()})"

    def wait(self, scope: Scope) -> str:
        """A wait for one event or two, or for one that passes a test, which may itself wait."""
        events = self.one(EVENTS[0], EVENTS[1], f"(list {EVENTS[0]} {EVENTS[2]})")
        tests = ("", "", " (lambda (x) (yield) (oddp x))", " (lambda (x) (when (= x 2) (fail :x1)) t)")
        return f"(wait-for-events {events}{self.one(*tests)})"

    def reach(self, scope: Scope) -> str:
        """A checkpoint."""
        return f"(checkpoint {self.number()})"

    def await_checkpoint(self, scope: Scope) -> str:
        """A wait for one."""
        return f"(checkpoint-wait {self.one(*scope.tasks)} {self.number()})"

    def await_task(self, scope: Scope) -> str:
        """A wait for the end of a task, perhaps its own."""
        task = self.one(*scope.tasks)
        return self.one(f"(wait-for-task {task})", f"(multiple-value-list (wait-for-task {task}))")

    def fail(self, scope: Scope) -> str:
        """A failure."""
        return f"(fail {self.one(*CAUSES)} {self.number()})"

    def host_error(self, scope: Scope) -> str:
        """A failure of the host."""
        return self.one("(car 5)", "(/ 1 0)", "(python-error)")

    def assign(self, scope: Scope) -> str:
        """A change of what conditions read."""
        return f"(setq {self.one(*VARIABLES)} {self.number()})"

    def condition(self, scope: Scope) -> str:
        """A wait for a condition."""
        timeout = self.one("", f" :timeout {self.one(*SECONDS)}")
        return f"(wait-until (= {self.one(*VARIABLES)} {self.number()}){timeout})"

    def abort(self, scope: Scope) -> str:
        """An abort of a task, perhaps of this one."""
        return f"(abort-task {self.one(*scope.tasks[1:], '(current-task)')})"

    def show(self, scope: Scope) -> str:
        """A value whose print function waits."""
        return "(progn (princ (make-shown :value 1)) nil)"

    def look(self, scope: Scope) -> str:
        """A look at how a task is."""
        return f"(note (task-status {self.one(*scope.tasks)}))"

    def own_end(self, scope: Scope) -> str:
        """The jumps that are written in the text here, if there are any."""
        choices = [self.note()]
        if scope.recovering:
            choices.append("(note (failure-cause))")
        if scope.recovering and self.jumps:
            choices += ["(retry)", f"(abort {self.number()})"]
        if self.jumps:
            choices += [f"(return-from {block} {self.number()})" for block in scope.blocks]
            choices += [f"(throw '{tag} {self.number()})" for tag in scope.catches]
        return self.one(*choices)
