"""The tokens of ESL text, as far as a prompt needs them.

For colouring what is typed, for completion, and to see cheaply that a text is
surely unfinished. The reader alone decides what a text means and whether it is
right: this file only saves asking it at every line.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

TOKEN = re.compile(
    r"""(?P<space>\s+)
      | (?P<comment>;[^\n]*)
      | (?P<block>\#\|)
      | (?P<string>"(?:[^"\\]|\\.)*"?)
      | (?P<character>\#\\.(?:[^\s()"';`,|\\])*)
      | (?P<open>\#?\()
      | (?P<close>\))
      | (?P<quote>\#'|\#[.:+-]|,@|['`,])
      | (?P<atom>(?:\\.|\|(?:[^|\\]|\\.)*\|?|[^\s()"';`,|\\])+)
      | (?P<other>.)""",
    re.VERBOSE | re.DOTALL,
)
BLOCK_PART = re.compile(r"#\||\|#")
NUMBER = re.compile(r"[+-]?(\d+(/\d+)?|\d*\.\d+([eE][+-]?\d+)?|\d+[eE][+-]?\d+)\Z")
BLANK = ("space", "comment", "block")


def tokens(text: str) -> Iterator[tuple[str, int, int]]:
    """The tokens of TEXT: kind, start, end. All of TEXT belongs to one of them."""
    position = 0
    while position < len(text):
        match = TOKEN.match(text, position)
        assert match is not None and match.lastgroup is not None
        kind, end = match.lastgroup, match.end()
        if kind == "block":
            end = block_end(text, position)
        elif kind == "atom":
            kind = atom_kind(match.group())
        yield kind, position, end
        position = end


def block_end(text: str, start: int) -> int:
    """Where the block comment that begins at START ends; the end of TEXT if it does not."""
    depth = 0
    for part in BLOCK_PART.finditer(text, start):
        depth += 1 if part.group() == "#|" else -1
        if depth == 0:
            return part.end()
    return len(text)


def atom_kind(atom: str) -> str:
    """What kind of atom the text ATOM is: keyword, number, logic variable or symbol."""
    if atom.startswith(":"):
        return "keyword"
    if atom.startswith(("?", "#?")):
        return "variable"
    return "number" if NUMBER.match(atom) else "symbol"


class Balance:
    """How much is open in a text that comes line by line."""

    def __init__(self) -> None:
        self.depth = 0
        self.held = ""  # from the start of a token that may go on in the next line

    def feed(self, text: str) -> None:
        """Take the next lines of the text."""
        text, self.held = self.held + text, ""
        for kind, start, end in tokens(text):
            if kind == "open":
                self.depth += 1
            elif kind == "close":
                self.depth = max(0, self.depth - 1)
            elif end == len(text) and goes_on(kind, text[start:end]):
                self.held = text[start:]

    @property
    def surely_open(self) -> bool:
        """True if something is open for which more text must come."""
        return self.depth > 0 or bool(self.held)


def goes_on(kind: str, token: str) -> bool:
    """True if TOKEN, the last of a text, is unfinished."""
    if kind == "string":
        return re.fullmatch(r'"(?:[^"\\]|\\.)*"', token, re.DOTALL) is None
    if kind == "block":
        depth = sum(1 if part == "#|" else -1 for part in BLOCK_PART.findall(token))
        return depth > 0
    return kind == "symbol" and re.fullmatch(r"(?:\\.|\|(?:[^|\\]|\\.)*\||[^|\\])+", token, re.DOTALL) is None


def open_lists(text: str) -> list[int]:
    """Where the lists begin that are open at the end of TEXT, outermost first."""
    stack: list[int] = []
    for kind, _, end in tokens(text):
        if kind == "open":
            stack.append(end - 1)
        elif kind == "close" and stack:
            stack.pop()
    return stack


def indentation(text: str) -> int:
    """How far to indent the line that follows TEXT: a little more than its innermost open list."""
    lists = open_lists(text)
    if not lists:
        return 0
    start = lists[-1]
    column = start - (text.rfind("\n", 0, start) + 1)
    inside = [(kind, at) for kind, at, _ in tokens(text[start + 1 :]) if kind not in BLANK]
    if not inside:
        return column + 1
    if inside[0][0] in ("open", "quote", "string", "number", "keyword"):
        return column + 1
    return column + 2


def incomplete_word(text: str) -> str:
    """The atom that TEXT ends in, as typed so far; empty if it ends otherwise."""
    found = list(tokens(text))
    if not found or found[-1][0] not in ("symbol", "keyword", "variable", "number"):
        return ""
    return text[found[-1][1] :]
