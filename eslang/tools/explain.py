"""`esl explain NAME`: what a diagnostic means, and how to mend what it is about.

The words are docs/reference/errors.md, one section a diagnostic. A wheel
carries that page inside the package; here it is only cut up and shown.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from textwrap import wrap

from eslang.base.suggest import nearest
from eslang.tools.options import Chosen, Usage

NOT_FOUND = 1
WIDTH = 78
_PACKAGE = Path(__file__).resolve().parents[1]
_PAGES = (_PACKAGE / "errors.md", _PACKAGE.parent / "docs" / "reference" / "errors.md")


def explain(chosen: Chosen) -> int:
    """Do what `esl explain` was asked for; the exit code."""
    if not chosen.words:
        raise Usage("`esl explain` needs the name of a diagnostic")
    code = 0
    for position, name in enumerate(chosen.words):
        text = explanation(name)
        if text is None:
            sys.stderr.write(_unknown(name))
            code = NOT_FOUND
        else:
            sys.stdout.write("\n" * bool(position) + text)
    return code


def explanation(name: str) -> str | None:
    """What the diagnostic NAME means, as a terminal shows it; None if there is none of that name."""
    section = sections().get(name)
    if section is None:
        return None
    lines = [name, ""]
    prose: list[str] = []
    fenced = False
    for line in [*section.strip().split("\n"), ""]:
        if line and not fenced and not line.startswith("```"):
            prose.append(line)
            continue
        lines += wrap(" ".join(prose), WIDTH)
        prose = []
        if line.startswith("```"):
            fenced = not fenced
        elif not line.startswith("; expect"):
            lines.append(f"    {line}".rstrip() if fenced else line)
    return "\n".join(lines).rstrip() + "\n"


def sections() -> dict[str, str]:
    """The sections of the reference page, by the name of the diagnostic."""
    page = next((path for path in _PAGES if path.exists()), None)
    if page is None:
        return {}
    parts = re.split(r"^## ([a-z-]+)\n", page.read_text(encoding="utf-8"), flags=re.M)
    return {name: text.split("\n# ")[0] for name, text in zip(parts[1::2], parts[2::2], strict=True)}


def _unknown(name: str) -> str:
    near = nearest(name, sections())
    return f"esl: no diagnostic is called `{name}`" + (f"; the nearest is `{near}`" if near else "") + "\n"
