"""Plans of tasks: which forms there are, how they nest, and how often each is chosen.

A plan is one form. Every loop in it is counted, and every recovery procedure
too; so it ends, if only with a deadlock, or else the kernel is wrong.
"""

from __future__ import annotations

from random import Random

from trees.leaves import Leaves
from trees.words import ANSWERED, EVENTS, SECONDS, Scope

TASKS = ("net", "net", "lenient_net", "race", "guardian", "guardian", "spawned", "spawned", "interrupt")
FAILING = ("recovery", "recovery", "recovery", "cleanup", "cleanup", "protection", "protection")
TIME = ("deadline", "deadline", "period", "masked", "rounds")
OTHER = ("block", "caught", "bound", "bound", "sorted_by", "walked", "through", "expanded", "sequence")


class Writer(Leaves):
    """Writes one plan."""

    def plan(self, depth: int) -> str:
        """A whole plan."""
        return f"(let ((*main* (current-task))) {self.body(Scope(), depth)})"

    def form(self, scope: Scope, depth: int) -> str:
        """A form that nests at most DEPTH deep."""
        if depth <= 0 or self.chance.randrange(5) == 0:
            return self.leaf(scope)
        kind = self.one(*TASKS * 2, *FAILING * 2, *TIME, *OTHER)
        return str(getattr(self, kind)(scope, depth - 1))

    def body(self, scope: Scope, depth: int) -> str:
        """One to three forms."""
        return " ".join(self.form(scope, depth) for _ in range(self.chance.randint(1, 3)))

    # --- tasks -----------------------------------------------------------------

    def net(self, scope: Scope, depth: int, option: str = "") -> str:
        """A task net; its members know one another."""
        names = [self.fresh("t") for _ in range(self.chance.randint(1, 3))]
        inner = scope._replace(tasks=(*scope.tasks, *names), recovering=False)
        return f"(task-net{option} {' '.join(f'({name} {self.body(inner, depth)})' for name in names)})"

    def lenient_net(self, scope: Scope, depth: int) -> str:
        """One whose members may fail."""
        return self.net(scope, depth, " :allow-failures")

    def race(self, scope: Scope, depth: int) -> str:
        """Tasks of which one must succeed."""
        forms = [self.form(scope, depth) for _ in range(self.chance.randint(0, 3))]
        return f"(or-parallel {' '.join(forms)})"

    def guardian(self, scope: Scope, depth: int) -> str:
        """A guardian, what it makes its task do, and what it guards."""
        guard, alarm = self.form(scope, depth), self.form(scope, min(depth, 1))
        return f"(with-guardian {guard} {alarm} {self.body(scope, depth)})"

    def spawned(self, scope: Scope, depth: int) -> str:
        """A task of its own, and what its owner does meanwhile."""
        name, daemon = self.fresh("s"), self.one("", "", " :daemon t")
        inner = scope._replace(tasks=(*scope.tasks, name))
        return f"(let (({name} (spawn {self.form(scope, depth)}{daemon}))) {self.body(inner, depth)})"

    def interrupt(self, scope: Scope, depth: int) -> str:
        """An interrupt of some task, and what it is to do."""
        task = self.one(*scope.tasks, "(current-task)")
        return f"(interrupt-task {task} (lambda () {self.form(scope, min(depth, 1))}))"

    # --- failures ---------------------------------------------------------------

    def recovery(self, scope: Scope, depth: int) -> str:
        """A form that answers failures, with RETRY, ABORT, or by running off the end of a procedure."""
        clauses = []
        for _ in range(self.chance.randint(1, 2)):
            inner = scope._replace(recovering=True)
            end = self.one("(retry)", "(retry)", f"(abort {self.number()})", self.note())
            what = self.perhaps(self.form(inner, min(depth, 1)))
            clauses.append(f"({self.one(*ANSWERED)} :retries {self.number()} {what} {end})")
        return f"(with-recovery-procedures ({' '.join(clauses)}) {self.body(scope, depth)})"

    def cleanup(self, scope: Scope, depth: int) -> str:
        """A body with a cleanup procedure."""
        return f"(cleaned {self.form(scope, min(depth, 1))} {self.body(scope, depth)})"

    def protection(self, scope: Scope, depth: int) -> str:
        """A form with a cleanup that runs in any case."""
        return f"(protected {self.form(scope, depth)} {self.form(scope, min(depth, 1))})"

    # --- time -------------------------------------------------------------------

    def deadline(self, scope: Scope, depth: int) -> str:
        """A body that must end in time."""
        return f"(with-deadline ({self.one(*SECONDS)}) {self.body(scope, depth)})"

    def period(self, scope: Scope, depth: int) -> str:
        """What is done again and again, a few times."""
        name = self.fresh("n")
        return (
            f"(let (({name} 0)) (periodically {self.one('0.5', '1')} {self.form(scope, depth)}"
            f" (if (> (incf {name}) 2) (return {name}))))"
        )

    def masked(self, scope: Scope, depth: int) -> str:
        """A body that no interrupt reaches."""
        return f"(without-interrupts {self.body(scope, depth)})"

    def rounds(self, scope: Scope, depth: int) -> str:
        """A loop."""
        return f"(dotimes (i 3) {self.body(scope, depth)})"

    # --- the rest of Lisp ---------------------------------------------------------

    def block(self, scope: Scope, depth: int) -> str:
        """A block that forms inside may leave, those of other tasks among them."""
        name = self.fresh("b")
        return f"(block {name} {self.body(scope._replace(blocks=(*scope.blocks, name)), depth)})"

    def caught(self, scope: Scope, depth: int) -> str:
        """The same for a catch."""
        name = self.fresh("k")
        return f"(catch '{name} {self.body(scope._replace(catches=(*scope.catches, name)), depth)})"

    def bound(self, scope: Scope, depth: int) -> str:
        """A dynamic binding, which is to be there still after BODY."""
        self.count += 1
        number = self.count
        return f"(let ((*d* {number})) (prog1 (progn {self.body(scope, depth)}) (here {number})))"

    def sorted_by(self, scope: Scope, depth: int) -> str:
        """A sort whose predicate does something."""
        return f"(sort (list 3 1 2) (lambda (a b) {self.form(scope, depth)} (< a b)))"

    def walked(self, scope: Scope, depth: int) -> str:
        """A walk through a hash table."""
        table = "(let ((table (make-hash-table))) (setf (gethash 1 table) 1 (gethash 2 table) 2) table)"
        return f"(maphash (lambda (key value) (note key value) {self.form(scope, depth)}) {table})"

    def through(self, scope: Scope, depth: int) -> str:
        """A call from Lisp through Python and back."""
        return f"(through (lambda () {self.form(scope, depth)}))"

    def expanded(self, scope: Scope, depth: int) -> str:
        """A macro whose expander waits, at run time."""
        form = f"(slowly (signal {self.one(*EVENTS)} 1))"
        return f"(eval '{form})"

    def sequence(self, scope: Scope, depth: int) -> str:
        """Several forms."""
        return f"(progn {self.body(scope, depth)})"


def task_plan(chance: Random, depth: int = 4, *, jumps: bool = True) -> str:
    """A plan of tasks, as text."""
    return Writer(chance, jumps=jumps).plan(depth)
