"""The prompt's idea of tokens: colours, balance, indentation."""

from __future__ import annotations

from itertools import pairwise

import pytest

from eslang.tools.tokens import Balance, incomplete_word, indentation, open_lists, tokens


def kinds(text: str) -> list[str]:
    return [kind for kind, _, _ in tokens(text) if kind != "space"]


def test_every_kind_of_token_is_told_apart() -> None:
    text = """(foo "a" #\\( :key ?x #?y 1/2 -3.5 'q #'f `(,@l) |a b| ; remark"""
    assert kinds(text) == [
        "open", "symbol", "string", "character", "keyword", "variable", "variable", "number",
        "number", "quote", "symbol", "quote", "symbol",
        "quote", "open", "quote", "symbol", "close", "symbol", "comment",
    ]  # fmt: skip


def test_tokens_cover_the_whole_text() -> None:
    text = 'a (b "c\n) ; d\n #| e #| f |# g |# |h i| \\ \x00 #'
    spans = [(start, end) for _, start, end in tokens(text)]
    assert spans[0][0] == 0 and spans[-1][1] == len(text)
    assert all(before[1] == after[0] for before, after in pairwise(spans))


@pytest.mark.parametrize(
    "text", ["(a", "(a (b)", '"x', '"x\\"', "|a b", "a|b c", "#| x", "#| a #| b |#", "#("]
)
def test_what_lacks_its_end_is_surely_open(text: str) -> None:
    balance = Balance()
    balance.feed(text + "\n")
    assert balance.surely_open


@pytest.mark.parametrize("text", ["", "a", "(a)", '"x"', "; (", '(a ")" #\\) |)|)', "#| ( |#", "a)", "'"])
def test_what_may_be_complete_is_left_to_the_reader(text: str) -> None:
    balance = Balance()
    balance.feed(text + "\n")
    assert not balance.surely_open


def test_a_text_may_come_line_by_line() -> None:
    balance = Balance()
    told = []
    for line in ("(print\n", '  "a (\n', '   b"\n', "  #| )\n", "|#)\n"):
        balance.feed(line)
        told.append(balance.surely_open)
    assert told == [True, True, True, True, False]


def test_the_open_lists_of_a_text_are_known_from_the_outside_in() -> None:
    assert open_lists("(a (b) (c (d") == [0, 7, 10]


@pytest.mark.parametrize(
    ("before", "columns"),
    [
        ("", 0),
        ("(foo", 2),
        ("(defun f (x)", 2),
        ("(let (", 6),
        ("(let ((a 1)", 6),
        ("(", 1),
        ("(f\n    (g", 6),
    ],
)
def test_a_new_line_is_indented_by_what_is_open(before: str, columns: int) -> None:
    assert indentation(before) == columns


@pytest.mark.parametrize(
    ("text", "word"),
    [("(foo", "foo"), ("(foo ", ""), ("(f :ba", ":ba"), ("x #?y", "#?y"), ("", ""), ('"ab', "")],
)
def test_the_word_being_typed_is_found(text: str, word: str) -> None:
    assert incomplete_word(text) == word
