"""A plane with walls, things that stand or walk about, and a bar: geometry, in metres and degrees.

Angles are counted to the left, from the direction in which x grows. A robot is
a disc here; what drives it, and what it senses, is robot_body.py. This file
knows no agent, no clock and no facts.
"""

from __future__ import annotations

from math import atan2, cos, degrees, hypot, inf, radians, sin, sqrt

from eslang.base.hints import Any, Iterator, NamedTuple

ROBOT_RADIUS = 0.2
MIDLINE_ZONE = 1.0  # how far from a bar the place is from which it is approached


class Edge(NamedTuple):
    """A straight piece of wall."""

    ax: float
    ay: float
    bx: float
    by: float

    def distance(self, x: float, y: float) -> float:
        """How far (X, Y) is from it."""
        dx, dy = self.bx - self.ax, self.by - self.ay
        length = dx * dx + dy * dy
        share = ((x - self.ax) * dx + (y - self.ay) * dy) / length if length else 0.0
        share = min(1.0, max(0.0, share))
        return hypot(x - self.ax - share * dx, y - self.ay - share * dy)

    def ahead(self, x: float, y: float, ux: float, uy: float) -> float:
        """How far it is from (X, Y) in the direction (UX, UY)."""
        dx, dy = self.bx - self.ax, self.by - self.ay
        across = ux * dy - uy * dx
        if abs(across) < 1e-12:
            return inf
        far = ((self.ax - x) * dy - (self.ay - y) * dx) / across
        share = ((self.ax - x) * uy - (self.ay - y) * ux) / across
        return far if far >= 0 and 0 <= share <= 1 else inf


class Disc:
    """Something round, which may be on its way somewhere."""

    __slots__ = ("goal", "radius", "speed", "x", "y")

    def __init__(self, x: float, y: float, radius: float) -> None:
        self.x, self.y, self.radius = x, y, radius
        self.goal: tuple[float, float] | None = None
        self.speed = 0.0

    def distance(self, x: float, y: float) -> float:
        """How far (X, Y) is from its rim."""
        return hypot(x - self.x, y - self.y) - self.radius

    def ahead(self, x: float, y: float, ux: float, uy: float) -> float:
        """How far it is from (X, Y) in the direction (UX, UY)."""
        along = (self.x - x) * ux + (self.y - y) * uy
        across = (self.x - x) * uy - (self.y - y) * ux
        if along < 0 or abs(across) > self.radius:
            return inf
        return max(0.0, along - sqrt(self.radius**2 - across**2))

    def next_place(self, seconds: float) -> tuple[float, float]:
        """Where it will be in SECONDS, if nothing is in its way."""
        if self.goal is None:
            return self.x, self.y
        gx, gy = self.goal
        left, step = hypot(gx - self.x, gy - self.y), self.speed * seconds
        if left <= step:
            return self.goal
        return self.x + (gx - self.x) * step / left, self.y + (gy - self.y) * step / left


class Bar(NamedTuple):
    """A bar that can be grabbed at its centre, from either side; it is in nobody's way."""

    x: float
    y: float
    angle: float

    def offset(self, x: float, y: float) -> float:
        """How far (X, Y) is from its midline, on which a robot comes to its centre."""
        ux, uy = unit(self.angle)
        return (x - self.x) * ux + (y - self.y) * uy

    def zone(self, x: float, y: float) -> tuple[float, float]:
        """The place on the midline from which the bar is approached, on the side of (X, Y)."""
        ux, uy = unit(self.angle + 90)
        side = MIDLINE_ZONE if (x - self.x) * ux + (y - self.y) * uy >= 0 else -MIDLINE_ZONE
        return self.x + side * ux, self.y + side * uy


class Plane:
    """All that is in the plane but the robot, each thing by its name."""

    def __init__(self) -> None:
        self.walls: dict[Any, list[Edge]] = {}
        self.discs: dict[Any, Disc] = {}
        self.bar: Bar | None = None
        self.charger: tuple[float, float] | None = None

    def solids(self) -> Iterator[tuple[Any, Edge | Disc]]:
        """Whatever is in the way, with its name."""
        for name, edges in self.walls.items():
            for edge in edges:
                yield name, edge
        yield from self.discs.items()

    def nearest(self, x: float, y: float) -> tuple[float, Any]:
        """How far the next thing is from (X, Y), and which."""
        best, nearest = inf, None
        for name, solid in self.solids():
            distance = solid.distance(x, y)
            if distance < best:
                best, nearest = distance, name
        return best, nearest

    def near(self, x: float, y: float, far: float) -> list[Edge | Disc]:
        """Whatever is no farther from (X, Y) than FAR."""
        return [solid for _, solid in self.solids() if solid.distance(x, y) <= far]

    def walk(self, seconds: float, x: float, y: float) -> bool:
        """Let what is on its way go on, but not into a robot at (X, Y); whether anything has moved."""
        moved = False
        for disc in self.discs.values():
            place = disc.next_place(seconds)
            if disc.goal is None or hypot(place[0] - x, place[1] - y) < disc.radius + ROBOT_RADIUS:
                continue
            disc.x, disc.y = place
            disc.goal = None if place == disc.goal else disc.goal
            moved = True
        return moved


def sight(solids: list[Edge | Disc], x: float, y: float, direction: float) -> float:
    """How far one can look from (X, Y) in DIRECTION, if these SOLIDS are there."""
    ux, uy = unit(direction)
    return min([solid.ahead(x, y, ux, uy) for solid in solids], default=inf)


def unit(direction: float) -> tuple[float, float]:
    """The step of one metre in DIRECTION."""
    return cos(radians(direction)), sin(radians(direction))


def direction(x: float, y: float, gx: float, gy: float) -> float:
    """The direction from (X, Y) to (GX, GY)."""
    return degrees(atan2(gy - y, gx - x))


def turned(angle: float) -> float:
    """ANGLE between -180 and 180."""
    return (angle + 180.0) % 360.0 - 180.0
