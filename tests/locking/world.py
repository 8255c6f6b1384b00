"""A world whose properties tasks maintain: what holds, how it is achieved, and what was seen of it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from io import StringIO
from typing import Any

from eslang import Failure, Interpreter, Keyword
from eslang.base.control import Abort
from eslang.runtime import failures
from eslang.runtime.claims import Property, Sight
from eslang.runtime.failures import Clause, Form
from eslang.runtime.maintenance import make_locks
from eslang.runtime.tasks import Task

ANY = "?"  # the value that goes with every other one
Body = Callable[[], Any]


def wanted(text: str) -> Property:
    """The property that TEXT, `name=value`, says."""
    key, _, value = text.partition("=")
    return Property(key, value, text, text)


class World:
    """Properties with values, and an interpreter whose tasks lock them."""

    def __init__(self, interp: Interpreter | None = None, **given: Any) -> None:
        self.interp = interp or Interpreter(clock="virtual", output=StringIO(), **given)
        self.scheduler = self.interp.scheduler
        self.values: dict[str, str] = {}
        self.watches: dict[str, dict[object, Callable[[], None]]] = {}
        self.methods: dict[str, Callable[[Property], object]] = {}
        self.unsteady: set[str] = set()  # what nobody is told of when it changes
        self.recoveries: dict[str, Callable[[Property], object]] = {}
        self.lines: list[str] = []
        self.changes: list[str] = []  # what was told of locks
        self.looks = 0
        self.tasks: dict[str, Task] = {}
        self.locks = make_locks(
            self.scheduler,
            achieve=self.achieve,
            compatible=self.compatible,
            observe=self.observe,
            recover=self.recover,
        )
        self.keeper: Any = self.locks.keeper
        self.interp.hooks.listeners.append(self.hear)

    # --- what the locks ask ----------------------------------------------------------

    def holds(self, one: Property) -> bool:
        """True if the world is so."""
        now = self.values.get(one.key)
        return now is not None and one.value in (now, ANY)

    def achieve(self, one: Property) -> None:
        """Make it so, in a second, unless it is, or another method was told."""
        if not self.holds(one):
            self.methods.get(one.key, self.switch)(one)
            if not self.holds(one):
                failures.fail(Keyword("CONDITION-NOT-ACHIEVED"), one.form)

    def recover(self, one: Property) -> None:
        """The same, if nothing else was told."""
        self.recoveries.get(one.key, self.achieve)(one)

    def switch(self, one: Property) -> None:
        """Make it so in a second."""
        self.note(f"switch {one.text}")
        self.sleep(1)
        self.set(one.key, one.value if one.value != ANY else "some")

    def compatible(self, one: Property, other: Property) -> bool:
        """True if both values can be those of one property at once."""
        return one.value == other.value or ANY in (one.value, other.value)

    def observe(self, one: Property, changed: Callable[[], None]) -> Sight:
        """Look, and watch, unless it is said of the property that it cannot be watched."""
        self.looks += 1
        mark = object()
        if one.key in self.unsteady:
            return Sight(self.holds(one), lambda: None, True)
        self.watches.setdefault(one.key, {})[mark] = changed
        return Sight(self.holds(one), lambda: self.forget(one.key, mark))

    def forget(self, key: str, mark: object) -> None:
        """Watch no more."""
        watches = self.watches[key]
        del watches[mark]
        if not watches:
            del self.watches[key]

    # --- what bodies do --------------------------------------------------------------

    def set(self, key: str, value: str | None) -> None:
        """Change the world."""
        if value is None:
            self.values.pop(key, None)
        else:
            self.values[key] = value
        for changed in list(self.watches.get(key, {}).values()):
            changed()

    def note(self, text: str) -> None:
        """Leave a trace."""
        current = self.scheduler.current
        self.lines.append(f"{self.interp.clock.now():g} {current.name if current else '-'}: {text}")

    def sleep(self, seconds: float) -> None:
        """Let time pass."""
        self.scheduler.sleep(seconds)

    def give_way(self) -> None:
        """Let the others have their turns."""
        self.scheduler.yield_turn(self.scheduler.at_work())

    def fail(self, cause: str, *arguments: Any) -> Any:
        """Fail."""
        return failures.fail(Keyword(cause), *arguments)

    def maintain(self, properties: str, body: Body = lambda: None) -> Any:
        """Run BODY while PROPERTIES, `a=1 b=2`, are maintained."""
        return self.locks.maintain([wanted(text) for text in properties.split()], body)

    def hold(self, properties: str, seconds: float = 0) -> Body:
        """The body of a task that maintains PROPERTIES for so many SECONDS, and says what became of that."""

        def inside() -> None:
            self.note("in")
            self.sleep(seconds)
            self.note("done")

        return lambda: self.noting(lambda: self.maintain(properties, inside))

    def noting(self, body: Body) -> Any:
        """Run BODY; if it fails, leave, and note with what."""
        found = self.answering("GENERAL-FAILURE", body)
        if isinstance(found, Failure):
            self.note(str(found).removeprefix("failure "))
            return None
        return found

    def answering(self, cause: str, body: Body, answer: Callable[[], object] | None = None) -> Any:
        """Run BODY; if it fails with CAUSE do ANSWER where it stands, and go on; or give the failure."""
        form = Form()

        def procedure(*arguments: Any) -> Any:
            if answer is not None:
                return answer()
            raise Abort(form, self.interp.dynamic.answering[-1][0])

        clause = Clause(Keyword(cause), None, None)
        return failures.run_form(form, (clause,), (procedure,), body)

    def tolerating(self, properties: str, body: Body) -> Any:
        """Run BODY while PROPERTIES are maintained; on a violation, wait until it is over."""

        def wait(*arguments: Any) -> None:
            failure = self.interp.dynamic.answering[-1][0]
            text = failure.arguments[0]
            self.note(f"waits for {text}")
            self.keeper.wait_for_recovery(wanted(text))
            self.note("goes on")

        return self.answering("MAINTAINED-PROPERTY-VIOLATION", lambda: self.maintain(properties, body), wait)

    # --- running -----------------------------------------------------------------------

    def spawn(self, name: str, body: Body) -> Task:
        """Start a task of the run."""
        task = self.scheduler.lives.create(name, body)
        task.seen = True
        self.tasks[name] = task
        self.scheduler.lives.start(task, "spawned")
        return task

    def abort(self, name: str) -> None:
        """Abort the task NAME."""
        self.scheduler.lives.abort(self.tasks[name], "abort-task")

    def run(self, **bodies: Body) -> list[str]:
        """Run BODIES, each in a task of its own, to their end; the trace. Nothing may be left of them."""

        def start() -> None:
            for name, body in bodies.items():
                self.spawn(name, body)

        with self.interp.door():
            self.interp.runs.enter(start)
            self.interp.runs.finish()
        left = self.remains()
        assert not left, left
        return self.lines

    def remains(self) -> list[str]:
        """What is left of locks, waits and watches when all has ended."""
        left = {
            "locks": self.locks.locks,
            "subscriptions": self.locks.subscriptions,
            "watches": self.watches,
            "suspects": self.keeper.suspects,
            "unsteady claims": self.keeper.unsteady,
            "daemon": self.keeper.daemon,
            "tasks": self.scheduler.lives.count,
            "waits": [task for task in self.tasks.values() if task.wait],
        }
        return [f"{name}: {value!r}" for name, value in left.items() if value]

    def hear(self, event: Any) -> None:
        """Keep what is told of locks."""
        if event.kind == "lock":
            told = event.data
            of, owner = (told[name].name if told[name] else "-" for name in ("of", "owner"))
            self.changes.append(f"{told['change']} {told['property']} {of} ({owner})")


def statuses(tasks: Sequence[Task]) -> list[str]:
    """How TASKS have ended."""
    return [str(task.status).strip(":").lower() for task in tasks]
