"""Text in columns of a terminal: how wide it is, cutting it, and tables of it."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from unicodedata import east_asian_width

GAP = 2  # between two columns of a table
NARROWEST = 4  # columns of a table are not made narrower, if they were wider


def columns_of_terminal() -> int:
    """The columns of the terminal; 80 where there is none."""
    return max(shutil.get_terminal_size((80, 24)).columns, 1)


def width(text: str) -> int:
    """The columns that TEXT takes."""
    return len(text) if text.isascii() else sum(1 + (east_asian_width(char) in "WF") for char in text)


def pad(text: str, columns: int, *, right: bool = False) -> str:
    """TEXT, and spaces to fill COLUMNS; before it, if it is to stand at the RIGHT."""
    space = " " * (columns - width(text))
    return space + text if right else text + space


def fitted(text: str, columns: int) -> str:
    """TEXT without control characters, cut to COLUMNS."""
    text = "".join([char if char.isprintable() else "·" for char in text])
    if width(text) <= columns:
        return text
    while text and width(text) >= columns:
        text = text[:-1]
    return text + "…"


def table(
    header: Sequence[str], rows: Sequence[Sequence[str]], right: Sequence[bool], columns: int
) -> list[str]:
    """ROWS below HEADER (which may be empty), no wider than COLUMNS; cells at the RIGHT of theirs where told.

    Where there are too many columns for that, each row stands as a list on its line.
    """
    whole = [header, *rows] if header else rows
    widths = fitting([max(width(row[i]) for row in whole) for i in range(len(right))], columns)
    if widths is None:
        return [fitted(" ".join(row), columns) for row in whole]
    ruled = [tuple("─" * wide for wide in widths)] if header else []
    return [_line(row, widths, right) for row in (*whole[: len(ruled)], *ruled, *rows)]


def _line(row: Sequence[str], widths: Sequence[int], right: Sequence[bool]) -> str:
    cells = [
        pad(fitted(cell, wide), wide, right=at) for cell, wide, at in zip(row, widths, right, strict=True)
    ]
    return (" " * GAP).join(cells).rstrip()


def fitting(widths: list[int], columns: int) -> list[int] | None:
    """WIDTHS, the widest of them made narrower until all have room in COLUMNS; None if they never have."""
    room = columns - GAP * (len(widths) - 1)
    if sum(min(wide, NARROWEST) for wide in widths) > room:
        return None
    most = max(widths, default=0)
    while sum(min(wide, most) for wide in widths) > room:
        most -= 1
    return [min(wide, most) for wide in widths]
