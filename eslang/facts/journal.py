"""What a journal is: it writes down every change of the facts, when it is made.

The store asks it before a fact is held, tells it of each row that comes or
goes while that is done, and then that a change is whole. Who hears of a change
later (watching.py) may make the next one; a journal has them in their order.
"""

from __future__ import annotations

from eslang.facts.relations import Relation
from eslang.facts.terms import Row


class Journal:
    """Writes changes down; this one does not, and says what there is to do."""

    def admit(self, relation: Relation, row: Row) -> None:
        """ROW is to be added. Raises Failure if that cannot be written down."""

    def note_added(self, relation: Relation, row: Row) -> None:
        """ROW stands in RELATION now, where its value is the journal's own."""

    def note_removed(self, relation: Relation, row: Row) -> None:
        """ROW is about to go."""

    def end_change(self) -> None:
        """All rows of a change have come and gone."""

    def close(self) -> None:
        """Nothing is to be written down any more."""
