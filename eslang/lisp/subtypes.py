"""SUBTYPEP: whether all that is of one type is of another.

The answer is yes, no, or NIL and NIL: not known. What a program defined is
known by its lineage, numbers by their limits, all else by the table below.
"""

from __future__ import annotations

from eslang.base.hints import Any
from eslang.base.lists import Cons, items
from eslang.base.many import pack
from eslang.base.number_kinds import is_rational
from eslang.base.symbols import Symbol, T, Value, truth
from eslang.compile.registry import function
from eslang.lisp.predicates import is_equal
from eslang.lisp.sequences import is_character_type
from eslang.lisp.types import LINE_OF, expand_type, is_of_type, named_type

Answer = bool | None  # None: not known

_PARENTS = {
    "T": "",
    "NULL": "BOOLEAN LIST",
    "BOOLEAN": "SYMBOL",
    "KEYWORD": "SYMBOL",
    "SYMBOL": "ATOM",
    "CONS": "LIST",
    "LIST": "SEQUENCE",
    "SEQUENCE": "T",
    "ATOM": "T",
    "INTEGER": "RATIONAL",
    "BIGNUM": "INTEGER",
    "RATIO": "RATIONAL",
    "RATIONAL": "REAL",
    "FLOAT": "REAL",
    "REAL": "NUMBER",
    "NUMBER": "ATOM",
    "STANDARD-CHAR": "CHARACTER",
    "CHARACTER": "ATOM",
    "SIMPLE-STRING": "STRING SIMPLE-ARRAY",
    "STRING": "VECTOR",
    "SIMPLE-VECTOR": "VECTOR SIMPLE-ARRAY",
    "VECTOR": "ARRAY SEQUENCE",
    "SIMPLE-ARRAY": "ARRAY",
    "ARRAY": "ATOM",
    "FUNCTION": "ATOM",
    "HASH-TABLE": "ATOM",
    "PACKAGE": "ATOM",
    "STREAM": "ATOM",
    "STRING-STREAM": "STREAM",
    "STRUCTURE-OBJECT": "ATOM",
    "EVENT": "ATOM",
    "TASK": "EVENT",
}
_SAME = {
    "SIGNED-BYTE": "INTEGER",
    "SINGLE-FLOAT": "FLOAT",
    "DOUBLE-FLOAT": "FLOAT",
    "SHORT-FLOAT": "FLOAT",
    "LONG-FLOAT": "FLOAT",
    "BASE-CHAR": "CHARACTER",
    "BASE-STRING": "STRING",
    "SIMPLE-BASE-STRING": "SIMPLE-STRING",
    "COMPILED-FUNCTION": "FUNCTION",
}
_MEMBERS: dict[str, list[Value]] = {"NULL": [None], "BOOLEAN": [None, T]}
_NUMBERS = ("INTEGER", "RATIONAL", "FLOAT", "REAL")


class _Type:
    """A type taken apart: its head, its arguments, and the elements it consists of, if few."""

    __slots__ = ("arguments", "head", "members", "specifier")

    def __init__(self, specifier: Value) -> None:
        self.specifier = specifier = expand_type(specifier)
        parts = items(specifier) if specifier.__class__ is Cons else [specifier]
        name = "NIL" if parts[0] is None else parts[0].name
        self.head, self.arguments = _normal(_SAME.get(name, name), parts[1:])
        self.members = self.arguments if self.head in ("MEMBER", "EQL") else _MEMBERS.get(name)


def _normal(head: str, arguments: list[Value]) -> tuple[str, list[Value]]:
    """Types of integers by their limits, both included; a cons of nothing is nothing."""
    size = arguments[0] if arguments and arguments[0].__class__ is int else None
    if head == "BIT":
        return "INTEGER", [0, 1]
    if head == "FIXNUM":
        return "INTEGER", [-(1 << 62), (1 << 62) - 1]
    if head == "MOD" and size is not None:
        return "INTEGER", [0, size - 1]
    if head == "UNSIGNED-BYTE":
        return "INTEGER", [0] if size is None else [0, (1 << size) - 1]
    if head == "INTEGER":
        return head, [
            limit.car + step if limit.__class__ is Cons else limit
            for limit, step in zip(arguments, (1, -1), strict=False)
        ]
    if head == "CONS" and "NIL" in [_Type(part).head for part in arguments]:
        return "NIL", []
    return head, arguments


