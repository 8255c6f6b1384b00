"""The names of characters that cannot be shown as themselves: #\\Space, #\\Newline.

The reader, the printer and CHAR-NAME share this table. A character outside it
that is not printable is called by its code: #\\U+200B.
"""

from __future__ import annotations

_NAMES = {
    "Nul": 0,
    "Backspace": 8,
    "Tab": 9,
    "Newline": 10,
    "Page": 12,
    "Return": 13,
    "Esc": 27,
    "Space": 32,
    "Rubout": 127,
}
_OTHER_NAMES = {"NULL": 0, "LINEFEED": 10, "ESCAPE": 27, "ALTMODE": 27, "DELETE": 127, "DEL": 127, "BELL": 7}

NAME_OF = {chr(code): name for name, code in _NAMES.items()}
CHARACTER_CALLED = {
    name: chr(code) for name, code in (*((n.upper(), c) for n, c in _NAMES.items()), *_OTHER_NAMES.items())
}


def character_name(char: str) -> str | None:
    """The name of CHAR; None if it is shown as itself."""
    name = NAME_OF.get(char)
    if name is None and not char.isprintable():
        return f"U+{ord(char):04X}"
    return name


def find_character(name: str) -> str | None:
    """The character that NAME (in any case, two letters or more) means; None if there is none."""
    upper = name.upper()
    if upper in CHARACTER_CALLED:
        return CHARACTER_CALLED[upper]
    if upper.startswith("U+"):
        upper = upper[1:]
    elif not upper.startswith("U") or len(upper) < 5:
        return None
    try:
        return chr(int(upper[1:], 16))
    except (ValueError, OverflowError):
        return None
