"""Properties: relations whose last argument is unique for the others (ARM §4).

(power-state ega_x :on) says what the power state of EGA_X is, so a new fact
takes the place of the old one.
"""

from __future__ import annotations

from eslang.facts.relations import Positions, Relation
from eslang.facts.terms import Row


def unique_positions(arity: int) -> Positions | None:
    """The positions that determine the last one; None where there is no last one."""
    return tuple(range(arity - 1)) if arity else None


def overruled(relation: Relation) -> list[Row]:
    """The rows of a property in whose place others stand that came later."""
    latest: dict[Row, Row] = {}
    for row in relation.rows:
        latest[row[:-1]] = row
    return [row for row in relation.rows if latest[row[:-1]] is not row]
