"""Facts as text, and back: one fact a line, as the reader reads it.

A file of facts (saving.py) and the durable store (eslang/durable.py) hold the
same text. What has no text that is read back as the same value is refused. A
line of plain terms is read here, token by token, without the reader's tables;
any other text by the reader, and both say the same.
"""

from __future__ import annotations

import re
from types import FunctionType

from eslang.base.failure import Failure, simple_error
from eslang.base.hints import Callable, Iterator
from eslang.base.lists import Cons, from_items
from eslang.base.number_text import float_text, integer_text
from eslang.base.packages import Package
from eslang.base.printer import prin1
from eslang.base.resolve import Resolve
from eslang.base.spans import Source
from eslang.base.symbol_text import escaped_name
from eslang.base.symbols import Datum, Keyword, Symbol, Value
from eslang.base.text import Character, String
from eslang.facts.terms import Row, fact_of, value_of
from eslang.reader.atoms import Unreadable, read_character, read_string, read_token

USER = "ESL-USER"
NAMES = (Symbol, Keyword, type(None))  # classes of symbols
LARGE = 10**18  # an integer below it is surely no trouble to Python
MANY = 100_000  # tokens whose values are remembered
BLANKS = " \t\r"
DOT = object()  # what stands before the tail of a list
OTHER = object()  # instead of a value: what only the reader can tell

# Tokens as the grammar has them (reader/esl.lark): the two change together.
_PIECE = r"""[^\s()"';`,|\\\0]|\\[^\0]|\|(?:[^|\\\0]|\\[^\0])*\|"""
_ATOM = rf"""(?!\#|\.+(?![^\s()"';`,\0]))(?:{_PIECE})+(?![^\s()"';`,\0])"""
_STRING = r'"[^"\\\0]*(?:\\[^\0][^"\\\0]*)*"'
_CHARACTER = r"""\#\\[^\0][^\s()"';`,\0]*"""
_is_atom = re.compile(_ATOM).fullmatch
_next_token = re.compile(rf" *(?:(\()|(\))|({_ATOM})|({_STRING})|({_CHARACTER})|(\.)(?= ))").match
_OPEN, _CLOSE, _AN_ATOM, _A_STRING, _A_CHARACTER = 1, 2, 3, 4, 5


class Unwritable(Exception):
    """A value has no text that is read back as the same value; why."""


class Writer:
    """Writes facts. NAME_OF writes their symbols; a fact that has no text cannot be what is PLANNED."""

    def __init__(self, name_of: Callable[[Symbol | None], str], planned: str) -> None:
        self.name_of = name_of
        self.planned = planned
        self._names: dict[Symbol | None, str] = {}

    def text(self, name: Symbol, row: Row) -> str:
        """A fact as text. Raises Failure if it has none."""
        names = self._names
        try:
            parts = [names.get(name) or self._name(name)]
            for code in row:
                kind = code.__class__
                if kind is int and -LARGE < code < LARGE:
                    parts.append(str(code))
                elif kind in NAMES:
                    parts.append(names.get(code) or self._name(code))
                else:
                    parts.append(self._term(value_of(code)))
            text = f"({' '.join(parts)})"
            if "\0" in text or not text.isascii():
                _check_characters(text)
        except Unwritable as why:
            raise simple_error(f"this fact cannot be {self.planned}: {why}", fact_of(name, row)) from None
        return text

    def _name(self, symbol: Symbol | None) -> str:
        text = self._names[symbol] = self.name_of(symbol)
        return text

    def _term(self, value: Value) -> str:
        """The text of a value; the work is kept on a list, so that nesting has no limit."""
        out: list[str] = []
        work: list[Value] = [value]  # values, and texts between them
        while work:
            value = work.pop()
            if value.__class__ is str:
                out.append(value)
            elif value.__class__ is Cons:
                parts: list[Value] = ["("]
                while value.__class__ is Cons:
                    parts += [value.car, " "]
                    value = value.cdr
                parts[-1:] = [")"] if value is None else [" . ", value, ")"]
                work += reversed(parts)
            else:
                out.append(self._atom(value))
        return "".join(out)

    def _atom(self, value: Value) -> str:
        kind = value.__class__
        if kind in NAMES:
            return self._names.get(value) or self._name(value)
        if kind is String:
            return f'"{quoted(value.text)}"'
        if kind is int:
            return integer_text(value)
        if kind is float and value - value == 0:
            return float_text(value)
        if kind is Character or kind.__name__ == "Ratio":
            return prin1(value)
        raise Unwritable(_obstacle(value))


def quoted(text: str) -> str:
    """TEXT as it stands between quotation marks."""
    return text.replace("\\", "\\\\").replace('"', '\\"')


def _check_characters(text: str) -> None:
    try:
        text.encode()
    except UnicodeEncodeError:
        raise Unwritable("it holds half a character") from None
    if "\0" in text:
        raise Unwritable("it holds the character with the code 0")


def _obstacle(value: Value) -> str:
    """Why VALUE, which is not made of others, cannot be written."""
    if value.__class__ is float:
        return "no text means infinity, or what is no number"
    if value.__class__ is FunctionType:
        return "a function has no text"
    if isinstance(value, Datum):
        return "it holds an object that is equal to itself only"
    return "an object of Python has no text"


def name_text(symbol: Symbol | None) -> str:
    """The bare name of SYMBOL as the reader needs it, in lower case where that can be undone."""
    return _lowered(escaped_name("NIL" if symbol is None else symbol.name))


