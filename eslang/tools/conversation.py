"""A conversation with one interpreter, as at the papers' prompt.

A text comes in; each form of it is answered by its values, one a line, by the
papers' lines for a failure, or by a diagnostic. The tasks that it has spawned
go on for a moment before the next one. The prompt (repl.py) and the replay of
transcripts (transcript.py) are both this conversation, so that what a
transcript shows is what a person sees. Nothing here knows a terminal.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from eslang.base.control import Stop
from eslang.base.diagnostics import EslError, IncompleteInput
from eslang.base.failure import Failure
from eslang.base.lists import from_items
from eslang.base.render import render
from eslang.base.spans import Source, Span
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.lisp.output import shown
from eslang.tools.census import Census
from eslang.tools.endings import QUIT
from eslang.tools.interrupts import INTERRUPTED
from eslang.tools.meanwhile import Meanwhile, Rest
from eslang.tools.report import bug_report, remark
from eslang.tools.words import WORDS, Leave, Word

PROMPT = "? "


class Writes(Protocol):
    """Something that text can be written to."""

    def write(self, text: str, /) -> object:
        """Write TEXT."""


class Conversation:
    """One interpreter, what it last answered, and where complaints go."""

    def __init__(
        self, interp: Any, errors: Writes | None = None, *, echo: bool = False, colour: bool = False
    ) -> None:
        self.interp = interp
        self.output = interp.output
        self.errors = errors  # None: among the answers, as in a transcript
        self.echo = echo  # print the forms: the input is not seen otherwise
        self.colour = colour  # of diagnostics
        self.remarks = False  # say a little more about a failure than the papers do
        self.prompted = False  # the prompt stands there, waiting
        self.failure: Failure | None = None  # the last one that nothing answered
        self.mistakes = 0  # forms that were no right program
        self.census = Census(interp)
        self.meanwhile = Meanwhile(interp)
        self.history = History(interp.image)

    def prompt(self) -> None:
        """Print the prompt, unless it stands there already."""
        if not self.prompted:
            self.output.fresh_line()
            self.output.write(PROMPT)
            self.prompted = True

    def typed(self) -> None:
        """Somebody has typed a line behind the prompt; the terminal has shown it."""
        self.prompted = False
        self.output.column = 0

    def hear(self, text: str, *, last: bool = False) -> str:
        """Answer the forms of TEXT; return the beginning of a form that TEXT leaves unfinished.

        With LAST, nothing more will come: an unfinished form is a mistake.
        """
        done = 0
        try:
            readings = self.interp.readings(source_of(text, "<prompt>"))
        except EslError as error:
            self.refuse(text, error)
            return ""
        while True:
            begun = done
            try:
                reading = next(readings, None)
                if reading is None:
                    return ""
                start, done = extent(text, reading.span)
                word, argument, done = said_with(reading, readings, text, done)
            except EslError as error:
                if isinstance(error, IncompleteInput) and not last:
                    return text[begun:]
                self.refuse(text[begun:], error)
                return ""
            if self.echo:
                self.show(text[start:done])
            if word is not None:
                word.answer(self, argument)
            elif not self.answer(reading):
                return ""
            self.settle()
            if word is not None and word.takes_name:
                return self.hear(text[done:], last=last)

    def refuse(self, text: str, error: EslError) -> None:
        """Say that TEXT cannot be read."""
        if self.echo:
            self.show(text.strip())
        self.complain(error)

    def show(self, form: str) -> None:
        """Print FORM behind the prompt, as if it had been typed there."""
        self.prompt()
        self.output.write(form + "\n")
        self.prompted = False

    def answer(self, reading: Any) -> bool:
        """Evaluate one form and print what comes of it; false if it was interrupted."""
        self.history.begin(reading.form)

        def tell(values: list[Value]) -> None:
            self.history.end(reading.form, values)
            for value in values:
                self.print_value(value)

        return self.attempt(lambda: self.interp.evaluate(reading), tell)

    def attempt(self, work: Callable[[], Any], tell: Callable[[Any], object]) -> bool:
        """Do WORK and TELL what it gave, or say what went wrong; false if it was interrupted."""
        try:
            given = work()
        except Failure as failure:
            self.note_fallen()
            self.failure = failure  # the narrator has spoken
            if self.remarks:
                self.write_error(remark(failure, self.interp))
        except EslError as error:
            self.complain(error)
        except Stop as stop:
            self.stopped(stop)
            return False
        except Exception as bug:
            self.write_error(bug_report(bug))
        else:
            tell(given)
        self.output.fresh_line()
        return True

    def print_value(self, value: Value) -> None:
        """Print VALUE on a line of its own."""
        self.output.fresh_line()
        with self.interp.at_work():
            self.output.write(shown(value) + "\n")

    def settle(self) -> None:
        """Let the tasks that forms have spawned go on for a moment."""
        try:
            self.meanwhile.settle()
        except Stop as stop:
            self.stopped(stop)
        self.output.fresh_line()
        self.note_fallen()

    def go_on(self, done: Callable[[], bool], rest: Rest) -> None:
        """Let tasks go on until DONE; where all wait, REST."""
        try:
            self.meanwhile.go_on(done, rest)
        except Stop as stop:
            self.stopped(stop)
        self.note_fallen()

    def burst(self, is_over: Callable[[], bool]) -> float | None:
        """Let tasks go on until IS_OVER, or all wait; the seconds until one goes on by itself."""
        try:
            return self.meanwhile.burst(is_over)
        except Stop as stop:
            self.stopped(stop)
            return 0.0
        finally:
            self.note_fallen()

    def note_fallen(self) -> None:
        """Remember, and remark, that tasks have failed whose failures the narrator has told."""
        for task in self.census.take_fallen():
            assert task.failure is not None
            self.failure = Failure(task.failure.cause, *task.failure.arguments)
            self.failure.origin = task
            if self.remarks:
                self.write_error(f"; task {task.name} has failed; :why tells more")

    def stopped(self, stop: Stop) -> None:
        """What runs was ended from outside, or by (quit)."""
        if stop.reason == QUIT or stop.code != INTERRUPTED:
            raise Leave(stop.code)
        self.output.fresh_line()
        self.output.write("Aborted\n")

    def complain(self, error: EslError) -> None:
        """Say what is wrong with a program."""
        self.mistakes += 1
        self.write_error(render(error.diagnostic, self.colour))

    def write_error(self, text: str) -> None:
        """Write a diagnostic, on a line of its own."""
        self.output.fresh_line()
        text = text.rstrip("\n") + "\n" if text else ""
        if self.errors is None:
            self.output.write(text)
        else:
            self.output.flush()
            self.errors.write(text)


class History:
    """The variables of the prompt: - + ++ +++ * ** *** / // ///, as Common Lisp has them."""

    def __init__(self, image: Any) -> None:
        names = ("-", "+", "++", "+++", "*", "**", "***", "/", "//", "///")
        self.cells = {name: image.cell(Symbol.intern(name, "COMMON-LISP")) for name in names}
        for name, cell in self.cells.items():
            image.packages["COMMON-LISP"].export(name)
            cell.special = True
            cell.value = None

    def begin(self, form: Value) -> None:
        """FORM is about to be evaluated."""
        self.cells["-"].value = form

    def end(self, form: Value, values: list[Value]) -> None:
        """FORM gave VALUES."""
        self._push("+", form)
        self._push("*", values[0] if values else None)
        self._push("/", from_items(values))

    def _push(self, name: str, value: Value) -> None:
        first, second, third = (self.cells[name * count] for count in (1, 2, 3))
        third.value, second.value, first.value = second.value, first.value, value


