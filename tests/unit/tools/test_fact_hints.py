"""What is told of a failure that the logical database found."""

from __future__ import annotations

from pathlib import Path

import pytest
from unit.tools.command import call

from eslang.base.failure import Failure
from eslang.base.symbols import Keyword
from eslang.tools.fact_hints import fact_hint


@pytest.mark.parametrize(
    ("plan", "sentence", "hint"),
    [
        (
            "(db-query '(count ?n))",
            "the logic variable ?N has no value in (COUNT ?N)",
            "`count` is a function, so this is a call; `(defrelation count)` makes it a relation",
        ),
        (
            "(db-query '(and (p ?x) (> ?x ?y)))",
            "the logic variable ?Y has no value in (> ?X ?Y)",
            "a pattern has to say what `?y` may be",
        ),
        (
            "(db-query '(not (p ?x)))",
            "the logic variable ?X has no value in (NOT (P ?X))",
            "a pattern beside the NOT has to say what `?x` may be; under NOT, `?_` is anything",
        ),
        (
            "(progn (defrelation near) (db-query (near ?x ?y)))",
            "the function NEAR is undefined",
            "`near` is a relation: facts and queries that are data stand under a quote",
        ),
        (
            "(progn (assert '(near a b)) (assert (near 2 3)))",
            "the function NEAR is undefined",
            "`near` is a relation: facts and queries that are data stand under a quote",
        ),
        ("(assert '(p ?x))", "the logic variable ?X has no value in (P ?X)", None),
        (
            "(defrule (a ?x) (p ?x) (not (a ?x)))",
            "the relation A would rest on its own absence: A, A",
            "let one of these relations be asserted rather than derived",
        ),
        (
            "(progn (defrule (z (s ?x)) (z ?x)) (db-query '(z ?x)))",
            "the rules of Z might make ever larger lists without end in (Z (S ?X))",
            "ask with more arguments known, or let the rules take lists apart rather than build them",
        ),
        (
            "(assert '(> 2 1))",
            "the value > is not of type RELATION",
            "`>` has a meaning of its own in queries: give the relation another name",
        ),
        (
            "(assert '(5 1))",
            "the value 5 is not of type RELATION",
            "a fact or a pattern begins with the name of a relation, which is a symbol and no variable",
        ),
        (
            "(retract '(and (p 1) (q 1)))",
            "the value (AND (P 1) (Q 1)) is not of type FACT",
            "one pattern is meant here; queries of several parts are for DB-QUERY and its like",
        ),
    ],
)
def test_what_is_told(plan: str, sentence: str, hint: str | None, tmp_path: Path) -> None:
    file = tmp_path / "plan.esl"
    file.write_text(plan + "\n")
    err = call(["run", "-q", str(file)]).err
    assert f"^ {sentence}\n" in err
    hints = [line.partition("= hint  ")[2] for line in err.splitlines() if "= hint" in line]
    assert hints == ([hint] if hint else [])


def test_causes_that_a_plan_fails_with_itself_may_have_any_arguments() -> None:
    for cause in ("UNBOUND-LOGIC-VARIABLE", "UNSTRATIFIED-RULES", "UNBOUNDED-RULES"):
        for arguments in ((), (1,), (None, None), (1, 2, 3)):
            failure = Failure(Keyword(cause), *arguments)
            assert isinstance(fact_hint(failure, None), str | None)
            assert str(failure)
