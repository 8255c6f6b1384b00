"""Where each box of a drawing stands, and where its lines run.

Each definition is a tree that grows to the right, on a card of its own. A box
and all in its care have a band of the card to themselves, so boxes never
overlap, and what is right of a box without parts is free. The lines that join
boxes run there to tracks at the right margin, and along the tracks.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from eslang.tools.columns import width
from eslang.tools.graph_model import Box, Graph, Join

LETTER, SMALL = 7.25, 6.65  # the widths of a column in a box, and on a line
LINE, ENTRY = 16, 13  # the height of a line of text; how far below its top a box is entered
PAD_X, PAD_Y = 9, 5
ROW, STUB = 8, 24  # between two boxes, one below the other; and beside the words on a line
MARGIN, CARD, BETWEEN = 20, 12, 28  # around all; within a card; between two cards
LANE, PORT, TRACK = 9, 6, 10  # what a line takes between bands, at a box, at the margin
HEADING = 30
APART = 6  # the lines to clauses from those to steps

Point = tuple[float, float]


class Spot(NamedTuple):
    """A box in its place."""

    box: Box
    x: float
    y: float
    width: float
    height: float

    @property
    def right(self) -> float:
        """Its right side."""
        return self.x + self.width

    @property
    def bottom(self) -> float:
        """Its lower side."""
        return self.y + self.height


class Stem(NamedTuple):
    """The line from a box to a part of it: where it begins, turns, and ends."""

    part: Box
    start: Point
    turn: float
    end: Point


class Card(NamedTuple):
    """What a definition stands on."""

    y: float
    height: float


class Wire(NamedTuple):
    """The lines of a join: from each box to the track, along it, and to each box."""

    join: Join
    track: float
    top: float
    bottom: float
    outward: list[list[Point]]  # each from a box to the track
    inward: list[list[Point]]  # each from the track to a box


@dataclass(slots=True)
class Layout:
    """All places of a drawing."""

    spots: dict[Box, Spot] = field(default_factory=dict)
    stems: list[Stem] = field(default_factory=list)
    cards: list[Card] = field(default_factory=list)
    wires: list[Wire] = field(default_factory=list)
    card_width: float = 0
    width: float = 0
    height: float = 0


def layout(graph: Graph) -> Layout:
    """Where everything in GRAPH stands."""
    placing = Placing(graph)
    placing.place_cards(graph)
    placing.run_wires()
    return placing.found


class Placing:
    """A drawing whose places are being found."""

    def __init__(self, graph: Graph) -> None:
        self.found = Layout()
        self.joins = graph.joins()
        self.roots = {definition.box for definition in graph.definitions}
        self.gives: dict[Box, list[Join]] = {}
        self.takes: dict[Box, list[Join]] = {}
        for join in self.joins:
            for box in join.sources:
                self.gives.setdefault(box, []).append(join)
            for box in join.sinks:
                self.takes.setdefault(box, []).append(join)
        self.above: dict[Box, float] = {}  # where lines to boxes with parts run
        self.below: dict[Box, float] = {}  # where lines from boxes with parts run
        self.used: dict[Box, int] = {}  # how many ports of a box have lines

    # --- boxes -------------------------------------------------------------------

    def place_cards(self, graph: Graph) -> None:
        """Give every definition a card, one below the other."""
        found, y = self.found, float(MARGIN + HEADING)
        for definition in graph.definitions:
            bottom = self.place(definition.box, MARGIN + CARD, y + CARD) + CARD
            found.cards.append(Card(y, bottom - y))
            y = bottom + BETWEEN
        right = max((spot.right for spot in found.spots.values()), default=MARGIN + 360.0)
        found.card_width = right + CARD - MARGIN
        found.width = MARGIN + found.card_width + MARGIN
        found.height = y - BETWEEN + MARGIN if graph.definitions else y + MARGIN

    def place(self, box: Box, x: float, y: float) -> float:
        """Place BOX and all in its care in a band that begins at Y; where that ends."""
        if box in self.roots:
            self.above[box] = y - CARD - BETWEEN / 3
        elif box.parts and box in self.takes:
            self.above[box], y = y, y + LANE
        spot = Spot(box, x, y, width_of(box), self.height_of(box))
        self.found.spots[box] = spot
        bottom, turn = spot.bottom, spot.right + STUB / 2
        start = spot.right + STUB + max(map(words_width, box.parts), default=0)
        at = y
        for part in box.parts:
            end = self.place(part, start, at)
            entry = self.found.spots[part].y + ENTRY
            aside = APART if part.kind == "clause" else 0
            self.found.stems.append(Stem(part, (spot.right, spot.y + ENTRY), turn - aside, (start, entry)))
            bottom = max(bottom, end)
            at = end + ROW
        if box.parts and box in self.gives:
            self.below[box] = bottom + LANE / 2
            bottom += LANE
        return bottom

    def height_of(self, box: Box) -> float:
        """The height of BOX, whose lines and ports it has room for."""
        ports = 0 if box.parts else len(self.gives.get(box, ())) + len(self.takes.get(box, ()))
        return max(len(box.lines) * LINE + 2 * PAD_Y, (ports + 1) * PORT)

    # --- lines -------------------------------------------------------------------

    def run_wires(self) -> None:
        """Find tracks for all joins, and their way there."""
        found = self.found
        edge = MARGIN + found.card_width + TRACK
        ends: list[float] = []  # how far down each track is taken
        ways = [(join, *self.ways(join)) for join in self.joins]
        for join, outward, inward in sorted(ways, key=lambda way: extent(way[1], way[2])):
            top, bottom = extent(outward, inward)
            number = next((i for i, end in enumerate(ends) if end + PORT < top), len(ends))
            ends[number : number + 1] = [bottom]
            track = edge + number * TRACK
            outward = [[*way, (track, way[-1][1])] for way in outward]
            inward = [[(track, way[0][1]), *way] for way in inward]
            found.wires.append(Wire(join, track, top, bottom, outward, inward))
        if ends:
            found.width = edge + (len(ends) - 1) * TRACK + MARGIN

    def ways(self, join: Join) -> tuple[list[list[Point]], list[list[Point]]]:
        """The lines of JOIN from its boxes, and those to its boxes, as far as the track."""
        outward = []
        for box in join.sources:
            spot = self.found.spots[box]
            if box in self.below:
                x, y = spot.x + PAD_X + PORT * self.next_port(box), self.below[box]
                outward.append([(x, spot.bottom), (x, y)])
            else:
                outward.append([self.port(spot)])
        inward = []
        for box in join.sinks:
            spot = self.found.spots[box]
            if box in self.above:
                x = spot.x + PAD_X + PORT
                inward.append([(x, self.above[box]), (x, spot.y)])
            else:
                inward.append([self.port(spot)])
        return outward, inward

    def port(self, spot: Spot) -> Point:
        """The next place at the right side of SPOT for a line."""
        count = len(self.gives.get(spot.box, ()))
        count += 0 if spot.box in self.above else len(self.takes.get(spot.box, ()))
        return spot.right, spot.y + spot.height * (self.next_port(spot.box) + 1) / (count + 1)

    def next_port(self, box: Box) -> int:
        """How many ports of BOX have lines already; now one more."""
        used = self.used.get(box, 0)
        self.used[box] = used + 1
        return used


def extent(outward: list[list[Point]], inward: list[list[Point]]) -> tuple[float, float]:
    """From where to where the track of such lines reaches."""
    heights = [way[-1][1] for way in outward] + [way[0][1] for way in inward]
    return min(heights), max(heights)


def shown_lines(box: Box) -> Iterator[str]:
    """The lines in BOX, with the word above them before the first."""
    first, *more = box.lines
    yield f"{box.tag} {first}" if box.tag else first
    yield from more


def width_of(box: Box) -> float:
    """The width of BOX."""
    return round(max(map(width, shown_lines(box))) * LETTER + 2 * PAD_X, 1)


def words_width(box: Box) -> float:
    """The width of the words on the line that leads to BOX."""
    return round(max(width(box.edge), width(box.under)) * SMALL, 1)
