"""The words that the prompt knows besides forms, such as :why.

Each begins with a colon; some take the name of a task, or a form, that begins
on the same line.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from eslang.base.lists import Cons
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.tools.report import why

HELP = """\
Type a form, and it is evaluated; its values are printed, one a line.
  :why          what is known of the last failure that nobody answered
  :tasks        the tasks that there are, and how they are
  :task NAME    all that is known of one task
  :abort NAME   abort a task, with its cleanup procedures
  :facts        the relations of the database; :facts RELATION shows its facts,
                :facts QUERY what a query finds
  :locks        the property locks: who owns them, who waits, since when
  :help         this text
  :quit         end, and abort all tasks; so does Ctrl-D
  (doc NAME)    the signature and documentation of NAME
  * ** ***      the last values; + ++ +++ the last forms; / // /// the lists of all values
Tasks that a form has spawned go on while the prompt waits.
Tab completes a name. Enter ends a form that is complete, and else begins a new line.
Ctrl-C ends the form that is evaluated, from an endless loop too, and returns to the prompt.
"""


class Leave(Exception):
    """The conversation is over; the code is the one to exit with."""

    def __init__(self, code: int) -> None:
        super().__init__(code)
        self.code = code


def tell_why(conversation: Any, name: str) -> None:
    """What is known of the last failure."""
    conversation.output.write(why(conversation.failure, conversation.interp))


def tell_help(conversation: Any, name: str) -> None:
    """What can be said."""
    conversation.output.write(HELP)


def leave(conversation: Any, name: str) -> None:
    """The end of the conversation."""
    raise Leave(0)


def tell_tasks(conversation: Any, name: str) -> None:
    """All tasks."""
    conversation.output.write(conversation.census.listing())


def tell_task(conversation: Any, name: str) -> None:
    """One task."""
    census = conversation.census
    found = census.find(name) if name else "Say `:task NAME`; :tasks tells the names.\n"
    conversation.output.write(found if isinstance(found, str) else census.about(found))


def abort_task(conversation: Any, name: str) -> None:
    """Abort one task."""
    found = conversation.census.find(name) if name else "Say `:abort NAME`; :tasks tells the names.\n"
    if isinstance(found, str):
        conversation.output.write(found)
    elif found.has_ended:
        conversation.output.write(f"{found.name} has ended.\n")
    else:
        with conversation.interp.at_work():
            conversation.interp.scheduler.lives.abort(found, "abort-task")


def tell_facts(conversation: Any, asked: Value) -> None:
    """The relations that there are, one of them, or what a query finds."""
    from eslang.tools.columns import columns_of_terminal
    from eslang.tools.fact_tables import FactTables

    interp, write = conversation.interp, conversation.output.write
    tables = FactTables(interp.database, columns_of_terminal())
    if asked is None:
        write(tables.overview())
    elif isinstance(asked, Symbol):
        write(tables.relation(asked))
    elif asked.__class__ is Cons:
        conversation.attempt(lambda: within(interp, lambda: tables.answers(asked)), write)
    else:
        write("Say `:facts`, `:facts RELATION` or `:facts (RELATION ?X ...)`.\n")


def tell_locks(conversation: Any, name: str) -> None:
    """The property locks that tasks have, or wait for."""
    from eslang.tools.columns import columns_of_terminal
    from eslang.tools.lock_table import lock_table

    locks = conversation.interp.locks
    holdings = locks.holdings() if locks is not None else []
    conversation.output.write(lock_table(holdings, columns_of_terminal()))


def within(interp: Any, work: Callable[[], Any]) -> Any:
    """What WORK gives, which may call Lisp."""
    with interp.door():
        return interp.runs.run(work)


class Word:
    """One word: what answers it, and whether it takes the name of a task, or any form."""

    def __init__(
        self, answer: Callable[[Any, Any], None], *, takes_name: bool = False, takes_form: bool = False
    ) -> None:
        self.answer = answer
        self.takes_name = takes_name
        self.takes_form = takes_form


WORDS = {
    Keyword("WHY"): Word(tell_why),
    Keyword("TASKS"): Word(tell_tasks),
    Keyword("TASK"): Word(tell_task, takes_name=True),
    Keyword("ABORT"): Word(abort_task, takes_name=True),
    Keyword("FACTS"): Word(tell_facts, takes_form=True),
    Keyword("LOCKS"): Word(tell_locks),
    Keyword("HELP"): Word(tell_help),
    Keyword("H"): Word(tell_help),
    Keyword("QUIT"): Word(leave),
    Keyword("Q"): Word(leave),
    Keyword("EXIT"): Word(leave),
}
