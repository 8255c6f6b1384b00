"""Packages: which symbol a name means.

A package belongs to one interpreter; the symbols in it are shared by all
(symbols.py). Names are as they stand: whoever reads upcases first.
"""

from __future__ import annotations

from eslang.base.hints import Iterable
from eslang.base.symbols import Datum, Symbol


class Package(Datum):
    """A name space: symbols of its own, which of them are external, and the packages it uses."""

    __slots__ = ("external", "name", "nicknames", "present", "shadowing", "uses")

    def __init__(self, name: str, nicknames: Iterable[str] = ()) -> None:
        self.name = name
        self.nicknames = tuple(nicknames)
        self.uses: list[Package] = []
        self.present: dict[str, Symbol] = {}
        self.external: set[str] = set()
        self.shadowing: set[str] = set()

    def find(self, name: str) -> tuple[Symbol | None, bool]:
        """The accessible symbol called NAME (None: there is none), and whether one was found.

        Two results, because the symbol NIL is None.
        """
        if name in self.present:
            return self.present[name], True
        for used in self.uses:
            if name in used.external:
                return used.present[name], True
        return None, False

    def intern(self, name: str) -> Symbol | None:
        """The accessible symbol called NAME, made here if there is none."""
        symbol, found = self.find(name)
        if found:
            return symbol
        symbol = Symbol.intern(name, self.name)
        self.present[name] = symbol
        if self.name == "KEYWORD":
            self.external.add(name)
        return symbol

    def export(self, name: str) -> None:
        """Make NAME external, importing it first if it is only inherited."""
        self.present.setdefault(name, self.intern(name))  # type: ignore[arg-type]
        self.external.add(name)

    def shadow(self, name: str) -> None:
        """Give this package a symbol NAME of its own, whatever it inherits."""
        self.shadowing.add(name)
        if name not in self.present:
            self.present[name] = Symbol.intern(name, self.name)

    def import_symbol(self, symbol: Symbol, *, shadowing: bool = False) -> None:
        """Make SYMBOL accessible here under its own name."""
        self.present[symbol.name] = symbol
        if shadowing:
            self.shadowing.add(symbol.name)

    def use(self, other: Package) -> None:
        """Inherit what OTHER exports."""
        if other is not self and other not in self.uses:
            self.uses.append(other)

    def accessible(self) -> Iterable[Symbol]:
        """Every symbol that a bare name can mean here."""
        yield from self.present.values()
        for used in self.uses:
            for name in used.external:
                if name not in self.present:
                    yield used.present[name]
