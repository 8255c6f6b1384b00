"""`esl graph`: draw the static structure of plans, as Mermaid or as SVG.

The plans are checked first, as `esl check` does it, and not run. What is wrong
with them is said in the same words. If they can be read nevertheless, say that
they call what nobody defines, they are drawn.
"""

from __future__ import annotations

import os
import sys

from eslang.base.render import render
from eslang.base.suggest import nearest
from eslang.tools.checking import WRONG, counted
from eslang.tools.graph_model import Graph
from eslang.tools.opening import readable, reason
from eslang.tools.options import Chosen, Usage


def graph(chosen: Chosen) -> int:
    """Do what `esl graph` was asked for; 65 if some plan is wrong."""
    from eslang.interpreter import Interpreter
    from eslang.tools.graph_plan import read_plan

    if not chosen.words:
        raise Usage("`esl graph` needs a file")
    path = out_of(chosen)
    for word in chosen.words:
        readable(word)
    with Interpreter(clock="virtual", output=sys.stderr) as interp:  # where macros may write
        found, errors = read_plan(interp, chosen.words)
    for diagnostic in errors:
        sys.stderr.write(render(diagnostic) + "\n")
    if errors:
        sys.stderr.write(counted(len(errors), "error") + ("" if found else ", nothing is drawn") + "\n")
    if found is not None:
        text = drawn(
            picked(found, chosen.all("of")), is_svg=chosen.has("svg") or path.lower().endswith(".svg")
        )
        write(text, path)
    return WRONG if errors else 0


def write(text: str, path: str) -> None:
    """Write TEXT to the file PATH, and say so; or to standard output."""
    if path == "-":
        sys.stdout.write(text)
        return
    try:
        with open(path, "w", encoding="utf-8", newline="\n") as stream:
            stream.write(text)
    except OSError as trouble:
        raise Usage(f"cannot write `{path}`: {reason(trouble)}") from None
    sys.stdout.write(f"{path}\n")


def out_of(chosen: Chosen) -> str:
    """The file that CHOSEN names for the drawing; `-` is standard output."""
    path = chosen.value("o") or "-"
    if path != "-" and any(os.path.realpath(word) == os.path.realpath(path) for word in chosen.words):
        raise Usage(f"`{path}` is the plan itself; let `-o` name another file")
    return path


def picked(found: Graph, names: list[str]) -> Graph:
    """Of what was FOUND, the definitions called one of NAMES; all, if there are none."""
    if not names:
        return found
    known = sorted({each.name for each in found.definitions})
    wanted = [name.lower().strip("()") if name.lower() not in known else name.lower() for name in names]
    for name, word in zip(wanted, names, strict=True):
        if name not in known:
            near = nearest(name, known)
            hint = f"; the nearest is `{near}`" if near else ""
            raise Usage(f"nothing is defined here that is called `{word}`{hint}")
    return found.only(wanted)


def drawn(found: Graph, *, is_svg: bool) -> str:
    """FOUND as the text of a file."""
    if is_svg:
        from eslang.tools.graph_svg import svg

        return svg(found)
    from eslang.tools.graph_mermaid import mermaid

    return mermaid(found)
