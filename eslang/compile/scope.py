"""Scopes: what names mean at one place in a program, at compile time.

A scope is a chain of small frames, one per binding form. Looking up a name
also notes what the emitter must know: that a variable is captured by an inner
procedure, or a block left from one.
"""

from __future__ import annotations

from eslang.base.hints import TYPE_CHECKING, Any
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

    __slots__ = ("analyser", "blocks", "functions", "notes", "outer", "procedure", "tags", "variables")

    def __init__(self, outer: Scope | None, procedure: Procedure, analyser: Analyser) -> None:
        self.outer = outer
        self.procedure = procedure
        self.analyser = analyser
        self.variables: dict[Symbol | None, Variable | SymbolMacro | Special] = {}
        self.functions: dict[Symbol | None, Variable | LocalMacro] = {}
        self.blocks: dict[Symbol | None, Exit] = {}
        self.tags: dict[Value, tuple[Exit, int]] = {}
        self.notes: dict[str, Value] = {}  # what constructs tell the forms inside them

    def inner(self, procedure: Procedure | None = None) -> Scope:
        """A new frame inside this one, perhaps at the start of an inner procedure."""
        return Scope(self, procedure or self.procedure, self.analyser)

    def find_variable(self, symbol: Symbol) -> Variable | SymbolMacro | Special | None:
        """What SYMBOL means as a variable here; None: nothing lexical."""
        frame: Scope | None = self
        while frame is not None:
            found = frame.variables.get(symbol)
            if found is not None:
                if found.__class__ is Variable:
                    self.mention(found)
                return found
            frame = frame.outer
        return None

    def find_function(self, symbol: Value) -> Variable | LocalMacro | None:
        """What SYMBOL means as an operator here; None: nothing lexical."""
        frame: Scope | None = self
        while frame is not None:
            found = frame.functions.get(symbol)
            if found is not None:
                if found.__class__ is Variable:
                    self.mention(found)
                return found
            frame = frame.outer
        return None

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
        frame: Scope | None = self
        while frame is not None:
            if symbol in frame.blocks:
                return frame.blocks[symbol]
            frame = frame.outer
        return None

    def find_tag(self, tag: Value) -> tuple[Exit, int] | None:
        """The innermost tagbody with TAG, and the number of its segment."""
        frame: Scope | None = self
        while frame is not None:
            if tag in frame.tags:
                return frame.tags[tag]
            frame = frame.outer
        return None

    def find_note(self, name: str) -> Value:
        """What the innermost construct that noted NAME said; None: nobody did."""
        frame: Scope | None = self
        while frame is not None:
            if name in frame.notes:
                return frame.notes[name]
            frame = frame.outer
        return None

    def visible(self, kind: str) -> list[str]:
        """The names of all lexical variables or functions here, for hints."""
        names = []
        frame: Scope | None = self
        while frame is not None:
            table = frame.variables if kind == "variable" else frame.functions
            names += [symbol.name for symbol in table if symbol is not None]
            frame = frame.outer
        return names
