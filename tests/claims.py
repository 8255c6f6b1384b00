"""The papers' claims, the files that show them, and docs/reference/conformance.md made from both.

Run as a program it writes the page.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
CONFORMANCE = ROOT / "tests" / "conformance"
FIRST_LINES = re.compile(r"^(?:;+|#) claim ([A-Z]+-[\w.-]+)(?:: (.*))?$", re.M)

INTRODUCTION = """\
# Conformance: the papers' sentences and the tests that show them

This page is made from `tests/conformance/claims.toml`, the files beside it, the transcripts,
and some tests in Python.
ESL is [Gat 1996]; ARM is [Gat and Pell 1998]; SCS is [Lee and Durfee 1995].
LR is the language reference, where it decides what the papers leave open.
A sentence is quoted as printed, hyphenation undone.
Where the second paper prints a sentence of the first again, its row points there.
"""


class Claim(NamedTuple):
    """One normative sentence of a paper."""

    id: str
    section: str
    quote: str
    same_as: str | None


def load_claims() -> list[Claim]:
    """All claims, in the order of the papers."""
    table = tomllib.loads((CONFORMANCE / "claims.toml").read_text(encoding="utf-8"))
    return [Claim(row["id"], row["section"], row["quote"], row.get("same-as")) for row in table["claim"]]


def shown_claims() -> dict[str, list[str]]:
    """The files that show claims, each with their ids; every conformance file is among them."""
    files = [*CONFORMANCE.rglob("*.esl"), *(ROOT / "tests" / "transcripts").glob("*.transcript")]
    files += (ROOT / "tests" / "unit" / "constructs").rglob("*.py")
    found = {}
    for path in sorted(files):
        ids = [name for name, _ in FIRST_LINES.findall(path.read_text(encoding="utf-8"))]
        if ids or path.suffix == ".esl":
            found[path.relative_to(ROOT).as_posix()] = ids
    return found


def conformance_page() -> str:
    """The reference page: one row a claim, under its section."""
    shown = shown_claims()
    page, section = [INTRODUCTION], ""
    for claim in load_claims():
        if claim.section != section:
            section = claim.section
            page.append(f"\n## {section}\n\n| claim | sentence | shown by |\n|---|---|---|\n")
        files = [path for path, ids in shown.items() if claim.id in ids]
        links = " · ".join(f"[{Path(path).stem}](../../{path})" for path in files)
        where = links or f"as {claim.same_as}"
        page.append(f"| {claim.id} | {cell(claim.quote)} | {where} |\n")
    return "".join(page)


def cell(quotation: str) -> str:
    """QUOTATION so that a table holds it."""
    return quotation.replace("|", "\\|").replace("*", "\\*")


if __name__ == "__main__":
    page = ROOT / "docs" / "reference" / "conformance.md"
    page.parent.mkdir(parents=True, exist_ok=True)
    page.write_text(conformance_page(), encoding="utf-8")
