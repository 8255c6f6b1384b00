"""A plan's structure as a picture, SVG that needs nothing but itself."""

from __future__ import annotations

from collections.abc import Iterator
from xml.sax.saxutils import escape, quoteattr

from eslang.tools.graph_layout import (
    ENTRY,
    HEADING,
    LINE,
    MARGIN,
    PAD_X,
    PAD_Y,
    STUB,
    Layout,
    Point,
    Spot,
    Stem,
    Wire,
    layout,
)
from eslang.tools.graph_looks import LOOKS, Look
from eslang.tools.graph_model import EMPTY, Box, Graph

HUES = ("#24558c", "#b05a00", "#2f7a3b", "#7a48ab", "#b02a32", "#1f7886", "#6d6a00", "#a0306f")
CALLS = ("call", "achieve")
STYLE = """\
text { font: 12px Menlo, Consolas, "DejaVu Sans Mono", ui-monospace, monospace; fill: #1b1f24 }
.e { font-size: 11px; fill: #3d4650 } .u { font-size: 11px; fill: #77530a }
.b { font-weight: 600 } .t { font-weight: 400; fill: #5a6572 } .h { font-size: 13px; font-weight: 600 }
.c { fill: #fcfcfd; stroke: #e1e5ea } .s { fill: none; stroke: #8b95a1 } .s.r { stroke: #bd5a20 }
.r, .d { stroke-dasharray: 5 3 } .w { fill: none; stroke-width: 1.4 } a { cursor: pointer }
:target > rect, :target > path { stroke-width: 3 }
"""


def svg(graph: Graph) -> str:
    """GRAPH as the text of an SVG file."""
    return "\n".join(parts(graph, layout(graph))) + "\n"


def parts(graph: Graph, found: Layout) -> Iterator[str]:
    """The elements of the picture, those behind before those in front."""
    wide, high = number(found.width), number(found.height)
    yield (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" height="{high}" viewBox="0 0 {wide} {high}"'
        ' role="img" aria-labelledby="title summary">'
    )
    yield f'<title id="title">{clean(graph.title)}</title>'
    yield f'<desc id="summary">{clean(summary(graph))}</desc>'
    yield f"<style>\n{STYLE}</style>"
    yield f'<rect width="{wide}" height="{high}" fill="#ffffff"/>'
    yield f'<text class="h" x="{MARGIN}" y="{MARGIN + HEADING / 2:g}">{clean(graph.title)}</text>'
    if not graph.definitions:
        yield f'<text x="{MARGIN}" y="{MARGIN + HEADING + LINE}">{clean(EMPTY)}</text>'
    for card in found.cards:
        yield (
            f'<rect class="c" x="{MARGIN}" y="{number(card.y)}" width="{number(found.card_width)}"'
            f' height="{number(card.height)}" rx="6"/>'
        )
    for stem in found.stems:
        yield from stem_parts(stem)
    for count, wire in enumerate(found.wires):
        yield from wire_parts(wire, HUES[count % len(HUES)])
    targets = targets_of(found)
    for spot in found.spots.values():
        yield from spot_parts(spot, targets.get(spot.box))
    yield "</svg>"


def summary(graph: Graph) -> str:
    """What is to be seen, in one sentence."""
    if not graph.definitions:
        return EMPTY
    named = [f"{each.box.tag} {each.box.lines[0]}" for each in graph.definitions]
    return f"From top to bottom: {'; '.join(named)}."


def targets_of(found: Layout) -> dict[Box, str]:
    """The one definition that a box without parts leads to, if it is one."""
    leads: dict[Box, list[str]] = {}
    for wire in found.wires:
        if wire.join.key.kind in CALLS:
            for box in wire.join.sources:
                leads.setdefault(box, []).append(wire.join.sinks[0].label)
    return {box: labels[0] for box, labels in leads.items() if len(labels) == 1 and not box.parts}


# --- boxes ---------------------------------------------------------------------------


