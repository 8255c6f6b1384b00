"""Dynamic bindings of special variables.

The value in force is always the one in the cell; what it hides waits on a
stack that belongs to the running task. When another task is to run, they are
taken off, and put on again when its turn comes: only those that exist cost
anything.
"""

from __future__ import annotations

from eslang.base.failure import type_error
from eslang.base.hints import Any
from eslang.base.image import Cell, Image
from eslang.base.lists import items
from eslang.base.symbols import Symbol, Value

UNBOUND = object()
Kept = tuple[tuple[Cell, Any], ...]  # bindings that are not in force: cells and values, outermost first


class Bindings:
    """The bindings of the running task: what each hides, and the one outside it."""

    __slots__ = ("hidden", "image")

    def __init__(self, image: Image) -> None:
        self.image = image
        self.hidden: Any = None  # (cell, value, the next one outward)

    def support(self) -> dict[str, Any]:
        """What compiled code calls."""
        return {"%bind": self.bind, "%bind-all": self.bind_all, "%unbind": self.unbind}

    def bind(self, cell: Cell, value: Value) -> None:
        """Give CELL a new value, to be undone by `unbind`."""
        self.hidden = (cell, getattr(cell, "value", UNBOUND), self.hidden)
        cell.value = value

    def bind_all(self, symbols: Value, values: Value) -> int:
        """PROGV: bind each symbol; a symbol without a value becomes unbound. How many there were."""
        cells = [self._cell(symbol) for symbol in items(symbols)]
        given = items(values)
        for index, cell in enumerate(cells):
            if index < len(given):
                self.bind(cell, given[index])
            else:
                self.bind(cell, None)
                del cell.value
        return len(cells)

    def _cell(self, symbol: Value) -> Cell:
        """The cell of a symbol that can be bound."""
        if not isinstance(symbol, Symbol):
            raise type_error(symbol, "SYMBOL")
        return self.image.cell(symbol)

    def unbind(self, count: int) -> None:
        """Undo the last COUNT bindings. It calls nothing, since the stack may be full."""
        while count:
            cell, value, self.hidden = self.hidden
            cell.value = value
            if value is UNBOUND:
                del cell.value
            count -= 1

    # --- turns -----------------------------------------------------------------

    def take_off(self) -> Kept:
        """Put the values outside the bindings in force; what is to be put on again."""
        kept = []
        while self.hidden is not None:
            cell, value, self.hidden = self.hidden
            kept.append((cell, getattr(cell, "value", UNBOUND)))
            cell.value = value
            if value is UNBOUND:
                del cell.value
        kept.reverse()
        return tuple(kept)

    def put_on(self, kept: Kept) -> None:
        """Put the bindings of KEPT in force."""
        for cell, value in kept:
            self.bind(cell, value)
            if value is UNBOUND:
                del cell.value

    def copy(self) -> Kept:
        """The values of the bindings in force, for a task that begins with them."""
        copied: dict[Cell, Any] = {}
        entry = self.hidden
        while entry is not None:
            cell, _, entry = entry
            copied.setdefault(cell, getattr(cell, "value", UNBOUND))
        return tuple(copied.items())
