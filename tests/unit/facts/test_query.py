"""Queries: patterns, AND, OR, NOT, tests; what is unsafe; snapshots; plans."""

from __future__ import annotations

import pytest

from asking import LISP, Asking, bound, read, told
from eslang.base.failure import Failure
from eslang.base.lists import Cons, from_items
from eslang.base.printer import prin1
from eslang.base.text import String
from eslang.facts.goals import UNBOUND

DEVICES = (
    "(is-a w1 widget)",
    "(is-a g1 gadget)",
    "(is-a w2 widget)",
    "(health-state w1 :broken)",
    "(health-state w2 :ok)",
    "(health-state g1 :ok)",
    "(load w1 3)",
    "(load w2 4)",
)


@pytest.mark.parametrize(
    ("query", "expected"),
    [
        ("(is-a ?x widget)", ["W1", "W2"]),
        ("(is-a ?x ?y)", ["W1 WIDGET", "G1 GADGET", "W2 WIDGET"]),
        ("(is-a w1 widget)", [""]),
        ("(is-a w1 gadget)", []),
        ("(unheard-of ?x)", []),
        ("(is-a ?x)", []),
        ("(is-a ?_ ?kind)", ["WIDGET", "GADGET"]),
        ("(and (is-a ?x ?type) (health-state ?x :ok))", ["W2 WIDGET", "G1 GADGET"]),
        ("(and (is-a ?x widget) (load ?x ?n) (> ?n 3))", ["W2 4"]),
        ("(and (> ?n 3) (load ?x ?n))", ["4 W2"]),
        ("(and (is-a ?x ?_) (not (load ?x ?_)))", ["G1"]),
        ("(and (not (health-state ?x :ok)) (is-a ?x widget))", ["W1"]),
        ("(or (is-a ?x gadget) (load ?x 3))", ["G1", "W1"]),
        ("(or (is-a ?x widget) (load ?x 3))", ["W1", "W2"]),
        ("(or (is-a g1 ?x) (load w1 ?y))", ["GADGET", "3"]),
        ("(and (load ?x ?n) (or (evenp ?n) (health-state ?x :broken)))", ["W1 3", "W2 4"]),
        ("(and (or (is-a ?x gadget) (is-a ?x widget)) (health-state ?x :ok))", ["W2", "G1"]),
        ("(not (is-a w9 ?_))", [""]),
        ("(not (not (is-a w1 ?_)))", [""]),
        ("(and)", [""]),
        ("(or)", []),
        ("(and (load ?x ?n) (or))", []),
        ("(and (load ?x ?n) (not (and (evenp ?n) (is-a ?x widget))))", ["W1 3"]),
    ],
)
def test_what_a_query_answers(query: str, expected: list[str]) -> None:
    facts = Asking(*DEVICES)
    assert facts.answers(query) == expected
    assert [told(each) for each in facts.solutions(read(query))] == expected
    assert told(facts.first(read(query))) == (expected or ["none"])[0]
    assert told(facts.ask(read(query))[0]) == (expected or ["none"])[0]


@pytest.mark.parametrize(
    ("query", "expected"),
    [
        ("(at ?r (pos ?x ?y))", ["R1 1 2.0"]),
        ("(at ?r (pos 1 ?y))", ["R1 2.0"]),
        ("(at ?r (pos 1.0 ?y))", []),
        ("(at ?r (?k . ?rest))", ["R1 POS (1 2.0)", "R2 PATH (A (B))"]),
        ("(at ?r (path ?x (?y)))", ["R2 A B"]),
        ("(at r2 ?p)", ["(PATH A (B))"]),
        ("(and (named ?n r1) (at r1 (pos 1 2.0)))", ['"one"']),
        ('(named "one" ?r)', ["R1"]),
        ("(and (same ?x ?l) (same ?y (?x ?y)))", ["A (A B) B"]),
        ("(and (same a ?l) (same ?y ?l) (same ?y (a ?y)))", ["(A B) B"]),
        ("(same ?x (?x ?_))", ["A"]),
    ],
)
def test_terms_inside_facts(query: str, expected: list[str]) -> None:
    facts = Asking("(at r1 (pos 1 2.0))", "(at r2 (path a (b)))", '(named "one" r1)', '(named "two" r2)')
    facts.add(read("(same a (a b))"))
    facts.add(read("(same b (a b))"))
    assert facts.answers(query) == expected


