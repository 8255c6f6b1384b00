"""The line editor: what it completes, colours and takes for complete."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from prompt_toolkit.completion import CompleteEvent
from prompt_toolkit.document import Document
from prompt_toolkit.history import InMemoryHistory

from eslang.interpreter import Interpreter
from eslang.tools.conversation import Conversation
from eslang.tools.editing import NameCompleter, TokenLexer, history, is_complete, signature_at


@pytest.fixture(name="interp", scope="module")
def fixture_interp() -> Iterator[Interpreter]:
    with Interpreter() as interp:
        interp.eval("(defun grasp-cup (side &optional force) (list side force)) (defvar *grip* 1)")
        yield interp


def completions(interp: Interpreter, text: str) -> dict[str, str]:
    """What TEXT can be completed to, and what is shown beside it."""
    found = NameCompleter(Conversation(interp)).get_completions(Document(text), CompleteEvent())
    return {completion.text: completion.display_meta_text for completion in found}


def test_names_are_completed_with_their_signatures(interp: Interpreter) -> None:
    assert completions(interp, "(list (grasp") == {"grasp-cup": "(grasp-cup side &optional force)"}
    assert "with-recovery-procedures" in completions(interp, "(with-r")
    assert "*grip*" in completions(interp, "*gr")
    assert completions(interp, "(GRASP").keys() == {"GRASP-CUP"}


def test_relations_are_completed_with_a_pattern_behind_facts_and_in_queries() -> None:
    with Interpreter() as interp:
        interp.eval("(defrelation zone-of (thing zone)) (assert '(zed 1))")
        patterns = {"zone-of": "(zone-of ?thing ?zone)"}
        assert completions(interp, ":facts ") == {**patterns, "zed": "(zed ?1)"}
        assert completions(interp, ":facts zo") == completions(interp, "(db-query '(zo") == patterns


@pytest.mark.parametrize("text", ["", "(", "(list ", '"gras', "; gras"])
def test_nothing_is_completed_where_no_name_is_typed(interp: Interpreter, text: str) -> None:
    assert completions(interp, text) == {}


@pytest.mark.parametrize(
    "text", ["", "a", "(a)", "(a) (b)", ":facts (a ?x)", ":facts", ")", "(a))", "#<", "; x"]
)
def test_what_is_complete_or_wrong_is_answered_at_once(interp: Interpreter, text: str) -> None:
    assert is_complete(interp, text)


@pytest.mark.parametrize("text", ["(a", "(a) (b", ":facts (a ?x", '"a', "'", "#|", "|a", "(a ; )"])
def test_what_is_unfinished_goes_on(interp: Interpreter, text: str) -> None:
    assert not is_complete(interp, text)


def test_the_toolbar_shows_the_signature_at_hand(interp: Interpreter) -> None:
    assert signature_at(interp, "(list (grasp-cup :left") == "(grasp-cup side &optional force)"
    assert signature_at(interp, "(grasp-cup (unknown 1") == "(grasp-cup side &optional force)"
    assert signature_at(interp, "(unknown") is None
    assert signature_at(interp, "grasp-cup") is None


def test_every_line_is_coloured_whole() -> None:
    document = Document('(defun f ()\n  "a\nb" :key ; c\n)')
    line_of = TokenLexer().lex_document(document)
    assert ["".join(part[1] for part in line_of(number)) for number in range(4)] == document.lines
    assert ("class:operator", "defun") in line_of(0)
    assert ("class:keyword", ":key") in line_of(2)


def test_history_is_kept_where_it_can_be(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    history().store_string("(a)")
    assert list(history().load_history_strings()) == ["(a)"]
    monkeypatch.setenv("XDG_STATE_HOME", "/dev/null/nowhere")
    assert isinstance(history(), InMemoryHistory)
