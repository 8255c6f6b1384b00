"""Symbols: their names, values, functions and properties (CLHS 10).

What a symbol means is kept in the image of the interpreter at work; the symbol
itself is only a name. Which symbol a name means is packages.py.
"""

from __future__ import annotations

from eslang.base.failure import simple_error, type_error, unbound_variable, undefined_function
from eslang.base.image import Cell
from eslang.base.lists import Cons
from eslang.base.running import running
from eslang.base.sameness import is_eql
from eslang.base.symbols import Keyword, Symbol, T, Value, truth
from eslang.base.text import String
from eslang.compile.registry import function
from eslang.lisp.numbers import is_integer
from eslang.lisp.predicates import is_symbol
from eslang.lisp.strings import check_string

_SETF = Symbol.intern("SETF", "COMMON-LISP")


def cell_of(symbol: Value, name: str) -> Cell:
    """The cell of SYMBOL in the image at work; a type error of the function NAME if it is no symbol."""
    if not is_symbol(symbol):
        raise type_error(symbol, "SYMBOL", name)
    cell: Cell = running.session.image.cell(symbol)
    return cell


def name_of(symbol: Value, name: str) -> str:
    """The name of SYMBOL; a type error of the function NAME if it is no symbol."""
    if symbol is None:
        return "NIL"
    if isinstance(symbol, Symbol):
        return symbol.name
    raise type_error(symbol, "SYMBOL", name)


@function("(symbol-name symbol)")
def symbol_name(symbol: Value) -> Value:
    """Return the name of SYMBOL as a string."""
    return String(name_of(symbol, "symbol-name"))


@function("(make-symbol name)")
def make_symbol(name: Value) -> Value:
    """Return a new symbol called NAME that belongs to no package."""
    return Symbol.uninterned(check_string(name, "make-symbol").text)


@function("(copy-symbol symbol &optional copy-properties)")
def copy_symbol(symbol: Value, copy_properties: Value = None) -> Value:
    """Return a new symbol of that name; with COPY-PROPERTIES, of that meaning."""
    copy = Symbol.uninterned(name_of(symbol, "copy-symbol"))
    if copy_properties is not None:
        old, new = cell_of(symbol, "copy-symbol"), cell_of(copy, "copy-symbol")
        for slot in ("value", "function"):
            if hasattr(old, slot):
                setattr(new, slot, getattr(old, slot))
        new.plist = _copied(old.plist)
    return copy


@function('(gensym &optional (prefix "G"))')
def gensym(prefix: Value = None) -> Value:
    """Return a new symbol like no other; its name is PREFIX and a number.

    The numbers belong to the interpreter, so the same program makes the same names.
    """
    if is_integer(prefix):
        if prefix < 0:
            raise type_error(prefix, "UNSIGNED-BYTE", "gensym")
        return Symbol.uninterned(f"G{prefix}")
    start = "G" if prefix is None else check_string(prefix, "gensym").text
    return Symbol.uninterned(f"{start}{running.session.image.count('GENSYM')}")


@function("(boundp symbol)")
def boundp(symbol: Value) -> Value:
    """Return T if SYMBOL has a value as a variable."""
    return truth(symbol is None or symbol is T or hasattr(cell_of(symbol, "boundp"), "value"))


@function("(symbol-value symbol)")
def symbol_value(symbol: Value) -> Value:
    """Return the value of SYMBOL as a global or special variable.

    Fails: :unbound-variable.
    """
    if symbol is None or symbol is T:
        return symbol
    try:
        return cell_of(symbol, "symbol-value").value
    except AttributeError:
        raise unbound_variable(symbol) from None


@function("(set symbol value)")
def set_value(symbol: Value, value: Value) -> Value:
    """Make VALUE the value of SYMBOL as a global or special variable."""
    cell = cell_of(symbol, "set")
    if cell.constant or symbol is None or symbol is T:
        raise simple_error("SET: a constant cannot be changed", symbol)
    cell.value = value
    return value


@function("(%set-symbol-value symbol value)")
def set_symbol_value(symbol: Value, value: Value) -> Value:
    """Make VALUE the value of SYMBOL, for (setf symbol-value)."""
    return set_value(symbol, value)


@function("(makunbound symbol)")
def makunbound(symbol: Value) -> Value:
    """Leave SYMBOL without a value."""
    cell = cell_of(symbol, "makunbound")
    if cell.constant or symbol is None or symbol is T:
        raise simple_error("MAKUNBOUND: a constant cannot be changed", symbol)
    if hasattr(cell, "value"):
        del cell.value
    return symbol


def _place_of(name: Value, operator: str) -> tuple[Cell, str]:
    """The cell and slot where the function called NAME, a symbol or (setf symbol), is kept."""
    if name.__class__ is Cons and name.car is _SETF and name.cdr.__class__ is Cons and name.cdr.cdr is None:
        return cell_of(name.cdr.car, operator), "setf_function"
    return cell_of(name, operator), "function"