@pytest.mark.parametrize(
    ("query", "variable", "goal"),
    [
        ("(> ?x 3)", "?X", "(> ?X 3)"),
        ("(not (is-a ?x widget))", "?X", "(NOT (IS-A ?X WIDGET))"),
        ("(and (is-a ?x widget) (not (load ?x ?n)))", "?N", "(NOT (LOAD ?X ?N))"),
        ("(and (or (is-a ?x widget) (load ?y ?n)) (evenp ?n))", "?N", "(EVENP ?N)"),
        ("(and (load ?x ?_) (> ?_ 3))", "?_", "(> ?_ 3)"),
        ("(or (is-a ?x widget) (> ?x 1))", "?X", "(> ?X 1)"),
    ],
)
def test_an_unsafe_query_fails_and_says_why(query: str, variable: str, goal: str) -> None:
    with pytest.raises(Failure) as caught:
        Asking(*DEVICES).all(read(query))
    assert caught.value.cause is UNBOUND
    assert [prin1(each) for each in caught.value.arguments] == [variable, goal]


@pytest.mark.parametrize(
    "query", ["a", "nil", "(1 2)", "(?p a)", "(a . b)", "(not)", "(not (a) (b))", "(and ?x)"]
)
def test_what_is_no_query_is_refused(query: str) -> None:
    with pytest.raises(Failure) as caught:
        Asking(*DEVICES).all(read(query))
    assert caught.value.cause is not UNBOUND


def test_a_query_without_an_end_is_refused() -> None:
    query = read("(p a)")
    query.cdr.cdr = query.cdr
    for ask in (Asking().all, Asking().add, Asking().retract):
        with pytest.raises(Failure):
            ask(query)


@pytest.mark.parametrize("part", ["car", "cdr"])
@pytest.mark.parametrize("text", ["(a)", "(?x)", "((a . b) c)"])
def test_a_term_that_contains_itself_is_refused(text: str, part: str) -> None:
    query = Cons(read("p"), Cons(read(text), None))
    innermost = query.cdr.car.car if query.cdr.car.car.__class__ is Cons else query.cdr.car
    setattr(innermost, part, query.cdr.car)
    for ask in (Asking().all, Asking().add, Asking().retract):
        with pytest.raises(Failure) as caught:
            ask(query)
        assert caught.value.arguments[0] is query.cdr.car


def test_bindings_that_are_given_constrain_a_query() -> None:
    facts = Asking(*DEVICES)
    assert facts.answers("(is-a ?x ?type)", x=read("w2")) == ["W2 WIDGET"]
    assert facts.answers("(is-a ?x ?type)", x=read("w9")) == []
    assert facts.answers("(> ?n 3)", n=4) == ["4"]
    facts.add(read('(named "a" (w1 "b"))'))
    assert facts.answers("(named ?n (?w ?b))", n=String("a"), b=String("b")) == ['"a" W1 "b"']


def test_a_test_gets_values_and_is_asked_no_sooner_than_it_must() -> None:
    facts = Asking(*DEVICES, '(named w1 (1 "x"))')
    assert facts.answers('(and (equal ?t (1 "x")) (named w1 ?t))') == ['(1 "x")']
    assert facts.answers('(and (named ?w (?n ?s)) (equal (?s ?n) ("x" 1)))') == ['W1 1 "x"']
    facts.calls.clear()
    assert facts.answers("(and (is-a ?x gadget) (load ?x ?n) (evenp ?n))") == []
    assert facts.calls == []


def test_solutions_are_found_when_they_are_asked_for() -> None:
    facts = Asking(*[f"(p {number})" for number in range(10)])
    solutions = facts.solutions(read("(and (p ?x) (evenp ?x))"))
    assert facts.calls == []
    assert (told(next(solutions)), told(next(solutions))) == ("0", "2")
    assert len(facts.calls) == 3


def test_solutions_are_those_of_the_moment_of_entry() -> None:
    facts = Asking(*DEVICES)
    solutions = facts.solutions(read("(and (is-a ?x widget) (load ?x ?n))"))
    facts.retract(read("(load w1 ?_)"))
    facts.add(read("(load w1 99)"))
    assert told(next(solutions)) == "W1 3"
    facts.clear()
    facts.add(read("(is-a w3 widget)"))
    assert [told(each) for each in solutions] == ["W2 4"]
    assert facts.answers("(is-a ?x widget)") == ["W3"]


