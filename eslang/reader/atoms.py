"""What one token means: a number, a symbol, a character, a string.

As Common Lisp has it, a token is first gathered and then understood: as a
number if it looks like one, else as a symbol. Names are upcased here, except
what `\\` and `|` protect. What cannot be understood is Unreadable; where it
stands is the reader's business.
"""

from __future__ import annotations

import re

from eslang.base.character_names import CHARACTER_CALLED, find_character
from eslang.base.number_text import DIGITS, digits_value
from eslang.base.resolve import NotExternal, Resolve, UnknownPackage
from eslang.base.suggest import nearest
from eslang.base.symbols import Symbol, Value
from eslang.base.text import Character, String, character

_NUMBER = re.compile(
    r"(?P<integer>[+-]?[0-9]+)\.?"
    r"|(?P<numerator>[+-]?[0-9]+)/(?P<denominator>[0-9]+)"
    r"|(?P<mantissa>[+-]?(?:[0-9]*\.[0-9]+|[0-9]+(?:\.[0-9]*)?(?=[eEsSfFdDlL])))"
    r"(?:[eEsSfFdDlL](?P<exponent>[+-]?[0-9]+))?"
)
_NUMBER_STARTS = frozenset("+-.0123456789")
_PROTECTED = re.compile(r"\\(.)|\|((?:[^|\\]|\\.)*)\||(:+)|([^\\|:]+)", re.DOTALL)
_ESCAPED = re.compile(r"\\(.)", re.DOTALL)
_BASES = {"x": 16, "o": 8, "b": 2}


class Unreadable(Exception):
    """A token that means nothing: the name of the mistake, and words for it."""

    def __init__(self, name: str, message: str, label: str = "", hint: str | None = None) -> None:
        super().__init__(message)
        self.name, self.message, self.label, self.hint = name, message, label, hint


def read_token(token: str, resolve: Resolve) -> Value:
    """The number or symbol that TOKEN stands for."""
    if token[0] in _NUMBER_STARTS:
        found = _NUMBER.fullmatch(token)
        if found is not None:
            return _number(found)
    package, name, external_only = split_symbol(token)
    try:
        return resolve(package, name, external_only)
    except UnknownPackage as unknown:
        raise _unknown_package(unknown, token) from None
    except NotExternal as absent:
        raise _not_external(absent, token) from None


def _number(found: re.Match[str]) -> Value:
    if (integer := found["integer"]) is not None:
        return _integer(integer)
    if (numerator := found["numerator"]) is not None:
        return _ratio(_integer(numerator), digits_value(found["denominator"]), found[0])
    text = f"{found['mantissa']}e{found['exponent'] or 0}"
    value = float(text)
    if value in (float("inf"), float("-inf")):
        raise Unreadable("number-out-of-range", f"`{found[0]}` is too large for a float")
    if value == 0 and found["mantissa"].strip("+-0."):
        raise Unreadable("number-out-of-range", f"`{found[0]}` is too small for a float")
    return value


def _integer(text: str, base: int = 10) -> int:
    digits = text.lstrip("+-")
    return -digits_value(digits, base) if text[0] == "-" else digits_value(digits, base)


def _ratio(numerator: int, denominator: int, text: str) -> Value:
    from eslang.base.ratios import divide

    if denominator == 0:
        raise Unreadable("bad-number", f"`{text}` has a denominator of zero")
    return divide(numerator, denominator)


