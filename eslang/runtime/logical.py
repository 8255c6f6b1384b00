"""What logic variables are bound to in a task, and by whom (ESL §5).

It is dynamic: forms put another in force for what they run, and a recovery
procedure sees what was in force where its form stands.
"""

from __future__ import annotations

from eslang.base.hints import Any, NamedTuple
from eslang.base.symbols import Symbol, Value


class Logical(NamedTuple):
    """The bindings in force; the query whose solutions are gone through; who notes what a condition reads."""

    bindings: dict[Symbol, Value]
    query: Any = None
    inquiry: Any = None

    def within(self, bindings: dict[Symbol, Value], query: Any = None) -> Logical:
        """The same, with more BINDINGS in force, and the innermost QUERY if that is told."""
        made = {**self.bindings, **bindings}, query or self.query, self.inquiry
        return tuple.__new__(Logical, made)  # at each solution of a query: the short way


NOTHING_BOUND = Logical({})
