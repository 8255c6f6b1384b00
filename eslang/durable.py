"""The durable store of an interpreter: its facts, kept in a file while they change.

Queries know nothing of it: all facts are in memory, loaded at the start. Each
step of the scheduler that changes facts is one transaction of the file, made
when the step ends; so is a change from Python between two calls. Whatever
happens to the process, the file holds what was true when some step ended.
Rules and declarations belong to the program, and are not kept.
"""

from __future__ import annotations

from eslang.base.diagnostics import EslError
from eslang.base.failure import Failure
from eslang.base.hints import TYPE_CHECKING
from eslang.base.symbols import Symbol
from eslang.constructs.esl.fact_text import OTHER, Scanner, UserNames, Writer, read_one
from eslang.facts.journal import Journal
from eslang.facts.query import Facts
from eslang.facts.relations import Relation
from eslang.facts.terms import Row
from eslang.runtime import failures
from eslang.runtime.tasks import Interrupt
from eslang.store_file import StoreFile

if TYPE_CHECKING:
    from eslang.interpreter import Interpreter


class Durable(Journal):
    """The journal of one interpreter's facts, and its file."""

    def __init__(self, session: Interpreter, path: str) -> None:
        self.session = session
        self.file = StoreFile(path)
        self.closed = False
        self._names = UserNames(session.image.packages)
        self._writer = Writer(self._names.name_of, f"kept in `{path}`")
        self._last = 0  # the number of the fact that came last
        self._added: dict[int, tuple[Symbol, Row]] = {}  # since the last transaction
        self._removed: list[int] = []
        self._trouble: Failure | None = None  # what the last transaction failed with

    def load(self, facts: Facts) -> None:
        """Let FACTS be what the file holds. Raises Failure."""
        scanner = Scanner(self._names.resolve)
        for number, text in self.file.facts():
            try:
                fact = scanner.plain(text)
                if fact is OTHER:
                    fact = read_one(text, self.file.path, self._names.resolve)
                facts.restore(fact, number)
            except (Failure, EslError):
                raise self.file.trouble(f"it is damaged: fact {number} is no fact: {text}") from None
            self._last = number

    # --- the changes of a step ---------------------------------------------------

    def admit(self, relation: Relation, row: Row) -> None:
        """Refuse what has no text."""
        if self.closed:
            raise Failure("interpreter-closed")
        self._writer.text(relation.name, row)

    def note_added(self, relation: Relation, row: Row) -> None:
        """ROW has come: it is the last one, and has a number from now on."""
        number = self._last = self._last + 1
        relation.rows[row] = number
        self._added[number] = relation.name, row

    def note_removed(self, relation: Relation, row: Row) -> None:
        """ROW goes."""
        number = relation.rows[row]
        if self._added.pop(number, None) is None:
            self._removed.append(number)

    def end_change(self) -> None:
        """A task's change is written when its step ends, which the driver is to see; any other at once."""
        scheduler = self.session.scheduler
        if scheduler.current is not None:
            scheduler.hand_back()
        else:
            trouble = self.settle()
            if trouble is not None:
                raise trouble

    # --- transactions ------------------------------------------------------------

    def settle(self) -> Failure | None:
        """A step is over: write what it has changed; the failure that this ends with, if it does.

        What could not be written is kept, and tried again after the next step.
        The task that the run waits for is told once.
        """
        if not self._added and not self._removed:
            self._trouble = None
            return None
        write = self._writer.text
        try:
            self.file.write(self._removed, [(number, write(*fact)) for number, fact in self._added.items()])
        except Failure as failure:
            first, self._trouble = self._trouble is None, failure
            if first:
                self._tell()
            return failure
        self._removed.clear()
        self._added.clear()
        self._trouble = None
        return None

    def _tell(self) -> None:
        """Let the task that the run waits for fail with what went wrong."""
        runs = self.session.runs
        task = runs.root or next(iter(runs.lives.tops), None)

        def fail() -> None:
            if self._trouble is not None:
                failures.signal(self._trouble, continuable=True)

        if task is not None:
            runs.scheduler.interrupt(task, Interrupt("store", fail))

    def close(self) -> None:
        """Write what is left, and let go of the file. Raises Failure if that is lost."""
        if not self.closed:
            trouble = self.settle()
            self.closed = True
            self.file.close()
            if trouble is not None:
                raise trouble


def keep_facts(session: Interpreter, path: str) -> None:
    """Let the facts of SESSION be those in the file PATH, from now on in both."""
    store = Durable(session, path)
    facts = session.database
    try:
        store.load(facts)
    except BaseException:
        store.file.close()
        raise
    facts.journal = store
    session.scheduler.settle = store.settle
