"""The blocks of a Markdown page that run.

The fenced blocks with `? ` prompts are one conversation, in the order of the
page, which may build on what it said before. An ```esl block without prompts
is a program of its own, whose `; expect` comments must hold. Other blocks are
left alone.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from eslang.base.spans import Source
from eslang.tools.expectations import Came, Expected, troubles
from eslang.tools.transcript import Entry, Stage, is_prompt, read_transcript, replay

FENCE = re.compile(r"^(?P<indent> *)(?P<fence>`{3,}|~{3,})\s*(?P<words>[^`]*)$")


class Block(NamedTuple):
    """One fenced block that runs."""

    text: str
    line: int  # of the first line inside the fence
    is_transcript: bool


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
        body = [line[depth:] if line[:depth].isspace() else line for line in lines[start:at]]
        at += 1
        is_transcript = any(is_prompt(line) for line in body)
        if is_transcript or opening["words"].split()[:1] == ["esl"]:
            blocks.append(Block("\n".join(body), start + 1, is_transcript))
    return blocks


def _closes(line: str, fence: str) -> bool:
    stripped = line.strip()
    return stripped.startswith(fence) and not stripped.strip(fence[0])


def page_entries(blocks: list[Block]) -> list[Entry]:
    """The entries of all the transcripts of a page."""
    return [
        entry for block in blocks if block.is_transcript for entry in read_transcript(block.text, block.line)
    ]


def block_troubles(block: Block, name: str) -> list[str]:
    """Run a block without prompts; what went otherwise than it expects."""
    came = Came()

    def run() -> None:
        for reading in stage.interp.readings(Source(f"{name}:{block.line}", block.text)):
            stage.interp.evaluate(reading)

    with Stage(listener=came.hear) as stage:
        came.of(run)
        came.output = stage.take()
    return troubles(Expected(block.text), came)


def page_troubles(text: str, name: str) -> list[str]:
    """Run all that runs of a page; what went otherwise than it says."""
    blocks, found = read_page(text), []
    for block in blocks:
        if not block.is_transcript:
            found += [f"{name}:{block.line}: {trouble}" for trouble in block_troubles(block, name)]
    differs = replay(page_entries(blocks))
    return [*found, differs.text(name)] if differs is not None else found
