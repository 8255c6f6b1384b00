"""Who waits for facts to change is woken by what was read, and by nothing else."""

from __future__ import annotations

import pytest

from asking import Asking, read
from eslang.facts.watching import Change, Watch, unwatch, watch


def watched(facts: Asking, query: str) -> tuple[list[Change | None], Watch]:
    """Ask, watch what was read, and keep what wakes."""
    woken: list[Change | None] = []
    _, reads = facts.ask(read(query))
    return woken, watch(reads, woken.append)


def woken_by(facts: Asking, query: str, *changes: str) -> list[str]:
    """The changes that wake who waits for QUERY: + or - before a fact."""
    woken, _ = watched(facts, query)
    for change in changes:
        (facts.add if change[0] == "+" else facts.retract)(read(change[1:]))
    return [repr(change) for change in woken]


def test_a_change_of_what_was_looked_up_wakes() -> None:
    facts = Asking("(power-state a :off)", "(power-state b :off)")
    found = woken_by(facts, "(power-state a :on)", "+(power-state b :on)", "+(power-state a :on)")
    assert found == ["+(POWER-STATE A :ON)"]


def test_the_other_keys_of_a_relation_do_not_wake() -> None:
    facts = Asking("(level a 3)", "(level b 4)")
    found = woken_by(facts, "(and (level a ?n) (> ?n 5))", "+(level b 9)", "-(level b 4)", "+(level a 9)")
    assert found == ["+(LEVEL A 9)"]


def test_what_a_scan_saw_wakes_whatever_it_is() -> None:
    facts = Asking("(level a 3)")
    assert woken_by(facts, "(and (level ?_ ?n) (> ?n 5))", "+(level b 1)", "-(level a 3)") == [
        "+(LEVEL B 1)",
        "-(LEVEL A 3)",
    ]


def test_joins_wake_by_the_keys_that_they_came_to() -> None:
    facts = Asking("(part-of a car)", "(broken b)")
    found = woken_by(
        facts, "(and (part-of ?x car) (broken ?x))", "+(broken c)", "+(part-of d bus)", "+(broken a)"
    )
    assert found == ["+(BROKEN A)"]


def test_what_is_negated_wakes_when_it_goes() -> None:
    facts = Asking("(blocked door)", "(blocked window)")
    assert woken_by(facts, "(not (blocked door))", "-(blocked window)", "-(blocked door)") == [
        "-(BLOCKED DOOR)"
    ]


def test_rules_wake_by_the_facts_under_them() -> None:
    for step in ("(edge ?x ?z) (reach ?z ?y)", "(reach ?x ?z) (edge ?z ?y)"):
        facts = Asking("(edge a b)", "(edge c d)")
        facts.rule("((reach ?x ?y) (edge ?x ?y))")
        facts.rule(f"((reach ?x ?y) {step})")
        facts.rule("((lost ?x) (place ?x) (not (reach a ?x)))")
        facts.add(read("(place b)"))
        assert woken_by(facts, "(lost b)", "+(edge c e)", "+(place c)", "-(edge a b)") == ["-(EDGE A B)"]


def test_a_new_rule_wakes_who_asked_its_relation() -> None:
    facts = Asking("(p 1)")
    woken, _ = watched(facts, "(q 1)")
    facts.rule("((r ?x) (p ?x))")
    assert woken == []
    facts.rule("((q ?x) (p ?x))")
    assert woken == [None]
    woken, _ = watched(facts, "(and (q 1) (s ?x))")
    facts.forget_rules(read("q"))
    assert woken == [None]


def test_one_change_wakes_once() -> None:
    facts = Asking("(count 1)", "(count 2)", "(total 3)")
    woken, _ = watched(facts, "(and (count ?n) (total ?n))")
    facts.update(read("(count ?_)"), read("(count 3)"))
    assert [repr(change) for change in woken] == ["-(COUNT 1)"]
    facts.retract(read("(count ?_)"))
    assert len(woken) == 2


def test_who_watches_no_more_is_not_woken() -> None:
    facts = Asking("(p 1)")
    first, one = watched(facts, "(p 2)")
    second, _ = watched(facts, "(p 2)")
    unwatch(one)
    unwatch(one)
    facts.add(read("(p 2)"))
    assert (len(first), len(second)) == (0, 1)


def test_who_watches_no_more_by_the_time_of_the_call_is_not_called() -> None:
    facts = Asking("(p 1)")
    _, reads = facts.ask(read("(p 2)"))
    watches: list[Watch] = []
    woken: list[int] = []
    for number in (0, 1):
        watches.append(watch(reads, lambda _, number=number: (woken.append(number), unwatch(watches[1]))))
    facts.add(read("(p 2)"))
    assert woken == [0]


def test_a_change_that_was_seen_when_the_watch_began_does_not_wake() -> None:
    facts = Asking("(p 1)")
    woken: list[str] = []

    def change_and_watch(change: Change) -> None:
        if change.name.name == "P":
            facts.add(read("(q 2)"))
            _, reads = facts.ask(read("(q 2)"))
            watch(reads, lambda each: woken.append(repr(each)))

    facts.subscribe(change_and_watch)
    facts.add(read("(p 2)"))
    assert woken == []
    facts.retract(read("(q 2)"))
    assert woken == ["-(Q 2)"]


def test_one_who_fails_keeps_nobody_from_hearing_of_rules() -> None:
    facts = Asking("(p 1)")
    _, reads = facts.ask(read("(q 1)"))
    woken: list[Change | None] = []

    def fail(change: Change | None) -> None:
        raise ZeroDivisionError

    watch(reads, fail)
    watch(reads, woken.append)
    with pytest.raises(ZeroDivisionError):
        facts.rule("((q ?x) (p ?x))")
    assert woken == [None] and facts.answers("(q ?x)") == ["1"]


def test_a_relation_that_is_not_there_yet_can_be_waited_for() -> None:
    assert woken_by(Asking(), "(found ?x)", "+(found key)") == ["+(FOUND KEY)"]


def test_reads_tell_the_relations_and_whether_lisp_was_asked() -> None:
    facts = Asking("(p 1)", "(q 2)")
    _, reads = facts.ask(read("(and (p ?x) (not (q ?x)))"))
    assert ([(name.name, arity) for name, arity in reads.relations()], reads.asked_lisp) == (
        [("P", 1), ("Q", 1)],
        False,
    )
    _, reads = facts.ask(read("(and (p ?x) (evenp ?x))"))
    assert reads.asked_lisp


def test_watches_leave_nothing_behind() -> None:
    facts = Asking("(p 1)")
    watches = [watched(facts, f"(and (p {number}) (q ?x))")[1] for number in range(10)]
    for each in watches:
        unwatch(each)
    assert not any(relation.watched for relation in facts.relations.values())
