"""What definitions do when they are run: functions, macros, variables, setf functions.

The compiler turns DEFUN and its kin into calls of these.
"""

from __future__ import annotations

from eslang.base.failure import simple_error
from eslang.base.hints import Any
from eslang.base.image import Cell, Image
from eslang.base.lists import items, lisp_list
from eslang.base.running import running
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.compile.registry import Definition, function

SETF = Symbol.intern("SETF", "COMMON-LISP")
CONSTANT, VAR = Keyword("CONSTANT"), Keyword("VAR")


def _describe(cell: Cell, kind: str, implementation: Any, signature: Value, doc: Value, where: Value) -> None:
    """Keep what people want to know of a definition; make a library's names external."""
    symbol = cell.symbol
    if symbol is None:
        raise simple_error("NIL cannot be defined")
    name = symbol.name
    definition = Definition(kind, name, symbol.package or "", signature.text, implementation)
    definition.documentation = doc.text if doc is not None else ""
    if where is not None:
        definition.where = ":".join(str(part) for part in items(where))
    cell.definition = definition
    running.session.defined(symbol)


def _free_cell(name: Symbol) -> Cell:
    """The cell of NAME, which may be defined as an operator."""
    image: Image = running.session.image
    if image.is_fixed(name):
        raise simple_error("an operator of Common Lisp cannot be redefined:", name)
    return image.cell(name)


@function("(%define-function name function signature documentation where)")
def define_function(name: Symbol, made: Value, signature: Value, doc: Value, where: Value) -> Value:
    """Make MADE the global function NAME."""
    cell = _free_cell(name)
    cell.macro = None
    cell.function = made
    _describe(cell, "function", made, signature, doc, where)
    return name


@function("(%define-setf-function name function signature documentation where)")
def define_setf_function(name: Symbol, made: Value, signature: Value, doc: Value, where: Value) -> Value:
    """Make MADE the function that sets the place NAME."""
    running.session.image.cell(name).setf_function = made
    return lisp_list(SETF, name)


@function("(%define-macro name expander signature documentation where)")
def define_macro(name: Symbol, expander: Value, signature: Value, doc: Value, where: Value) -> Value:
    """Make EXPANDER the macro function of NAME."""
    cell = _free_cell(name)
    if hasattr(cell, "function"):
        del cell.function
    cell.macro = expander
    _describe(cell, "macro", expander, signature, doc, where)
    return name


@function("(%define-variable name kind value documentation where)")
def define_variable(name: Symbol, kind: Keyword, value: Value, doc: Value, where: Value) -> Value:
    """Proclaim NAME special; VALUE is a function that computes its value."""
    cell = running.session.image.cell(name)
    if cell.constant and kind is not CONSTANT:
        raise simple_error("this is a constant and cannot become a variable:", name)
    cell.special = True
    if value is not None and not (kind is VAR and hasattr(cell, "value")):
        cell.value = value()
    cell.constant = kind is CONSTANT
    if cell.definition is None or cell.definition.kind in ("variable", "constant"):
        signature = doc if doc is not None else None
        definition = Definition(
            "constant" if cell.constant else "variable",
            name.name,
            name.package or "",
            name.name.lower(),
            None,
        )
        definition.documentation = signature.text if signature is not None else ""
        if where is not None:
            definition.where = ":".join(str(part) for part in items(where))
        cell.definition = definition
        running.session.defined(name)
    return name
