"""The border: Lisp values as Python people expect them, and back.

NIL ⇄ None, T ⇄ True, False → NIL, lists ⇄ lists, strings ⇄ str, ratios ⇄
Fraction; symbols and keywords are themselves; all else passes untouched
(language reference §10).
"""

from __future__ import annotations

from eslang.base.failure import Failure
from eslang.base.hints import Any
from eslang.base.lists import Cons, from_items
from eslang.base.many import Values, primary
from eslang.base.symbols import T, Value
from eslang.base.text import String


class Text(str):
    """A string, where a plain str is a name: in facts and queries. It is a str in all else."""

    __slots__ = ()

    def __repr__(self) -> str:
        return f"Text({str.__repr__(self)})"


def to_python(value: Value, text: type[str] = str) -> Any:
    """VALUE for Python code, strings as TEXT; a dotted or circular list stays as it is."""
    return _python_list(value, text, set()) if value.__class__ is Cons else _python_atom(value, text)


def _python_atom(value: Value, text: type[str]) -> Any:
    kind = value.__class__
    if kind is String:
        return text(value.text)
    if value is T:
        return True
    if kind is Values:
        return to_python(primary(value), text)
    if kind.__name__ == "Ratio":
        from fractions import Fraction

        return Fraction(value.numerator, value.denominator)
    return value


def _python_list(lst: Cons, text: type[str], above: set[int]) -> Any:
    """A list as a Python list, built without recursion along the cdr; ABOVE are the conses that it is in."""
    conses: list[Cons] = []
    seen: set[int] = set()
    rest: Value = lst
    while rest.__class__ is Cons:
        if id(rest) in seen or id(rest) in above:
            return lst
        seen.add(id(rest))
        conses.append(rest)
        rest = rest.cdr
    if rest is not None:
        return lst
    elements: list[Any] = []
    added: list[int] = []
    for cons in conses:
        if cons.car.__class__ is Cons:
            added.append(id(cons))
            above.add(id(cons))
            elements.append(_python_list(cons.car, text, above))
        else:
            elements.append(_python_atom(cons.car, text))
    above.difference_update(added)
    return elements


def leave(failure: Failure) -> None:
    """Give FAILURE, on its way out to Python code, arguments as Python has them."""
    if failure.kept is None:
        failure.kept = failure.arguments
        failure.arguments = tuple([to_python(argument) for argument in failure.arguments])


def enter(failure: Failure) -> None:
    """Give FAILURE, which Python code raised, arguments as Lisp has them."""
    if failure.kept is not None:
        failure.arguments, failure.kept = failure.kept, None
    else:
        failure.arguments = tuple([to_lisp(argument) for argument in failure.arguments])


def to_lisp(value: Any) -> Value:
    """VALUE for Lisp code."""
    kind = value.__class__
    if kind is str:
        return String(value)
    if kind is bool:
        return T if value else None
    if kind is list:
        return from_items([to_lisp(element) for element in value])
    if kind.__name__ == "Fraction":
        from eslang.base.ratios import canonical

        return canonical(value)
    if kind is not int and kind is not float and isinstance(value, str):
        return String(str.__str__(value))
    return value
