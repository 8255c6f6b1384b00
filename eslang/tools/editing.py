"""The line editor of the prompt, on prompt-toolkit: the only file that knows it.

Enter ends what is complete, by the reader's judgement, and else begins a new,
indented line. Tab completes names and shows their signatures; the toolbar
shows the signature of the operator at hand. What was typed is remembered from
session to session, where it can be written. While a person types, tasks go on
in short bursts, and what they write appears above the prompt.
"""

from __future__ import annotations

import asyncio
import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any, TextIO

from prompt_toolkit import PromptSession
from prompt_toolkit.application import run_in_terminal
from prompt_toolkit.completion import CompleteEvent, Completer, Completion
from prompt_toolkit.document import Document
from prompt_toolkit.formatted_text import StyleAndTextTuples
from prompt_toolkit.history import FileHistory, History, InMemoryHistory
from prompt_toolkit.key_binding import KeyBindings, KeyPressEvent
from prompt_toolkit.layout.processors import HighlightMatchingBracketProcessor
from prompt_toolkit.lexers import Lexer
from prompt_toolkit.styles import Style

from eslang.base.diagnostics import EslError, IncompleteInput
from eslang.base.spans import Source
from eslang.tools.conversation import PROMPT, Conversation
from eslang.tools.interrupts import PATIENCE, Interrupts
from eslang.tools.names import known_names, relations, signature_of
from eslang.tools.opening import Outlet
from eslang.tools.tokens import incomplete_word, indentation, open_lists, tokens
from eslang.tools.words import WORDS, Leave

BURST = 0.02  # seconds that tasks go on between two looks at the keys
POLL = 0.05  # seconds between two looks at what goes on outside
LONG = 3600.0
NAMED = [str(name).lower() for name, word in WORDS.items() if word.takes_name]
FORMS = [str(name).lower() for name, word in WORDS.items() if word.takes_form]

STYLE = Style.from_dict(
    {
        "comment": "ansibrightblack",
        "block": "ansibrightblack",
        "string": "ansigreen",
        "character": "ansigreen",
        "keyword": "ansicyan",
        "number": "ansimagenta",
        "variable": "ansiyellow",
        "quote": "ansiblue",
        "operator": "bold",
        "bottom-toolbar": "noreverse ansibrightblack",
        "matching-bracket.cursor": "bold",
        "matching-bracket.other": "bold underline",
    }
)


class Editor:
    """Reads what a person types, one complete text at a time."""

    def __init__(self, conversation: Conversation, outlet: Outlet) -> None:
        self.conversation = conversation
        self.interp = interp = conversation.interp
        self.outlet = outlet
        self.session: PromptSession[str] = PromptSession(
            PROMPT,
            multiline=True,
            lexer=TokenLexer(),
            completer=NameCompleter(conversation),
            complete_while_typing=False,
            history=history(),
            key_bindings=keys(interp),
            style=STYLE,
            prompt_continuation="  ",
            bottom_toolbar=self.toolbar,
            input_processors=[HighlightMatchingBracketProcessor(chars="()")],
        )

    def read(self) -> str:
        """The next text; EOFError at Ctrl-D, KeyboardInterrupt at Ctrl-C. Raises Leave if a task quits."""
        return asyncio.run(self._read())

    async def _read(self) -> str:
        """The same; what tasks write meanwhile is kept until it can be shown."""
        above = Above(self.outlet.stream)
        conversation, errors = self.conversation, sys.stderr
        self.outlet.stream = conversation.errors = sys.stderr = above  # type: ignore[assignment]
        tasks = asyncio.ensure_future(self._go_on(above))
        try:
            text = await self.session.prompt_async()
        finally:
            tasks.cancel()
            await asyncio.wait([tasks])
            self.interp.output.fresh_line()
            self.outlet.stream, conversation.errors, sys.stderr = above.stream, errors, errors
            above.show()
        if not tasks.cancelled() and isinstance(tasks.exception(), Leave):
            tasks.result()
        return text

    async def _go_on(self, above: Above) -> None:
        """Let tasks go on, for as long as somebody types; what ends that ends the typing, too."""
        scheduler = self.interp.scheduler
        try:
            while True:
                pause = self._burst()
                if pause != 0:
                    self.interp.output.fresh_line()
                if above.has_lines:
                    await run_in_terminal(above.show)
                longest = POLL if scheduler.outside else LONG
                await asyncio.sleep(longest if pause is None else min(pause, longest))
        except Exception as reason:
            with suppress(Exception):  # somebody has just pressed Enter
                self.session.app.exit(exception=reason)
            if isinstance(reason, Leave):
                raise

    def _burst(self) -> float | None:
        """Let tasks go on for a little, or until Ctrl-C; the seconds until one of them goes on."""
        loop = asyncio.get_running_loop()
        end = loop.time() + BURST
        interrupts = Interrupts(self.interp, patience=PATIENCE, gentle=True)
        with CtrlCSignals(self.session.input.fileno()), interrupts:
            return self.conversation.burst(lambda: loop.time() >= end or interrupts.code is not None)

    def toolbar(self) -> str | None:
        """The signature of the operator whose arguments are being typed."""
        return signature_at(self.interp, self.session.default_buffer.document.text_before_cursor)


