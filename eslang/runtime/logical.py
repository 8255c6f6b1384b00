"""What logic variables are bound to in a task, and by whom (ESL §5); which circuit it is in (SCS).

It is dynamic: forms put another in force for what they run, and a recovery
procedure sees what was in force where its form stands.
"""

from __future__ import annotations

from eslang.base.hints import Any, NamedTuple
from eslang.base.symbols import Symbol, Value


class Logical(NamedTuple):
    """The bindings in force, and who else matters here.

    query: whose solutions are gone through; inquiry: what notes the reads of a
    condition; circuit: the innermost construct that goes on while a condition holds;
    learned: the choice to which a reinforcement would be due; stage: the innermost
    construct of SCS that is under way.
    """

    bindings: dict[Symbol, Value]
    query: Any = None
    inquiry: Any = None
    circuit: Any = None
    learned: Any = None
    stage: Any = None

    def within(self, bindings: dict[Symbol, Value], query: Any = None) -> Logical:
        """The same, with more BINDINGS in force, and the innermost QUERY if that is told."""
        made = {**self.bindings, **bindings}, query or self.query, *self[2:]
        return tuple.__new__(Logical, made)  # at each solution of a query: the short way

    def entered(self, stage: Any) -> Logical:
        """The same, within one more construct of SCS: the short way, too."""
        return tuple.__new__(Logical, (*self[:-1], stage))

    def outside_circuits(self) -> Logical:
        """The same bindings, outside all constructs of SCS."""
        return Logical(*self[:3])

    def shielded(self) -> Logical:
        """The same for a cleanup: no condition around it is asked; but actions stay one at a time."""
        if self.stage is self.circuit is None:
            return self
        bare = self._replace(circuit=None, stage=None)
        return bare if self.circuit is None else bare._replace(circuit=self.circuit.shield(bare))


NOTHING_BOUND = Logical({})