def source_of(text: str, name: str) -> Source:
    """TEXT as a source; an error if some of the bytes that it came from were no UTF-8."""
    from eslang.base.decoding import decode

    return decode(text.encode("utf-8", "surrogateescape"), name)


def said_with(reading: Any, readings: Any, text: str, done: int) -> tuple[Word | None, Any, int]:
    """The word that READING is, if it is one, what it is said of, and where in TEXT that ends."""
    word = WORDS.get(reading.form) if isinstance(reading.form, Keyword) else None
    if word is None or not (word.takes_name or word.takes_form):
        return word, None, done
    end = end_of_line(text, done)
    if word.takes_name:
        return word, text[done:end].strip(), end
    behind = next(readings, None) if end > done else None
    return word, *((behind.form, extent(text, behind.span)[1]) if behind is not None else (None, done))


def end_of_line(text: str, start: int) -> int:
    """Where in TEXT the line ends that START stands in, or the remark at its end begins."""
    end = text.find("\n", start)
    line = text[start:] if end < 0 else text[start:end]
    return start + len(line.partition(";")[0].rstrip())


def extent(text: str, span: Span) -> tuple[int, int]:
    """Where in TEXT the form at SPAN begins and ends."""
    starts = [0]
    for line in text.split("\n"):
        starts.append(starts[-1] + len(line) + 1)
    return starts[span.line - 1] + span.column - 1, starts[span.end_line - 1] + span.end_column - 1
