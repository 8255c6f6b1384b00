"""What is asserted, retracted, updated; properties; and who is told."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from asking import Asking, read
from eslang.base.failure import WRONG_NUMBER_OF_ARGUMENTS, Failure
from eslang.base.printer import prin1
from eslang.facts.goals import UNBOUND
from eslang.facts.watching import watch


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


@pytest.mark.parametrize(
    "act",
    [
        lambda facts: facts.add(read("(level a)")),
        lambda facts: facts.add_all([read("(p 2)"), read("(level a)")]),
        lambda facts: facts.retract(read("(level ?x)")),
        lambda facts: facts.update(read("(p ?x)"), read("(level a)")),
        lambda facts: facts.answers("(level ?x)"),
        lambda facts: facts.answers("(and (> ?n 3) (level ?x) (p ?n))"),
        lambda facts: facts.answers("(not (level a))"),
        lambda facts: facts.answers("(or (p ?x) (level ?x))"),
        lambda facts: facts.rule("((level ?x) (p ?x))"),
        lambda facts: facts.rule("((q ?x) (p ?x) (not (level ?x)))"),
    ],
)
def test_a_declared_arity_is_kept(act: Callable[[Asking], object]) -> None:
    facts = Asking("(p 1)")
    facts.declare(read("level"), 2)
    with pytest.raises(Failure) as caught:
        act(facts)
    assert caught.value.cause is WRONG_NUMBER_OF_ARGUMENTS
    assert caught.value.arguments == (read("level"), "takes 2 arguments but 1 was given")
    assert facts.held() == ["(P 1)"] and not facts.is_relation(read("q"))


def test_a_relation_may_be_declared_with_several_arities() -> None:
    facts = Asking()
    for arity in (3, 1, 3):
        facts.declare(read("at"), arity)
    facts.add_all(map(read, ["(at a)", "(at a b c)"]))
    with pytest.raises(Failure) as caught:
        facts.add(read("(at a b)"))
    assert caught.value.arguments[1] == "takes 1 or 3 arguments but 2 were given"


def test_what_was_there_before_an_arity_was_declared_stays() -> None:
    facts = Asking("(level a 1 2)", "(level)")
    facts.rule("((level ?x) (level ?x ?_ ?_))")
    facts.answers("(level ?x ?y ?z ?u)")
    facts.declare(read("level"), 2)
    facts.add(read("(level b 1 2)"))
    assert facts.answers("(level ?x)") == ["A", "B"]
    assert facts.answers("(level)") == [""]
    assert facts.forget_rules(read("level"))
    with pytest.raises(Failure):
        facts.answers("(level ?x ?y ?z ?u)")  # nothing was there but a question


def test_who_waits_for_an_arity_that_comes_to_be_declared_is_woken() -> None:
    facts = Asking()
    woken: list[object] = []
    watch(facts.ask(read("(level ?x ?y ?z)"))[1], woken.append)
    facts.declare(read("level"), 2)
    facts.declare(read("level"), 3)
    facts.add(read("(level a b c)"))
    assert len(woken) == 1
