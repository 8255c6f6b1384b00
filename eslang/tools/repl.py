"""`esl repl`: the prompt of the papers, from a terminal or from a pipe.

From a pipe each form is printed behind its prompt, since nobody else shows it:
the output is a transcript that `esl test` can replay. On a terminal the editor
(editing.py, on prompt-toolkit) shows what is typed. Tasks go on meanwhile.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from typing import Any, TextIO

from eslang.base.control import Stop
from eslang.tools.conversation import PROMPT, Conversation
from eslang.tools.interrupts import INTERRUPTED, PATIENCE, Interrupts, Turns
from eslang.tools.lines import Lines, can_be_awaited
from eslang.tools.narrator import narrate, narrate_ends
from eslang.tools.opening import Opened, Outlet, begin_world, readable
from eslang.tools.options import Chosen
from eslang.tools.report import wants_colour
from eslang.tools.run import load, outcome
from eslang.tools.tokens import Balance
from eslang.tools.words import Leave

WRONG = 65

WELCOME = """\
eslang {version}. Type a form; :help tells what else can be said, :quit or Ctrl-D ends.
"""


def repl(chosen: Chosen) -> int:
    """Do what `esl repl` was asked for; the exit code."""
    for path in chosen.words:
        readable(path)
    opened = Opened(chosen, narrate_ends if chosen.has("quiet") else narrate)
    with opened as interp, Turns(interp):
        code = outcome(interp, lambda: begin_world(interp, chosen))
        if code:
            return code
        for path in chosen.words:
            with Interrupts(interp):
                code = outcome(interp, lambda path=path: load(interp, path))  # type: ignore[misc]
            if code:
                sys.stderr.write(f"esl: `{path}` was not loaded to its end\n")
        try:
            code = talk(interp, opened.outlet)
        except Leave as leave:
            code = leave.code
        return end(interp, code)


def talk(interp: Any, outlet: Outlet) -> int:
    """Talk, at whatever stands at the other end; the exit code."""
    if not sys.stdin.isatty():
        return from_pipe(interp, sys.stdin, outlet)
    if sys.stdout.isatty() and os.environ.get("TERM") != "dumb":
        return at_terminal(interp, outlet)
    return at_plain_terminal(interp, sys.stdin, outlet)


def end(interp: Any, code: int) -> int:
    """Abort all tasks that are left, with their cleanups; CODE, unless that was interrupted."""
    with Interrupts(interp) as interrupts, interp.at_work():
        try:
            interp.runs.abort_all()
        except Stop as stop:
            code = stop.code
        interp.output.fresh_line()
        interp.output.flush()
    return code if interrupts.code is None else interrupts.code


def opened_conversation(interp: Any, *, echo: bool) -> Conversation:
    """A conversation whose diagnostics go to standard error."""
    return Conversation(interp, sys.stderr, echo=echo, colour=wants_colour(sys.stderr))


# --- without a screen ----------------------------------------------------------------


class Standing:
    """An output at whose end a prompt may stand; what tasks write to it begins on a line of its own."""

    def __init__(self, stream: TextIO, stands: bool) -> None:
        self.stream = stream
        self.stands = stands
        self.touched = False  # something was written since

    def write(self, text: str) -> None:
        """Write TEXT."""
        if self.stands and text and not text.startswith("\n"):
            self.stream.write("\n")
        self.stands, self.touched = False, True
        self.stream.write(text)

    def prompt(self) -> None:
        """Let the prompt stand at the end."""
        self.stream.write(PROMPT)
        self.stands, self.touched = True, False

    def flush(self) -> None:
        """Let everything written so far arrive."""
        self.stream.flush()


def next_line(conversation: Conversation, lines: Lines, outlet: Outlet) -> str:
    """The next line of input; tasks go on until it is there. Raises KeyboardInterrupt."""
    output, interrupts = conversation.output, Interrupts(conversation.interp, patience=PATIENCE, gentle=True)
    prompted = conversation.prompted
    standing = Standing(outlet.stream, prompted)

    def rest(seconds: float | None) -> None:
        conversation.note_fallen()
        if standing.touched and prompted:
            output.fresh_line()
            standing.prompt()
        output.flush()
        at_ease(lambda: lines.rest(seconds))

    def at_ease(look: Callable[[], bool]) -> bool:
        """What LOOK says, which Ctrl-C leaves: a terminal then drops what was typed."""
        interrupts.resting = True
        found = interrupts.code is not None or look()  # it may have been pressed just before
        interrupts.resting = False
        return found

    outlet.stream, output.column = standing, 0  # type: ignore[assignment]
    try:
        with interrupts:
            conversation.go_on(lambda: at_ease(lines.is_ready), rest)
            if interrupts.code is not None:
                raise KeyboardInterrupt
    finally:
        outlet.stream, conversation.prompted = standing.stream, standing.stands
        if standing.stands:
            output.column = len(PROMPT)
    return lines.readline()


def from_pipe(interp: Any, stream: TextIO, outlet: Outlet) -> int:
    """Answer what STREAM says; 65 if some of it was no right program, 130 if it was interrupted.

    On the virtual clock time does not pass between two forms, so that what is
    answered depends on what is said alone, and not on when.
    """
    conversation = opened_conversation(interp, echo=True)
    if interp.clock.is_virtual or not can_be_awaited(stream):
        return answer_lines(conversation, stream.readline)
    with Lines(stream) as lines:
        try:
            return answer_lines(conversation, lambda: next_line(conversation, lines, outlet))
        except KeyboardInterrupt:
            return INTERRUPTED


def answer_lines(conversation: Conversation, next_one: Callable[[], str]) -> int:
    """Answer the lines that NEXT_ONE gives, until it gives an empty one."""
    interp, pending, balance = conversation.interp, "", Balance()
    conversation.prompt()
    while line := next_one():
        pending += line
        balance.feed(line)
        if balance.surely_open:
            continue
        with Interrupts(interp, gentle=True) as interrupts:
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


def at_plain_terminal(interp: Any, stream: TextIO, outlet: Outlet) -> int:
    """Answer what is typed at a terminal without a screen, until Ctrl-D or :quit."""
    conversation = opened_conversation(interp, echo=False)
    conversation.remarks = True
    pending = ""
    with Lines(stream) as lines:
        while True:
            try:
                if not pending:
                    conversation.prompt()
                line = next_line(conversation, lines, outlet)
                conversation.typed()
                pending = answered(conversation, pending + line, last=not line)
            except KeyboardInterrupt:
                conversation.typed()
                interp.output.write("\n")
                pending, line = "", "?"
            if not line:
                interp.output.write("\n")
                return 0


# --- with a screen -------------------------------------------------------------------


def at_terminal(interp: Any, outlet: Outlet) -> int:
    """Answer what is typed, until Ctrl-D or :quit."""
    from eslang import __version__
    from eslang.tools.editing import Editor

    conversation = opened_conversation(interp, echo=False)
    conversation.remarks = True
    editor = Editor(conversation, outlet)
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
    with Interrupts(conversation.interp, patience=PATIENCE, gentle=True) as interrupts:
        rest = conversation.hear(text, last=last)
    return rest if interrupts.code is None else ""
