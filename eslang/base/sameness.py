"""When two values are the same object to a program: EQ and EQL.

EQUAL and EQUALP, which look inside, are lisp/predicates.py.
"""

from __future__ import annotations

from eslang.base.symbols import Value


def is_eq(a: Value, b: Value) -> bool:
    """The same object; equal integers are."""
    return a is b or (a.__class__ is int and b.__class__ is int and a == b)


def is_eql(a: Value, b: Value) -> bool:
    """The same object, or numbers of the same type and value; 0.0 is not -0.0."""
    if a is b:
        return True
    kind = a.__class__
    if kind is not b.__class__:
        return False
    if kind is int:
        return bool(a == b)
    if kind is float:
        return bool(a.hex() == b.hex())
    return kind.__name__ == "Ratio" and bool(a == b)