def test_a_snapshot_knows_what_was_a_fact() -> None:
    facts = Asking("(p 1)", "(p 2)", "(p 3)", "(q 1)", "(q 2)")
    solutions = facts.solutions(read("(and (p ?x) (q ?x))"))
    assert told(next(solutions)) == "1"
    facts.retract(read("(q 2)"))
    facts.add(read("(q 3)"))
    assert [told(each) for each in solutions] == ["2"]


def test_a_snapshot_of_many_facts_under_one_key_is_not_disturbed() -> None:
    facts = Asking(*[f"(is-a w{number} widget)" for number in range(30)])
    for query in ("(is-a ?x widget)", "(is-a ?x ?kind)", "(and (is-a ?x ?kind) (is-a ?y ?kind))"):
        expected = facts.answers(query)
        solutions = facts.solutions(read(query))
        found = [told(next(solutions)) for _ in range(3)]
        facts.retract(read("(is-a w2 widget)"))
        found.append(told(next(solutions)))
        facts.retract(read("(is-a w9 widget)"))
        facts.add_all(map(read, ["(is-a w2 widget)", "(is-a w9 widget)", "(is-a w99 widget)"]))
        found += [told(each) for each in solutions]
        assert found == expected
        facts.retract(read("(is-a w99 ?_)"))


def test_a_test_may_change_the_facts_it_is_asked_about() -> None:
    facts = Asking("(p 1)", "(p 2)", "(p 3)")
    facts.call = lambda name, arguments: facts.add(read(f"(p {arguments[0] + 10})"))
    assert facts.answers("(and (p ?x) (evenp ?x))") == ["1", "2", "3"]
    assert len(facts) == 6


def test_a_test_that_fails_ends_no_search() -> None:
    failing = Asking("(p 2)", "(p 4)", "(p 6)")
    solutions = failing.solutions(read("(and (p ?x) (evenp ?x))"))
    assert told(next(solutions)) == "2"
    failing.broken = True
    with pytest.raises(ZeroDivisionError):
        next(solutions)
    failing.broken = False
    failing.clear()
    assert [told(each) for each in solutions] == ["4", "6"]
    assert not any(relation.views for relation in failing.relations.values())


def test_nobody_is_kept_waiting_for_a_snapshot_that_is_given_up() -> None:
    facts = Asking(*DEVICES)
    for end in ("drop", "close", "finish"):
        solutions = facts.solutions(read("(is-a ?x widget)"))
        next(solutions)
        if end == "close":
            solutions.close()
            assert next(solutions, None) is None
        elif end == "finish":
            list(solutions)
        del solutions
        assert not any(relation.views for relation in facts.relations.values())


def test_a_snapshot_that_ends_while_others_are_kept_does_not_disturb_them() -> None:
    facts = Asking("(p 1)", "(p 2)")
    (relation,) = facts.relations.values()
    snapshots = [facts.solutions(read("(p ?x)")) for _ in range(3)]
    first, second, _ = relation.views
    keep = second.keep
    dropped = type("Dropped", (), {"keep": lambda self, *change: (snapshots.pop(0).close(), keep(*change))})()
    relation.views = {dropped: None, **relation.views}
    facts.retract(read("(p 1)"))
    del relation.views[dropped]
    assert first not in relation.views
    assert [[told(each) for each in snapshot] for snapshot in snapshots] == [["1", "2"]] * 2


def test_queries_that_differ_in_constants_share_a_plan() -> None:
    facts = Asking(*DEVICES)
    for name in ("w1", "w2", "g1", '"x"', "(a b)"):
        facts.answers(f"(load {name} ?n)")
    assert len(facts.plans) == 1


