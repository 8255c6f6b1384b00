"""ANDs of many ORs: their ways are joined, not multiplied."""

from __future__ import annotations

import pytest

from asking import Asking, read, told
from eslang.base.failure import Failure


@pytest.fixture(params=[1, 8], autouse=True)
def most(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Ways are joined always; and only if there are many."""
    monkeypatch.setattr("eslang.facts.steps.MANY", request.param)


def both(first: str, second: str, count: int) -> str:
    """An AND of COUNT times (or FIRST SECOND), with the number for *."""
    return f"(and {' '.join(f'(or {first} {second})'.replace('*', str(n)) for n in range(count))})"


def test_each_way_is_gone() -> None:
    facts = Asking(*(f"({letter}{n} 1)" for n in range(40) for letter in "pq"), "(q1 2)", "(p30 3)")
    query = both("(p* ?x*)", "(q* ?x*)", 40)
    values = [(second, thirtieth) for second in "12" for thirtieth in "13"]
    expected = [
        " ".join({1: second, 30: thirtieth}.get(n, "1") for n in range(40)) for second, thirtieth in values
    ]
    assert facts.answers(query) == expected
    assert [told(each) for each in facts.solutions(read(query))] == expected
    assert told(facts.first(read(query))) == expected[0]
    assert facts.answers(f"(and (p30 ?z) (not {both('(p* ?_)', '(q* ?_)', 40)}))") == []
    assert facts.answers(f"(and (p30 ?z) (not {both('(p* ?_)', '(q* 7)', 40)}))") == []
    assert facts.answers(f"(and (p30 ?z) (not {both('(p* 1)', '(q* ?_)', 41)}))") == ["1", "3"]


def test_what_stands_behind_the_ors_has_their_values() -> None:
    facts = Asking("(p 1)", "(p 2)", "(q 2)", "(q 3)", "(r 2)", "(r 4)")
    ors = "(or (p ?x) (q ?x)) (or (q ?y) (r ?y)) (or (r ?z) (p ?z) (q ?z))"
    assert len(facts.answers(f"(and {ors})")) == 3 * 3 * 4
    assert facts.answers(f"(and {ors} (evenp ?x) (> ?z 3))") == ["2 2 4", "2 3 4", "2 4 4"]
    assert facts.answers(f"(and {ors} (not (r ?x)) (q ?x) (not (q ?y)) (p ?z))") == ["3 4 2", "3 4 1"]


def test_ors_in_rules() -> None:
    """In rules that do not need themselves, and in such as do, twice over."""
    facts = Asking(*(f"({name} {n} {n + 1})" for n in range(6) for name in ("road", "path")), "(road 6 0)")
    for rule in [
        "((linked ?x ?y) (or (road ?x ?y) (path ?x ?y)))",
        """((three ?a ?d) (or (road ?a ?b) (path ?a ?b)) (or (road ?b ?c) (path ?b ?c) (linked ?b ?c))
                          (or (road ?c ?d) (path ?c ?d) (linked ?c ?d)))""",
        """((far ?a ?d) (or (three ?a ?b) (far ?a ?b)) (or (linked ?b ?c) (three ?b ?c))
                        (or (linked ?c ?d) (road ?c ?d) (path ?c ?d) (far ?c ?d)))""",
        "((far ?a ?b) (or (road ?a ?b) (path ?a ?b)))",
    ]:
        facts.rule(rule)
    assert facts.answers("(three 0 ?d)") == ["3"]
    assert sorted(facts.answers("(far 0 ?d)")) == [str(n) for n in range(7)]
    assert len(facts.answers("(far ?a ?d)")) == 49
    assert facts.answers("(far 2 1)") == [""]
    assert facts.answers("(and (road ?x 3) (not (three ?x 4)))") == ["2"]


def test_ways_that_bind_different_variables_multiply(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("eslang.facts.steps.MOST", 20)
    facts = Asking("(p0 1)", "(q1 2)", "(p2 3)", "(q2 4)")
    assert facts.answers(both("(p* ?x*)", "(q* ?y*)", 3)) == ["1 2 3", "1 2 4"]
    with pytest.raises(Failure, match="too many ways through the ORs"):
        facts.answers(both("(p* ?x*)", "(q* ?y*)", 30))
    wide = " ".join(f"(p{number} ?x)" for number in range(100))
    assert facts.answers(f"(or {wide})") == ["1", "3"]


def test_an_unsafe_way_is_told_of() -> None:
    ors = both("(p* ?x*)", "(q* ?y*)", 5)
    with pytest.raises(Failure, match="UNBOUND-LOGIC-VARIABLE"):
        Asking().answers(f"(and {ors} (not (r ?x3)))")


def test_the_ways_and_what_is_behind_them_are_explained() -> None:
    facts = Asking("(p 1)", "(r 2)")
    ors = "(or (p ?x) (q ?x)) (or (p ?y) (q ?y)) (or (p ?z) (q ?z)) (or (p ?u) (q ?u)) (or (p ?v) (q ?v))"
    steps = facts.explain(read(f"(and {ors} (> ?x ?v))")).steps
    assert steps[0].kind == "or"
    assert len(str(steps)) < 20_000
