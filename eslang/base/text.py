"""Characters, strings and vectors: the values that Lisp can change in place.

Lisp strings are objects of their own and not Python's, because they can be
changed, and because they must refuse arithmetic (symbols.Datum). They become
Python's at the embedding border.
"""

from __future__ import annotations

from eslang.base.symbols import Datum, Value


class Character(Datum):
    """One character; `character("a")` gives the only one of its kind, so EQ works."""

    __slots__ = ("char",)

    def __init__(self, char: str) -> None:
        self.char = char

    def __repr__(self) -> str:
        return f"Character({self.char!r})"


class _Characters(dict[str, Character]):
    def __missing__(self, char: str) -> Character:
        return self.setdefault(char, Character(char))


CHARACTERS = _Characters()


def character(char: str) -> Character:
    """The Character for a Python string of length one."""
    return CHARACTERS[char]


class String(Datum):
    """A Lisp string: `text` is its present contents, without what a fill pointer hides.

    A change replaces `text`. `fill` is True for strings made with a fill
    pointer, which VECTOR-PUSH-EXTEND may lengthen.
    """

    __slots__ = ("fill", "text")

    def __init__(self, text: str, fill: bool = False) -> None:
        self.text = text
        self.fill = fill

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"String({self.text!r})"


class Vector(Datum):
    """A one-dimensional array. `items` is all of it; `fill`, if any, its active length."""

    __slots__ = ("fill", "items")

    def __init__(self, items: list[Value], fill: int | None = None) -> None:
        self.items = items
        self.fill = fill

    def active(self) -> list[Value]:
        """The elements before the fill pointer (the very list, where there is none)."""
        return self.items if self.fill is None else self.items[: self.fill]


class Array(Datum):
    """An array of another rank than one, its elements in row-major order."""

    __slots__ = ("dimensions", "items")

    def __init__(self, dimensions: tuple[int, ...], items: list[Value]) -> None:
        self.dimensions = dimensions
        self.items = items
