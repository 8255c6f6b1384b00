"""Rules: recursion ends, negation has a meaning or is refused, and Lisp may be asked."""

from __future__ import annotations

import pytest

from asking import Asking, bound, read, told
from eslang.base.failure import Failure
from eslang.base.printer import prin1
from eslang.facts.goals import UNBOUND
from eslang.facts.procs import UNBOUNDED
from eslang.facts.rules import UNSTRATIFIED

ROUND = ("(edge a b)", "(edge b c)", "(edge c a)", "(edge c d)")
LEFT = ("((reach ?x ?y) (edge ?x ?y))", "((reach ?x ?y) (reach ?x ?z) (edge ?z ?y))")
RIGHT = ("((reach ?x ?y) (edge ?x ?y))", "((reach ?x ?y) (edge ?x ?z) (reach ?z ?y))")
DOUBLE = ("((reach ?x ?y) (edge ?x ?y))", "((reach ?x ?y) (reach ?x ?z) (reach ?z ?y))")
MUTUAL = (
    "((reach ?x ?y) (edge ?x ?y))",
    "((reach ?x ?y) (onward ?x ?y))",
    "((onward ?x ?y) (edge ?x ?z) (reach ?z ?y))",
)


def with_rules(rules: tuple[str, ...], *facts: str) -> Asking:
    """A database with these rules and facts."""
    made = Asking(*facts)
    for rule in rules:
        assert made.rule(rule)
    return made


@pytest.mark.parametrize("rules", [LEFT, RIGHT, DOUBLE, MUTUAL], ids=["left", "right", "double", "mutual"])
@pytest.mark.parametrize(
    ("query", "expected"),
    [
        ("(reach a ?x)", "A B C D"),
        ("(reach ?x d)", "A B C"),
        ("(reach d ?x)", ""),
        ("(reach a d)", "-"),
        ("(reach d a)", ""),
        ("(reach ?x ?x)", "A B C"),
        ("(and (edge ?_ ?x) (not (reach ?x ?x)))", "D"),
    ],
)
def test_recursion_ends_on_facts_in_a_circle(rules: tuple[str, ...], query: str, expected: str) -> None:
    facts = with_rules(rules, *ROUND)
    assert sorted(answer or "-" for answer in facts.answers(query)) == expected.split()
    assert len(facts.answers("(reach ?x ?y)")) == 12


def test_rules_that_need_themselves_only_as_a_tail_are_walked() -> None:
    kinds = [
        with_rules(rules, *ROUND).explain(read("(reach a ?x)")).rules[0].kind
        for rules in (RIGHT, LEFT, DOUBLE, (RIGHT[0],))
    ]
    assert kinds == ["walked", "tabled", "walked", "plain"]


def test_a_tail_that_does_more_than_pass_its_answers_on_is_not_walked() -> None:
    facts = with_rules(("((swap ?k ?a ?b) (next ?k ?j) (swap ?j ?b ?a))",), "(next 1 2)", "(next 2 3)")
    facts.add(read("(swap 3 x y)"))
    assert facts.answers("(swap 2 ?a ?b)") == ["Y X"]
    assert facts.answers("(swap 1 ?a ?b)") == ["X Y"]
    facts = with_rules(("((twin ?k ?a ?a) (next ?k ?j) (twin ?j ?a ?a))",), "(next 1 2)")
    facts.add_all(map(read, ["(twin 2 x y)", "(twin 2 z z)"]))
    assert facts.answers("(twin 1 ?a ?b)") == ["Z Z"]
    facts = with_rules(("((up ?k ?a) (next ?k ?j) (up ?j ?_) (up ?j ?a))",), "(next 1 2)", "(next 2 3)")
    facts.add(read("(up 3 x)"))
    assert facts.answers("(up 1 ?a)") == ["X"]


def test_facts_come_before_what_is_derived_and_rules_in_order() -> None:
    facts = with_rules(("((p ?x) (r ?x))", "((p ?x) (q ?x))"), "(q 1)", "(q 2)", "(r 3)", "(r 2)", "(p 4)")
    assert facts.answers("(p ?x)") == ["4", "3", "2", "1"]
    facts.add(read("(p 1)"))
    assert facts.answers("(p ?x)") == ["4", "1", "3", "2"]


