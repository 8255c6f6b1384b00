"""Transcripts: reading them, and saying where a replay differs."""

from __future__ import annotations

from textwrap import dedent

from eslang.tools.expectations import Came, Expected, troubles
from eslang.tools.markdown import page_entries, read_page
from eslang.tools.transcript import Entry, difference, example_of, read_transcript

WIDGET = dedent("""\
    ; what stands first is for people
    ? (operate-widget)
    OPERATING WIDGET SUCCESSFULLY.
    NIL
    ? (list 1
        2)
    ; a remark
    (1 2)

    ?
    ? :last
    :LAST
    """)


def test_forms_and_answers_are_told_apart_with_their_lines() -> None:
    first, second, last = read_transcript(WIDGET)
    assert first == Entry("(operate-widget)", 2, ["OPERATING WIDGET SUCCESSFULLY.", "NIL"], 3)
    assert (second.form, second.line) == ("(list 1\n    2)", 5)
    assert (last.form, last.line) == (":last", 11)


def test_an_equal_answer_makes_no_difference() -> None:
    entry = read_transcript(WIDGET)[1]
    assert difference(entry, "(1 2)  \n\n") is None


def test_the_first_different_line_is_told_with_its_place() -> None:
    entry = read_transcript(WIDGET)[0]
    found = difference(entry, "OPERATING WIDGET SUCCESSFULLY.\nT\n")
    assert found is not None
    assert found.text("w.transcript").split("\n")[:3] == [
        "w.transcript:4: `(operate-widget)` was answered differently",
        "  expected  NIL",
        "  found     T",
    ]


def test_too_much_and_too_little_are_differences() -> None:
    entry = read_transcript(WIDGET)[0]
    less, more = difference(entry, ""), difference(entry, "OPERATING WIDGET SUCCESSFULLY.\nNIL\nMORE\n")
    assert less is not None and less.found is None
    assert more is not None and more.expected is None and more.found == "MORE"


def test_blank_lines_inside_an_answer_count() -> None:
    entry = Entry("(print 1)", 1, ["", "1", "1"], 2)
    assert difference(entry, "\n1 \n1\n") is None
    assert difference(entry, "1 \n1\n") is not None


def test_the_example_of_a_docstring_is_a_transcript() -> None:
    docstring = """Do it.

    Example:
        ? (do-it
            :now)
        :DONE

    Source: ours.
    """
    (entry,) = example_of(docstring)
    assert entry.form == "(do-it\n    :now)"
    assert entry.expected[0] == ":DONE"
    assert example_of("Nothing to show.") == []


def test_the_blocks_of_a_page_that_run_are_found() -> None:
    page = dedent("""\
        # Title
        ```esl
        (print 1) ; expect: 1
        ```
        ```python
        no()
        ```
        1. A step:

           ```
           ? :a
           :A
           ```
        ```esl
        ? :b
        :B
        ```
        """)
    blocks = read_page(page)
    assert [(block.line, block.is_transcript) for block in blocks] == [(3, False), (11, True), (15, True)]
    assert [entry.line for entry in page_entries(blocks)] == [11, 15]


def test_what_a_comment_expects_must_come() -> None:
    expected = Expected("(print 1)\n; expect: 1\n;; expect failure: :OOPS 1\n; expect trace: Aborted\n")
    assert troubles(expected, Came("\n1 \n")) == [
        "expected the failure `:OOPS 1`, but nothing failed",
        "line 1 of the trace:\n  expected  Aborted\n  found     (nothing more)",
    ]
    assert troubles(Expected("; expect nonsense: 1"), Came()) == [
        "`; expect nonsense:` is not known (write one of output, trace, failure, error)"
    ]
