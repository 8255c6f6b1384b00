"""`agent.facts`: the logical database for Python code."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from enum import Enum, StrEnum
from fractions import Fraction
from typing import Any

import pytest

from around import whole_agent
from eslang import EslError, Failure, Interpreter, Keyword, Symbol, Text
from eslang.knowledge import Change

W1, W2, WIDGET = Symbol("w1"), Symbol("w2"), Symbol("widget")


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """An interpreter on virtual time."""
    with whole_agent("nil", clock="virtual") as made:
        yield made


def held(agent: Interpreter) -> list[str]:
    """The facts that AGENT holds, as text."""
    return [" ".join(map(str, fact)) for fact in agent.facts]


def cause_of(work: Any) -> Any:
    """The cause of the failure that WORK raises."""
    with pytest.raises(Failure) as caught:
        work()
    return caught.value.cause


# --- what the contract shows --------------------------------------------------------------


def test_a_fact_is_added_and_found(agent: Interpreter) -> None:
    agent.facts.add("is-a", "w1", "widget")
    assert agent.facts.query("(is-a ?x widget)") == [{"x": W1}]


def test_facts_are_those_that_plans_use(agent: Interpreter) -> None:
    agent.facts.add("is-a", "w1", "widget")
    agent.eval("(assert '(is-a w2 widget))")
    assert agent.eval("(princ-to-string (db-query '(is-a ?x widget)))") == "(((?X . W1)) ((?X . W2)))"
    assert [row["x"] for row in agent.facts.query("(is-a ?x widget)")] == [W1, W2]


def test_an_interpreter_has_one_and_another_interpreter_another(agent: Interpreter) -> None:
    assert agent.facts is agent.facts
    agent.facts.add("raining")
    with Interpreter() as other:
        assert len(other.facts) == 0


# --- how facts are written ----------------------------------------------------------------


def test_a_fact_may_be_parts_or_text_or_a_list(agent: Interpreter) -> None:
    facts = agent.facts
    assert facts.add("health-state", "w1", ":ok")
    assert not facts.add(" (health-state w1 :ok)")
    assert not facts.add(["health-state", "w1", ":ok"])
    assert not facts.add(agent.symbol("health-state"), W1, Keyword("ok"))  # type: ignore[arg-type]
    assert held(agent) == ["HEALTH-STATE W1 :OK"]


def test_a_str_is_an_atom_as_a_plan_would_write_it(agent: Interpreter) -> None:
    agent.facts.add("has", ":ok", "12", "-2.5", "1/2", "nil", "t", "|a b|", '"text"', " esl-user::w1 ")
    agent.eval('(assert \'(has :ok 12 -2.5 1/2 nil t |a b| "text" w1))')
    [fact] = agent.facts
    odd = agent.eval("'|a b|")
    assert fact[1:] == [Keyword("ok"), 12, -2.5, Fraction(1, 2), None, True, odd, "text", W1]


def test_text_is_text_and_comes_back_as_text(agent: Interpreter) -> None:
    facts = agent.facts
    facts.add("name", "w1", Text("Left arm"))
    [found] = facts.query("(name w1 ?n)")
    assert found == {"n": "Left arm"} and repr(found) == "{'n': Text('Left arm')}"
    assert facts.add("name", "w2", found["n"])
    assert facts.query('(name ?w "Left arm")') == [{"w": W1}, {"w": W2}]
    assert facts.query("name", "?w", Text("Left arm")) == [{"w": W1}, {"w": W2}]
    assert agent.call("string-upcase", found["n"]) == "LEFT ARM"


def test_values_of_python_are_terms(agent: Interpreter) -> None:
    cup = object()
    agent.facts.add("at", W1, ["point", 1, [2.5, Text("x")]], True, None, False, (1, 2), Fraction(4, 2), cup)
    [fact] = agent.facts
    assert fact[2:] == [[Symbol("point"), 1, [2.5, "x"]], True, None, None, [1, 2], 2, cup]
    assert agent.eval("(db-query '(at w1 (point ?x ?_) t nil nil (1 2) 2 ?cup))") is not None


def test_numbers_of_other_libraries_are_numbers(agent: Interpreter) -> None:
    class Whole(int):
        """As numpy.int64 is one."""

    class Real(float):
        """As numpy.float64 is one."""

    agent.facts.add("weight", Whole(3), Real(2.5))
    assert agent.facts.holds("(weight 3 2.5)")


def test_a_str_of_another_class_is_a_name_too(agent: Interpreter) -> None:
    class State(StrEnum):
        OK = ":ok"

    class Old(str, Enum):  # noqa: UP042
        BROKEN = ":broken"

    agent.facts.add("health", State.OK, Old.BROKEN)
    assert agent.facts.holds("(health :ok :broken)")
    assert agent.call("list", State.OK, Old.BROKEN) == [":ok", ":broken"]


def test_facts_come_out_as_they_go_in(agent: Interpreter) -> None:
    agent.eval("""(assert '(is-a w1 "widget" (:a (1 2.5 1/3) |a b|))) (assert '(raining))""")
    with Interpreter() as other:
        assert other.facts.add_all(agent.facts) == 2
        assert list(other.facts) == list(agent.facts)
        assert all(fact in other.facts for fact in agent.facts)


def test_what_is_no_name_says_how_text_is_given(agent: Interpreter) -> None:
    for text in ("Left arm", "", "O'Brien", "w1)", "(w1", "a;b", "#(1)", "'a", "#:a"):
        with pytest.raises(Failure, match="for text, write Text") as caught:
            agent.facts.add("name", "w1", text)
        assert caught.value.cause is Keyword("error"), text


def test_text_that_cannot_be_read_is_an_error_with_its_place(agent: Interpreter) -> None:
    for text, name in (
        ("(is-a w1", "unclosed-list"),
        ("(is-a no-such:w1)", "unknown-package"),
        ("(is-a #.(quit))", "read-evaluation"),
    ):
        with pytest.raises(EslError) as caught:
            agent.facts.add(text)
        assert caught.value.diagnostic.name == name
        assert caught.value.diagnostic.labels[0].span.line == 1
    with pytest.raises(EslError):
        agent.facts.add("is-a", "no-such:w1")
    assert len(agent.facts) == 0


def test_what_is_no_fact_fails_as_in_a_plan(agent: Interpreter) -> None:
    unbound = Keyword("unbound-logic-variable")
    assert cause_of(lambda: agent.facts.add("is-a", "?x", "widget")) is unbound
    assert cause_of(lambda: agent.facts.add("(is-a ?_ widget)")) is unbound
    for wrong in (5, "and", [], ["?x", 1], Text("(is-a)"), [["is-a"], 1], ":is-a x"):
        assert cause_of(lambda wrong=wrong: agent.facts.add(wrong)) in (  # type: ignore[misc]
            Keyword("type-error"),
            Keyword("error"),
        ), wrong
    assert cause_of(lambda: agent.facts.add("(is-a w1) (is-a w2)")) is Keyword("error")
    assert len(agent.facts) == 0


def test_a_list_that_holds_itself_is_refused(agent: Interpreter) -> None:
    endless: list[Any] = []
    endless.append(endless)
    assert cause_of(lambda: agent.facts.add("is-a", endless)) is Keyword("stack-exhausted")


def test_a_failure_has_arguments_as_python_has_them(agent: Interpreter) -> None:
    with pytest.raises(Failure) as caught:
        agent.facts.add("name", "?x", Text("Left arm"))
    assert caught.value.arguments[1] == [Symbol("name"), Symbol("?x"), "Left arm"]


# --- changes ------------------------------------------------------------------------------


def test_a_change_tells_what_it_did(agent: Interpreter) -> None:
    facts = agent.facts
    assert facts.add("load", "w1", 3) is True
    assert facts.add("load", "w1", 3) is False
    assert facts.add_all([("load", "w1", 3), ("load", "w2", 5), ("load", "w3", 5)]) == 2
    assert facts.remove("load", "?_", 5) == 2
    assert facts.remove("(load ?x ?y)") == 1
    assert facts.remove("load", "?x", "?x") == 0
    assert len(facts) == 0


def test_who_is_to_hear_of_changes_can_be_called(agent: Interpreter) -> None:
    with pytest.raises(TypeError, match="each change, and 5 cannot be"):
        agent.facts.subscribe(5)  # type: ignore[arg-type]
    assert agent.facts.add("raining") is True


def test_update_is_one_change(agent: Interpreter) -> None:
    facts = agent.facts
    facts.add_all(["(at cup table)", "(at cup shelf)"])
    told: list[Change] = []
    facts.subscribe(told.append)
    assert facts.update("(at cup ?_)", ["at", "cup", "tray"]) is True
    assert facts.update("(at cup ?_)", "(at cup tray)") is False
    assert [(each.added, each.terms[1]) for each in told] == [
        (False, Symbol("table")),
        (False, Symbol("shelf")),
        (True, Symbol("tray")),
    ]


def test_clear_takes_all_facts_and_leaves_rules(agent: Interpreter) -> None:
    agent.eval("(defrule (idle ?x) (is-a ?x widget))")
    agent.facts.add("is-a", "w1", "widget")
    assert agent.facts.clear() == 1
    agent.facts.add("is-a", "w2", "widget")
    assert agent.facts.query("(idle ?x)") == [{"x": W2}]


def test_a_property_has_one_value(agent: Interpreter) -> None:
    agent.eval("(defproperty power-state)")
    agent.facts.add("power-state", "radio", ":off")
    agent.facts.add("power-state", "radio", ":on")
    assert agent.facts.first("power-state", "radio", "?s") == {"s": Keyword("on")}


# --- bulk ---------------------------------------------------------------------------------


def test_rows_of_a_csv_file_are_facts_of_a_relation(agent: Interpreter) -> None:
    table = io.StringIO("w1,12.5,:ok\nw2,7,:broken\n")
    assert agent.facts.add_all(csv.reader(table), "health") == 2
    assert agent.facts.query("(and (health ?w ?n :ok) (> ?n 10))") == [{"w": W1, "n": 12.5}]


def test_rows_may_be_facts_terms_or_a_single_term(agent: Interpreter) -> None:
    facts = agent.facts
    assert facts.add_all(["(is-a w1 widget)", ("is-a", "w2", "widget"), ["raining"]]) == 3
    assert facts.add_all(("w1", W2, Text("it")), relation="seen") == 3
    assert facts.add_all([(), (1,), [1, 2]], relation=Symbol("count")) == 3
    assert facts.add_all(iter(())) == 0
    assert [fact[1:] for fact in facts][3:] == [[W1], [W2], ["it"], [], [1], [1, 2]]


@pytest.mark.parametrize(
    "row",
    [("is-a", "?x"), {"is-a": "w1"}, "(is-a w1", "(is-a", 5, ("is-a", "Left arm"), ["?x"], object(), None],
)
def test_of_rows_all_are_taken_or_none_and_a_wrong_one_names_its_number(agent: Interpreter, row: Any) -> None:
    agent.facts.add("is-a", "w1", "widget")
    with pytest.raises(Failure, match="row 3, ") as caught:
        agent.facts.add_all(
            [("is-a", "w2", "widget"), ("is-a", "w3", "widget"), row, ("is-a", "w4", "widget")]
        )
    assert caught.value.cause is Keyword("error")
    assert held(agent) == ["IS-A W1 WIDGET"]


def test_an_error_of_the_iterable_is_its_own(agent: Interpreter) -> None:
    def rows() -> Iterator[Any]:
        yield ("is-a", "w1", "widget")
        raise OSError("the disk is gone")

    with pytest.raises(OSError, match="disk"):
        agent.facts.add_all(rows())
    assert len(agent.facts) == 0


def test_a_text_is_not_taken_for_its_letters(agent: Interpreter) -> None:
    with pytest.raises(TypeError, match="many facts"):
        agent.facts.add_all("(is-a w1 widget)")


def test_rows_are_one_change(agent: Interpreter) -> None:
    held: list[int] = []
    agent.facts.subscribe(lambda change: held.append(len(agent.facts)))
    agent.facts.add_all([("load", number) for number in range(5)])
    assert held == [5] * 5


# --- questions ----------------------------------------------------------------------------


def test_a_dict_has_the_names_of_variables_and_no_wildcard(agent: Interpreter) -> None:
    agent.facts.add("sees", "camera", "cup", 3)
    assert agent.facts.query("(sees ?SENSOR ?what-it-is ?_)") == [
        {"sensor": Symbol("camera"), "what-it-is": Symbol("cup")}
    ]


def test_variables_may_be_given(agent: Interpreter) -> None:
    agent.facts.add_all(["(at w1 kitchen)", "(at w2 hall)", '(at w3 "the hall")'])
    query = "(at ?thing ?the-place)"
    assert agent.facts.query(query, thing="w1") == [{"thing": W1, "the-place": Symbol("kitchen")}]
    assert agent.facts.query(query, the_place="hall") == [{"thing": W2, "the-place": Symbol("hall")}]
    assert agent.facts.query(query, **{"the-place": Text("the hall")})[0]["thing"] is Symbol("w3")
    [row] = agent.facts.query(query, thing=W1)
    assert agent.facts.query(query, **row) == [row]
    assert agent.facts.query("at", "?thing", "?place", thing="w9") == []
    assert agent.facts.holds("(and (at ?a ?p) (not (at ?b ?p)))", b="w2")


def test_a_variable_that_is_given_and_not_there_is_an_error(agent: Interpreter) -> None:
    with pytest.raises(TypeError, match=r"no variable \?the-thing"):
        agent.facts.query("(at ?thing ?_)", the_thing="w1")


def test_a_query_without_variables_has_one_solution_or_none(agent: Interpreter) -> None:
    agent.facts.add("raining")
    assert agent.facts.query("(raining)") == [{}]
    assert agent.facts.query("(snowing)") == []
    assert agent.facts.first("(raining)") == {}
    assert agent.facts.first("(snowing)") is None


def test_held_is_what_was_asserted_and_what_rules_derive_holds(agent: Interpreter) -> None:
    agent.eval(
        "(defrule (reaches ?x ?y) (path ?x ?y)) (defrule (reaches ?x ?z) (reaches ?x ?y) (path ?y ?z))"
    )
    agent.facts.add_all([("a", "b"), ("b", "c"), ("c", "a")], "path")
    assert "(path a b)" in agent.facts and ["path", "b", "a"] not in agent.facts
    assert "(reaches a c)" not in agent.facts
    assert agent.facts.holds("(reaches a c)")
    assert len(agent.facts.query("(reaches a ?x)")) == 3


def test_queries_may_be_lists_too(agent: Interpreter) -> None:
    agent.facts.add_all([("load", "w1", 3), ("load", "w2", 5)])
    assert agent.facts.query(["and", ["load", "?w", "?n"], [">", "?n", 4]]) == [{"w": W2, "n": 5}]
    assert agent.facts.query("and", ["load", "?w", 3], ["not", ["load", "?w", 5]]) == [{"w": W1}]


def test_an_unsafe_query_fails(agent: Interpreter) -> None:
    assert cause_of(lambda: agent.facts.query("(not (at ?x hall))")) is Keyword("unbound-logic-variable")
    assert cause_of(lambda: agent.facts.query("(> ?x 3)")) is Keyword("unbound-logic-variable")


def test_a_query_may_call_lisp_which_may_wait(agent: Interpreter) -> None:
    agent.facts.add_all([("load", 3), ("load", 5)])
    agent.eval("(defun heavy-p (n) (sleep 1) (> n 4))")
    assert agent.facts.query("(and (load ?n) (heavy-p ?n))") == [{"n": 5}]
    assert agent.clock.now() == 2
    agent.eval("(defun limit () (sleep 1) 4)")
    assert agent.facts.query("(and (load ?n) (> ?n (limit)))") == [{"n": 5}]
    assert agent.clock.now() == 4


def test_what_a_query_calls_may_fail(agent: Interpreter) -> None:
    agent.facts.add("load", 3)
    agent.eval("(defun heavy-p (n) (fail :no-scales n))")
    with pytest.raises(Failure) as caught:
        agent.facts.query("(and (load ?n) (heavy-p ?n))")
    assert (caught.value.cause, caught.value.arguments) == (Keyword("no-scales"), (3,))
    agent.primitive(name="weigh")(lambda: agent.facts.holds("(and (load ?n) (heavy-p ?n))"))
    assert agent.eval("(with-recovery-procedures (((:no-scales n) (abort n))) (weigh))") == 3
