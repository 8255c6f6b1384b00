"""Matching: patterns with logic variables against terms.

A logic variable is a symbol whose name begins with ?; ?_ matches anything and
is bound to nothing.
"""

from __future__ import annotations

from eslang.base.lists import Cons
from eslang.base.sameness import is_eql
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.base.text import String


def is_variable(term: Value) -> bool:
    """True if TERM is a logic variable."""
    return (
        isinstance(term, Symbol)
        and not isinstance(term, Keyword)
        and term.name.startswith("?")
        and len(term.name) > 1
    )


def same(left: Value, right: Value) -> bool:
    """EQUAL, for atoms."""
    if left.__class__ is String and right.__class__ is String:
        return bool(left.text == right.text)
    return is_eql(left, right)


def match(pattern: Value, term: Value) -> dict[Symbol, Value] | None:
    """The bindings under which PATTERN is TERM; None if there are none."""
    bindings: dict[Symbol, Value] = {}
    pending = [(pattern, term)]
    while pending:
        pattern, term = pending.pop()
        if is_variable(pattern):
            if pattern.name == "?_":
                continue
            if pattern in bindings:
                pending.append((bindings[pattern], term))
            else:
                bindings[pattern] = term
        elif pattern.__class__ is Cons and term.__class__ is Cons:
            pending += [(pattern.cdr, term.cdr), (pattern.car, term.car)]
        elif not same(pattern, term):
            return None
    return bindings


def is_same_pattern(left: Value, right: Value) -> bool:
    """True if two patterns differ at most in the names of their variables."""
    forth: dict[Symbol, Symbol] = {}
    back: dict[Symbol, Symbol] = {}
    pending = [(left, right)]
    while pending:
        left, right = pending.pop()
        if is_variable(left) and is_variable(right) and "?_" not in (left.name, right.name):
            if forth.setdefault(left, right) is not right or back.setdefault(right, left) is not left:
                return False
        elif left.__class__ is Cons and right.__class__ is Cons:
            pending += [(left.cdr, right.cdr), (left.car, right.car)]
        elif not same(left, right):
            return False
    return True


class Patterns:
    """Things remembered by pattern: what TO-ACHIEVE defined. Those of the library come after all others."""

    def __init__(self) -> None:
        self.entries: list[tuple[Value, Value]] = []
        self.own = 0  # how many are not the library's

    def define(self, pattern: Value, entry: Value, *, is_library: bool = False) -> None:
        """Remember ENTRY for PATTERN, in the place of what was remembered for the same one."""
        begin, end = (self.own, len(self.entries)) if is_library else (0, self.own)
        for index in range(begin, end):
            if is_same_pattern(self.entries[index][0], pattern):
                self.entries[index] = (pattern, entry)
                return
        self.entries.insert(end, (pattern, entry))
        self.own += not is_library

    def exact(self, term: Value) -> Value:
        """What was remembered for TERM itself; None if nothing was."""
        for pattern, entry in self.entries:
            if match(pattern, term) == {} and is_same_pattern(pattern, term):
                return entry
        return None

    def find(self, term: Value) -> tuple[dict[Symbol, Value], Value]:
        """The first entry whose pattern TERM matches, one without variables before all; (…, None) if none."""
        best: tuple[dict[Symbol, Value], Value] = ({}, None)
        for pattern, entry in self.entries:
            bindings = match(pattern, term)
            if bindings is not None and (not bindings or best[1] is None):
                best = (bindings, entry)
                if not bindings:
                    break
        return best


Place = tuple[bool, Value]  # a term, and whether its variables are those of the right side


def unifiable(left: Value, right: Value) -> bool:
    """True if LEFT and RIGHT, whose variables are not the same ones, can be made the same."""
    bound: dict[Place, Place] = {}
    pending: list[tuple[Place, Place]] = [((False, left), (True, right))]
    while pending:
        one, other = (walked(each, bound) for each in pending.pop())
        if (one[1] is other[1] and one[0] is other[0]) or is_anything(one[1]) or is_anything(other[1]):
            continue
        if is_variable(other[1]):
            one, other = other, one
        if is_variable(one[1]):
            if occurs(one, other, bound):
                return False
            bound[one] = other
        elif one[1].__class__ is Cons and other[1].__class__ is Cons:
            pending.append(((one[0], one[1].cdr), (other[0], other[1].cdr)))
            pending.append(((one[0], one[1].car), (other[0], other[1].car)))
        elif not same(one[1], other[1]):
            return False
    return True


def is_anything(term: Value) -> bool:
    """True if TERM is ?_, which is another variable each time."""
    return is_variable(term) and bool(term.name == "?_")


def walked(place: Place, bound: dict[Place, Place]) -> Place:
    """PLACE, or what it is BOUND to if it is a variable."""
    while is_variable(place[1]) and place in bound:
        place = bound[place]
    return place


def occurs(variable: Place, place: Place, bound: dict[Place, Place]) -> bool:
    """True if VARIABLE is a part of PLACE, as far as variables are BOUND."""
    pending = [place]
    while pending:
        side, term = walked(pending.pop(), bound)
        if term.__class__ is Cons:
            pending += [(side, term.cdr), (side, term.car)]
        elif (side, term) == variable and is_variable(term):
            return True
    return False
