"""Drawings as the tests of them look at them: a plan's structure as an outline, and what joins its boxes."""

from __future__ import annotations

import tempfile
from pathlib import Path

from eslang.interpreter import Interpreter
from eslang.tools.graph_layout import shown_lines
from eslang.tools.graph_model import Box, Graph
from eslang.tools.graph_plan import read_plan

NEST = """
(in-package :scs-user)
(defstep work (n) "Nested." :until (> n 3)
  (do-first ((< n 1) (halt))
            (t (do-best :learn t
                        ((oddp n) (* 2 n) (halt))
                        (t 0 (repeat :while (< n 9) (halt))))
               (do*-all (do-any (halt) (work 1))
                        (with-cycle (10) (halt))))))
(defaction halt () :halted)
"""


def drawn(text: str) -> Graph:
    """The structure of the plan TEXT, which is right."""
    with tempfile.TemporaryDirectory() as folder, Interpreter(clock="virtual") as interp:
        path = Path(folder) / "plan.esl"
        path.write_text(text, encoding="utf-8")
        graph, _ = read_plan(interp, [str(path)])
    assert graph is not None
    return graph


def outline(text: str) -> list[str]:
    """The boxes of the plan TEXT, each indented below the one that it is in the care of."""
    return [line for each in drawn(text).definitions for line in lines_of(each.box, "")]


def lines_of(box: Box, indentation: str) -> list[str]:
    """BOX and all in its care, as lines."""
    lines = list(shown_lines(box))
    if box.kind == "plain":
        lines = [" / ".join(lines)]
    lead = f"{box.edge} > " if box.edge else ""
    lead += f"[{box.under}] " if box.under else ""
    found = [indentation + lead + lines[0], *(f"{indentation}  {line}" for line in lines[1:])]
    for part in box.parts:
        found += lines_of(part, indentation + "  ")
    return found


def joined(graph: Graph) -> list[tuple[str, str, str]]:
    """What joins the boxes of GRAPH: how, from where, and to where; definitions by their names alone."""
    return [
        (join.key.kind, name_of(source), name_of(sink))
        for join in graph.joins()
        for source in join.sources
        for sink in join.sinks
    ]


def name_of(box: Box) -> str:
    """The first line of BOX; of a function, without its arguments."""
    return box.lines[0].split(" ")[0] if box.kind == "definition" else box.lines[0]
