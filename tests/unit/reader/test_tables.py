"""The grammar: what its tables promise, and that its page is current."""

from __future__ import annotations

from pathlib import Path

from lark import Lark

from eslang.reader.tables import GRAMMAR, tables

ROOT = Path(__file__).resolve().parents[3]
TEXT = """
(defun f (x &optional (y 1.5)) "doc" ; comment
  `(a ,x ,@y . #(1 #\\( #x1F)) #'car #:g #?v #+eslang (b) #.c |odd ; (name| :key)
"""


def test_a_state_either_shifts_or_reduces():
    found = tables()
    assert not any(path and rule for path, rule in zip(found.paths, found.rules, strict=True))


def test_the_tables_find_the_tokens_that_lark_finds():
    lark = Lark(GRAMMAR.read_text(encoding="utf-8"), parser="lalr", lexer="basic")
    theirs = [(token.type, str(token)) for token in lark.lex(TEXT)]
    ours, offset = [], 0
    while (found := tables().pattern.match(TEXT, offset)).lastgroup != "END":
        ours.append((found.lastgroup, found[found.lastgroup]))
        offset = found.end()
    assert ours == theirs


def test_the_rules_in_the_reference_are_those_of_the_grammar():
    page = (ROOT / "docs" / "reference" / "grammar.md").read_text(encoding="utf-8")
    rules = page.split("```\n")[1].strip()
    assert rules in GRAMMAR.read_text(encoding="utf-8")


def test_lark_is_not_loaded_before_a_text_is_read():
    import subprocess
    import sys

    code = "import sys, eslang.reader.reader; sys.exit('lark' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=False).returncode == 0
