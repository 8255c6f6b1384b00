"""The blocks of a Markdown page that run.

A fenced block with `? ` prompts is a transcript; an ```esl block without them
is a plan whose `; expect` comments must hold. All blocks of one page share one
interpreter, in order, so that a page may build on what it said before; a fence
```esl fresh``` begins anew. Other blocks are left alone.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from eslang.tools.conversation import PROMPT
from eslang.tools.expectations import Came, Expected, troubles
from eslang.tools.narrator import narrate
from eslang.tools.transcript import Stage, difference, read_transcript

FENCE = re.compile(r"^(?P<indent> *)(?P<fence>`{3,}|~{3,})\s*(?P<words>[^`]*)$")


class Block(NamedTuple):
    """One fenced block that runs."""

    text: str
    line: int  # of the first line inside the fence
    fresh: bool

    @property
    def is_transcript(self) -> bool:
        """True if the block has prompts."""
        return any(line.startswith(PROMPT) for line in self.text.split("\n"))


def read_page(text: str) -> list[Block]:
    """The blocks of a page that run, in order."""
    blocks: list[Block] = []
    lines, at = text.split("\n"), 0
    while at < len(lines):
        opening = FENCE.match(lines[at])
        at += 1
        if opening is None:
            continue
        start, depth = at, len(opening["indent"])
        while at < len(lines) and not _closes(lines[at], opening["fence"]):
            at += 1
        body = "\n".join(line[depth:] if line[:depth].isspace() else line for line in lines[start:at])
        at += 1
        words = opening["words"].split()
        block = Block(body, start + 1, "fresh" in words)
        if words[:1] == ["esl"] or (not words and block.is_transcript):
            blocks.append(block)
    return blocks


def _closes(line: str, fence: str) -> bool:
    stripped = line.strip()
    return stripped.startswith(fence) and not stripped.strip(fence[0])


def page_troubles(text: str, name: str) -> list[str]:
    """Run the blocks of a page; what went otherwise than it says."""
    stage: Stage | None = None
    found: list[str] = []
    for block in read_page(text):
        if stage is None or block.fresh:
            stage = Stage()
        if block.is_transcript:
            for entry in read_transcript(block.text, block.line):
                differs = difference(entry, stage.answer_to(entry.form))
                if differs is not None:
                    return [*found, differs.text(name)]
        else:
            found += [f"{name}:{block.line}: {trouble}" for trouble in block_troubles(block, stage)]
    return found


def block_troubles(block: Block, stage: Stage) -> list[str]:
    """Run a block without prompts on STAGE; what went otherwise than it expects."""
    from eslang.base.spans import Source

    interp, came = stage.interp, Came()

    def run() -> None:
        for reading in interp.readings(Source("<page>", block.text)):
            interp.evaluate(reading)

    stage.take()
    stage.listener = came.hear
    came.of(run)
    stage.listener = narrate
    came.output = stage.take()
    return troubles(Expected(block.text), came)