def _all(answers: list[Answer]) -> Answer:
    if False in answers:
        return False
    return None if None in answers else True


def is_subtype(first: Value, second: Value) -> Answer:
    """Whether all that is of the type FIRST is of the type SECOND."""
    a, b = _Type(first), _Type(second)
    if a.head == "NIL" or b.head == "T" or is_equal(a.specifier, b.specifier):
        return True
    if "SATISFIES" in (a.head, b.head):
        return None
    if a.members is not None:
        return False not in [is_of_type(member, b.specifier) for member in a.members]
    if a.head == "OR":
        return _all([is_subtype(part, second) for part in a.arguments])
    if b.head == "AND":
        return _all([is_subtype(first, part) for part in b.arguments])
    if a.head == "AND":
        return True if True in [is_subtype(part, second) for part in a.arguments] else None
    if b.head == "OR":
        return True if True in [is_subtype(first, part) for part in b.arguments] else None
    if "NOT" in (a.head, b.head):
        return None
    if b.members is not None:
        return None if a.head == "INTEGER" else False
    return False if b.head == "NIL" else _is_simple_subtype(a, b)


def _is_simple_subtype(a: _Type, b: _Type) -> Answer:
    """Of types that are no combinations of others."""
    ours, theirs = named_type(a.specifier), named_type(b.specifier)
    if ours.__class__ in LINE_OF:
        return theirs in LINE_OF[ours.__class__](ours) or b.head in ("ATOM", "STRUCTURE-OBJECT", "CONDITION")
    if theirs.__class__ in LINE_OF:
        return False if a.head in _PARENTS else None
    if a.head not in _PARENTS or b.head not in _PARENTS:
        return None
    if not _descends(a.head, b.head):
        return False
    if not b.arguments:
        return True
    if b.head in _NUMBERS:
        return _is_within(a.arguments, b.arguments)
    if a.head == b.head == "CONS":
        return _are_parts_within(a.arguments, b.arguments)
    return None


def _descends(name: str, ancestor: str) -> bool:
    return name == ancestor or any(
        _descends(parent, ancestor) for parent in _PARENTS.get(name, "").split() if parent != "T"
    )


def _is_within(inner: list[Value], outer: list[Value]) -> bool:
    """Whether the limits INNER lie within OUTER; both as in (INTEGER LOW HIGH)."""
    for place, sign in ((0, 1), (1, -1)):
        limit = _limit(outer, place)
        if limit is None:
            continue
        own = _limit(inner, place)
        if own is None or sign * (own[0] - limit[0]) < 0:
            return False
        if own[0] == limit[0] and limit[1] and not own[1]:
            return False
    return True


def _limit(limits: list[Value], place: int) -> tuple[Any, bool] | None:
    """The number at PLACE and whether it is itself excluded; None where there is no limit."""
    limit = limits[place] if place < len(limits) else None
    if limit.__class__ is Cons:
        return limit.car, True
    return (limit, False) if is_rational(limit) or limit.__class__ is float else None


def _are_parts_within(inner: list[Value], outer: list[Value]) -> Answer:
    """Of (CONS A D) types: whether the parts INNER are subtypes of OUTER."""
    answers = []
    for place in range(2):
        own = inner[place] if place < len(inner) else T
        other = outer[place] if place < len(outer) else T
        answers.append(is_subtype(T if _is_star(own) else own, T if _is_star(other) else other))
    return _all(answers)


def _is_star(part: Value) -> bool:
    return isinstance(part, Symbol) and part.name == "*"


def _subtypep_values(first: Value, second: Value, _environment: Value = None) -> Value:
    answer = is_subtype(first, second)
    return pack([truth(answer is True), truth(answer is not None)])


@function("(subtypep type-1 type-2 &optional environment)", many=_subtypep_values)
def subtypep(first: Value, second: Value, _environment: Value = None) -> Value:
    """True if all that is of TYPE-1 is surely of TYPE-2.

    Returns: second, true if the answer is known.
    """
    return truth(is_subtype(first, second) is True)


@function("(upgraded-array-element-type type-specifier &optional environment)")
def upgraded_array_element_type(specifier: Value, _environment: Value = None) -> Value:
    """Return CHARACTER, if TYPE-SPECIFIER is a type of characters; else T."""
    return Symbol.intern("CHARACTER", "COMMON-LISP") if is_character_type(specifier) else T
