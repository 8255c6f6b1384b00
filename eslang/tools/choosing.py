"""The options that force the order of turns, or write it down: `--choices` and `--record-choices`."""

from __future__ import annotations

import os
import sys
from typing import Any

from eslang.runtime.choices import choices_text, read_choices
from eslang.tools.options import Chosen, Usage


def choices_of(chosen: Chosen) -> list[str] | None:
    """The list of choices that CHOSEN names; an empty one if they are only to be written down."""
    path, record = chosen.value("choices"), chosen.value("record-choices")
    if record is not None and any(
        os.path.realpath(word) == os.path.realpath(record) for word in chosen.words
    ):
        raise Usage(f"the choices would take the place of `{record}`")
    if path is None:
        return [] if record is not None and not chosen.has("shuffle") else None
    if chosen.has("shuffle"):
        raise Usage("`--choices` says what `--shuffle` would draw: give one of them")
    try:
        with open(path, encoding="utf-8") as stream:
            return read_choices(stream.read())
    except (OSError, UnicodeDecodeError) as trouble:
        raise Usage(f"cannot read `{path}`: {words_of(trouble)}") from None


def write_choices(chosen: Chosen, interp: Any) -> None:
    """Write down the choices of INTERP, if CHOSEN asks for that."""
    path = chosen.value("record-choices")
    if path is None or interp.runs.choices is None:
        return
    try:
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(choices_text(interp.runs.choices.made))
    except OSError as trouble:
        sys.stderr.write(f"esl: cannot write `{path}`: {words_of(trouble)}\n")


def words_of(trouble: OSError | UnicodeDecodeError) -> str:
    """What went wrong, in words."""
    if isinstance(trouble, UnicodeDecodeError):
        return "it is no UTF-8 text"
    return (trouble.strerror or str(trouble)).lower()
