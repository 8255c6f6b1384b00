"""Feature expressions: what stands behind #+ and #-.

A feature is a keyword, and (and ...), (or ...), (not x) combine them. We are
:ESLANG, and not :COMMON-LISP, which claims the whole of the standard.
"""

from __future__ import annotations

from eslang.base.lists import Cons, is_proper, items
from eslang.base.symbols import Symbol, Value
from eslang.reader.atoms import Unreadable

FEATURES = frozenset({"ESLANG"})
_DEEPEST = 50


def resolve_feature(package: str | None, name: str, external_only: bool) -> Symbol:
    """The symbol that NAME means in a feature expression: a keyword."""
    return Symbol.intern(name, package or "KEYWORD")


def is_true(expression: Value, features: frozenset[str], depth: int = 0) -> bool:
    """True if EXPRESSION holds where there are FEATURES."""
    if isinstance(expression, Symbol):
        return expression.package == "KEYWORD" and expression.name in features
    if expression.__class__ is Cons and is_proper(expression) and depth < _DEEPEST:
        operator, *operands = items(expression)
        name = operator.name if isinstance(operator, Symbol) else ""
        if name in ("AND", "OR") or (name == "NOT" and len(operands) == 1):
            held = [is_true(operand, features, depth + 1) for operand in operands]
            return all(held) if name == "AND" else any(held) if name == "OR" else not held[0]
    raise Unreadable(
        "bad-feature",
        "this is no feature expression",
        "expected a feature, or `and`, `or`, `not` of features",
    )
