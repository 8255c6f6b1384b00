"""What of the library is loaded when it is first wanted.

Each definition costs some of the time that a start takes, and few plans use
all of them. Texts of the library that define functions and macros alone can
wait, once they were compiled: their names stand for them until one of these
is called, or until something is compiled, which may use the macros.
"""

from __future__ import annotations

from eslang import library
from eslang.base.hints import Any, Callable, Iterable
from eslang.base.image import PACKAGE, Cell, Image
from eslang.base.many import many_of
from eslang.base.symbols import Value

FUNCTION, MACRO = "function", "macro"
Name = tuple[str, Any]  # FUNCTION or MACRO; a package, and a name in it
Meaning = tuple[Any, Any]  # the function and the macro that a cell holds


def meaning(cell: Cell) -> Meaning:
    """What CELL means as an operator."""
    return getattr(cell, "function", None), cell.macro


class Recorder:
    """Finds the names that texts define, while the library is compiled."""

    def __init__(self, image: Image) -> None:
        self.image = image
        self.names: list[Name] = []  # of those that can wait
        self.before: dict[Cell, Meaning] = {}
        self.pass_over(False)

    def pass_over(self, waits: bool) -> None:
        """One more text was loaded, which WAITS or not."""
        for symbol, cell in self.image.cells.items():
            if self.before.get(cell, (None, None)) != meaning(cell):
                self.before[cell] = meaning(cell)
                if waits and symbol is not None:
                    kind = FUNCTION if cell.macro is None else MACRO
                    self.names.append((kind, (symbol.package, symbol.name)))


class Later:
    """Texts of the library whose NAMES stand for them; LOAD runs them."""

    def __init__(self, session: Any, names: Iterable[Name], load: Callable[[], None]) -> None:
        self.session = session
        self.load = load
        self.standing: dict[Cell, Meaning] = {}  # what the names mean until then
        image: Image = session.image
        for kind, (package, name) in names:
            symbol = image.packages[package].intern(name)
            if symbol is not None:
                library.export(image, symbol)
                self.stand_in(image.cell(symbol), kind)

    def stand_in(self, cell: Cell, kind: str) -> None:
        """Let CELL mean something that loads the texts, and then is what they define."""

        def function(*arguments: Value) -> Value:
            self.session.texts.load_later()
            return cell.function(*arguments)

        def values(*arguments: Value) -> Value:
            self.session.texts.load_later()
            return many_of(cell.function)(*arguments)

        def macro(form: Value, environment: Value) -> Value:
            self.session.texts.load_later()
            return cell.macro(form, environment)  # type: ignore[misc]

        if kind == MACRO:
            cell.macro = macro
        else:
            function.many = values  # type: ignore[attr-defined]
            cell.function = function
        self.standing[cell] = meaning(cell)

    def take(self) -> None:
        """Load the texts, all at once; what a program has defined meanwhile stays as it is."""
        session, image = self.session, self.session.image
        own = {cell: (*meaning(cell), cell.definition) for cell in self.standing if self.is_own(cell)}
        package, sealed = image.cell(PACKAGE), image.sealed
        before = package.value
        session.dynamic.masked += 1
        try:
            with session.at_work():
                image.sealed = False
                self.load()
        finally:
            image.sealed = sealed
            package.value = before
            session.dynamic.masked -= 1
            for cell, (function, macro, definition) in own.items():
                restore(cell, function, macro)
                cell.definition = definition

    def is_own(self, cell: Cell) -> bool:
        """True if a program has defined CELL anew."""
        return meaning(cell) != self.standing[cell]


def restore(cell: Cell, function: Any, macro: Any) -> None:
    """Let CELL mean FUNCTION and MACRO again, each of which may be None."""
    if function is not None:
        cell.function = function
    elif hasattr(cell, "function"):
        del cell.function
    cell.macro = macro
