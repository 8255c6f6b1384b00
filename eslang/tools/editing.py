"""The line editor of the prompt, on prompt-toolkit: the only file that knows it.

Enter ends what is complete, by the reader's judgement, and else begins a new,
indented line. Tab completes names and shows their signatures; the toolbar
shows the signature of the operator at hand. What was typed is remembered from
session to session, where it can be written.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from prompt_toolkit import PromptSession
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
from eslang.tools.names import known_names, signature_of
from eslang.tools.tokens import incomplete_word, indentation, open_lists, tokens

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

    def __init__(self, interp: Any, prompt: str) -> None:
        self.interp = interp
        self.session: PromptSession[str] = PromptSession(
            prompt,
            multiline=True,
            lexer=TokenLexer(),
            completer=NameCompleter(interp),
            complete_while_typing=False,
            history=history(),
            key_bindings=keys(interp),
            style=STYLE,
            prompt_continuation="  ",
            bottom_toolbar=self.toolbar,
            input_processors=[HighlightMatchingBracketProcessor(chars="()")],
        )

    def read(self) -> str:
        """The next text; EOFError at Ctrl-D, KeyboardInterrupt at Ctrl-C."""
        return self.session.prompt()

    def toolbar(self) -> str | None:
        """The signature of the operator whose arguments are being typed."""
        return signature_at(self.interp, self.session.default_buffer.document.text_before_cursor)


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
    """Completes names that mean something in the current package, with their signatures."""

    def __init__(self, interp: Any) -> None:
        self.interp = interp

    def get_completions(self, document: Document, event: CompleteEvent) -> Iterable[Completion]:
        """The names that begin with the word before the cursor."""
        word = incomplete_word(document.text_before_cursor)
        if not word:
            return
        upper = word != word.lower()
        for name, meta in known_names(self.interp):
            if name.startswith(word.upper()):
                shown = name if upper else name.lower()
                yield Completion(shown, start_position=-len(word), display_meta=meta)


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
