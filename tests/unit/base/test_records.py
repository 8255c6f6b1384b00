"""Named tuples made without compiling: they do what Python's own do."""

from __future__ import annotations

import copy
import pickle

import pytest

from eslang.base.hints import NamedTuple


class Part(NamedTuple):
    """A line of a list, for these tests."""

    name: str
    amount: int
    note: str = "none"

    @property
    def label(self) -> str:
        """Name and amount."""
        return f"{self.name} x {self.amount}"


def test_values_come_by_place_by_name_or_from_the_default() -> None:
    by_place, by_name = Part("valve", 2), Part(amount=2, name="valve")
    assert by_place == by_name == ("valve", 2, "none")
    assert by_place.label == "valve x 2"
    name, amount, note = Part("valve", 2, note="spare")
    assert (name, amount, note) == ("valve", 2, "spare")


def test_a_record_is_a_tuple_that_cannot_be_changed() -> None:
    part = Part("valve", 2)
    assert hash(part) == hash(("valve", 2, "none"))
    with pytest.raises(AttributeError):
        part.amount = 3  # type: ignore[misc]
    with pytest.raises(AttributeError):
        part.other = 3  # type: ignore[attr-defined]


def test_replace_makes_another_record() -> None:
    part = Part("valve", 2)
    assert part._replace(amount=3) == Part("valve", 3)
    assert part == Part("valve", 2)


def test_a_record_survives_copying_and_shows_its_fields() -> None:
    part = Part("valve", 2)
    assert type(copy.deepcopy(part)) is Part and copy.deepcopy(part) == part
    assert pickle.loads(pickle.dumps(part)) == part
    assert repr(part) == "Part(name='valve', amount=2, note='none')"


@pytest.mark.parametrize(
    ("values", "named"),
    [((), {}), (("valve",), {}), ((1, 2, 3, 4), {}), ((1, 2), {"name": 1}), ((1, 2), {"colour": 3})],
)
def test_too_few_too_many_or_unknown_values_are_refused(
    values: tuple[object, ...], named: dict[str, object]
) -> None:
    with pytest.raises(TypeError):
        Part(*values, **named)  # type: ignore[arg-type]
