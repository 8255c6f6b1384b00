"""`--watch`: a live tree of the tasks at the bottom of the terminal, the plan's output above it.

Plain control sequences: up, erase below, colours. What is drawn always ends at
the start of a line, so whoever ends the command leaves a terminal in order. A
thread of its own draws, at most ten times a second; it never touches the run,
whose order is the same with and without it.
"""

from __future__ import annotations

import os
import shutil
import sys
import time
from collections.abc import Callable
from threading import Event, RLock, Thread
from typing import Any, TextIO

from eslang.tools.columns import fitted, pad, width
from eslang.tools.watch_tree import HUES, WatchTree

PAUSE = 0.1  # seconds between two drawings, at least
COST = 10  # and so many times what the last one took
TICK = 1.0  # seconds after which time alone is a reason to draw
BEGIN, END = "\x1b[?2026h", "\x1b[?2026l"  # what lies between appears at once, where the terminal can


class Watch:
    """The listener, and the stream that the plan's output goes to."""

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream
        self.tree = WatchTree()
        self.coloured = not os.environ.get("NO_COLOR")
        self.partial = ""  # output whose line is not complete yet
        self.now: Callable[[], float] = lambda: 0.0
        self._lock = RLock()
        self._over = Event()
        self._lines: list[str] = []
        self._drawn: list[int] = []  # the widths of the lines that stand on the terminal
        self._changed = False
        self._shown = 0.0  # when the tree was put there
        self._made = 0.0  # when its lines were made, and may be again
        self._next = 0.0

    # --- the listener and the stream ----------------------------------------------

    def __call__(self, event: Any) -> None:
        """Note EVENT; it will be seen soon."""
        with self._lock:
            self.tree(event)
            self._changed = True

    def write(self, text: str) -> int:
        """Write TEXT above the tree."""
        with self._lock:
            whole, newline, rest = (self.partial + text).rpartition("\n")
            self.partial = rest
            if newline:
                self._put(self._eraser() + whole + newline)
                if time.monotonic() >= self._shown + PAUSE:
                    self._stand()  # a flood of lines does not draw it behind each
            self._changed = True
        return len(text)

    def flush(self) -> None:
        """Let everything written so far arrive."""
        self.stream.flush()

    def fileno(self) -> int:
        """The descriptor of the terminal."""
        return self.stream.fileno()

    def isatty(self) -> bool:
        """True: it is a terminal."""
        return True

    # --- drawing ------------------------------------------------------------------

    def show(self, work: Callable[[], Any], now: Callable[[], float]) -> Any:
        """Do WORK, and show its tasks meanwhile; NOW is its clock."""
        self.now = now
        errors = sys.stderr
        if errors.isatty():
            sys.stderr = self
        painter = Thread(target=self._paint, name="watch", daemon=True)
        painter.start()
        try:
            return work()
        finally:
            self._over.set()
            painter.join()
            sys.stderr = errors
            self._finish()

    def _paint(self) -> None:
        """Draw again and again, when something has changed."""
        while not self._over.wait(PAUSE):
            with self._lock:
                try:
                    self._repaint(time.monotonic())
                except OSError:
                    return  # nobody reads the output: the run will notice it when it writes

    def _repaint(self, moment: float) -> None:
        """Draw what has changed by MOMENT, or the same again where output has taken it away."""
        if moment >= self._next and (self._changed or moment >= self._made + TICK):
            begun = time.thread_time()
            self._make()
            self._made, self._next = moment, moment + COST * (time.thread_time() - begun)
        elif self._drawn:
            return
        self._stand()

    def _finish(self) -> None:
        """Leave the tree as it was in the end, and what was not a whole line yet above it."""
        with self._lock:
            rest, self.partial = self.partial, ""
            self._put(self._eraser() + rest + ("\n" if rest else ""))
            self._make()
            self._stand()
            self._drawn = []

    def _make(self) -> None:
        """Make the lines of the tree anew."""
        columns, rows = shutil.get_terminal_size((80, 24))
        self._lines = self._tree_lines(columns - 1, max(rows - 6, 4))
        self._changed = False

    def _stand(self) -> None:
        """Put the tree on the terminal, behind the output whose line is not complete yet."""
        lines = self._lines
        if self.partial:
            lines = [fitted(self.partial, shutil.get_terminal_size((80, 24)).columns - 1), *lines]
        self._put(BEGIN + self._eraser() + "".join(line + "\n" for line in lines) + END)
        self.stream.flush()
        self._drawn = [width(plain(line)) for line in lines]
        self._shown = time.monotonic()

    def _eraser(self) -> str:
        """What takes the tree away that stands there, which the terminal may have wrapped since."""
        if not self._drawn:
            return ""
        columns = max(shutil.get_terminal_size((80, 24)).columns, 1)
        rows = sum(max(1, -(-wide // columns)) for wide in self._drawn)
        self._drawn = []
        return f"\x1b[{rows}A\r\x1b[J"

    def _put(self, text: str) -> None:
        self.stream.write(text)

    def _tree_lines(self, columns: int, rows: int) -> list[str]:
        """The tree between a line that sums it up and one for the last failure."""
        now = self.now()
        head = f"── {now:.1f} s  {self.tree.summary()} "
        lines = [self._hued(fitted(head + "─" * max(0, columns - len(head)), columns), "2")]
        found = self.tree.lines(now, rows)
        name_width = min(max([width(name) for _, name, _ in found], default=0), columns // 2)
        for mark, name, words in found:
            text = f"{pad(fitted(name, name_width), name_width)}  {words}"
            hue = HUES.get(mark, "2")
            body = fitted(text, columns - 2)
            lines.append(f"{self._hued(mark, hue)} {self._hued(body, hue) if hue in ('2', '31') else body}")
        if self.tree.last_fact:
            lines.append(self._hued(fitted(self.tree.fact_line(), columns), "2"))
        if self.tree.last_failure:
            lines.append(self._hued(fitted(f"last failure: {self.tree.last_failure}", columns), "31"))
        return lines

    def _hued(self, text: str, hue: str) -> str:
        return f"\x1b[{hue}m{text}\x1b[0m" if self.coloured else text


def plain(text: str) -> str:
    """TEXT without colours."""
    pieces = text.split("\x1b[")
    return pieces[0] + "".join(piece.partition("m")[2] for piece in pieces[1:])
