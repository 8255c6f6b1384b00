"""`esl repl`: the prompt of the papers, from a terminal or from a pipe.

From a pipe each form is printed behind its prompt, since nobody else shows it:
the output is a transcript that `esl test` can replay. On a terminal the editor
(editing.py, on prompt-toolkit) shows what is typed.
"""

from __future__ import annotations

import os
import sys
from typing import Any, TextIO

from eslang.base.symbols import Keyword
from eslang.tools.conversation import PROMPT, Conversation, Leave
from eslang.tools.interrupts import Interrupts
from eslang.tools.narrator import narrate, narrate_ends
from eslang.tools.opening import Opened, readable
from eslang.tools.options import Chosen
from eslang.tools.run import load, outcome
from eslang.tools.tokens import Balance

WRONG = 65
PATIENCE = 3  # Ctrl-C may be pressed so often before it ends the session

WELCOME = """\
eslang {version}. Type a form; :help tells what else can be said, :quit or Ctrl-D ends.
"""
HELP = """\
Type a form, and it is evaluated; its values are printed, one a line.
  :why          what is known of the last failure that nobody answered
  :help         this text
  :quit         end; so does Ctrl-D
  (doc NAME)    the signature and documentation of NAME
  * ** ***      the last values; + ++ +++ the last forms; / // /// the lists of all values
Tab completes a name. Enter ends a form that is complete, and else begins a new line.
Ctrl-C returns to the prompt, from an endless loop too.
"""


def repl(chosen: Chosen) -> int:
    """Do what `esl repl` was asked for; the exit code."""
    for path in chosen.words:
        readable(path)
    with Opened(chosen, narrate_ends if chosen.has("quiet") else narrate) as interp:
        for path in chosen.words:
            code = outcome(interp, lambda path=path: load(interp, path))  # type: ignore[misc]
            if code:
                sys.stderr.write(f"esl: `{path}` was not loaded to its end\n")
        try:
            if not sys.stdin.isatty():
                return from_pipe(interp, sys.stdin)
            if sys.stdout.isatty() and os.environ.get("TERM") != "dumb":
                return at_terminal(interp)
            return at_plain_terminal(interp, sys.stdin)
        except Leave as leave:
            return leave.code


def opened_conversation(interp: Any, *, echo: bool) -> Conversation:
    """A conversation that knows the words beginning with a colon."""
    from eslang.tools.report import wants_colour, why

    conversation = Conversation(interp, sys.stderr, echo=echo, colour=wants_colour(sys.stderr))

    def tell_why(conversation: Conversation) -> None:
        conversation.output.write(why(conversation.failure, interp))

    def tell_help(conversation: Conversation) -> None:
        conversation.output.write(HELP)

    def leave(conversation: Conversation) -> None:
        raise Leave(0)

    for names, answer in ((("WHY",), tell_why), (("HELP", "H"), tell_help), (("QUIT", "Q", "EXIT"), leave)):
        for name in names:
            conversation.said[Keyword(name)] = answer
    return conversation


def from_pipe(interp: Any, stream: TextIO) -> int:
    """Answer what STREAM says; 65 if some of it was no right program, 130 if it was interrupted."""
    conversation = opened_conversation(interp, echo=True)
    pending, balance = "", Balance()
    conversation.prompt()
    while line := stream.readline():
        pending += line
        balance.feed(line)
        if balance.surely_open:
            continue
        with Interrupts(interp) as interrupts:
            pending, balance = conversation.hear(pending), Balance()
        if interrupts.code is not None:
            return interrupts.code
        balance.feed(pending)
        conversation.prompt()
    with Interrupts(interp):
        conversation.hear(pending, last=True)
    if conversation.prompted:
        interp.output.write("\n")
    interp.output.flush()
    return WRONG if conversation.mistakes else 0


def at_plain_terminal(interp: Any, stream: TextIO) -> int:
    """Answer what is typed at a terminal without a screen, until Ctrl-D or :quit."""
    conversation = opened_conversation(interp, echo=False)
    conversation.remarks = True
    pending = ""
    while True:
        try:
            if not pending:
                conversation.prompt()
                interp.output.flush()
            line = stream.readline()
            conversation.typed()
            pending = answered(conversation, pending + line, last=not line)
        except KeyboardInterrupt:
            conversation.typed()
            interp.output.write("\n")
            pending, line = "", "?"
        if not line:
            interp.output.write("\n")
            return 0


def at_terminal(interp: Any) -> int:
    """Answer what is typed, until Ctrl-D or :quit."""
    from eslang import __version__
    from eslang.tools.editing import Editor

    conversation = opened_conversation(interp, echo=False)
    conversation.remarks = True
    editor = Editor(interp, PROMPT)
    interp.output.write(WELCOME.format(version=__version__))
    while True:
        try:
            interp.output.fresh_line()
            interp.output.flush()
            answered(conversation, editor.read() + "\n", last=True)
        except KeyboardInterrupt:
            continue
        except EOFError:
            return 0


def answered(conversation: Conversation, text: str, *, last: bool) -> str:
    """Answer TEXT; what is left of it unfinished, and nothing if Ctrl-C was pressed."""
    with Interrupts(conversation.interp, patience=PATIENCE) as interrupts:
        rest = conversation.hear(text, last=last)
    return rest if interrupts.code is None else ""
