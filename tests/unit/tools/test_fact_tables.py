"""Facts at the prompt: tables of relations, of what they hold, and of what a query finds."""

from __future__ import annotations

import pytest

from eslang import Interpreter
from eslang.tools.columns import table, width
from eslang.tools.fact_tables import FactTables
from eslang.tools.transcript import Stage

WORLD = """(progn
  (defproperty power-state (device state))
  (defrelation link (from to metres))
  (assert '(power-state ega-x :on)) (assert '(power-state ega-y :off))
  (assert '(link yard hall 12)) (assert '(link hall lab 7)) (assert '(link lab attic 7/2))
  (assert '(note "lamp" (on 2)))
  (defrule (reaches ?x ?y) (link ?x ?y ?m))
  (defrule (reaches ?x ?z) (reaches ?x ?y) (link ?y ?z ?m)))"""


def said(*forms: str) -> list[str]:
    """What each of FORMS is answered with, behind the definition of a small world."""
    with Stage() as stage:
        stage.answer_to(WORLD)
        return [stage.answer_to(form) for form in forms]


def lines(form: str) -> list[str]:
    """The lines that FORM is answered with."""
    return said(form)[0].splitlines()


def test_all_relations_are_listed_with_what_is_known_of_them() -> None:
    assert lines(":facts") == [
        "relation       facts  rules  declared",
        "─────────────  ─────  ─────  ─────────────────────────",
        "link/3             3         relation (from to metres)",
        "note/2             1",
        "power-state/2      2         property (device state)",
        "reaches/2          0      2",
    ]


def test_columns_in_which_nothing_stands_are_left_out() -> None:
    with Stage() as stage:
        stage.answer_to("(assert '(is-a w1 widget))")
        assert stage.answer_to(":facts") == "relation  facts\n────────  ─────\nis-a/2        1\n"


def test_without_facts_it_is_said_so() -> None:
    with Stage() as stage:
        assert stage.answer_to(":facts") == "There are no facts.\n"


def test_a_relation_is_a_table_with_the_declared_names_above_and_numbers_at_the_right() -> None:
    assert lines(":facts link") == [
        "link/3: 3 facts",
        "from  to     metres",
        "────  ─────  ──────",
        "yard  hall       12",
        "hall  lab         7",
        "lab   attic     7/2",
    ]


def test_a_relation_without_declared_names_has_no_header() -> None:
    assert lines(":facts note") == ["note/2: 1 fact", '"lamp"  (on 2)']


def test_a_property_is_called_one() -> None:
    assert lines(":facts power-state")[0] == "power-state/2, a property: 2 facts"


def test_a_relation_that_is_derived_shows_its_rules() -> None:
    assert lines(":facts reaches") == [
        "reaches/2: no facts, 2 rules",
        "(defrule (reaches ?x ?y) (link ?x ?y ?m))",
        "(defrule (reaches ?x ?z) (reaches ?x ?y) (link ?y ?z ?m))",
        "`:facts (reaches ?1 ?2)` asks what follows.",
    ]


def test_each_arity_of_a_name_has_its_own_table() -> None:
    found = said("(assert '(note plain))", ":facts note")[1]
    assert found == 'note/1: 1 fact\nplain\n\nnote/2: 1 fact\n"lamp"  (on 2)\n'


def test_a_relation_may_be_called_as_the_list_of_all_has_it() -> None:
    found = said("(assert '(note plain))", ":facts note/1", ":facts note/3")[1:]
    assert found == [
        "note/1: 1 fact\nplain\n",
        "There is no relation `note/3`; the nearest name is `note`.\n",
    ]


def test_what_had_facts_once_is_still_known() -> None:
    assert said("(retract '(note ?x ?y))", ":facts note")[1] == "note: no facts\n"


def test_of_a_name_that_is_no_relation_the_nearest_is_told() -> None:
    told = "There is no relation `powr-state`; the nearest name is `power-state`.\n"
    assert said(":facts powr-state", ":facts (powr-state ?x ?y)", ":facts zebra") == [
        told,
        told,
        "There is no relation `zebra`.\n",
    ]


def test_a_query_is_a_table_with_a_column_for_each_variable() -> None:
    assert lines(":facts (and (link ?from ?to ?m) (> ?m 5))") == [
        "?from  ?to   ?m",
        "─────  ────  ──",
        "yard   hall  12",
        "hall   lab    7",
    ]


def test_a_query_finds_what_rules_derive() -> None:
    assert lines(":facts (reaches yard ?x)") == ["?x", "─────", "hall", "lab", "attic"]


@pytest.mark.parametrize(
    ("query", "answer"),
    [
        ("(power-state ega-x :on)", "It holds."),
        ("(power-state ega-x :off)", "It does not hold."),
        ("(power-state ega-z ?s)", "Nothing matches."),
    ],
)
def test_a_query_without_a_table_is_answered_in_words(query: str, answer: str) -> None:
    assert lines(f":facts {query}") == [answer]


def test_a_query_may_go_on_over_several_lines_and_be_followed_by_forms() -> None:
    found = said(":facts (and (link yard ?to ?m) ; far away\n  (> ?m 5)) (+ 1 2)")[0]
    assert found == "?to   ?m\n────  ──\nhall  12\n3\n"


def test_a_query_that_is_not_finished_is_waited_for() -> None:
    with Stage() as stage:
        assert stage.conversation.hear(":facts (and (link yard\n") == ":facts (and (link yard\n"


def test_a_form_on_the_next_line_is_not_the_words_own() -> None:
    assert said(":facts power-state ; what is on\n(+ 1 2)")[0].splitlines()[-1] == "3"
    assert said(":facts\n(+ 1 2)")[0].splitlines()[-1] == "3"


def test_a_query_that_fails_is_a_failure_as_everywhere() -> None:
    told = "Failure :UNBOUND-LOGIC-VARIABLE, no recovery available.\nAborted\n"
    assert said(":facts (and (> ?x 3))")[0] == told


def test_what_is_neither_a_name_nor_a_query_is_refused() -> None:
    assert said(":facts 3")[0] == "Say `:facts`, `:facts RELATION` or `:facts (RELATION ?X ...)`.\n"


def test_of_many_facts_the_first_are_shown_and_the_others_counted() -> None:
    many = said("(dotimes (i 1500) (assert (list 'n i)))", ":facts n", ":facts (n ?x)")
    assert many[1].splitlines()[0] == "n/1: 1,500 facts"
    assert [each.splitlines()[-2:] for each in many[1:]] == [["19", "… and 1,480 more"]] * 2


def test_no_line_is_wider_than_the_terminal() -> None:
    with Interpreter() as interp:
        interp.eval('(assert (list \'note "%s" \'short "界界界界界界界界界界" 3))' % ("words " * 50))
        interp.eval("(assert (cons 'wide (make-list 40 :initial-element 'thing)))")
        for columns in (20, 33, 80):
            tables = FactTables(interp.database, columns)
            shown = "".join(tables.relation(interp.symbol(name)) for name in ("note", "wide"))
            assert max(map(width, shown.splitlines())) <= columns


def test_the_widest_columns_of_a_table_give_way_first() -> None:
    assert table((), [("a" * 30, "short", "b" * 20)], (False, False, False), 30) == [
        "aaaaaaaaa…  short  bbbbbbbbb…"
    ]
