"""What the place macros of stdlib/places.esl and the like stand on.

A name's writer is what DEFSETF and its kin left with it, or, for accessors of
our own packages, the function %SET-name: it takes the accessor's arguments and
then the new value. The macros themselves are Lisp.
"""

from __future__ import annotations

from eslang.base.failure import TYPE_ERROR, Failure, simple_error, type_error
from eslang.base.lists import Cons
from eslang.base.many import pack
from eslang.base.running import running
from eslang.base.sameness import is_eql
from eslang.base.symbols import Symbol, T, Value
from eslang.compile.registry import function
from eslang.lisp.conses import car, cdr

OURS = ("COMMON-LISP", "ESL", "SCS")


@function("(%setf-writer name)")
def setf_writer(name: Value) -> Value:
    """What writes places (NAME ...): an expander function, the name of a writer, or NIL."""
    if not isinstance(name, Symbol):
        return None
    cells = running.session.image.cells
    cell = cells.get(name)
    if cell is not None and cell.setf_expander is not None:
        return cell.setf_expander
    if name.package not in OURS:
        return None
    writer = Symbol.intern(f"%SET-{name.name}", name.package)
    return writer if writer in cells and hasattr(cells[writer], "function") else None


@function("(%set-setf-writer name writer)")
def set_setf_writer(name: Symbol, writer: Value) -> Value:
    """Let WRITER, a function of five values or a name, write places (NAME ...); return NAME."""
    running.session.image.cell(name).setf_expander = writer
    return name


@function("(%define-symbol-macro symbol expansion)")
def define_symbol_macro(symbol: Symbol, expansion: Value) -> Value:
    """Let SYMBOL, as a variable, stand for the form EXPANSION; return SYMBOL."""
    running.session.image.cell(symbol).symbol_macro = [expansion]
    return symbol


def _property(plist: Value, indicator: Value, operator: str) -> tuple[Value, Value]:
    """The tail of PLIST that begins with INDICATOR (NIL: there is none), and the cons before it."""
    before = None
    rest = plist
    while rest is not None:
        if rest.__class__ is not Cons or rest.cdr.__class__ is not Cons:
            raise type_error(plist, "LIST", operator)
        if is_eql(rest.car, indicator):
            break
        before, rest = rest.cdr, rest.cdr.cdr
    return rest, before


@function("(%putf plist indicator value)")
def putf(plist: Value, indicator: Value, value: Value) -> Value:
    """PLIST with VALUE as the property INDICATOR: changed in place, or with two conses more in front."""
    found, _ = _property(plist, indicator, "GETF")
    if found is None:
        return Cons(indicator, Cons(value, plist))
    found.cdr.car = value
    return plist


def _remf_many(plist: Value, indicator: Value) -> Value:
    found, before = _property(plist, indicator, "REMF")
    if found is None:
        return pack([plist, None])
    if before is None:
        return pack([found.cdr.cdr, T])
    before.cdr = found.cdr.cdr
    return pack([plist, T])


@function("(%remf plist indicator)", many=_remf_many)
def remf(plist: Value, indicator: Value) -> Value:
    """PLIST without the property INDICATOR, and whether it was there."""
    return _remf_many(plist, indicator)[0]


@function("(%collect tail item)")
def collect(tail: Value, item: Value) -> Value:
    """Put ITEM behind the cons TAIL; return the new last cons. For LOOP."""
    cell = tail.cdr = Cons(item, None)
    return cell


# What DOLIST and LOOP say of what is no NIL: open-coded without a test for it.
function("(%car cons)")(car)
function("(%cdr cons)")(cdr)


@function("(%wrong-type datum expected operator)")
def wrong_type(datum: Value, expected: Value, operator: Value) -> Value:
    """Fail, since OPERATOR found DATUM, which is not of the type EXPECTED.

    Fails: with :type-error.
    """
    raise Failure(TYPE_ERROR, datum, expected, operator)


@function("(%mistake control &rest arguments)")
def mistake(control: Value, *arguments: Value) -> Value:
    """Fail, in a macro's expander: the form at hand is wrong. CONTROL and ARGUMENTS are FORMAT's.

    Raised and not signalled, so no recovery procedure hears of it: it is the
    program's author who does.

    Fails: with :error.
    """
    form = running.session.image.cell(FORMAT).function
    raise simple_error(str(form(None, control, *arguments)))


FORMAT = Symbol.intern("FORMAT", "COMMON-LISP")
