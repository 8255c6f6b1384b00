"""Symbols as Lisp writes them: prefixes, bars and case.

A symbol is printed so that it reads back where it was printed. Which package
that is, if any, is the caller's to say.
"""

from __future__ import annotations

from eslang.base.number_text import is_number_token
from eslang.base.packages import Package
from eslang.base.symbols import Symbol

_LETTERS = frozenset("ABCDEFGHIJKLMNOPQRSTUVWXYZ*?%&$<>=!_/~^@[]{}")
_SAFE = _LETTERS | frozenset("0123456789+-.#")
_BREAKING = frozenset("()\"';,`|\\:")


def escaped_name(name: str) -> str:
    """NAME as the reader needs it: as it stands, or between bars."""
    if _SAFE.issuperset(name) and name and name[0] in _LETTERS:
        return name
    if name and not needs_bars(name):
        return name
    return "|" + name.replace("\\", "\\\\").replace("|", "\\|") + "|"


def needs_bars(name: str) -> bool:
    """True if the reader would take NAME, as it stands, for anything but a symbol of that name."""
    return (
        name != name.upper()
        or not _BREAKING.isdisjoint(name)
        or name.startswith("#")
        or not name.strip(".")
        or " " in name
        or not name.isprintable()
        or any(char.isspace() for char in name)
        or is_number_token(name)
    )


def in_case(text: str, case: str) -> str:
    """TEXT of an upper-case symbol as *PRINT-CASE* (UPCASE, DOWNCASE or CAPITALIZE) wants it."""
    if case == "UPCASE":
        return text
    if case == "DOWNCASE":
        return text.lower()
    letters, inside = [], False
    for char in text:
        letters.append(char.lower() if inside else char.upper())
        inside = char.isalnum()
    return "".join(letters)


def symbol_text(
    symbol: Symbol | None,
    escape: bool = True,
    case: str = "UPCASE",
    package: Package | None = None,
    packages: dict[str, Package] | None = None,
) -> str:
    """SYMBOL as PACKAGE needs it (None: its bare name); without ESCAPE just the name.

    PACKAGES, if given, tells which symbols of other packages are external.
    """
    name = "NIL" if symbol is None else symbol.name
    if not escape:
        return in_case(name, case)
    text = escaped_name(name)
    if case != "UPCASE" and not text.startswith("|"):
        text = in_case(text, case)
    home = "COMMON-LISP" if symbol is None else symbol.package
    if home is None:
        return "#:" + text
    if home == "KEYWORD":
        return ":" + text
    if package is None or package.find(name) == (symbol, True):
        return text
    there = packages.get(home) if packages is not None else None
    colons = ":" if there is not None and name in there.external else "::"
    return in_case(escaped_name(home), case) + colons + text
