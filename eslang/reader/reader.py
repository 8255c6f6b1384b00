"""Text → forms, one top-level form at a time.

The reader runs the tables of the grammar over a text with stacks of its own,
so nesting has no limit, and notes where every list and element stands. Which
symbol a name means, it asks of a function that it is given; so the package may
change between two forms, and what stands before a mistake can be run.
"""

from __future__ import annotations

from eslang.base.hints import Any, Callable, Iterator, NamedTuple
from eslang.base.resolve import Resolve
from eslang.base.spans import Source, Span, Spans
from eslang.base.symbols import Value
from eslang.reader.atoms import (
    Unreadable,
    read_character,
    read_logical,
    read_radix,
    read_string,
    read_token,
    read_uninterned,
)
from eslang.reader.broken import explain_broken, pass_comment, place_at
from eslang.reader.building import Builder, Elements, Parts, Place
from eslang.reader.features import FEATURES, is_true, resolve_feature
from eslang.reader.mistakes import Stuck, explain, explain_token
from eslang.reader.tables import END, WRONG, tables

Evaluate = Callable[[Value], Value]

_ABSENT = object()  # what a form that a feature leaves out is read as: nothing
_UNKNOWN = object()


class Reading(NamedTuple):
    """One top-level form, the places of all it holds, and its own."""

    form: Value
    spans: Spans
    span: Span


def read_forms(
    source: Source,
    resolve: Resolve,
    *,
    evaluate: Evaluate | None = None,
    features: frozenset[str] = FEATURES,
) -> Iterator[Reading]:
    """The forms of SOURCE, each read when it is asked for. EVALUATE allows #. and answers it."""
    reader = Reader(source, resolve, 0, evaluate, features)
    while (reading := reader.read()) is not None:
        yield reading


def read_at(
    source: Source, offset: int, resolve: Resolve, *, evaluate: Evaluate | None = None
) -> tuple[Reading | None, int]:
    """The form that begins at or after OFFSET of SOURCE, and the offset behind it.

    None instead of a form tells that there is no more.
    """
    reader = Reader(source, resolve, offset, evaluate)
    return reader.read(), reader.offset


def skip(package: str | None, name: str, external_only: bool) -> None:
    """What names mean in a form that a feature leaves out."""


