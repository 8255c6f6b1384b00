"""Standard input by lines, which tasks need not wait for.

A line is read when it is there; whether it is can be asked, and waited for,
without reading. Where input is no file of the system, or cannot be waited for,
it is read as it is.
"""

from __future__ import annotations

import os
import select
import sys
from typing import Any, TextIO

CHUNK = 1 << 16


class Lines:
    """The lines of a file descriptor; while entered, it is standard input for plans, too."""

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream
        self.number = stream.fileno()
        self.held = b""
        self.ended = False
        self._before: Any = None

    def __enter__(self) -> Lines:
        self._before, sys.stdin = sys.stdin, self
        return self

    def __exit__(self, *_: object) -> None:
        sys.stdin = self._before

    def is_ready(self) -> bool:
        """True if a line, or the end, is there."""
        while not self._has_line() and self.rest(0):
            self._take()
        return self._has_line()

    def rest(self, seconds: float | None) -> bool:
        """Sleep for SECONDS, or until something has come; true if it has."""
        return bool(select.select([self.number], [], [], seconds)[0])

    def readline(self) -> str:
        """The next line, with its newline; "" at the end."""
        while not self._has_line():
            self._take()
        line, newline, self.held = self.held.partition(b"\n")
        self.ended = False  # at a terminal, more may come behind an end
        return (line + newline).decode("utf-8", "surrogateescape").replace("\r\n", "\n")

    def _has_line(self) -> bool:
        return self.ended or b"\n" in self.held

    def _take(self) -> None:
        piece = os.read(self.number, CHUNK)
        self.held += piece
        self.ended = not piece

    def isatty(self) -> bool:
        """True if a person types."""
        return self.stream.isatty()


def can_be_awaited(stream: TextIO) -> bool:
    """True if STREAM is a file of the system that can be waited for."""
    try:
        select.select([stream.fileno()], [], [], 0)
    except (OSError, ValueError):
        return False
    return True
