"""Every claim has a file that shows it, every file shows a claim, and the page says so."""

from __future__ import annotations

from claims import ROOT, conformance_page, load_claims, shown_claims

PAGE = ROOT / "docs" / "reference" / "conformance.md"


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
