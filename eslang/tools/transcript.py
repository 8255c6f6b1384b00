"""Transcripts: read one, replay it, say where it first differs.

A transcript is what the papers print: `? ` and a form, which may go on over
several lines, then the lines that answered it. It stands in a .transcript
file, in a Markdown page, or in the `Example:` of a docstring. Lines that begin
with `;` are remarks. Blanks at the ends of lines, and blank lines at the end
of an answer, are not compared; everything else is, to the letter.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from io import StringIO
from typing import Any, NamedTuple

from eslang.tools.conversation import PROMPT, Conversation
from eslang.tools.narrator import narrate
from eslang.tools.tokens import Balance
from eslang.tools.words import Leave


class Entry(NamedTuple):
    """One form of a transcript, and the lines that must answer it."""

    form: str
    line: int  # of the form, in its file
    expected: list[str]
    expected_line: int  # of the first expected line


class Difference(NamedTuple):
    """The first place where a replay leaves its transcript."""

    entry: Entry
    line: int
    expected: str | None  # None: no more lines were expected
    found: str | None  # None: no more lines came
    answer: list[str]

    def text(self, name: str) -> str:
        """The difference, for a person; NAME is the file's."""
        first = self.entry.form.split("\n")[0]
        form = first if first == self.entry.form else first + " ..."
        lines = [f"{name}:{self.line}: `{form}` was answered differently"]
        lines.append(f"  expected  {self.expected if self.expected is not None else '(nothing more)'}")
        lines.append(f"  found     {self.found if self.found is not None else '(nothing more)'}")
        if len(self.answer) > 1:
            lines += ["  the whole answer:", *(f"    {line}".rstrip() for line in self.answer)]
        return "\n".join(lines)


def read_transcript(text: str, first_line: int = 1) -> list[Entry]:
    """The entries of a transcript; what stands before the first prompt is ignored."""
    entries: list[Entry] = []
    lines = text.split("\n")
    at = 0
    while at < len(lines):
        if not is_prompt(lines[at]):
            at += 1
            continue
        start = at
        form, balance = [lines[at][len(PROMPT) :]], Balance()
        balance.feed(form[0] + "\n")
        at += 1
        while balance.surely_open and at < len(lines) and not is_prompt(lines[at]):
            form.append(lines[at])
            balance.feed(lines[at] + "\n")
            at += 1
        answer = at
        while at < len(lines) and not is_prompt(lines[at]):
            at += 1
        if "".join(form).strip():
            entries.append(Entry("\n".join(form), first_line + start, lines[answer:at], first_line + answer))
    return entries


def is_prompt(line: str) -> bool:
    """True if LINE begins with the prompt; an editor may have stripped one that stands alone."""
    return line.startswith(PROMPT) or line == PROMPT.rstrip()


def comparable(lines: list[str]) -> list[tuple[int, str]]:
    """LINES as they are compared, with their numbers: no remarks, no blanks at the end of lines or answer."""
    kept = [(number, line.rstrip()) for number, line in enumerate(lines) if not line.startswith(";")]
    while kept and not kept[-1][1]:
        kept.pop()
    return kept


def difference(entry: Entry, answer: str) -> Difference | None:
    """The first difference between what ENTRY expects and ANSWER; None if there is none."""
    expected, found = comparable(entry.expected), comparable(answer.split("\n"))
    for index in range(max(len(expected), len(found))):
        wanted = expected[index][1] if index < len(expected) else None
        came = found[index][1] if index < len(found) else None
        if wanted != came:
            number = expected[index][0] if wanted is not None else len(entry.expected)
            line = entry.expected_line + number if wanted is not None else entry.line
            return Difference(entry, line, wanted, came, [text for _, text in found])
    return None


class Stage:
    """An interpreter for a replay: virtual time, the papers' trace lines, and the text it has written."""

    def __init__(self, *, seed: int = 0, listener: Callable[[Any], None] = narrate) -> None:
        from eslang.interpreter import Interpreter

        self.written = StringIO()
        self.interp: Any = Interpreter(seed=seed, clock="virtual", output=self.written)
        self.interp.hooks.speakers.append(listener)
        self.conversation = Conversation(self.interp)

    def __enter__(self) -> Stage:
        return self

    def __exit__(self, *_: object) -> None:
        self.interp.close()

    def answer_to(self, form: str) -> str:
        """What FORM is answered with."""
        with suppress(Leave):
            self.conversation.hear(form + "\n", last=True)
        return self.take()

    def take(self) -> str:
        """What was written since the last time."""
        self.interp.output.fresh_line()
        text = self.written.getvalue()
        self.written.seek(0)
        self.written.truncate()
        return text


def replay(entries: list[Entry]) -> Difference | None:
    """Replay ENTRIES in one interpreter; the first difference, None if there is none."""
    with Stage() as stage:
        for entry in entries:
            found = difference(entry, stage.answer_to(entry.form))
            if found is not None:
                return found
    return None


def example_of(docstring: str) -> list[Entry]:
    """The entries of the `Example:` of a docstring; none if it has none."""
    from textwrap import dedent

    lines = docstring.split("\n")
    heads = [number for number, line in enumerate(lines) if line.strip() == "Example:"]
    if not heads:
        return []
    depth = len(lines[heads[0]]) - len(lines[heads[0]].lstrip())
    block: list[str] = []
    for line in lines[heads[0] + 1 :]:
        if line.strip() and len(line) - len(line.lstrip()) <= depth:
            break
        block.append(line)
    return read_transcript(dedent("\n".join(block)), heads[0] + 2)
