"""SAVE-FACTS and LOAD-FACTS, sentence by sentence."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from eslang import Failure, Interpreter


@pytest.fixture
def agent() -> Any:
    """An interpreter that knows a few things."""
    with Interpreter(clock="virtual") as made:
        made.eval("""
            (assert '(is-a w1 widget))
            (assert '(weight w1 2.5))
            (assert '(is-a w2 "a widget, of sorts"))""")
        yield made


def ends(agent: Interpreter, form: str) -> str:
    """The words of the failure that FORM ends with."""
    with pytest.raises(Failure) as caught:
        agent.eval(form)
    return " ".join(map(str, caught.value.arguments))


def test_facts_stand_in_the_file_one_a_line_below_what_says_how_to_read_them(
    agent: Interpreter, tmp_path: Path
) -> None:
    path = tmp_path / "all.facts"
    assert agent.call("save-facts", str(path)) == 3
    assert path.read_text().splitlines() == [
        ";;;; 3 facts, written by SAVE-FACTS for LOAD-FACTS",
        '(cl:in-package "ESL-USER")',
        "",
        "(is-a w1 widget)",
        '(is-a w2 "a widget, of sorts")',
        "(weight w1 2.5)",
    ]


def test_only_the_relations_that_are_named_are_saved_in_that_order(
    agent: Interpreter, tmp_path: Path
) -> None:
    path = tmp_path / "some.facts"
    agent.eval("(assert '(left out))")
    assert agent.eval(f"(save-facts \"{path}\" 'weight 'is-a)") == 3
    assert [line.split()[0] for line in path.read_text().splitlines()[3:]] == ["(weight", "(is-a", "(is-a"]


def test_a_relation_that_nobody_knows_is_not_saved(agent: Interpreter, tmp_path: Path) -> None:
    assert "no relation of this name" in ends(agent, f'(save-facts "{tmp_path}/f" \'wieght)')
    assert not (tmp_path / "f").exists()


@pytest.mark.parametrize(
    ("fact", "why"),
    [
        ("(list 'a #'car)", "a function has no text"),
        ('(list \'a (list 1 (make-symbol "X")))', "an uninterned symbol"),
        ("(list 'a (vector 1 2))", "equal to itself only"),
        ("(list 'a (cup))", "an object of Python has no text"),
        ('(list \'a (format nil "~C" (code-char 0)))', "the character with the code 0"),
        ("'(cl:in-package b)", "this name means something else"),
    ],
)
def test_what_has_no_text_is_refused_by_name_and_the_file_stays_as_it_was(
    agent: Interpreter, tmp_path: Path, fact: str, why: str
) -> None:
    agent.primitive(name="cup")(lambda: object())
    path = tmp_path / "f.facts"
    agent.call("save-facts", str(path))
    before = path.read_bytes()
    agent.eval(f"(assert {fact})")
    assert why in ends(agent, f'(save-facts "{path}")')
    assert path.read_bytes() == before
    assert os.listdir(tmp_path) == ["f.facts"]


def test_a_save_that_breaks_off_leaves_the_old_file_and_nothing_else(
    agent: Interpreter, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "f.facts"
    agent.call("save-facts", str(path))
    before = path.read_bytes()
    agent.eval("(assert '(more))")

    def full(number: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    assert "the file cannot be written" in ends(agent, f'(save-facts "{path}")')
    assert path.read_bytes() == before
    assert os.listdir(tmp_path) == ["f.facts"]


def test_a_link_stays_a_link_and_the_file_keeps_its_mode(agent: Interpreter, tmp_path: Path) -> None:
    path, link = tmp_path / "f.facts", tmp_path / "link"
    agent.call("save-facts", str(path))
    path.chmod(0o600)
    link.symlink_to(path)
    agent.eval("(assert '(more))")
    agent.call("save-facts", str(link))
    assert link.is_symlink() and "(more)" in path.read_text()
    assert path.stat().st_mode & 0o777 == 0o600


@pytest.mark.parametrize("path", ["/nowhere/f.facts", ".", "/dev/null", "a\\0b"])
def test_what_cannot_be_a_file_is_refused(agent: Interpreter, path: str) -> None:
    before = os.stat("/dev/null").st_ino
    with pytest.raises(Failure) as caught:
        agent.call("save-facts", path.replace("\\0", "\0"))
    assert caught.value.arguments[0] == "the file cannot be written"
    assert os.stat("/dev/null").st_ino == before


def test_loading_asserts_all_in_order_and_counts_what_is_new(agent: Interpreter, tmp_path: Path) -> None:
    path = tmp_path / "f.facts"
    path.write_text("; some\n\n(is-a w3 widget) (is-a w1 widget)\n(is-a\n  w0 ; first\n  widget)\n")
    assert agent.call("load-facts", str(path)) == 2
    found = agent.eval("(mapcar #'cdar (db-query '(is-a ?w widget)))")
    assert [symbol.name for symbol in found] == ["W1", "W3", "W0"]


def test_loading_is_one_change(agent: Interpreter, tmp_path: Path) -> None:
    path = tmp_path / "f.facts"
    path.write_text("(state on)\n(state off)\n")
    seen: list[int] = []
    agent.database.subscribe(lambda change: seen.append(len(agent.database)))
    agent.call("load-facts", str(path))
    assert seen == [5, 5]


def test_names_mean_what_in_package_says_and_until_then_what_they_mean_here(
    agent: Interpreter, tmp_path: Path
) -> None:
    path = tmp_path / "f.facts"
    agent.eval("(defpackage :robot (:use :cl))")
    path.write_text('(here a)\n(cl:in-package "ROBOT")\n(there b)\n(in-package :esl-user)\n(here c)\n')
    agent.call("load-facts", str(path))
    assert agent.eval("(length (db-query '(here ?x)))") == 2
    assert agent.eval("(length (db-query '(robot::there robot::b)))") == 1


def test_a_file_is_looked_for_beside_the_plan_that_is_being_loaded(
    agent: Interpreter, tmp_path: Path
) -> None:
    (tmp_path / "w.facts").write_text("(beside the plan)\n")
    (tmp_path / "plan.esl").write_text('(load-facts "w.facts")\n')
    agent.load(tmp_path / "plan.esl")
    assert agent.eval("(db-query '(beside the plan))")
    assert "the file cannot be read" in ends(agent, '(load-facts "w.facts")')


@pytest.mark.parametrize(
    ("text", "line", "why"),
    [
        ("(a b)\n(c d", 2, "this list is never closed"),
        ("(a b)\n)\n", 2, "this `)` closes nothing"),
        ("(a b)\n\n(c ?x)\n", 3, "this is no fact: ?X is a variable"),
        ("(a b)\n5\n", 2, "this is no fact: the value 5 is not of type LIST"),
        ("(a b) \n((c) d)\n", 2, "this is no fact: the value (C) is not of type RELATION"),
        ("(and b c)", 1, "this is no fact: the value AND is not of type RELATION"),
        ("(a . b)", 1, "this is no fact"),
        ("(a b)\n(c #<robot>)", 2, "there is no syntax `#<` here"),
        ("(a b)\n(c #.(quit))", 2, "`#.` would run a form"),
        ("(a nowhere:b)", 1, "there is no package `nowhere`"),
        ("(cl:in-package nowhere)\n(a b)", 1, "there is no such package"),
        ('(a b)\n(c "d)\n(e f)\n', 2, "this string is never closed"),
        ("(a b)\n(c \udcff)\n", 2, "the byte FF is no UTF-8 here"),
        ("(a b)\n(sized 1 2)\n", 2, "this relation was declared with"),
    ],
)
def test_a_damaged_file_is_told_of_with_line_and_fact_and_changes_nothing(
    agent: Interpreter, tmp_path: Path, text: str, line: int, why: str
) -> None:
    agent.eval("(defrelation sized (thing))")
    path = tmp_path / "bad.facts"
    path.write_bytes(text.encode(errors="surrogateescape"))
    before = list(map(str, agent.database.facts()))
    words = ends(agent, f'(load-facts "{path}")')
    assert words.startswith(f"{path}:{line}: {why}")
    assert list(map(str, agent.database.facts())) == before


def test_a_plan_can_recover_from_a_damaged_file(agent: Interpreter, tmp_path: Path) -> None:
    (tmp_path / "bad.facts").write_text("(a ?b)")
    form = f'(with-recovery-procedures ((:error (abort :lost))) (load-facts "{tmp_path}/bad.facts"))'
    assert str(agent.eval(form)) == ":LOST"
    assert agent.eval(f'(handler-case (load-facts "{tmp_path}/none") (file-error () 1))') == 1


def test_only_a_string_names_a_file(agent: Interpreter) -> None:
    assert ends(agent, "(load-facts 'f)").startswith("F STRING")
    assert ends(agent, "(save-facts 5)").startswith("5 STRING")
