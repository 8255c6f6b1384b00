"""Every claim has a file that shows it, every file shows a claim, and the page says so.

Where the papers leave it open which task runs first, or which step is chosen,
what they do say must hold whichever it is: the files about tasks, and all
about SCS, run with shuffled turns as well, and under many seeds.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from claims import CONFORMANCE, FIRST_LINES, ROOT, conformance_page, load_claims, shown_claims
from eslang.tools.expectations import Expected, troubles
from support import run

PAGE = ROOT / "docs" / "reference" / "conformance.md"
SEEDS = range(20)
FEW = 1  # of the seeds, where the suite is to be fast
TASKS = ("ESL §4", "ESL §6", "ARM §2, Task Management", "ARM §3", "SCS", "Language reference §7")
FACTS = ("ESL §5", "ARM §2, Logical", "ARM §4", "ARM §5", "ARM §6", "Language reference")
STARTS_TASKS = re.compile(r"\((?:task-net|or-parallel|with-guardian|spawn)\b")


def files_about_tasks() -> list[Path]:
    """The files that show claims about tasks, and those about facts that start tasks."""
    claims = load_claims()
    tasks = {claim.id for claim in claims if claim.section.startswith(TASKS)}
    facts = {claim.id for claim in claims if claim.section.startswith(FACTS)}
    found = []
    for path in sorted(CONFORMANCE.rglob("*.esl")):
        ids = {name for name, _ in first_lines(path)}
        if ids & tasks or (ids & facts and STARTS_TASKS.search(path.read_text(encoding="utf-8"))):
            found.append(path)
    return found


def first_lines(path: Path) -> list[tuple[str, str]]:
    """The claims that PATH names, each with its sentence."""
    return FIRST_LINES.findall(path.read_text(encoding="utf-8"))


def check_order(path: Path, seeds: range) -> None:
    """Fail unless PATH does the same with turns shuffled by each of SEEDS."""
    text = path.read_text(encoding="utf-8")
    expected = Expected(text)
    for seed in seeds:
        found = troubles(expected, run(text, name=path.name, seed=seed, shuffle=True))
        assert not found, "\n".join([f"{path.name}, shuffled with seed {seed}", *found])


every_file = pytest.mark.parametrize("path", files_about_tasks(), ids=lambda path: path.stem)


@every_file
def test_a_claim_about_tasks_holds_in_a_few_orders(path: Path) -> None:
    check_order(path, SEEDS[:FEW])


@pytest.mark.slow
@every_file
def test_a_claim_about_tasks_holds_in_any_order(path: Path) -> None:
    check_order(path, SEEDS[FEW:])


def test_every_file_shows_a_claim() -> None:
    known = {claim.id for claim in load_claims()}
    wrong = {path: ids for path, ids in shown_claims().items() if not ids or set(ids) - known}
    assert wrong == {}


def test_every_claim_has_a_file() -> None:
    shown = {claim for ids in shown_claims().values() for claim in ids}
    claims = {claim.id: claim for claim in load_claims()}
    assert len(claims) == len(load_claims()), "an id stands twice"
    assert [claim.id for claim in claims.values() if claim.same_as is None and claim.id not in shown] == []
    assert [claim.id for claim in claims.values() if claim.same_as and claim.same_as not in shown] == []


def test_the_page_of_claims_is_current() -> None:
    message = "python tests/claims.py writes it anew"
    assert PAGE.read_text(encoding="utf-8") == conformance_page(), message
