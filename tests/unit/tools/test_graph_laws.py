"""Laws of drawings, on all plans and on drawings that chance makes."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from itertools import pairwise
from random import Random
from typing import NamedTuple

import pytest
from hypothesis import given
from hypothesis import strategies as st
from unit.tools.command import ROOT, call
from unit.tools.graphs import NEST, drawn

from eslang.base.spans import Source
from eslang.interpreter import Interpreter
from eslang.tools.graph_layout import Layout, Point, Spot, layout
from eslang.tools.graph_looks import LOOKS
from eslang.tools.graph_mermaid import mermaid
from eslang.tools.graph_model import Box, Definition, Graph, Key
from eslang.tools.graph_plan import DEFINING, READERS, Plan
from eslang.tools.graph_svg import svg

PLANS = sorted((ROOT / "plans").glob("*/*.esl"))
every_plan = pytest.mark.parametrize("text", [NEST, *(path.read_text(encoding="utf-8") for path in PLANS)])

NODE = re.compile(
    r'  (\w+)(?:\[|\(\[|\{\{|\(\()"((?:[\w (),.:?!=/+\'-]|#\d+;|<br/>)*)"(?:\]|\]\)|\}\}|\)\))(?::::\w+)?'
)
EDGE = re.compile(r'  (\w+) (?:---|-\.-|-->|-\.->)(?:\|"(?:[\w (),.:?!=/+\'-]|#\d+;)*"\|)? (\w+)')
CLASS = re.compile(r"  classDef \w+ fill:#\w{6},stroke:#\w{6},color:#\w{6}")

OPERATORS = [f"{each.package}::{each.name}" for each in (*READERS, *DEFINING)]
ATOMS = [
    "x",
    "nil",
    "t",
    ":k",
    "3",
    '"s"',
    "#?v",
    "'q",
    "`(a ,(f))",
    ":retries",
    ":while",
    "#'f",
    "f",
    "(f)",
    "((f) x)",
]

texts = st.text(st.characters(codec="utf-8"), min_size=1, max_size=30).map(lambda text: text or "x")
keys = st.builds(Key, st.sampled_from(["call", "achieve", "event", "end"]), st.integers(0, 5))


def boxes(parts: st.SearchStrategy[list[Box]]) -> st.SearchStrategy[Box]:
    """Boxes of any kind, with PARTS."""
    return st.builds(
        Box,
        kind=st.sampled_from(sorted(LOOKS)),
        lines=st.lists(texts, min_size=1, max_size=4),
        tag=st.sampled_from(["", "function"]),
        edge=st.one_of(st.just(""), texts),
        under=st.sampled_from(["", "utility 3"]),
        title=texts,
        parts=parts,
        gives=st.lists(keys, max_size=4, unique=True),
        takes=st.lists(keys, max_size=2, unique=True),
    )


trees = st.recursive(boxes(st.just([])), lambda inner: boxes(st.lists(inner, max_size=4)), max_leaves=12)
graphs = st.lists(st.builds(Definition, texts, trees), max_size=4).map(
    lambda found: Graph("a <b> & c", found)
)


class Line(NamedTuple):
    """A piece of a line, from left to right or from top to bottom."""

    left: float
    top: float
    right: float
    bottom: float


def lines_of(found: Layout) -> list[Line]:
    """All pieces of lines between boxes."""
    pieces: list[Line] = []
    for stem in found.stems:
        turns = [(stem.turn, stem.start[1]), (stem.turn, stem.end[1])]
        pieces += pieces_of([stem.start, *turns, stem.end])
    for wire in found.wires:
        for way in (*wire.outward, *wire.inward, [(wire.track, wire.top), (wire.track, wire.bottom)]):
            pieces += pieces_of(way)
    return pieces


def pieces_of(way: list[Point]) -> list[Line]:
    """The pieces of a line with corners."""
    return [Line(min(a, c), min(b, d), max(a, c), max(b, d)) for (a, b), (c, d) in pairwise(way)]


def overlap(one: Spot, other: Spot) -> bool:
    """Whether two boxes have some of the drawing in common."""
    beside = one.right <= other.x or other.right <= one.x
    return not beside and not (one.bottom <= other.y or other.bottom <= one.y)


def check_layout(graph: Graph) -> None:
    """No two boxes overlap, no line runs through a box, and all is inside the drawing."""
    found = layout(graph)
    spots = sorted(found.spots.values(), key=lambda spot: spot.y)
    for number, one in enumerate(spots):
        for other in spots[number + 1 :]:
            if other.y >= one.bottom:
                break
            assert not overlap(one, other), (one.box.lines, other.box.lines)
    for line in lines_of(found):
        assert line.left == line.right or line.top == line.bottom
        assert line.left >= 0 and line.top >= 0 and line.right <= found.width and line.bottom <= found.height
        for spot in spots:
            beside = line.right <= spot.x or line.left >= spot.right
            assert beside or line.bottom <= spot.y or line.top >= spot.bottom, (line, spot.box.lines)


def check_mermaid(graph: Graph) -> None:
    """Every line is one that Mermaid knows, and every node that a line names is there."""
    title, head, *lines = mermaid(graph).rstrip("\n").split("\n")
    assert (title[:3], head) == ("%% ", "flowchart LR")
    nodes, named = [], set()
    for line in lines:
        node, edge = NODE.fullmatch(line), EDGE.fullmatch(line)
        assert node or edge or CLASS.fullmatch(line), line
        if node:
            nodes.append(node[1])
        elif edge:
            named |= {edge[1], edge[2]}
    assert len(nodes) == len(set(nodes))
    assert named <= set(nodes)


def check_svg(graph: Graph) -> None:
    """It is XML with a title; every box is a group that can be named, and every link leads to one."""
    picture = ET.fromstring(svg(graph))
    space = "{http://www.w3.org/2000/svg}"
    assert picture.tag == f"{space}svg"
    assert picture.findtext(f"{space}title") == graph.title
    groups = [each.get("id") for each in picture.iter(f"{space}g")]
    assert groups == list(dict.fromkeys(groups))
    assert set(groups) == {box.label for box in graph.boxes()}
    assert {each.get("href", "")[1:] for each in picture.iter(f"{space}a")} <= set(groups)


@every_plan
def test_the_drawing_of_a_plan_keeps_the_laws(text: str) -> None:
    graph = drawn(text)
    assert graph.definitions
    check_layout(graph)
    check_mermaid(graph)
    check_svg(graph)


@pytest.mark.slow
@given(graphs)
def test_boxes_and_lines_keep_apart(graph: Graph) -> None:
    check_layout(graph)


@pytest.mark.slow
@given(graphs)
def test_a_flowchart_names_only_its_nodes_and_no_label_ends_it(graph: Graph) -> None:
    check_mermaid(graph)


@pytest.mark.slow
@given(graphs)
def test_a_picture_is_xml_whatever_stands_in_it(graph: Graph) -> None:
    check_svg(graph)


@pytest.mark.slow
@given(st.randoms(use_true_random=False))
def test_forms_of_any_shape_can_be_drawn(chance: Random) -> None:
    with Interpreter(clock="virtual") as interp, interp.at_work():
        text = "\n".join(any_form(chance, 4) for _ in range(20))
        readings = list(interp.readings(Source("any", text)))
        graph = Graph("any", Plan(interp.image, readings).definitions())
    check_layout(graph)
    check_mermaid(graph)
    check_svg(graph)


def any_form(chance: Random, depth: int) -> str:
    """A form of any shape, whether it could be run or not."""
    if depth == 0 or chance.random() < 0.25:
        return chance.choice(ATOMS)
    inner = [any_form(chance, depth - 1) for _ in range(chance.randrange(5))]
    end = " . x)" if inner and chance.random() < 0.05 else ")"
    return "(" + " ".join([chance.choice(OPERATORS), *inner]) + end


def test_the_same_plan_is_drawn_the_same_byte_for_byte() -> None:
    plan = str(PLANS[-1])
    for options in ([], ["--svg"]):
        assert call(["graph", *options, plan]).out == call(["graph", *options, plan]).out


def test_many_who_signal_to_many_who_wait_are_joined_in_one_point() -> None:
    steps = [Box("signal", [f"s{n}"], gives=[Key("event", 1)]) for n in range(5)]
    waits = [Box("wait", [f"w{n}"], takes=[Key("event", 1)]) for n in range(5)]
    text = mermaid(Graph("x", [Definition("f", Box("definition", ["f"], parts=[*steps, *waits]))]))
    assert text.count(" -.-> j1") == text.count("  j1 -.-> ") == 5
    assert '  j1(("event"))' in text
