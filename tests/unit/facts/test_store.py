"""What is asserted, retracted, updated; properties; and who is told."""

from __future__ import annotations

import pytest

from asking import Asking, read
from eslang.base.failure import Failure
from eslang.base.printer import prin1
from eslang.facts.goals import UNBOUND


def test_a_fact_is_held_once_and_in_order() -> None:
    facts = Asking("(is-a w1 widget)", "(is-a w2 widget)")
    assert not facts.add(read("(is-a w1 widget)"))
    assert facts.held() == ["(IS-A W1 WIDGET)", "(IS-A W2 WIDGET)"]
    assert len(facts) == 2 and read("(is-a w2 widget)") in facts and read("(is-a w3 widget)") not in facts


def test_facts_are_the_same_as_equal_says() -> None:
    facts = Asking('(at "a" 1)', '(at "a" 1.0)', "(at a 1)", "(at (1 2) 1)")
    assert len(facts) == 4
    assert not facts.add(read('(at "a" 1)'))
    assert not facts.add(read("(at (1 2) 1)"))


def test_a_fact_without_arguments_is_a_fact() -> None:
    facts = Asking("(raining)")
    assert facts.answers("(raining)") == [""]
    assert facts.retract(read("(raining)")) == 1
    assert facts.answers("(raining)") == []


def test_retract_takes_all_that_match() -> None:
    facts = Asking("(at a 1)", "(at b 1)", "(at a 2)", "(at a (1 a))", "(at a)")
    assert facts.retract(read("(at a ?)")) == 0  # that is a symbol
    assert facts.retract(read("(at ?x (?n ?x))")) == 1
    assert facts.retract(read("(at ?_ 1)")) == 2
    assert facts.retract(read("(at b ?x)")) == 0
    assert facts.retract(read("(at ?x ?x)")) == 0
    assert facts.held() == ["(AT A 2)", "(AT A)"]


def test_update_puts_a_fact_in_the_place_of_others() -> None:
    facts = Asking("(count 1)", "(count 2)")
    told: list[str] = []
    facts.subscribe(lambda change: told.append(repr(change)))
    assert facts.update(read("(count ?n)"), read("(count 2)"))
    assert told == ["-(COUNT 1)"]
    assert not facts.update(read("(count ?n)"), read("(count 2)"))
    assert facts.update(read("(count ?n)"), read("(total 7)"))
    assert facts.held() == ["(TOTAL 7)"]


def test_update_tells_whether_it_changed_anything_even_if_nobody_listens() -> None:
    facts = Asking("(count 1)", "(count 2)")
    assert facts.update(read("(count ?n)"), read("(count 2)"))
    assert not facts.update(read("(count ?n)"), read("(count 2)"))
    assert facts.update(read("(count ?n)"), read("(count 3)"))
    assert facts.update(read("(count 4)"), read("(count 4)"))
    answers: list[bool] = []
    unsubscribe = facts.subscribe(lambda _: answers.append(facts.update(read("(p ?n)"), read("(p 1)"))))
    facts.add_all(map(read, ["(q 1)", "(q 2)"]))
    unsubscribe()
    assert answers == [True, False, False]


@pytest.mark.parametrize("text", ["a", "((a) b)", "(1 2)", "(a . b)", "(?x 1)", "nil", "(not (p))"])
def test_what_is_no_fact_is_refused(text: str) -> None:
    with pytest.raises(Failure):
        Asking().add(read(text))


@pytest.mark.parametrize("text", ["(at a ?x)", "(at ?_ 1)", "(at a (1 (?x)))", "(at (a . ?x))"])
def test_a_fact_has_no_variables(text: str) -> None:
    facts = Asking()
    with pytest.raises(Failure) as caught:
        facts.add(read(text))
    assert caught.value.cause is UNBOUND
    assert len(facts) == 0