def _is_operator(cell: Cell) -> bool:
    if cell.symbol is None:
        return False
    return cell.macro is not None or running.session.is_special_form(cell.symbol)


@function("(fboundp name)")
def fboundp(name: Value) -> Value:
    """Return T if NAME names a function, macro or special form."""
    cell, slot = _place_of(name, "fboundp")
    return truth(hasattr(cell, slot) or (slot == "function" and _is_operator(cell)))


def _function_called(name: Value, operator: str) -> Value:
    cell, slot = _place_of(name, operator)
    try:
        return getattr(cell, slot)
    except AttributeError:
        raise undefined_function(name) from None


@function("(symbol-function symbol)")
def symbol_function(symbol: Value) -> Value:
    """Return the global function that SYMBOL names.

    Fails: :undefined-function.
    """
    name_of(symbol, "symbol-function")
    return _function_called(symbol, "symbol-function")


@function("(fdefinition name)")
def fdefinition(name: Value) -> Value:
    """Return the global function that NAME, a symbol or (setf symbol), names.

    Fails: :undefined-function.
    """
    return _function_called(name, "fdefinition")


@function("(%set-fdefinition name function)")
def set_fdefinition(name: Value, new: Value) -> Value:
    """Let NAME or (setf NAME) mean FUNCTION, for (setf fdefinition)."""
    cell, slot = _place_of(name, "fdefinition")
    if not callable(new):
        raise type_error(new, "FUNCTION", "fdefinition")
    setattr(cell, slot, new)
    if slot == "function":
        cell.macro = None
    return new


@function("(%set-symbol-function symbol function)")
def set_symbol_function(symbol: Value, new: Value) -> Value:
    """Let SYMBOL name FUNCTION, for (setf symbol-function)."""
    name_of(symbol, "symbol-function")
    return set_fdefinition(symbol, new)


@function("(fmakunbound name)")
def fmakunbound(name: Value) -> Value:
    """Leave NAME, a symbol or (setf symbol), without a function or macro."""
    cell, slot = _place_of(name, "fmakunbound")
    if hasattr(cell, slot):
        delattr(cell, slot)
    if slot == "function":
        cell.macro = None
    return name


@function("(symbol-plist symbol)")
def symbol_plist(symbol: Value) -> Value:
    """Return the property list of SYMBOL."""
    return cell_of(symbol, "symbol-plist").plist


@function("(%set-symbol-plist symbol plist)")
def set_symbol_plist(symbol: Value, plist: Value) -> Value:
    """Make PLIST the property list of SYMBOL, for (setf symbol-plist)."""
    cell_of(symbol, "symbol-plist").plist = plist
    return plist


def _find_property(cell: Cell, indicator: Value) -> Value:
    """The cons that holds the value of INDICATOR; None if there is none."""
    rest = cell.plist
    while rest.__class__ is Cons and rest.cdr.__class__ is Cons:
        if is_eql(rest.car, indicator):
            return rest.cdr
        rest = rest.cdr.cdr
    return None


def _copied(plist: Value) -> Value:
    from eslang.base.lists import from_items, items

    return from_items(items(plist))


@function("(get symbol indicator &optional default)")
def get(symbol: Value, indicator: Value, default: Value = None) -> Value:
    """Return the property INDICATOR of SYMBOL, or DEFAULT if it has none."""
    found = _find_property(cell_of(symbol, "get"), indicator)
    return default if found is None else found.car


@function("(%set-get symbol indicator value-or-default &optional value)")
def set_get(symbol: Value, indicator: Value, first: Value, *second: Value) -> Value:
    """Set the property INDICATOR of SYMBOL, for (setf get); value last."""
    cell, value = cell_of(symbol, "get"), second[0] if second else first
    found = _find_property(cell, indicator)
    if found is None:
        cell.plist = Cons(indicator, Cons(value, cell.plist))
    else:
        found.car = value
    return value


@function("(remprop symbol indicator)")
def remprop(symbol: Value, indicator: Value) -> Value:
    """Take the property INDICATOR from SYMBOL; return T if it had one."""
    cell = cell_of(symbol, "remprop")
    before, rest = None, cell.plist
    while rest.__class__ is Cons and rest.cdr.__class__ is Cons:
        if is_eql(rest.car, indicator):
            if before is None:
                cell.plist = rest.cdr.cdr
            else:
                before.cdr = rest.cdr.cdr
            return T
        before, rest = rest.cdr, rest.cdr.cdr
    return None


@function("(constantp form &optional environment)")
def constantp(form: Value, environment: Value = None) -> Value:
    """Return T if FORM always means the same: a constant, or a quoted form."""
    if isinstance(form, Symbol) and not isinstance(form, Keyword):
        return truth(form is T or running.session.image.cell(form).constant)
    if form.__class__ is Cons:
        return truth(form.car is Symbol.intern("QUOTE", "COMMON-LISP"))
    return T
