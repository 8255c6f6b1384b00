"""Which parts of a structure are met more than once, and whether it contains itself.

Lists and vectors can be joined to anything, themselves included. Whoever walks
them to the end asks here first. Nothing is kept on Python's stack.
"""

from __future__ import annotations

from eslang.base.lists import Cons
from eslang.base.symbols import Value
from eslang.base.text import Array, Vector

COMPOUND = frozenset((Cons, Vector, Array))


def parts_of(value: Value) -> list[Value]:
    """The compound values that a compound VALUE is made of."""
    if value.__class__ is Cons:
        return [part for part in (value.car, value.cdr) if part.__class__ in COMPOUND]
    return [part for part in value.items if part.__class__ in COMPOUND]


def shared_parts(value: Value) -> dict[int, int]:
    """The id of every part that is met more than once in VALUE, each without a label yet."""
    met: set[int] = set()
    shared: dict[int, int] = {}
    waiting = [value]
    while waiting:
        part = waiting.pop()
        if id(part) in met:
            shared[id(part)] = 0
            continue
        met.add(id(part))
        waiting.extend(reversed(parts_of(part)))
    return shared


def contains_itself(value: Value) -> bool:
    """True if VALUE, a compound one, is among its own parts, or one of its parts is."""
    around: set[int] = set()
    done: set[int] = set()
    waiting: list[tuple[Value, bool]] = [(value, False)]
    while waiting:
        part, leaving = waiting.pop()
        if leaving:
            around.discard(id(part))
            done.add(id(part))
        elif id(part) in around:
            return True
        elif id(part) not in done:
            around.add(id(part))
            waiting.append((part, True))
            waiting.extend((inner, False) for inner in parts_of(part))
    return False
