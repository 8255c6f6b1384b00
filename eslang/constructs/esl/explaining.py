"""EXPLAIN-QUERY: the steps by which a query is answered, for people who want it faster."""

from __future__ import annotations

from eslang.base.hints import TYPE_CHECKING, Iterable
from eslang.base.many import Values
from eslang.base.printer import prin1
from eslang.base.running import running
from eslang.base.symbols import Value
from eslang.compile.registry import ESL, function
from eslang.constructs.queries import in_force

if TYPE_CHECKING:
    from eslang.facts.explain import Explained, ExplainedRules, Explanation

STEPS = {
    "check": "is it a fact?",
    "look-up": "look up",
    "scan": "go through all",
    "rules": "ask the rules",
    "other rules": "ask the other rules",
    "test": "ask Lisp",
    "not": "unless",
    "or": "either",
}
KINDS = {
    "plain": "asked in turn",
    "walked": "walked along, each place once",
    "tabled": "asked in a circle: answers are kept in a table",
}


def _explain_values(query: Value) -> Value:
    explanation = running.session.database.explain(in_force(query))
    running.session.output.fresh_line()
    running.session.output.write("".join(f"{line}\n" for line in lines_of(explanation)))
    return Values()


@function("(explain-query query)", ESL, many=_explain_values)
def explain_query(query: Value) -> Value:
    """Print how QUERY is answered: its steps in order, and the rules.

    A look-up goes through an index on the arguments that are known then; to go
    through all facts of a relation is what makes a query slow.

    Returns: no values.
    Fails:   as DB-QUERY does, if QUERY is wrong.

    Example:
        ? (progn (assert '(is-a w1 widget)) (assert '(health-state w1 :ok)))
        (HEALTH-STATE W1 :OK)
        ? (explain-query '(and (health-state ?x :ok) (is-a ?x widget)))
        look up        (HEALTH-STATE ?X :OK)  by argument 2, of 1 fact
        is it a fact?  (IS-A ?X WIDGET)  of 1 fact

    Source: ours; language reference §5 has queries in any order.
    """
    _explain_values(query)
    return None


def lines_of(explanation: Explanation) -> Iterable[str]:
    """EXPLANATION as lines of text."""
    yield from _steps(explanation.steps, "")
    for rules in explanation.rules:
        yield ""
        yield from _rules(rules)


def _steps(steps: tuple[Explained, ...], margin: str) -> Iterable[str]:
    wide = max([len(STEPS[step.kind]) for step in steps], default=0)
    for step in steps:
        if step.inner:
            yield f"{margin}{STEPS[step.kind]}"
            for number, way in enumerate(step.inner):
                if number:
                    yield f"{margin}or"
                yield from _steps(way, margin + "    ")
        else:
            yield f"{margin}{STEPS[step.kind]:{wide}}  {prin1(step.goal)}{_more(step)}"
    if not steps:
        yield f"{margin}nothing to ask"


def _more(step: Explained) -> str:
    """What else is to be said of STEP."""
    facts = f"of {step.facts} fact{'s' if step.facts != 1 else ''}"
    if step.kind == "look-up":
        return f"  by {_arguments(step.positions)}, {facts}"
    if step.kind in ("check", "scan"):
        return f"  {facts}"
    is_asked = step.kind in ("rules", "other rules") and step.positions
    return f"  by {_arguments(step.positions)}" if is_asked else ""


def _arguments(positions: tuple[int, ...]) -> str:
    """POSITIONS as people count them."""
    return f"argument{'s' if len(positions) > 1 else ''} {' and '.join(str(each + 1) for each in positions)}"


def _rules(rules: ExplainedRules) -> Iterable[str]:
    known = f"by {_arguments(rules.positions)}" if rules.positions else "for all"
    which = "other rules" if rules.is_direct else "rules"
    yield f"The {which} of {rules.name}, {known}, are {KINDS[rules.kind]}:"
    for head, steps in rules.rules:
        yield f"  {prin1(head)}"
        yield from _steps(steps, "      ")
