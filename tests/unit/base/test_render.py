"""How a diagnostic looks: the layout that everything else relies on."""

from __future__ import annotations

from textwrap import dedent

import pytest

from eslang.base.diagnostics import Diagnostic, Label
from eslang.base.render import render
from eslang.base.spans import Source, Span
from eslang.base.suggest import distance, nearest

REPAIR = dedent("""\
    (defun repair-widget ()
      (with-recovery-procedures
          ((:widget-broken :retrys 3
             (attempt-widget-fix :broken)
             (retry)))
        (operate-widget)))
    """)


def at(source: Source, line: int, column: int, length: int = 1, words: str = "") -> Label:
    return Label(Span(source, line, column, line, column + length), words)


def shown(text: str) -> str:
    return dedent(text).strip("\n")


def test_one_label_with_all_three_closing_lines():
    source = Source("plans/repair.esl", REPAIR)
    diagnostic = Diagnostic(
        "unknown-clause-option",
        "a recovery clause has no option `:retrys`",
        (at(source, 3, 24, 7, "expected `:retries`"),),
        within="(with-recovery-procedures …) of `repair-widget`",
        hint="write `:retries 3`",
    )
    assert render(diagnostic) == shown("""
        plans/repair.esl:3:24: error: a recovery clause has no option `:retrys`
          |
        3 |       ((:widget-broken :retrys 3
          |                        ^^^^^^^ expected `:retries`
          = in    (with-recovery-procedures …) of `repair-widget`
          = hint  write `:retries 3`
          = more  esl explain unknown-clause-option
        """)


def test_two_labels_leave_out_the_lines_between():
    source = Source("plans/repair.esl", REPAIR.replace("(operate-widget)))", "(operate-widget))"))
    diagnostic = Diagnostic(
        "unclosed-list",
        "this list is never closed",
        (at(source, 1, 1, 1, "opened here"), at(source, 6, 22, 0, "the file ends here, one `)` short")),
        hint="add `)` after 6:21",
    )
    assert render(diagnostic) == shown("""
        plans/repair.esl:1:1: error: this list is never closed
          |
        1 | (defun repair-widget ()
          | ^ opened here
        6 |     (operate-widget))
          |                      ^ the file ends here, one `)` short
          = hint  add `)` after 6:21
        """)


def test_notes_stand_in_for_the_excerpt():
    source = Source("plans/net.esl", "\n  (task-net)\n")
    diagnostic = Diagnostic(
        "deadlock",
        "deadlock: 2 tasks wait, and nothing can wake them",
        (at(source, 2, 3),),
        hint="each waits for the other; let one of them pass its checkpoint first",
        notes=(
            "t1  waits for checkpoint :cp of t2     plans/net.esl:3:7",
            "t2  waits for checkpoint :cp of t1     plans/net.esl:6:7",
        ),
    )
    assert render(diagnostic) == shown("""
        plans/net.esl:2:3: error: deadlock: 2 tasks wait, and nothing can wake them
          t1  waits for checkpoint :cp of t2     plans/net.esl:3:7
          t2  waits for checkpoint :cp of t1     plans/net.esl:6:7
          = hint  each waits for the other; let one of them pass its checkpoint first
        """)


def test_without_a_place():
    assert render(Diagnostic("no-such-file", "there is no file `x.esl`")) == shown("""
        error: there is no file `x.esl`
          = more  esl explain no-such-file
        """)


def test_a_warning_says_so():
    source = Source("a.esl", "(f)")
    text = render(Diagnostic("w", "odd", (at(source, 1, 1, 3, "here"),), severity="warning"))
    assert text.startswith("a.esl:1:1: warning: odd\n")


def test_an_earlier_second_label_is_shown_first_and_line_one_keeps_its_place():
    source = Source("a.esl", "(a)\n(b)\n(c)\n")
    text = render(Diagnostic("twice", "again", (at(source, 3, 1, 3, "again"), at(source, 1, 1, 3, "first"))))
    assert text == shown("""
        a.esl:3:1: error: again
          |
        1 | (a)
          | ^^^ first
        3 | (c)
          | ^^^ again
        """)


def test_labels_on_one_line_share_it():
    source = Source("a.esl", "(a b)\n")
    text = render(Diagnostic("n", "m", (at(source, 1, 2, 1, "one"), at(source, 1, 4, 1, "two"))))
    assert text.splitlines()[2:] == ["1 | (a b)", "  |  ^ one", "  |    ^ two"]