def _lowered(text: str) -> str:
    return text.lower() if text.isascii() and not text.startswith("|") else text


def with_home(symbol: Symbol | None) -> str:
    """The name of SYMBOL behind that of its home package. Raises Unwritable if it has none."""
    home = "COMMON-LISP" if symbol is None else symbol.package
    if home is None:
        raise Unwritable("an uninterned symbol is read as another one")
    return (":" if home == "KEYWORD" else _lowered(escaped_name(home)) + "::") + name_text(symbol)


class UserNames:
    """Names as a program in ESL-USER means them before it has defined anything, whatever it defines later.

    Symbols of its own packages stand with their home, and are found although
    that is not there yet.
    """

    def __init__(self, packages: dict[str, Package]) -> None:
        self._packages = packages
        self._meant: dict[str, Symbol | None] = {"NIL": None}
        for symbol in packages[USER].accessible():
            if symbol is not None:
                self._meant[symbol.name] = symbol

    def name_of(self, symbol: Symbol | None) -> str:
        """The text of SYMBOL. Raises Unwritable if it has no home."""
        if symbol is None:
            return name_text(symbol)
        if self._meant.get(symbol.name, symbol) is symbol and (
            symbol.package == USER or symbol.name in self._meant
        ):
            return name_text(symbol)
        return with_home(symbol)

    def resolve(self, package: str | None, name: str, external_only: bool) -> Symbol | None:
        """The symbol that has this text."""
        if package is None and name in self._meant:
            return self._meant[name]
        home = package or USER
        there = self._packages.get(home)
        if there is not None and not there.find(name)[1]:
            there.intern(name)
        return Symbol.intern(name, home)


class Scanner:
    """Reads facts; RESOLVE says what their names mean."""

    def __init__(self, resolve: Resolve) -> None:
        self.resolve = resolve
        self._known: dict[str, Value] = {}

    def forget(self) -> None:
        """Names mean something else from now on."""
        self._known.clear()

    def plain(self, line: str) -> Value:
        """The one list that LINE is; OTHER if only the reader can tell what it is."""
        if line[:1] != "(" or line[-1:] != ")":
            return OTHER
        known, fact = self._known, None
        for token in reversed(line[1:-1].split(" ")):
            value = known.get(token, OTHER)
            if value is OTHER:
                value = self._value(token)
                if value is OTHER:
                    return self._nested(line)
            fact = Cons(value, fact)
        return fact

    def _value(self, token: str) -> Value:
        """What a token means; OTHER if it is none, or a wrong one, for which the reader finds the words."""
        try:
            if token.isascii() and token.replace("-", "").isalnum() and token[0].isalpha():
                value: Value = self.resolve(None, token.upper(), False)
            elif _is_atom(token) is not None:
                value = read_token(token, self.resolve)
            else:
                return OTHER
        except Unreadable:
            return OTHER
        if len(self._known) >= MANY:
            self._known.clear()
        self._known[token] = value
        return value

    def _nested(self, line: str) -> Value:
        """The same for a list that holds strings, lists and what else the writer writes."""
        stack: list[list[Value]] = []
        position = 0
        while (found := _next_token(line, position)) is not None:
            position, kind = found.end(), found.lastindex
            if kind == _OPEN:
                stack.append([])
                continue
            if kind == _CLOSE:
                value = _list_of(stack.pop())
                if not stack and position < len(line):
                    return OTHER
            else:
                value = self._token(found[0].lstrip(" "), kind)
            if not stack or value is OTHER:
                return value
            stack[-1].append(value)
        return OTHER

    def _token(self, token: str, kind: int | None) -> Value:
        if kind == _AN_ATOM:
            value = self._known.get(token, OTHER)
            return self._value(token) if value is OTHER else value
        if kind == _A_STRING:
            return read_string(token)
        try:
            return read_character(token) if kind == _A_CHARACTER else DOT
        except Unreadable:
            return OTHER

    def forms(self, source: Source) -> Iterator[tuple[int, Value]]:
        """The forms of SOURCE, each with the number of its line. Raises EslError."""
        text, number, offset, reader = source.text, 1, 0, None
        while offset < len(text):
            end = text.find("\n", offset)
            end = len(text) if end < 0 else end
            line = text[offset:end].strip(BLANKS)
            if line and line[0] != ";":
                form = self.plain(line)
                if form is OTHER:
                    from eslang.reader.reader import Reader

                    reader = reader or Reader(source, self.resolve)
                    reader.offset = offset
                    reading = reader.read()
                    if reading is None:
                        return
                    yield reading.span.line, reading.form
                    number += text.count("\n", offset, reader.offset)
                    offset = reader.offset
                    continue
                yield number, form
            number, offset = number + 1, end + 1


def _list_of(parts: list[Value]) -> Value:
    """The list of PARTS, the last of which may be its tail, behind a dot."""
    dots = [place for place, part in enumerate(parts) if part is DOT]
    if not dots:
        return from_items(parts)
    return from_items(parts[:-2], parts[-1]) if dots == [len(parts) - 2] and len(parts) > 2 else OTHER


def read_one(text: str, name: str, resolve: Resolve) -> Value:
    """The one form that TEXT, of the file NAME, is. Raises Failure, EslError if it is none."""
    from eslang.reader.reader import read_at

    reading, end = read_at(Source(name, text), 0, resolve)
    if reading is None or text[end:].strip():
        raise Failure("error", "there is no fact here")
    return reading.form
