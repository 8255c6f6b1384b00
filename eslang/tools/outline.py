"""The lists of a plan's text, and where they stand, without a reader's knowledge.

Plan coverage compares these places with those that compiled code carries. A
name is only its text here; which package it belongs to does not matter.
"""

from __future__ import annotations

from collections.abc import Iterator

from eslang.tools.tokens import BLANK, tokens

Place = tuple[int, int, int, int]  # line, column, end line, end column, as compiled code counts them


class Node:
    """A list of the text: where it stands, its parts (nodes, and atoms as text), its beginning as text."""

    def __init__(self, start: int) -> None:
        self.start = start
        self.parts: list[Node | str] = []
        self.place: Place = (0, 0, 0, 0)
        self.text = ""

    @property
    def operator(self) -> str:
        """The first part in lower case, if it is an atom."""
        return self.parts[0].lower() if self.parts and isinstance(self.parts[0], str) else ""

    def lists(self) -> list[Node]:
        """The parts that are lists."""
        return [part for part in self.parts if isinstance(part, Node)]

    def all(self) -> Iterator[Node]:
        """This list and all inside it."""
        yield self
        for part in self.lists():
            yield from part.all()


def outline(text: str) -> list[Node]:
    """The top-level lists of TEXT. A list that is not closed is left out."""
    starts = [0]
    for content in text.split("\n"):
        starts.append(starts[-1] + len(content) + 1)
    top: list[Node] = []
    stack: list[Node] = []
    line = 0
    for kind, start, end in tokens(text):
        if kind == "open":
            while starts[line + 1] <= start:
                line += 1
            stack.append(Node(start))
            stack[-1].place = (line + 1, start - starts[line], 0, 0)
        elif kind == "close" and stack:
            while starts[line + 1] <= start:
                line += 1
            node = stack.pop()
            node.place = (*node.place[:2], line + 1, end - starts[line])
            node.text = text[node.start : end]
            if stack:
                stack[-1].parts.append(node)
            else:
                top.append(node)
        elif stack and kind not in (*BLANK, "close", "quote"):
            stack[-1].parts.append(text[start:end])
    return top


class Clause:
    """A recovery clause of the text: its cause, its place, and the lists that are its body."""

    def __init__(self, node: Node) -> None:
        head = node.parts[0] if node.parts else ""
        self.node = node
        self.cause = head.operator if isinstance(head, Node) else head.lower()
        self.body = node.lists()[1:] if isinstance(head, Node) else node.lists()


def clauses_of(node: Node) -> list[Clause]:
    """The recovery clauses of the form NODE, if it has any (ESL §2.1; one clause needs no list around it)."""
    if node.operator.rpartition(":")[2] != "with-recovery-procedures" or len(node.parts) < 2:
        return []
    listed = node.parts[1]
    if not isinstance(listed, Node):
        return []
    return [Clause(listed)] if listed.operator else [Clause(part) for part in listed.lists()]