class Reader:
    """A text being read: how far, and what is open there."""

    def __init__(
        self,
        source: Source,
        resolve: Resolve,
        offset: int = 0,
        evaluate: Evaluate | None = None,
        features: frozenset[str] = FEATURES,
    ) -> None:
        self.source = source
        self.offset = offset
        if offset == 0 and source.text.startswith("\ufeff"):
            self.offset = 1
        self._evaluate = evaluate
        self._features = features
        self._line, column = place_at(source, offset)
        self._margin = offset - column  # a column is an offset less this
        self._newline = self._next_newline(offset)
        self._resolve = resolve
        self._known: dict[str, Value] = {}  # what each token means, within one form
        self._modes: list[tuple[Resolve, dict[str, Value]]] = []  # those outside of #+ and #-
        self._skipping = 0  # how many forms that features leave out are open
        self._level = 0  # how many more backquotes than commas are open
        self._begin(Builder(source))
        self._makers: dict[str, Callable[[str], Any]] = {
            "ATOM": self._atom,
            "STRING": read_string,
            "CHARACTER": read_character,
            "RADIX": read_radix,
            "UNINTERNED": read_uninterned,
            "LOGICAL": self._logical,
            "PREFIX": self._prefix,
            "FEATURE": self._feature,
            "EVALUATE": self._allow,
        }

    def _begin(self, builder: Builder) -> None:
        self._builder = builder
        self._start = self.offset
        self._last: Place = (1, 1)  # the end of the token before
        self._states = [tables().start]
        self._values: list[Any] = []  # what has been read; a token that waits for more, as its text
        self._marks: list[Place] = []  # where each of them begins
        self._known.clear()
        self._actions: dict[str, Callable[[Parts, list[Place], Place], Any]] = {
            "first": builder.first,
            "next": builder.next,
            "empty": builder.empty,
            "proper": builder.proper,
            "dotted": builder.dotted,
            "empty_vector": builder.empty_vector,
            "vector": builder.vector,
            "quoted": self._quoted,
            "logical": builder.logical,
            "evaluated": self._evaluated,
            "condition": self._condition,
            "conditional": self._conditional,
        }

    def read(self) -> Reading | None:
        """The next form; None at the end of the text."""
        builder = Builder(self.source)
        self._begin(builder)
        text, makers, (pattern, paths, rules, _, end_state) = self.source.text, self._makers, tables()
        states, values, marks = self._states, self._values, self._marks
        while states[-1] != end_state:
            found = pattern.match(text, self.offset)
            assert found is not None  # WRONG matches everything
            kind = found.lastgroup or WRONG
            begin, stop = found.span(kind)
            if begin > self._newline:
                self._pass_lines(begin)
            state = paths[states[-1]].get(kind)
            if state is None:
                self.offset = begin
                if self._is_over(kind, stop - begin):
                    return None
                continue
            marks.append((self._line, begin - self._margin))
            value: Any = found[kind]
            if kind in makers:
                try:
                    value = makers[kind](value)
                except Unreadable as wrong:
                    self._refuse(wrong, begin, stop)
            values.append(value)
            states.append(state)
            if stop > self._newline:
                self._pass_lines(stop)
            self.offset = stop
            self._last = (self._line, stop - self._margin)
            if rules[state] is not None:
                self._reduce(state)
        span = Span(self.source, *marks[0], *self._last)
        builder.spans.default = span
        return Reading(values[0], builder.spans, span)

    def _reduce(self, state: int) -> None:
        """Make of what is on the stacks what the grammar says, as far as it goes."""
        _, paths, rules, _, _ = tables()
        states, values, marks, end = self._states, self._values, self._marks, self._last
        while (rule := rules[state]) is not None:
            size, origin, action = rule
            parts, places = values[-size:], marks[-size:]
            del states[-size:], values[-size:], marks[-size:]
            value = self._actions[action](parts, places, end)
            if value is _ABSENT:
                return
            state = paths[states[-1]][origin]
            states.append(state)
            values.append(value)
            marks.append(places[0])

    def _pass_lines(self, offset: int) -> None:
        """Keep count of the lines up to OFFSET."""
        while self._newline < offset:
            self._line += 1
            self._margin = self._newline
            self._newline = self._next_newline(self._newline + 1)

    def _next_newline(self, offset: int) -> int:
        found = self.source.text.find("\n", offset)
        return found if found >= 0 else len(self.source.text) + 1

    def _is_over(self, kind: str, length: int) -> bool:
        """True at the end of the text; what is no token of the grammar is passed over or refused."""
        if kind == "BLOCK":
            self.offset = pass_comment(self.source, self.offset)
            return False
        if kind == END and len(self._states) == 1:
            return True
        if kind == WRONG:
            raise explain_broken(self.source, self.offset, self._start)
        waiting = self._values[-1] if self._values and self._values[-1].__class__ is str else ""
        opened = [mark for value, mark in zip(self._values, self._marks, strict=True) if _is_open(value)]
        line, column = self._line, self.offset - self._margin
        span = Span(self.source, line, column, line, column + length)
        raise explain(Stuck(self._states[-1], kind, span, waiting, opened, self._start, self._last))

    def _refuse(self, wrong: Unreadable, begin: int, stop: int) -> None:
        """Report a token that means nothing, unless a feature leaves it out."""
        if not self._skipping:
            span = Span(self.source, *place_at(self.source, begin), *place_at(self.source, stop))
            raise explain_token(wrong, span, stop == len(self.source.text))

    def _atom(self, token: str) -> Value:
        value = self._known.get(token, _UNKNOWN)
        if value is _UNKNOWN:
            value = self._known[token] = read_token(token, self._resolve)
        return value

    def _logical(self, token: str) -> Value:
        return read_logical(token, self._resolve)

    def _prefix(self, token: str) -> str:
        if token == "`":
            self._level += 1
        elif token[0] == "," and not self._skipping:
            if self._level == 0:
                raise Unreadable("unquote-outside-backquote", f"`{token}` stands outside of any backquote")
            self._level -= 1
        return token

    def _quoted(self, parts: Parts, marks: list[Place], end: Place) -> Value:
        if parts[0] == "`":
            self._level -= 1
        elif parts[0][0] == "," and not self._skipping:
            self._level += 1
        return self._builder.quoted(parts, marks, end)

    def _allow(self, token: str) -> str:
        if self._evaluate is None:
            raise Unreadable(
                "read-evaluation",
                "`#.` would run a form while it is being read",
                "not allowed here",
                "write the value, or compute it when the program runs",
            )
        return token

    def _evaluated(self, parts: Parts, marks: list[Place], end: Place) -> Value:
        return None if self._skipping or self._evaluate is None else self._evaluate(parts[1])

    def _feature(self, token: str) -> str:
        self._modes.append((self._resolve, self._known))
        self._resolve, self._known = resolve_feature, {}
        return token

    def _condition(self, parts: Parts, marks: list[Place], end: Place) -> bool:
        """Whether the form behind #+ or #- is wanted; if not, it is skipped."""
        self._resolve, self._known = self._modes.pop()
        if self._skipping:
            return True
        try:
            wanted: bool = is_true(parts[1], self._features) == (parts[0] == "#+")
        except Unreadable as wrong:
            at_end = self.offset == len(self.source.text)
            raise explain_token(wrong, Span(self.source, *marks[1], *end), at_end) from None
        if not wanted:
            self._modes.append((self._resolve, self._known))
            self._resolve, self._known = skip, {}
            self._skipping += 1
        return wanted

    def _conditional(self, parts: Parts, marks: list[Place], end: Place) -> Any:
        """The form behind a feature, or nothing; it stands where it stands itself."""
        wanted, form = parts
        marks[0] = marks[1]
        if wanted:
            return form
        self._resolve, self._known = self._modes.pop()
        self._skipping -= 1
        return _ABSENT


def _is_open(value: Any) -> bool:
    """True for what a list or vector leaves on the stack until it is closed."""
    return value.__class__ is Elements or (value.__class__ is str and value in ("(", "#("))
