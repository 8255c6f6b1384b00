"""How each kind of box looks, in whatever drawing: its colours, dark on light, and its shape."""

from __future__ import annotations

from typing import NamedTuple


class Look(NamedTuple):
    """Colours of the box and its line, and the kind of its outline."""

    fill: str
    stroke: str
    shape: str = "box"  # box, round (something that runs or waits), cut (a choice)
    is_bold: bool = False  # its first line is an operator or a name


LOOKS = {
    "definition": Look("#d9e7f7", "#24558c", "box", True),
    "loaded": Look("#e9ecef", "#4a5563", "box", True),
    "goal": Look("#dcf1df", "#2f7a3b", "box", True),
    "function": Look("#e9f0f9", "#6c8fb5", "box", True),
    "sequence": Look("#f1f3f5", "#7b8591", "box", True),
    "loop": Look("#f1f3f5", "#7b8591", "box", True),
    "branch": Look("#fbf6e3", "#a8882d", "cut", True),
    "choice": Look("#fdeec7", "#a87405", "cut", True),
    "parallel": Look("#efe4f8", "#7a48ab", "box", True),
    "task": Look("#f6effb", "#7a48ab", "round", True),
    "recovery": Look("#fdebdf", "#bd5a20", "box", True),
    "clause": Look("#fef5ee", "#bd5a20", "box", True),
    "keep": Look("#e6e8fb", "#4c57b3", "box", True),
    "around": Look("#f1f3f5", "#7b8591", "box", True),
    "call": Look("#ffffff", "#24558c"),
    "fail": Look("#fce1e2", "#b02a32"),
    "leave": Look("#fff1f1", "#b02a32"),
    "wait": Look("#ddf2f5", "#1f7886", "round"),
    "signal": Look("#f0fafb", "#1f7886", "round"),
    "fact": Look("#f3f7e6", "#728426"),
    "plain": Look("#ffffff", "#b3bac2"),
}
