"""Dynamic bindings of special variables.

The value in force is always the one in the cell; what it hides waits on a
stack that belongs to the running task.
"""

from __future__ import annotations

from typing import Any

from eslang.base.image import Cell, Image
from eslang.base.lists import items
from eslang.base.symbols import Value

UNBOUND = object()


class Bindings:
    """The bindings of the running task, innermost last."""

    __slots__ = ("hidden", "image")

    def __init__(self, image: Image) -> None:
        self.image = image
        self.hidden: list[tuple[Cell, Any]] = []

    def bind(self, cell: Cell, value: Value) -> None:
        """Give CELL a new value, to be undone by `unbind`."""
        self.hidden.append((cell, getattr(cell, "value", UNBOUND)))
        cell.value = value

    def bind_all(self, symbols: Value, values: Value) -> int:
        """PROGV: bind each symbol; a symbol without a value becomes unbound. How many there were."""
        names = items(symbols)
        given = items(values)
        for index, symbol in enumerate(names):
            cell = self.image.cell(symbol)
            if index < len(given):
                self.bind(cell, given[index])
            else:
                self.bind(cell, None)
                del cell.value
        return len(names)

    def unbind(self, count: int) -> None:
        """Undo the last COUNT bindings."""
        for _ in range(count):
            cell, value = self.hidden.pop()
            if value is UNBOUND:
                if hasattr(cell, "value"):
                    del cell.value
            else:
                cell.value = value
