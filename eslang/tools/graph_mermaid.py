"""A plan's structure as a flowchart of Mermaid."""

from __future__ import annotations

import re
from collections.abc import Iterator

from eslang.tools.graph_looks import LOOKS
from eslang.tools.graph_model import EMPTY, Box, Graph, Join

STRANGE = re.compile(r"[^\w (),.:?!=/+'-]", re.ASCII)  # may mean something to Mermaid, Markdown or HTML
SHAPES = {"box": ("[", "]"), "round": ("([", "])"), "cut": ("{{", "}}")}
MOST = 12  # lines that are drawn one by one between those that a key joins


def mermaid(graph: Graph) -> str:
    """GRAPH as the text of a flowchart."""
    title = "".join([char if char.isprintable() else " " for char in graph.title])
    return "\n".join([f"%% {title}", "flowchart LR", *lines(graph)]) + "\n"


def lines(graph: Graph) -> Iterator[str]:
    """The boxes, what leads from one to the other, and how they look."""
    if not graph.definitions:
        yield f'  nothing["{escaped(EMPTY)}"]'
    for box in graph.boxes():
        yield f"  {node(box)}"
    for box in graph.boxes():
        for part in box.parts:
            line = "-.-" if part.kind == "clause" else "---"
            yield f"  {box.label} {line}{edge_text(part)} {part.label}"
    for number, join in enumerate(graph.joins(), 1):
        yield from joined(join, number)
    kinds = {box.kind for box in graph.boxes()}
    for kind, look in LOOKS.items():
        if kind in kinds:
            yield f"  classDef {kind}Box fill:{look.fill},stroke:{look.stroke},color:#1b1f24"


def node(box: Box) -> str:
    """BOX, with its shape and class."""
    begin, end = SHAPES[LOOKS[box.kind].shape]
    first, *more = box.lines
    words = [f"{box.tag} {first}" if box.tag else first, *more]
    return f'{box.label}{begin}"{"<br/>".join(map(escaped, words))}"{end}:::{box.kind}Box'


def edge_text(box: Box) -> str:
    """What stands on the line that leads to BOX, as Mermaid wants it."""
    words = ", ".join(filter(None, (box.edge, box.under)))
    return f'|"{escaped(words)}"|' if words else ""


def joined(join: Join, number: int) -> Iterator[str]:
    """The lines of the NUMBERth JOIN; if they were many, through a point of its own."""
    arrow = "-->" if join.key.kind in ("call", "achieve") else "-.->"
    if len(join.sources) == 1 or len(join.sinks) == 1 or len(join.sources) * len(join.sinks) <= MOST:
        for source in join.sources:
            for sink in join.sinks:
                yield f"  {source.label} {arrow} {sink.label}"
        return
    point = f"j{number}"
    yield f'  {point}(("{join.key.kind}"))'
    for source in join.sources:
        yield f"  {source.label} {arrow} {point}"
    for sink in join.sinks:
        yield f"  {point} {arrow} {sink.label}"


def escaped(text: str) -> str:
    """TEXT between quotes, so that nothing in it has a meaning: its numbers stand for what is strange."""
    return STRANGE.sub(lambda found: numbered(found.group()), text)


def numbered(char: str) -> str:
    """CHAR by its number; letters of all scripts as they are."""
    return char if char.isalnum() else f"#{ord(char)};"
