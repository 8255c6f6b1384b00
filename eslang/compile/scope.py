"""Scopes: what names mean at one place in a program, at compile time.

A scope is a chain of small frames, one per binding form. Looking up a name
also notes what the emitter must know: that a variable is captured by an inner
procedure, or a block left from one.
"""

from __future__ import annotations

from eslang.base.hints import TYPE_CHECKING, Any, Iterator
from eslang.base.symbols import Symbol, Value
from eslang.compile.core import Exit, Procedure, Variable

if TYPE_CHECKING:
    from eslang.compile.analyser import Analyser


class SymbolMacro:
    """A name that stands for a form."""

    __slots__ = ("expansion",)

    def __init__(self, expansion: Value) -> None:
        self.expansion = expansion


class LocalMacro:
    """A MACROLET name."""

    __slots__ = ("expander",)

    def __init__(self, expander: Any) -> None:
        self.expander = expander


class Special:
    """A variable declared special here."""

    __slots__ = ()


SPECIAL = Special()


class Scope:
    """One frame of names, and the frames around it."""

    __slots__ = ("analyser", "blocks", "functions", "outer", "procedure", "tags", "variables")

    def __init__(self, outer: Scope | None, procedure: Procedure, analyser: Analyser) -> None:
        self.outer = outer
        self.procedure = procedure
        self.analyser = analyser
        self.variables: dict[Symbol | None, Variable | SymbolMacro | Special] = {}
        self.functions: dict[Symbol | None, Variable | LocalMacro] = {}
        self.blocks: dict[Symbol | None, Exit] = {}
        self.tags: dict[Value, tuple[Exit, int]] = {}

    def inner(self, procedure: Procedure | None = None) -> Scope:
        """A new frame inside this one, perhaps at the start of an inner procedure."""
        return Scope(self, procedure or self.procedure, self.analyser)

    def frames(self) -> Iterator[Scope]:
        """This frame and those around it, innermost first."""
        frame: Scope | None = self
        while frame is not None:
            yield frame
            frame = frame.outer

    def find_variable(self, symbol: Symbol) -> Variable | SymbolMacro | Special | None:
        """What SYMBOL means as a variable here; None: nothing lexical."""
        found = next((f.variables[symbol] for f in self.frames() if symbol in f.variables), None)
        if isinstance(found, Variable):
            self.mention(found)
        return found

    def find_function(self, symbol: Value) -> Variable | LocalMacro | None:
        """What SYMBOL means as an operator here; None: nothing lexical."""
        found = next((f.functions[symbol] for f in self.frames() if symbol in f.functions), None)
        if isinstance(found, Variable):
            self.mention(found)
        return found

    def mention(self, variable: Variable) -> None:
        """Note that code here uses VARIABLE, perhaps across procedures."""
        variable.mentioned = True
        procedure: Procedure | None = self.procedure
        while procedure is not None and procedure is not variable.owner:
            variable.captured = True
            procedure.free[variable] = None
            procedure = procedure.parent

    def find_block(self, symbol: Symbol | None) -> Exit | None:
        """The innermost block called SYMBOL."""
        return next((frame.blocks[symbol] for frame in self.frames() if symbol in frame.blocks), None)

    def find_tag(self, tag: Value) -> tuple[Exit, int] | None:
        """The innermost tagbody with TAG, and the number of its segment."""
        return next((frame.tags[tag] for frame in self.frames() if tag in frame.tags), None)

    def visible(self, kind: str) -> list[str]:
        """The names of all lexical variables or functions here, for hints."""
        tables = [frame.variables if kind == "variable" else frame.functions for frame in self.frames()]
        return [symbol.name for table in tables for symbol in table if isinstance(symbol, Symbol)]
