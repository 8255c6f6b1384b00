"""The words that the prompt knows besides forms, such as :why.

Each begins with a colon; some take the name of a task, on the same line.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from eslang.base.symbols import Keyword
from eslang.tools.report import why

HELP = """\
Type a form, and it is evaluated; its values are printed, one a line.
  :why          what is known of the last failure that nobody answered
  :tasks        the tasks that there are, and how they are
  :task NAME    all that is known of one task
  :abort NAME   abort a task, with its cleanup procedures
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


class Word:
    """One word: what answers it, and whether it takes the name of a task."""

    def __init__(self, answer: Callable[[Any, str], None], *, takes_name: bool = False) -> None:
        self.answer = answer
        self.takes_name = takes_name


WORDS = {
    Keyword("WHY"): Word(tell_why),
    Keyword("TASKS"): Word(tell_tasks),
    Keyword("TASK"): Word(tell_task, takes_name=True),
    Keyword("ABORT"): Word(abort_task, takes_name=True),
    Keyword("HELP"): Word(tell_help),
    Keyword("H"): Word(tell_help),
    Keyword("QUIT"): Word(leave),
    Keyword("Q"): Word(leave),
    Keyword("EXIT"): Word(leave),
}
