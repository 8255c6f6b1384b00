"""When two values are the same, and what kind of value one is.

The `is_` functions answer Python's bool and are what the rest of the room
uses; the registered ones answer T or NIL. TYPEP is in types.py.
"""

from __future__ import annotations

from types import FunctionType

from eslang.base.hashing import equalp_key
from eslang.base.lists import Cons
from eslang.base.number_kinds import is_number, is_rational
from eslang.base.packages import Package
from eslang.base.sameness import is_eq, is_eql
from eslang.base.symbols import Keyword, Symbol, Value, truth
from eslang.base.text import Array, Character, String, Vector
from eslang.compile.registry import function


def _is_equal_atom(a: Value, b: Value) -> bool:
    if a.__class__ is String:
        return b.__class__ is String and bool(a.text == b.text)
    return is_eql(a, b)


def is_equal(a: Value, b: Value) -> bool:
    """EQL, or strings of the same characters, or conses whose parts are equal."""
    pending: list[tuple[Value, Value]] = []
    while True:
        while a is not b:
            if a.__class__ is not Cons:
                if not _is_equal_atom(a, b):
                    return False
                break
            if b.__class__ is not Cons:
                return False
            x, y = a.car, b.car
            if x.__class__ is Cons:
                pending.append((a.cdr, b.cdr))
                a, b = x, y
            elif x is y or _is_equal_atom(x, y):
                a, b = a.cdr, b.cdr
            else:
                return False
        if not pending:
            return True
        a, b = pending.pop()


def is_equalp(a: Value, b: Value) -> bool:
    """Equal when neither case nor the types of numbers count; arrays and tables by content."""
    return a is b or bool(equalp_key(a) == equalp_key(b))


def is_symbol(value: Value) -> bool:
    """A symbol; NIL is one."""
    return value is None or isinstance(value, Symbol)


def is_list(value: Value) -> bool:
    """A cons or NIL."""
    return value is None or value.__class__ is Cons


def is_vector(value: Value) -> bool:
    """A one-dimensional array; strings are some."""
    return value.__class__ is Vector or value.__class__ is String


def is_array(value: Value) -> bool:
    """An array of any rank."""
    return is_vector(value) or value.__class__ is Array


def is_function(value: Value) -> bool:
    """Something to call."""
    return value.__class__ is FunctionType or callable(value)


@function("(eq x y)")
def eq(x: Value, y: Value) -> Value:
    """True if X and Y are the same object; equal integers are."""
    return truth(is_eq(x, y))


@function("(eql x y)")
def eql(x: Value, y: Value) -> Value:
    """True if X and Y are one object, or numbers of one type and value."""
    return truth(is_eql(x, y))


@function("(equal x y)")
def equal(x: Value, y: Value) -> Value:
    """True if X and Y are EQL, equal strings, or conses of equal parts."""
    return truth(is_equal(x, y))


@function("(equalp x y)")
def equalp(x: Value, y: Value) -> Value:
    """True if X and Y are EQUAL but for case and the types of numbers.

    Arrays, structures and hash tables are compared by their contents.
    """
    return truth(is_equalp(x, y))


@function("(not x)")
def not_(x: Value) -> Value:
    """True if X is NIL."""
    return truth(x is None)


@function("(null object)")
def null(value: Value) -> Value:
    """True if OBJECT is NIL."""
    return truth(value is None)


@function("(atom object)")
def atom(value: Value) -> Value:
    """True if OBJECT is no cons."""
    return truth(value.__class__ is not Cons)


@function("(consp object)")
def consp(value: Value) -> Value:
    """True if OBJECT is a cons."""
    return truth(value.__class__ is Cons)


@function("(listp object)")
def listp(value: Value) -> Value:
    """True if OBJECT is a cons or NIL."""
    return truth(is_list(value))


@function("(symbolp object)")
def symbolp(value: Value) -> Value:
    """True if OBJECT is a symbol; NIL is one."""
    return truth(is_symbol(value))


@function("(keywordp object)")
def keywordp(value: Value) -> Value:
    """True if OBJECT is a keyword."""
    return truth(value.__class__ is Keyword)


@function("(numberp object)")
def numberp(value: Value) -> Value:
    """True if OBJECT is a number."""
    return truth(is_number(value))


@function("(realp object)")
def realp(value: Value) -> Value:
    """True if OBJECT is a real number; all numbers here are."""
    return truth(is_number(value))


@function("(rationalp object)")
def rationalp(value: Value) -> Value:
    """True if OBJECT is an integer or a ratio."""
    return truth(is_rational(value))


@function("(integerp object)")
def integerp(value: Value) -> Value:
    """True if OBJECT is an integer."""
    return truth(value.__class__ is int)


@function("(floatp object)")
def floatp(value: Value) -> Value:
    """True if OBJECT is a float."""
    return truth(value.__class__ is float)


@function("(complexp object)")
def complexp(_value: Value) -> Value:
    """True if OBJECT is a complex number; there are none here."""
    return None


@function("(characterp object)")
def characterp(value: Value) -> Value:
    """True if OBJECT is a character."""
    return truth(value.__class__ is Character)


@function("(stringp object)")
def stringp(value: Value) -> Value:
    """True if OBJECT is a string."""
    return truth(value.__class__ is String)


@function("(simple-string-p object)")
def simple_string_p(value: Value) -> Value:
    """True if OBJECT is a string without a fill pointer."""
    return truth(value.__class__ is String and not value.fill)


@function("(vectorp object)")
def vectorp(value: Value) -> Value:
    """True if OBJECT is a one-dimensional array; strings are some."""
    return truth(is_vector(value))


@function("(simple-vector-p object)")
def simple_vector_p(value: Value) -> Value:
    """True if OBJECT is a vector, no string, without a fill pointer."""
    return truth(value.__class__ is Vector and value.fill is None)


@function("(arrayp object)")
def arrayp(value: Value) -> Value:
    """True if OBJECT is an array of any rank."""
    return truth(is_array(value))


@function("(functionp object)")
def functionp(value: Value) -> Value:
    """True if OBJECT is a function; a symbol that names one is not."""
    return truth(is_function(value))


@function("(compiled-function-p object)")
def compiled_function_p(value: Value) -> Value:
    """True if OBJECT is a function; all functions here are compiled."""
    return truth(is_function(value))


@function("(packagep object)")
def packagep(value: Value) -> Value:
    """True if OBJECT is a package."""
    return truth(value.__class__ is Package)