class CtrlCSignals:
    """While entered, Ctrl-C is a signal, although a program reads the keys: a task may keep it from that."""

    def __init__(self, terminal: int) -> None:
        self.terminal = terminal
        self.before: list[Any] | None = None

    def __enter__(self) -> None:
        with suppress(ImportError):
            import termios

            self.before = termios.tcgetattr(self.terminal)
            changed = [*self.before[:6], [*self.before[6]]]
            changed[3] |= termios.ISIG | termios.NOFLSH
            changed[6][termios.VSUSP] = changed[6][termios.VQUIT] = b"\0"
            termios.tcsetattr(self.terminal, termios.TCSANOW, changed)

    def __exit__(self, *_: object) -> None:
        if self.before is not None:
            import termios

            termios.tcsetattr(self.terminal, termios.TCSANOW, self.before)


class Above:
    """What is written while the prompt stands: it is to appear above it, in whole lines."""

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream
        self.kept: list[str] = []
        self.has_lines = False

    def write(self, text: str) -> None:
        """Keep TEXT."""
        self.kept.append(text)
        self.has_lines = self.has_lines or "\n" in text

    def flush(self) -> None:
        """It is shown when the prompt can make way."""

    def show(self) -> None:
        """Write the lines that are whole."""
        lines, newline, rest = "".join(self.kept).rpartition("\n")
        self.stream.write(lines + newline)
        self.stream.flush()
        self.kept, self.has_lines = [rest], False


def signature_at(interp: Any, before: str) -> str | None:
    """The signature of the innermost operator known whose list is open at the end of the text BEFORE."""
    for start in reversed(open_lists(before)):
        words = before[start + 1 :].split(None, 1)
        operator = incomplete_word(words[0]) if words else ""
        signature = signature_of(interp, operator) if operator else None
        if signature is not None:
            return signature
    return None


def is_complete(interp: Any, text: str) -> bool:
    """True unless TEXT ends inside a form. A wrong text is complete: its diagnostic comes at once."""
    try:
        for _ in interp.readings(Source("<prompt>", text)):
            pass
    except IncompleteInput:
        return False
    except EslError:
        return True
    return True


def keys(interp: Any) -> KeyBindings:
    """What Enter does."""
    bindings = KeyBindings()

    @bindings.add("enter")
    def _(event: KeyPressEvent) -> None:
        buffer = event.current_buffer
        if is_complete(interp, buffer.text):
            buffer.validate_and_handle()
        else:
            buffer.insert_text("\n" + " " * indentation(buffer.document.text_before_cursor))

    return bindings


class TokenLexer(Lexer):
    """Colours by kind of token; the operator of each list stands out."""

    def lex_document(self, document: Document) -> Any:
        """The coloured fragments of each line of DOCUMENT."""
        lines: list[StyleAndTextTuples] = [[]]
        after_open = False
        for kind, start, end in tokens(document.text):
            style = "operator" if after_open and kind == "symbol" else kind
            if kind not in ("space", "comment", "block"):
                after_open = kind == "open"
            for number, part in enumerate(document.text[start:end].split("\n")):
                if number:
                    lines.append([])
                lines[-1].append((f"class:{style}", part))
        return lambda number: lines[number] if number < len(lines) else []


class NameCompleter(Completer):
    """Completes names that mean something in the current package, its own words, tasks, relations."""

    def __init__(self, conversation: Conversation) -> None:
        self.conversation = conversation

    def get_completions(self, document: Document, event: CompleteEvent) -> Iterable[Completion]:
        """The names that begin with the word before the cursor."""
        before = document.text_before_cursor
        word = incomplete_word(before)
        for name, meta in self.candidates(before[: len(before) - len(word)].strip().lower(), word):
            if name.startswith(word.upper()):
                shown = name if word != word.lower() else name.lower()
                yield Completion(shown, start_position=-len(word), display_meta=meta)

    def candidates(self, before: str, word: str) -> Iterator[tuple[str, str]]:
        """What may stand behind the text BEFORE and begin with WORD, with a remark on each."""
        if before in NAMED:
            yield from [(name.upper(), "") for name in self.conversation.census.names()]
        elif before in FORMS:
            yield from relations(self.conversation.interp)
        elif word.startswith(":") and not before:
            yield from [(str(name), "") for name in WORDS]
        elif word:
            yield from known_names(self.conversation.interp)
            yield from relations(self.conversation.interp)


class KeptHistory(FileHistory):
    """A history file that may become unwritable without harm."""

    def store_string(self, string: str) -> None:
        """Remember STRING, if the file can still be written."""
        try:
            super().store_string(string)
        except OSError:
            return


def history() -> History:
    """The history of former sessions; one that forgets, where no file can be had."""
    state = os.environ.get("XDG_STATE_HOME") or os.path.join(os.path.expanduser("~"), ".local", "state")
    path = Path(state, "eslang", "history")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(path, "a", encoding="utf-8"):
            return KeptHistory(str(path))
    except OSError:
        return InMemoryHistory()
