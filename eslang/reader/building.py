"""Lists, vectors and quotations out of their parts, each with its place.

One method for each alias in the grammar that makes a value: it gets the parts
of the rule, where each of them begins, and where the last one ends.
"""

from __future__ import annotations

from eslang.base.hints import Any
from eslang.base.lists import Cons
from eslang.base.spans import Source, Span, Spans
from eslang.base.symbols import Symbol, Value
from eslang.base.text import Vector

PREFIXES = {
    "'": Symbol.intern("QUOTE", "COMMON-LISP"),
    "#'": Symbol.intern("FUNCTION", "COMMON-LISP"),
    "`": Symbol.intern("QUASIQUOTE", "COMMON-LISP"),
    ",": Symbol.intern("UNQUOTE", "COMMON-LISP"),
    ",@": Symbol.intern("UNQUOTE-SPLICING", "COMMON-LISP"),
    ",.": Symbol.intern("UNQUOTE-SPLICING", "COMMON-LISP"),
}
LOGICAL_BINDING = Symbol.intern("LOGICAL-BINDING", "ESL")

Place = tuple[int, int]  # line, column
Parts = list[Any]


class Elements:
    """A list or vector in the making: its elements so far, and their spans."""

    __slots__ = ("items", "spans")

    def __init__(self, item: Value, span: Span) -> None:
        self.items: list[Value] = [item]
        self.spans: list[Span] = [span]


class Builder:
    """Makes the values of one top-level form, and notes their spans."""

    __slots__ = ("source", "spans")

    def __init__(self, source: Source) -> None:
        self.source = source
        self.spans = Spans()

    def first(self, parts: Parts, marks: list[Place], end: Place) -> Elements:
        """The beginning of a list or vector, and its first element."""
        return Elements(parts[1], Span(self.source, *marks[1], *end))

    def next(self, parts: Parts, marks: list[Place], end: Place) -> Elements:
        """One more element."""
        elements: Elements = parts[0]
        elements.items.append(parts[1])
        elements.spans.append(Span(self.source, *marks[1], *end))
        return elements

    def empty(self, parts: Parts, marks: list[Place], end: Place) -> Value:
        """()"""
        return None

    def proper(self, parts: Parts, marks: list[Place], end: Place) -> Value:
        """A list that ends in NIL."""
        return self._chain(parts[0], None, Span(self.source, *marks[0], *end))

    def dotted(self, parts: Parts, marks: list[Place], end: Place) -> Value:
        """A list with another end."""
        return self._chain(parts[0], parts[2], Span(self.source, *marks[0], *end))

    def empty_vector(self, parts: Parts, marks: list[Place], end: Place) -> Vector:
        """#()"""
        return Vector([])

    def vector(self, parts: Parts, marks: list[Place], end: Place) -> Vector:
        """A vector of the elements as they stand."""
        return Vector(parts[0].items)

    def quoted(self, parts: Parts, marks: list[Place], end: Place) -> Value:
        """'x and its kin: a list of an operator, which is the prefix, and x."""
        line, column = marks[0]
        sign = Span(self.source, line, column, line, column + len(parts[0]))
        elements = Elements(PREFIXES[parts[0]], sign)
        elements.items.append(parts[1])
        elements.spans.append(Span(self.source, *marks[1], *end))
        return self._chain(elements, None, Span(self.source, *marks[0], *end))

    def logical(self, parts: Parts, marks: list[Place], end: Place) -> Value:
        """#?x: (logical-binding ?x)."""
        line, column = marks[0]
        elements = Elements(LOGICAL_BINDING, Span(self.source, line, column, line, column + 2))
        elements.items.append(parts[0])
        elements.spans.append(Span(self.source, line, column + 1, *end))
        return self._chain(elements, None, Span(self.source, *marks[0], *end))

    def _chain(self, elements: Elements, tail: Value, span: Span) -> Value:
        """The conses of a list, from the last to the first."""
        note = self.spans.note
        spans = elements.spans
        for number in range(len(spans) - 1, 0, -1):
            tail = Cons(elements.items[number], tail)
            note(tail, None, spans[number])
        tail = Cons(elements.items[0], tail)
        note(tail, span, spans[0])
        return tail
