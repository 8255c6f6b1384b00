"""Where a form stands in its text.

Lines and columns count characters from 1; a span's end is the place just
behind its last character.
"""

from __future__ import annotations

from eslang.base.hints import NamedTuple
from eslang.base.symbols import Value


class Source:
    """A text and the name people know it by (a path, `-e`, `<prompt>`)."""

    __slots__ = ("_lines", "name", "text")

    def __init__(self, name: str, text: str) -> None:
        self.name = name
        self.text = text
        self._lines: list[str] | None = None

    def line(self, number: int) -> str:
        """Line NUMBER, counted from 1, without its end; empty if there is none."""
        if self._lines is None:
            self._lines = self.text.split("\n")
        return self._lines[number - 1].rstrip("\r") if 1 <= number <= len(self._lines) else ""


class Span(NamedTuple):
    """From line:column up to, not including, end_line:end_column of a source."""

    source: Source
    line: int
    column: int
    end_line: int
    end_column: int

    def __str__(self) -> str:
        return f"{self.source.name}:{self.line}:{self.column}"


class Spans:
    """The spans of one reading: of each list by its first cons, of each element by its cons.

    Atoms have no identity of their own, so their place belongs to the cons that
    holds them. The table keeps its conses alive; it is dropped after compiling.
    """

    __slots__ = ("_table", "default")

    def __init__(self, default: Span | None = None) -> None:
        self._table: dict[int, tuple[Value, Span | None, Span | None]] = {}
        self.default = default  # the whole top-level form, for forms that macros made up

    def note(self, cons: Value, span: Span | None, element: Span | None) -> None:
        """CONS begins a list at SPAN (None: it continues one); its car stands at ELEMENT."""
        self._table[id(cons)] = (cons, span, element)

    def of(self, form: Value) -> Span | None:
        """Where the list FORM stands; None for atoms and for what no reader read."""
        entry = self._table.get(id(form))
        return entry[1] if entry is not None else None

    def element(self, cons: Value) -> Span | None:
        """Where the car of CONS stands."""
        entry = self._table.get(id(cons))
        return entry[2] if entry is not None else None

    def copy_from(self, form: Value, original: Value) -> None:
        """Let FORM, which a macro made, stand where ORIGINAL stood, unless it has a place."""
        if self.of(form) is None:
            entry = self._table.get(id(original))
            if entry is not None and form.__class__ is original.__class__:
                self._table[id(form)] = (form, entry[1], entry[2])