def split_symbol(token: str) -> tuple[str | None, str, bool]:
    """The package (None: the current one), the name, and whether only an external symbol will do."""
    if ":" not in token and "\\" not in token and "|" not in token:
        if not token.strip("."):
            raise Unreadable("bad-symbol", f"`{token}` is nothing but dots", "", f"write `|{token}|`")
        return None, _upcase(token), False
    names, colons = [""], ""
    for escaped, barred, colon, plain in _PROTECTED.findall(token):
        if colon:
            colons += colon + " "
            names.append("")
        else:
            names[-1] += escaped or _ESCAPED.sub(r"\1", barred) or _upcase(plain)
    marks = colons.split()
    if not marks:
        return None, names[0], False
    if len(marks) > 1 or len(marks[0]) > 2:
        raise Unreadable("bad-symbol", f"`{token}` has too many colons", "at most one package and one name")
    if not names[1] and not token.endswith("|"):
        raise Unreadable("bad-symbol", f"`{token}` has no name behind its colon")
    if not names[0]:
        if marks[0] == "::":
            raise Unreadable("bad-symbol", f"`{token}` has no package before its colons", "", "write one `:`")
        return "KEYWORD", names[1], False
    return names[0], names[1], marks[0] == ":"


def _upcase(text: str) -> str:
    if text.isascii():
        return text.upper()
    return "".join([char.upper() if len(char.upper()) == 1 else char for char in text])


def _unknown_package(unknown: UnknownPackage, token: str) -> Unreadable:
    package, colon, name = token.partition(":")
    near = nearest(unknown.package, unknown.known)
    hint = f"write `{_recased(near, token)}{colon}{name}`" if near else None
    return Unreadable("unknown-package", f"there is no package `{package}`", "", hint)


def _recased(name: str, token: str) -> str:
    """NAME in the case in which the user writes."""
    return name.lower() if token == token.lower() else name


def _not_external(absent: NotExternal, token: str) -> Unreadable:
    package, _, name = token.partition(":")
    if absent.present:
        message, label = f"`{name}` is not external in the package `{package}`", "internal"
        return Unreadable("not-external", message, label, f"write `{package}::{name}`")
    near = nearest(absent.name, absent.external)
    hint = f"write `{package}:{_recased(near, token)}`" if near else None
    return Unreadable("not-external", f"the package `{package}` has no symbol `{name}`", "", hint)


def read_string(token: str) -> String:
    """The string of a token with its quotation marks."""
    body = token[1:-1]
    return String(_ESCAPED.sub(r"\1", body) if "\\" in body else body)


def read_character(token: str) -> Character:
    """The character of a token such as #\\a or #\\Space."""
    name = token[2:]
    if len(name) == 1:
        return character(name)
    char = find_character(name)
    if char is not None:
        return character(char)
    near = nearest(name.upper(), CHARACTER_CALLED)
    hint = f"write `#\\{near.capitalize()}`" if near else None
    raise Unreadable("unknown-character", f"there is no character `#\\{name}`", "", hint)


def read_uninterned(token: str) -> Symbol:
    """The fresh symbol of a token such as #:name."""
    try:
        package, name, _ = split_symbol(token[2:])
    except Unreadable:
        package, name = "", ""
    if package is not None:
        raise Unreadable("bad-symbol", f"`{token}` has a package", "", "a name alone stands behind `#:`")
    return Symbol.uninterned(name)


def read_radix(token: str) -> Value:
    """The rational of a token such as #xFF, #b-101/11 or #36rZZ."""
    found = re.match(r"#([0-9]*)([xobr])", token.lower())
    assert found is not None
    text = token[found.end() :]
    base = _BASES.get(found[2]) or digits_value(found[1])
    if not 2 <= base <= 36:
        raise Unreadable("bad-number", f"`{token}` has a base that is not from 2 to 36")
    sign, slash = text[:1] if text[:1] in ("+", "-") else "", "/" in text
    numerator, _, denominator = text[len(sign) :].partition("/")
    digits = DIGITS[:base]
    for part in (numerator, denominator) if slash else (numerator,):
        if not part or not frozenset(digits).issuperset(part.upper()):
            raise Unreadable("bad-number", f"`{text}` is no number of base {base}", f"digits {digits}")
    value = _integer(sign + numerator, base)
    return _ratio(value, digits_value(denominator, base), token) if slash else value


def read_logical(token: str, resolve: Resolve) -> Value:
    """The variable of a token such as #?x: the symbol ?X."""
    return read_token(token[1:], resolve)
