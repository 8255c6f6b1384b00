"""Control strings of FORMAT: text and directives (CLHS 22.3).

A control string is parsed once: into pieces of text and Directives, those that
enclose others (~[ ~{ ~( ~<) holding their clauses. What each directive does is
registered here by the files that know it. A wrong control string is a failure
that names the directive and its position.
"""

from __future__ import annotations

from eslang.base.failure import Failure, simple_error
from eslang.base.hints import Any, Callable
from eslang.base.symbols import Value
from eslang.base.text import String, character

Items = list[Any]  # pieces of text (str) and Directives
Perform = Callable[[Any, "Directive"], int]  # (run, directive) → how to go on (format_run.py)

V, COUNT = "V", "#"  # parameters that an argument gives, that the number of arguments gives

_DIRECTIVES: dict[str, tuple[Perform, int]] = {}
_PAIRS = {"(": ")", "[": "]", "{": "}", "<": ">"}
_CACHE: dict[str, Items] = {}
_CACHED = 2000


def directive(chars: str, parameters: int = 0) -> Callable[[Perform], Perform]:
    """Register what the directives CHARS do, and how many parameters they take at most."""

    def register(perform: Perform) -> Perform:
        for char in chars:
            _DIRECTIVES[char] = (perform, parameters)
        return perform

    return register


class Directive:
    """One ~ and what belongs to it."""

    __slots__ = (
        "at",
        "char",
        "clauses",
        "closing",
        "colon",
        "control",
        "name",
        "parameters",
        "perform",
        "position",
        "separators",
    )
    perform: Perform

    def __init__(self, control: str, position: int) -> None:
        self.control = control
        self.position = position  # of its tilde, from 0
        self.char = ""
        self.parameters: list[Value] = []  # integers, characters, V, COUNT; None where left out
        self.colon = False
        self.at = False
        self.name = ""  # of ~/name/
        self.clauses: list[Items] = []  # what an enclosing directive encloses
        self.separators: list[Directive] = []  # the ~; between them
        self.closing: Directive | None = None

    def wrong(self, what: str, *arguments: Value) -> Failure:
        """The failure that says WHAT is wrong at this directive."""
        shown = "newline" if self.char == "\n" else self.char
        where = f"directive ~{shown} at position {self.position} of the control string"
        return simple_error(f"FORMAT: {what}, {where}", String(self.control), *arguments)


def parse_control(text: str) -> Items:
    """The pieces of a control string."""
    parsed = _CACHE.get(text)
    if parsed is None:
        if len(_CACHE) >= _CACHED:
            _CACHE.clear()
        parsed = _CACHE[text] = _Parser(text).parse()
    return parsed


class _Parser:
    """A control string being parsed: how far, and which directives are open."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.place = 0
        self.items: Items = []
        self.open: list[tuple[Directive, Items]] = []  # and the items around each

    def parse(self) -> Items:
        """All of the text."""
        text = self.text
        while self.place < len(text):
            tilde = text.find("~", self.place)
            end = len(text) if tilde < 0 else tilde
            if end > self.place:
                self.items.append(text[self.place : end])
            self.place = end
            if tilde >= 0:
                self.add(self.read_directive())
        if self.open:
            raise self.open[-1][0].wrong("never closed")
        return self.items

    def read_directive(self) -> Directive:
        """The directive that begins here."""
        found = Directive(self.text, self.place)
        self.place += 1
        self.read_parameters(found)
        while self.peek(found) in ":@":
            if found.colon if self.peek(found) == ":" else found.at:
                raise found.wrong(f"`{self.peek(found)}` given twice")
            if self.peek(found) == ":":
                found.colon = True
            else:
                found.at = True
            self.place += 1
        found.char = self.peek(found).upper()
        self.place += 1
        if found.char == "/":
            end = self.text.find("/", self.place)
            if end < 0:
                raise found.wrong("no second `/`")
            found.name, self.place = self.text[self.place : end], end + 1
        return found

    def peek(self, found: Directive) -> str:
        """The next character of the directive FOUND; a failure at the end of the text."""
        if self.place >= len(self.text):
            found.char = self.text[found.position + 1 :]
            raise found.wrong("the control string ends within a directive")
        return self.text[self.place]

    def read_parameters(self, found: Directive) -> None:
        """The parameters of FOUND, up to what is none."""
        while True:
            given, parameter = self.read_parameter(found)
            if self.peek(found) == ",":
                self.place += 1
                found.parameters.append(parameter)
                continue
            if given:
                found.parameters.append(parameter)
            return

    def read_parameter(self, found: Directive) -> tuple[bool, Value]:
        """Whether a parameter stands here, and which."""
        char = self.peek(found)
        if char == "'":
            self.place += 1
            quoted = self.peek(found)
            self.place += 1
            return True, character(quoted)
        if char in "vV#":
            self.place += 1
            return True, V if char in "vV" else COUNT
        end = self.place + (char in "+-")
        while end < len(self.text) and "0" <= self.text[end] <= "9":
            end += 1
        digits, self.place = self.text[self.place : end], end
        if digits in ("+", "-"):
            raise found.wrong(f"no digits after `{digits}`")
        return bool(digits), int(digits) if digits else None

    def add(self, found: Directive) -> None:
        """Put FOUND where it belongs."""
        if found.char == "\n":
            self.skip_newline(found)
        elif found.char == ";":
            self.begin_clause(found)
        elif found.char in _PAIRS.values():
            self.close(found)
        else:
            known = _DIRECTIVES.get(found.char)
            if known is None:
                raise found.wrong("there is no such directive")
            found.perform, most = known
            if len(found.parameters) > most:
                raise found.wrong(f"at most {most} parameters, not {len(found.parameters)}")
            if found.char in _PAIRS:
                self.open.append((found, self.items))
                self.items = []
            else:
                self.items.append(found)

    def skip_newline(self, found: Directive) -> None:
        """~newline: leave out the newline and the blanks after it, or (`:`, `@`) only one of them."""
        if found.at:
            self.items.append("\n")
        while not found.colon and self.place < len(self.text) and self.text[self.place] in " \t\n\r\f":
            self.place += 1

    def begin_clause(self, found: Directive) -> None:
        """~; ends one clause and begins the next."""
        if not self.open or self.open[-1][0].char not in "[<":
            raise found.wrong("not within ~[ or ~<")
        around = self.open[-1][0]
        around.clauses.append(self.items)
        around.separators.append(found)
        self.items = []

    def close(self, found: Directive) -> None:
        """~) and its like end what the last open directive encloses."""
        if not self.open or _PAIRS[self.open[-1][0].char] != found.char:
            raise found.wrong("nothing to close")
        opened, around = self.open.pop()
        opened.clauses.append(self.items)
        opened.closing = found
        if opened.char == "[" and opened.colon and len(opened.clauses) != 2:
            raise opened.wrong(f"exactly two clauses, not {len(opened.clauses)}")
        if opened.char == "[" and opened.at and len(opened.clauses) != 1:
            raise opened.wrong(f"exactly one clause, not {len(opened.clauses)}")
        around.append(opened)
        self.items = around
