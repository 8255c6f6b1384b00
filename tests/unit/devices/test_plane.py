"""The plane: walls, round things and a bar."""

from __future__ import annotations

from math import inf, isclose

import pytest

from eslang.devices.plane import Bar, Disc, Edge, Plane, direction, sight, turned


def test_an_edge_is_as_far_as_its_nearest_point() -> None:
    edge = Edge(0, 0, 4, 0)
    assert [edge.distance(2, 3), edge.distance(7, 4), edge.distance(-1, 0)] == [3, 5, 1]


def test_an_edge_without_length_is_a_point() -> None:
    assert Edge(1, 1, 1, 1).distance(4, 5) == 5


def test_an_edge_is_seen_where_one_looks_at_it() -> None:
    edge = Edge(3, -1, 3, 1)
    assert [edge.ahead(0, 0, 1, 0), edge.ahead(0, 0, -1, 0), edge.ahead(0, 5, 1, 0)] == [3, inf, inf]
    assert edge.ahead(0, 0, 0, 1) == inf


def test_a_disc_is_seen_at_its_rim() -> None:
    disc = Disc(5, 0, 1)
    assert [disc.ahead(0, 0, 1, 0), disc.ahead(0, 0, -1, 0), disc.ahead(0, 2, 1, 0)] == [4, inf, inf]
    assert disc.distance(5, 3) == 2


def test_a_disc_goes_to_its_goal_and_stands_there() -> None:
    plane = Plane()
    disc = plane.discs["cart"] = Disc(0, 0, 0.3)
    disc.goal, disc.speed = (1.0, 0.0), 0.5
    assert plane.walk(1.0, 9, 9)
    assert (disc.x, disc.y) == (0.5, 0)
    assert plane.walk(5.0, 9, 9)
    assert (disc.x, disc.y, disc.goal) == (1, 0, None)
    assert not plane.walk(1.0, 9, 9)


def test_a_disc_does_not_run_into_the_robot() -> None:
    plane = Plane()
    disc = plane.discs["cart"] = Disc(0, 0, 0.3)
    disc.goal, disc.speed = (4.0, 0.0), 1.0
    assert not plane.walk(1.0, 1.2, 0)
    assert (disc.x, disc.goal) == (0, (4.0, 0.0))
    assert plane.walk(1.0, 1.2, 3)


def test_the_nearest_thing_has_a_name() -> None:
    plane = Plane()
    assert plane.nearest(0, 0) == (inf, None)
    plane.walls["north"] = [Edge(-5, 2, 5, 2)]
    plane.discs["cart"] = Disc(3, 0, 0.5)
    assert [plane.nearest(0, 0), plane.nearest(1, 0)] == [(2, "north"), (1.5, "cart")]
    assert isclose(sight(plane.near(0, 0, 4), 0, 0, 90), 2)
    assert sight(plane.near(0, 0, 1), 0, 0, 90) == inf


@pytest.mark.parametrize(("side", "zone"), [(1, (2, 1)), (-1, (2, -1))])
def test_a_bar_is_approached_from_the_side_where_one_is(side: int, zone: tuple[float, float]) -> None:
    found = Bar(2, 0, 0).zone(5, 3 * side)
    assert all(isclose(one, other, abs_tol=1e-9) for one, other in zip(found, zone, strict=True))
    assert isclose(Bar(2, 0, 0).offset(5, 3 * side), 3)


def test_angles_are_counted_to_the_left() -> None:
    assert [direction(0, 0, 0, 1), direction(1, 1, 0, 1), turned(270), turned(-190)] == [90, 180, -90, 170]
