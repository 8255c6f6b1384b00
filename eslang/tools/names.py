"""What the names of an interpreter mean, for completion and documentation."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from eslang.base.image import Cell
from eslang.base.symbols import Keyword, Symbol


def find_symbol(interp: Any, text: str) -> Symbol | None:
    """The symbol that TEXT names in the current package, `package:name` too; None if there is none."""
    interp.compiler("<names>")  # brings the special forms
    name, package = text.upper(), interp.image.package
    if ":" in name.strip(":"):
        prefix, _, name = name.partition(":")
        package = interp.image.packages.get(prefix)
        name = name.lstrip(":")
    return package.find(name)[0] if package is not None else None


def is_known(cell: Cell) -> bool:
    """True if CELL means something: a function, macro, variable or what is defined otherwise."""
    return (
        cell.definition is not None
        or cell.macro is not None
        or cell.special
        or cell.constant
        or getattr(cell, "function", None) is not None
    )


def signature_of(interp: Any, text: str) -> str | None:
    """The signature of the operator that TEXT names, in lower case."""
    symbol = find_symbol(interp, text)
    definition = interp.definition(symbol) if symbol is not None else None
    return (
        str(definition.signature) if definition is not None and definition.signature.startswith("(") else None
    )


def known_names(interp: Any) -> Iterator[tuple[str, str]]:
    """Each name that means something in the current package, with its signature; in alphabetical order."""
    interp.compiler("<names>")  # brings the special forms
    found: dict[str, str] = {}
    for symbol in interp.image.package.accessible():
        if not isinstance(symbol, Symbol) or isinstance(symbol, Keyword) or symbol.name.startswith("%"):
            continue
        cell = interp.image.cells.get(symbol)
        if cell is not None and is_known(cell):
            definition = interp.definition(symbol)
            found[symbol.name] = definition.signature if definition is not None else ""
    yield from sorted(found.items())


def relations(interp: Any) -> Iterable[tuple[str, str]]:
    """The names of the relations of the database, each with a pattern of it; in alphabetical order."""
    from eslang.tools.fact_tables import FactTables

    tables = FactTables(interp.database, 80)
    found = {named.name.name: tables.pattern(named) for named in tables.relations()}
    return sorted(found.items())