def test_a_label_in_another_file_names_it():
    here, there = Source("a.esl", "(a)\n"), Source("b.esl", "\n(b)\n")
    text = render(Diagnostic("n", "m", (at(here, 1, 1, 3, "here"), at(there, 2, 1, 3, "there"))))
    assert text.splitlines()[3:] == ["  | ^^^ here", "  : b.esl:2:1", "2 | (b)", "  | ^^^ there"]


def test_line_numbers_are_aligned():
    source = Source("a.esl", "\n" * 8 + "(a)\n(b)\n")
    text = render(Diagnostic("n", "m", (at(source, 9, 1, 3, "x"), at(source, 10, 1, 3, "y"))))
    assert text.splitlines()[1:] == ["   |", " 9 | (a)", "   | ^^^ x", "10 | (b)", "   | ^^^ y"]


def test_a_span_over_several_lines_is_underlined_to_the_end_of_its_first():
    source = Source("a.esl", "(a\n  b)\n")
    text = render(Diagnostic("n", "m", (Label(Span(source, 1, 1, 2, 5), "x"),)))
    assert text.splitlines()[2:4] == ["1 | (a", "  | ^^ x"]


@pytest.mark.parametrize(
    ("line", "column", "length", "drawn", "caret"),
    [
        ("\t(x)", 2, 3, "        (x)", "        ^^^"),
        ("ab\t(x)", 4, 3, "ab      (x)", "        ^^^"),
        ('"日本" x', 6, 1, '"日本" x', "       ^"),
        ("日本", 1, 2, "日本", "^^^^"),
        ("e\u0301 x", 4, 1, "e\u0301 x", "  ^"),
        ("\ufeff(x)", 2, 3, "\ufeff(x)", "^^^"),
        ("\x1b[31m x", 7, 1, "\u241b[31m x", "      ^"),
        ("a\ud800 x", 4, 1, "a\ufffd x", "   ^"),
        ("(x)\r", 2, 1, "(x)", " ^"),
    ],
)
def test_the_caret_stands_under_its_character(line, column, length, drawn, caret):
    source = Source("a.esl", line + "\n")
    text = render(Diagnostic("n", "m", (at(source, 1, column, length),)))
    assert text.split("\n")[2:4] == [f"1 | {drawn}", f"  | {caret}"]


@pytest.mark.parametrize("column", [1, 20, 90, 101, 500, 990, 1000])
def test_a_long_line_is_cut_round_the_caret(column):
    line = "".join(chr(ord("a") + i % 26) for i in range(1000))
    source = Source("a.esl", line)
    text = render(Diagnostic("n", "m", (at(source, 1, column, 5, "x"),))).split("\n")
    assert len(text[2]) <= 4 + 102
    assert text[2][text[3].index("^")] == line[column - 1]
    assert ("…" in text[2][4:5]) == (column > 31)


def test_a_long_underline_stays_within_the_cut():
    source = Source("a.esl", "x" * 1000)
    text = render(Diagnostic("n", "m", (at(source, 1, 1, 1000),))).split("\n")
    assert text[3].count("^") == 100


def test_a_message_cannot_disturb_the_terminal():
    assert render(Diagnostic("n", "no `\x1b]0;x\n`")).startswith("error: no `␛]0;x␊`\n")


def test_colour_is_the_same_text_with_colours():
    import re

    source = Source("a.esl", REPAIR)
    diagnostic = Diagnostic("n", "m", (at(source, 1, 1, 1, "a"), at(source, 3, 1, 1, "b")), hint="do")
    coloured = render(diagnostic, colour=True)
    assert coloured != render(diagnostic)
    assert re.sub("\x1b\\[[0-9;]*m", "", coloured) == render(diagnostic)


def test_a_source_without_text_gives_line_one_only():
    text = render(Diagnostic("n", "m", (at(Source("a.esl", ""), 3, 1, 1, "x"),), hint="h"))
    assert text.splitlines() == ["a.esl:3:1: error: m", "  = hint  h", "  = more  esl explain n"]


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        (":retrys", ":retries"),
        ("wiht-recovery", "with-recovery"),
        ("car", None),
        ("x", None),
        ("zzzzzzzzz", None),
        ("with-recovery", None),
    ],
)
def test_the_nearest_name_is_within_a_third_of_its_length(word, expected):
    assert nearest(word, [":retries", "with-recovery", "cadadr"]) == expected


def test_of_equally_near_names_the_alphabetically_first():
    assert nearest("mapcat", ["mapcar", "mapcan"]) == "mapcan"


def test_distance_counts_single_steps():
    pairs = [("ab", "ba"), ("abc", "abc"), ("abc", "bc"), ("", "ab")]
    assert [distance(left, right, 9) for left, right in pairs] == [1, 0, 1, 2]