def spot_parts(spot: Spot, target: str | None) -> Iterator[str]:
    """A box: its outline, its words, what it says when pointed at, and where a click leads."""
    box, look = spot.box, LOOKS[spot.box.kind]
    if target is not None:
        yield f"<a href={quoteattr('#' + target)}>"
    yield f'<g id="{box.label}"><title>{clean(told(box))}</title>'
    yield outline(spot, look)
    y = spot.y + PAD_Y + LINE * 3 / 4 + (spot.height - 2 * PAD_Y - LINE * len(box.lines)) / 2
    for count, line in enumerate(box.lines):
        weight = ' class="b"' if look.is_bold and count == 0 else ""
        tag = f'<tspan class="t">{clean(box.tag)} </tspan>' if box.tag and count == 0 else ""
        place = f'x="{number(spot.x + PAD_X)}" y="{number(y + count * LINE)}"'
        yield f"<text{weight} {place}>{tag}{clean(line)}</text>"
    yield "</g>" if target is None else "</g></a>"


def outline(spot: Spot, look: Look) -> str:
    """The outline of a box."""
    paint = f'fill="{look.fill}" stroke="{look.stroke}"'
    x, y, wide, high = (number(each) for each in (spot.x, spot.y, spot.width, spot.height))
    if look.shape != "cut":
        radius = 11 if look.shape == "round" else 3
        return f'<rect x="{x}" y="{y}" width="{wide}" height="{high}" rx="{radius}" {paint}/>'
    cut, left, top, right, bottom = 6, spot.x, spot.y, spot.right, spot.bottom
    corners = [(left + cut, top), (right - cut, top), (right, top + cut), (right, bottom - cut)]
    corners += [(right - cut, bottom), (left + cut, bottom), (left, bottom - cut), (left, top + cut)]
    return f'<path d="{path(corners)}Z" {paint}/>'


def told(box: Box) -> str:
    """What a box says when it is pointed at."""
    return "\n".join(filter(None, (box.title, box.place)))


# --- lines ---------------------------------------------------------------------------


def stem_parts(stem: Stem) -> Iterator[str]:
    """The line to a part, and the words on it."""
    (x, y), (to_x, to_y) = stem.start, stem.end
    way = f"M{number(x)} {number(y)}H{number(stem.turn)}V{number(to_y)}H{number(to_x)}"
    yield f'<path class="s{" r" if stem.part.kind == "clause" else ""}" d="{way}"/>'
    at = number(stem.turn + STUB / 4)
    if stem.part.edge:
        yield f'<text class="e" x="{at}" y="{number(to_y - 3)}">{clean(stem.part.edge)}</text>'
    if stem.part.under:
        yield f'<text class="u" x="{at}" y="{number(to_y + ENTRY - 1)}">{clean(stem.part.under)}</text>'


def wire_parts(wire: Wire, hue: str) -> Iterator[str]:
    """The lines that join boxes: along the track, from and to the boxes."""
    dashed = "" if wire.join.key.kind in CALLS else " d"
    ways = [path(way) for way in (*wire.outward, *wire.inward)]
    ways.append(path([(wire.track, wire.top), (wire.track, wire.bottom)]))
    yield f'<path class="w{dashed}" stroke="{hue}" d="{"".join(ways)}"/>'
    heads = "".join(arrow(way[-2], way[-1]) for way in wire.inward)
    yield f'<path fill="{hue}" d="{heads}"/>'


def arrow(before: Point, end: Point) -> str:
    """The head of an arrow that comes from BEFORE, and ends at END."""
    (x, y), (from_x, from_y) = end, before
    if from_x == x:
        side = -7 if from_y < y else 7
        return path([(x, y), (x - 3.5, y + side), (x + 3.5, y + side)]) + "Z"
    side = -7 if from_x < x else 7
    return path([(x, y), (x + side, y - 3.5), (x + side, y + 3.5)]) + "Z"


def path(points: list[Point]) -> str:
    """Straight lines from point to point."""
    return "M" + "L".join(f"{number(x)} {number(y)}" for x, y in points)


def number(value: float) -> str:
    """VALUE in pixels, short."""
    return f"{round(value, 1):g}" if abs(value) < 100_000 else str(round(value))


def clean(text: str) -> str:
    """TEXT as XML has it, without characters that it cannot have."""
    return escape("".join([char if char.isprintable() or char == "\n" else "·" for char in text]))
