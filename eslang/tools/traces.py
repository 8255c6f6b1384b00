"""`esl trace`: tell the run that a trace file holds, as text, as a page, or for a viewer of traces."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import PurePath

from eslang.base.suggest import nearest
from eslang.runtime.kinds import KINDS
from eslang.tools.opening import reason
from eslang.tools.options import Chosen, Usage
from eslang.tools.trace_reading import BadTrace, Trace, read_trace

WRONG = 65
NARROWEST = 60


def trace(chosen: Chosen) -> int:
    """Do what `esl trace` was asked for; the exit code."""
    if len(chosen.words) != 1:
        raise Usage("`esl trace` needs one file, which `esl run --trace FILE` has written")
    if chosen.has("html") and chosen.has("perfetto"):
        raise Usage("either `--html` or `--perfetto`")
    if chosen.has("o") and not (chosen.has("html") or chosen.has("perfetto")):
        raise Usage("`-o` is for `--html` and `--perfetto`")
    path = chosen.words[0]
    try:
        found = read_trace(path)
    except OSError as trouble:
        raise Usage(f"cannot read `{path}`: {reason(trouble)}") from None
    except BadTrace as wrong:
        sys.stderr.write(f"esl: {wrong}\n")
        return WRONG
    if chosen.has("html"):
        from eslang.tools.trace_page import page

        return write(chosen, page(found), ".html", found)
    if chosen.has("perfetto"):
        from eslang.tools.trace_chrome import chrome_text

        return write(chosen, chrome_text(found), ".perfetto.json", found)
    tell(found, chosen)
    return 0


def tell(found: Trace, chosen: Chosen) -> None:
    """Print the trace FOUND as text."""
    from eslang.tools.trace_text import Choice, trace_text

    tasks, kinds = chosen.all("task"), chosen.all("kind")
    known = {name for record in found.records for name in (record.task, record.told.get("about")) if name}
    for word, names, what in ((tasks, known, "task"), (kinds, set(KINDS), "kind of event")):
        for name in word:
            check_known(name, names, what)
    choice = Choice(tasks, kinds, moment(chosen, "from"), moment(chosen, "to"), everything=chosen.has("all"))
    columns = max(shutil.get_terminal_size((80, 24)).columns, NARROWEST)
    for line in trace_text(found, choice, columns):
        sys.stdout.write(line.rstrip() + "\n")


def check_known(name: str, names: set[str], what: str) -> None:
    """Refuse a NAME that is none of NAMES."""
    if name not in names:
        near = nearest(name, sorted(names))
        raise Usage(f"there is no {what} `{name}`" + (f"; the nearest is `{near}`" if near else ""))


def moment(chosen: Chosen, key: str) -> float | None:
    """The number of seconds that option KEY gives."""
    word = chosen.value(key)
    if word is None:
        return None
    try:
        return float(word)
    except ValueError:
        raise Usage(f"`--{key}` is a number of seconds, not `{word}`") from None


def write(chosen: Chosen, text: str, ending: str, found: Trace) -> int:
    """Write TEXT to the file that CHOSEN names, or to one beside the trace; say which."""
    path = chosen.value("o")
    if path is None:
        path = "-" if found.name == "<stdin>" else str(PurePath(found.name).with_suffix(ending))
    if path == "-":
        sys.stdout.write(text)
        return 0
    if os.path.realpath(path) == os.path.realpath(found.name):
        raise Usage(f"`{path}` is the trace itself; let `-o` name another file")
    try:
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(text)
    except OSError as trouble:
        raise Usage(f"cannot write `{path}`: {reason(trouble)}") from None
    sys.stdout.write(f"{path}\n")
    for remark in found.remarks:
        sys.stderr.write(f"esl: {found.name}: {remark}\n")
    return 0
