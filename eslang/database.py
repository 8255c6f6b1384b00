"""The logical database of an interpreter: facts that know the session's functions and listeners."""

from __future__ import annotations

from eslang.base.calls import spread
from eslang.base.hints import TYPE_CHECKING, Iterable
from eslang.base.lists import Cons, items
from eslang.base.running import running, to_function
from eslang.base.symbols import Symbol, Value
from eslang.facts.nested import Written, filled
from eslang.facts.query import Facts
from eslang.facts.unify import is_variable
from eslang.runtime.failures import guarded
from eslang.runtime.story import place_here

if TYPE_CHECKING:
    from eslang.facts.watching import Change
    from eslang.interpreter import Interpreter

FUNCTION, QUOTE = (Symbol.intern(name, "COMMON-LISP") for name in ("FUNCTION", "QUOTE"))
STEADY_NAMES = (
    "< > <= >= = /= + - * / 1+ 1- MIN MAX ABS MOD REM EVENP ODDP ZEROP PLUSP MINUSP "
    "EQ EQL EQUAL EQUALP NOT NULL ATOM CONSP LISTP SYMBOLP KEYWORDP STRINGP CHARACTERP "
    "NUMBERP INTEGERP RATIONALP FLOATP REALP FIRST SECOND THIRD REST CAR CDR NTH LENGTH LIST CONS "
    "STRING= STRING/= STRING< STRING> STRING-EQUAL CHAR= CHAR< CHAR>"
)
RESERVED_NAMES = "< > <= >= = /= EQ EQL EQUAL EQUALP FUNCALL"  # no relation takes them from the queries
# Functions whose answer hangs on their arguments alone.
STEADY = frozenset(Symbol.intern(name, "COMMON-LISP") for name in STEADY_NAMES.split())
RESERVED = frozenset(Symbol.intern(name, "COMMON-LISP") for name in RESERVED_NAMES.split())
STEADY_OF_TWO = frozenset(Symbol.intern(name, "COMMON-LISP") for name in ("MEMBER", "ASSOC"))


def make_database(session: Interpreter) -> Facts:
    """An empty database for SESSION, whose listeners hear of each change."""
    cell, hooks = session.image.cell, session.hooks

    def is_call(symbol: Symbol) -> bool:
        return hasattr(cell(symbol), "function")

    def tell(change: Change) -> None:
        place = place_here() if hooks.current() is not None else None
        hooks.tell("fact", place, added=change.added, fact=change.fact)

    def look() -> None:
        if session.ticks.pending is not None:
            session.scheduler.safepoint()

    made = Facts(is_call, call_test)
    made.reserved |= RESERVED
    made.audience, made.tell = hooks.listeners, tell
    made.pauses.give_way, made.pauses.look = session.scheduler.safepoint, look
    return made


def call_test(symbol: Symbol, arguments: list[Value]) -> bool:
    """Whether the function SYMBOL says something else than NIL of ARGUMENTS."""
    inquiry = running.session.dynamic.logical.inquiry
    if inquiry is not None and not _is_steady(symbol, arguments):
        inquiry.asked_lisp = True
    return guarded(lambda: _apply(symbol, arguments)) is not None


def _is_steady(symbol: Symbol, arguments: list[Value]) -> bool:
    """Whether a call of SYMBOL gives the same whenever it is made: facts alone can change what it says."""
    if symbol in STEADY or (symbol in STEADY_OF_TWO and len(arguments) == 2):
        return all(each.__class__ is not Written or _is_steady_argument(each) for each in arguments)
    return False


def _is_steady_argument(written: Written) -> bool:
    form, cell = written.form, running.session.image.cell
    if form.__class__ is not Cons:
        return form.__class__ is not Symbol or is_variable(form) or not cell(form).special
    if form.car is QUOTE or form.car is FUNCTION:
        return form.car is QUOTE
    if not (isinstance(form.car, Symbol) and hasattr(cell(form.car), "function")):
        return True  # data
    return _is_steady(form.car, [Written(each, written.bindings) for each in items(form.cdr)])


def _apply(symbol: Symbol, arguments: Iterable[Value]) -> Value:
    function = to_function(symbol)
    return spread(function, [_computed(each) if each.__class__ is Written else each for each in arguments])


def _computed(written: Written) -> Value:
    """The value of an argument.

    A variable has its value, a call of a function is made, what is quoted is
    as it stands, a global variable has its value; all else stands for itself.
    """
    form, bindings = written
    if is_variable(form):
        return bindings[form]
    if form.__class__ is not Cons:
        return _global(form) if form.__class__ is Symbol else form
    if form.car is QUOTE or form.car is FUNCTION:
        datum = filled(form.cdr.car, bindings)
        return datum if form.car is QUOTE else to_function(datum)
    if isinstance(form.car, Symbol) and hasattr(running.session.image.cell(form.car), "function"):
        return _apply(form.car, [Written(each, bindings) for each in items(form.cdr)])
    return filled(form, bindings)


def _global(symbol: Symbol) -> Value:
    """The value of the global variable SYMBOL; SYMBOL, if it is none."""
    cell = running.session.image.cell(symbol)
    return getattr(cell, "value", symbol) if cell.special or cell.constant else symbol