def test_constants_and_repeated_variables_in_a_head_are_tests() -> None:
    facts = with_rules(
        ("((p a ?x) (q ?x))", "((p ?x ?x) (q ?x))", "((p ?x (b ?x)) (q ?x))"), "(q a)", "(q b)"
    )
    assert facts.answers("(p a ?y)") == ["A", "B", "(B A)"]
    assert facts.answers("(p ?x b)") == ["A", "B"]
    assert facts.answers("(p b b)") == [""]
    assert facts.answers("(p b a)") == []
    assert facts.answers("(p ?x (b ?y))") == ["A A", "B B"]
    assert facts.answers("(p b (b a))") == []


def test_a_rule_may_ask_lisp() -> None:
    facts = with_rules(("((high ?d) (level ?d ?n) (> ?n 5))",), "(level a 3)", "(level b 7)")
    assert facts.answers("(high ?d)") == ["B"]
    facts.add(read("(level a 9)"))
    assert facts.answers("(high a)") == [""]


def test_a_rule_may_need_to_be_told_a_variable() -> None:
    facts = with_rules(("((big ?n) (> ?n 5))",), "(level a 3)", "(level b 7)")
    assert facts.answers("(and (big ?n) (level ?d ?n))") == ["7 B"]
    with pytest.raises(Failure) as caught:
        facts.answers("(big ?n)")
    assert caught.value.cause is UNBOUND


def test_a_head_that_stays_unknown_is_unsafe() -> None:
    facts = with_rules(("((likes ?x pizza) (is-a ?_ party))",), "(is-a p party)")
    assert facts.answers("(likes joe ?y)") == ["PIZZA"]
    with pytest.raises(Failure) as caught:
        facts.answers("(likes ?who pizza)")
    assert [prin1(each) for each in caught.value.arguments] == ["?X", "(LIKES ?X PIZZA)"]


def test_negation_through_strata() -> None:
    facts = with_rules(
        (
            *RIGHT,
            "((node ?x) (edge ?x ?_))",
            "((node ?x) (edge ?_ ?x))",
            "((cut-off ?x ?y) (node ?x) (node ?y) (not (reach ?x ?y)))",
            "((hub ?x) (node ?x) (not (cut-off ?x d)))",
        ),
        *ROUND,
    )
    assert sorted(facts.answers("(hub ?x)")) == ["A", "B", "C"]
    facts.retract(read("(edge c d)"))
    facts.add(read("(edge e d)"))
    assert facts.answers("(hub ?x)") == ["E"]


@pytest.mark.parametrize(
    ("rules", "circle"),
    [
        (("((win ?x) (move ?x ?y) (not (win ?y)))",), "(WIN WIN)"),
        (("((p ?x) (q ?x))", "((q ?x) (r ?x))", "((r ?x) (s ?x) (not (p ?x)))"), "(R P Q R)"),
        (("((p ?x) (s ?x) (not (q ?x)))", "((q ?x) (or (s ?x) (and (s ?x) (p ?x))))"), "(P Q P)"),
    ],
)
def test_a_circle_through_not_is_refused_and_named(rules: tuple[str, ...], circle: str) -> None:
    facts = with_rules(rules[:-1])
    with pytest.raises(Failure) as caught:
        facts.rule(rules[-1])
    assert caught.value.cause is UNSTRATIFIED
    assert [prin1(each) for each in caught.value.arguments] == [circle, prin1(read(rules[-1]))]
    facts.answers("(and (s ?x) (not (p ?x)))")  # the rule is not there


def test_terms_that_would_grow_for_ever_are_refused() -> None:
    facts = with_rules(("((number (next ?x)) (number ?x))",), "(number nought)")
    with pytest.raises(Failure) as caught:
        facts.answers("(number ?x)")
    assert caught.value.cause is UNBOUNDED
    assert facts.answers("(number (next (next nought)))") == [""]
    assert facts.answers("(number (next (next one)))") == []


def test_rules_may_be_told_a_term_that_the_question_makes() -> None:
    facts = with_rules(
        ("((big (mass ?n)) (> ?n 5))", "((heavy ?d) (level ?d ?n) (big (mass ?n)))"),
        "(level a 3)",
        "(level b 7)",
    )
    assert facts.answers("(and (level ?d ?n) (big (mass ?n)))") == ["B 7"]
    assert facts.answers("(heavy ?d)") == ["B"]
    assert facts.answers("(and (level ?d ?n) (not (big (mass ?n))))") == ["A 3"]
    assert facts.answers("(and (level ?d ?n) (big (size ?n)))") == []