def test_a_property_has_one_value() -> None:
    facts = Asking()
    facts.declare_property(read("power-state"))
    told: list[str] = []
    facts.subscribe(lambda change: told.append(repr(change)))
    for fact in ("(power-state d1 :off)", "(power-state d2 :off)", "(power-state d1 :on)"):
        facts.add(read(fact))
    assert facts.held() == ["(POWER-STATE D2 :OFF)", "(POWER-STATE D1 :ON)"]
    assert told[2:] == ["-(POWER-STATE D1 :OFF)", "+(POWER-STATE D1 :ON)"]
    facts.update(read("(power-state d1 ?_)"), read("(power-state d1 :off)"))
    assert facts.answers("(power-state d1 ?x)") == [":OFF"]


def test_a_property_of_nothing_has_one_value_too() -> None:
    facts = Asking()
    facts.declare_property(read("mode"))
    facts.add(read("(mode :idle)"))
    facts.add(read("(mode :busy)"))
    facts.add(read("(mode)"))
    assert facts.held() == ["(MODE :BUSY)", "(MODE)"]


def test_what_becomes_a_property_keeps_the_latest_values() -> None:
    facts = Asking("(at a 1)", "(at b 1)", "(at a 2)", "(at b 2)", "(at c 1)")
    told: list[str] = []
    facts.subscribe(lambda change: told.append(repr(change)))
    facts.declare_property(read("at"))
    assert facts.held() == ["(AT A 2)", "(AT B 2)", "(AT C 1)"]
    assert told == ["-(AT A 1)", "-(AT B 1)"]


def test_a_change_is_whole_before_anybody_is_told() -> None:
    facts = Asking("(count 1)", "(count 2)")
    seen: list[list[str]] = []
    facts.subscribe(lambda change: seen.append(facts.held()))
    facts.update(read("(count ?_)"), read("(count 3)"))
    assert seen == [["(COUNT 3)"]] * 3


def test_changes_made_by_who_is_told_are_told_afterwards() -> None:
    facts = Asking("(p 1)", "(p 2)")
    told: list[str] = []

    def answer(change: object) -> None:
        told.append(repr(change))
        if len(told) == 1:
            facts.add(read("(q 1)"))

    unsubscribe = facts.subscribe(answer)
    facts.retract(read("(p ?_)"))
    assert told == ["-(P 1)", "-(P 2)", "+(Q 1)"]
    unsubscribe()
    unsubscribe()
    facts.clear()
    assert len(told) == 3 and len(facts) == 0


def test_who_subscribes_no_more_hears_not_even_of_the_rest_of_a_change() -> None:
    facts = Asking("(p 1)", "(p 2)")
    told: list[str] = []
    unsubscribe = facts.subscribe(lambda change: (told.append(repr(change)), unsubscribe()))
    facts.retract(read("(p ?_)"))
    assert told == ["-(P 1)"]


def test_many_facts_are_one_change_or_none() -> None:
    facts = Asking("(p 1)")
    assert facts.add_all(map(read, ["(p 1)", "(p 2)", "(p 3)"])) == 2
    with pytest.raises(Failure):
        facts.add_all(map(read, ["(p 4)", "(p ?x)"]))
    assert facts.held() == ["(P 1)", "(P 2)", "(P 3)"]


def test_the_facts_of_one_name_whatever_their_arity() -> None:
    facts = Asking("(p 1)", "(q 1)", "(p 1 2)")
    assert [prin1(fact) for fact in facts.facts(read("p"))] == ["(P 1)", "(P 1 2)"]


def test_what_is_a_relation() -> None:
    facts = Asking("(p 1)")
    facts.retract(read("(p ?_)"))
    facts.declare(read("q"), 2)
    facts.declare_property(read("r"))
    facts.rule("((s ?x) (p ?x))")
    facts.answers("(t ?x)")
    assert [facts.is_relation(read(name)) for name in "pqrst"] == [True, True, True, True, False]