def test_plans_are_not_kept_without_end(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("eslang.facts.query.MANY", 3)
    facts = Asking(*DEVICES)
    for number in range(10):
        assert facts.answers(f"(is-a ?x{number} gadget)") == ["G1"]
    assert len(facts.plans) <= 3


def test_a_name_that_becomes_a_relation_is_no_test_any_more() -> None:
    facts = Asking("(p 2)")
    assert facts.answers("(and (p ?x) (evenp ?x))") == ["2"]
    facts.add(read("(evenp 3)"))
    assert facts.answers("(and (p ?x) (evenp ?x))") == []


def test_a_name_that_nobody_knew_may_become_a_function_or_a_relation(monkeypatch: pytest.MonkeyPatch) -> None:
    facts = Asking("(p 2)", "(p 4)")
    assert facts.answers("(and (p ?x) (oddly ?x))") == []
    assert facts.answers("(and (p ?x) (rarely ?x))") == []
    monkeypatch.setitem(LISP, "ODDLY", lambda number: number == 4)
    assert facts.answers("(and (p ?x) (oddly ?x))") == ["4"]
    facts.add(read("(rarely 2)"))
    assert facts.answers("(and (p ?x) (rarely ?x))") == ["2"]


def test_a_relation_may_get_its_first_string_late() -> None:
    facts = Asking("(p 1)")
    assert facts.answers("(p ?x)") == ["1"]
    facts.add(read('(p "x")'))
    assert facts.answers("(p ?x)") == ["1", '"x"']


def test_a_query_may_be_longer_than_python_nests() -> None:
    facts = Asking(*[f"(next {number} {number + 1})" for number in range(40)], "(next 1 3)")
    long = " ".join(f"(next ?v{number} ?v{number + 1})" for number in range(30))
    assert len(facts.answers(f"(and {long})", v0=0)) == 2
    assert len(list(facts.solutions(read(f"(and {long})"), {bound("?v0"): 0}))) == 2
    assert facts.first(read(f"(and {long})"), {bound("?v0"): 0}) is not None
    assert facts.answers(f"(and {long} (not (and {long})))", v0=0) == []
    facts.rule(f"((far ?v0 ?v30) {long})")
    assert facts.answers("(far 0 ?x)") == ["30", "31"]


def test_a_fact_may_hold_more_lists_than_python_nests() -> None:
    places = range(120)
    facts = Asking(f"(p {' '.join(f'(f {place})' for place in places)})")
    pattern = f"(p {' '.join(f'(f ?v{place})' for place in places)})"
    assert facts.answers(pattern) == [" ".join(map(str, places))]
    assert facts.answers(pattern.replace("?v7)", "?v8)")) == []
    assert facts.retract(read(pattern)) == 1


def test_facts_hold_copies_and_answers_are_copies() -> None:
    text, part = String("before"), read("(a b)")
    facts = Asking()
    facts.add(from_items([read("named"), text, part]))
    text.text, part.car = "after", read("c")
    (found,) = facts.all(read("(named ?n ?p)"))
    assert told(found) == '"before" (A B)'
    found[bound("?n")].text, found[bound("?p")].car = "later", read("d")
    assert facts.held() == ['(NAMED "before" (A B))']
    assert facts.answers('(named "before" (?x . ?_))') == ["A"]


def test_an_explanation_tells_plan_and_indexes() -> None:
    facts = Asking(*DEVICES)
    explained = facts.explain(
        read("(and (is-a ?x ?type) (health-state ?x :ok) (not (load ?x 3)) (evenp ?x))")
    )
    shown = [(step.kind, prin1(step.goal), step.positions) for step in explained.steps]
    assert shown == [
        ("look-up", "(HEALTH-STATE ?X :OK)", (1,)),
        ("not", "(NOT (LOAD ?X 3))", ()),
        ("test", "(EVENP ?X)", ()),
        ("look-up", "(IS-A ?X ?TYPE)", (0,)),
    ]
    assert [(name.name, positions) for name, _, positions in explained.indexes] == [
        ("HEALTH-STATE", (1,)),
        ("IS-A", (0,)),
    ]


@pytest.mark.parametrize("part", ["(or (p 2) {})", "(not {})", "(and (p 1) {})", "(or (p 2) (and (p 1) {}))"])
def test_goals_deep_inside_one_another_are_planned_once_each(part: str) -> None:
    facts, query = Asking("(p 1)"), "(p 1)"
    for _ in range(40):
        query = part.format(query)
    assert facts.answers(query) == [""]
    assert facts.answers(query.replace("(p 1)", "(p ?x)") if "not" not in part else query) != []


def test_what_is_too_deep_for_a_query_is_a_failure() -> None:
    term, goal, p, no = read("?x"), read("(p 1)"), read("p"), read("not")
    for _ in range(2_000):
        term, goal = Cons(term, None), Cons(no, Cons(goal, None))
    for query in (Cons(p, Cons(term, None)), goal):
        with pytest.raises(Failure) as caught:
            Asking().all(query)
        assert caught.value.cause.name == "STACK-EXHAUSTED"