def test_a_question_that_grows_and_comes_back_ends() -> None:
    facts = with_rules(
        ("((p ?x) (q ?x))", "((q ?x) (start ?x) (p (f ?x)))", "((q ?x) (end ?x))"),
        "(start a)",
        "(end (f a))",
        "(start (f (f a)))",
        "(end (f (f (f a))))",
    )
    assert facts.answers("(p a)") == [""]
    assert sorted(facts.answers("(p ?x)")) == ["(F (F (F A)))", "(F (F A))", "(F A)", "A"]


def test_rules_may_walk_down_a_list() -> None:
    facts = with_rules(
        ("((holds ?x (?x . ?_)))", "((holds ?x (?_ . ?rest)) (holds ?x ?rest))"), "(path p (a b c))"
    )
    assert facts.answers("(and (path p ?l) (holds ?x ?l))") == ["(A B C) A", "(A B C) B", "(A B C) C"]
    assert facts.answers("(holds b (a b))") == [""]


def test_a_rule_that_is_there_already_changes_nothing() -> None:
    facts = with_rules(RIGHT, *ROUND)
    assert not facts.rule("((reach ?from ?to) (edge ?from ?by) (reach ?by ?to))")
    assert facts.forget_rules(read("reach"))
    assert not facts.forget_rules(read("reach"))
    assert facts.answers("(reach a ?x)") == []
    assert facts.rule(LEFT[0])
    assert facts.answers("(reach a ?x)") == ["B"]


def test_a_rule_that_says_more_is_not_there_already() -> None:
    facts = with_rules(("((twin) (edge ?x ?x))", "((twin) (edge ?_ ?_))"), *ROUND)
    assert facts.answers("(twin)") == [""]


@pytest.mark.parametrize("rule", ["(a (b))", "((and ?x) (b ?x))", "((?r ?x) (b ?x))", "((p ?x) b)"])
def test_what_is_no_rule_is_refused(rule: str) -> None:
    with pytest.raises(Failure):
        Asking().rule(rule)


def test_a_derived_snapshot_is_that_of_the_moment_of_entry() -> None:
    for rules in (LEFT, RIGHT, DOUBLE, MUTUAL):
        facts = with_rules(rules, *ROUND)
        expected = facts.answers("(reach ?x ?y)")
        solutions = facts.solutions(read("(reach ?x ?y)"))
        first = told(next(solutions))
        facts.retract(read("(edge ?_ ?_)"))
        facts.forget_rules(read("reach"))
        assert [first, *(told(each) for each in solutions)] == expected
        assert facts.answers("(reach ?x ?y)") == []


def test_given_bindings_reach_the_rules() -> None:
    facts = with_rules(RIGHT, *ROUND)
    found = facts.all(read("(reach ?x ?y)"), {bound("?y"): read("d")})
    assert sorted(told(each) for each in found) == ["A D", "B D", "C D"]


def test_a_long_chain_is_no_deep_recursion() -> None:
    facts = with_rules(LEFT, *[f"(edge {number} {number + 1})" for number in range(1500)])
    assert len(facts.answers("(reach 0 ?x)")) == 1500
    facts.forget_rules(read("reach"))
    for rule in RIGHT:
        facts.rule(rule)
    assert len(facts.answers("(reach 0 ?x)")) == 1500
    assert facts.answers("(reach 0 1500)") == [""]


def test_rules_over_strings_and_numbers() -> None:
    facts = with_rules(RIGHT, '(edge "a" 1.5)', '(edge 1.5 (b "c"))', '(edge (b "c") "a")')
    assert facts.answers('(reach "a" ?x)') == ["1.5", '(B "c")', '"a"']


def test_a_head_with_anything_inside_a_term_names_it_when_it_is_asked_for() -> None:
    facts = Asking("(q 1)")
    facts.rule("((p (?_ ?x)) (q ?x))")
    with pytest.raises(Failure) as caught:
        facts.answers("(p ?t)")
    assert caught.value.cause is UNBOUND
    assert prin1(caught.value.arguments[0]) == "?_"
    assert prin1(caught.value.arguments[1]) == "(P (?_ ?X))"
