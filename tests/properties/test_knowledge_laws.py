"""What goes into the facts from Python comes out, and goes in again, as the same."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from eslang import Interpreter, Keyword, Text

NAMES = st.from_regex(r"[a-z][a-z0-9-]{0,6}", fullmatch=True)
ATOMS = st.one_of(
    NAMES,
    NAMES.map(lambda name: f":{name}"),
    st.text(max_size=6).map(Text),
    st.integers(),
    st.floats(allow_nan=False),
    st.fractions(),
    st.booleans(),
    st.none(),
    NAMES.map(Keyword),
)
TERMS = st.recursive(ATOMS, lambda terms: st.lists(terms, max_size=3), max_leaves=6)
AGENT = Interpreter()


@pytest.mark.slow
@settings(deadline=None)
@given(NAMES, st.lists(TERMS, max_size=4))
def test_a_fact_comes_out_as_it_went_in(relation: str, terms: list[Any]) -> None:
    facts = AGENT.facts
    facts.clear()
    assert facts.add(f"robot-{relation}", *terms)
    [fact] = facts
    assert fact in facts and [f"robot-{relation}", *terms] in facts
    assert facts.add(fact) is False and facts.add_all([fact]) == 0
    variables = [f"?v{number}" for number in range(len(terms))]
    [row] = facts.query(fact[0], *variables)
    assert list(row.values()) == fact[1:]
    assert facts.query(fact[0], *variables, **row) == [row]
    assert facts.remove(fact) == 1


@pytest.mark.slow
@settings(deadline=None)
@given(st.text(max_size=8))
def test_a_str_is_one_atom_or_refused(text: str) -> None:
    from eslang import EslError, Failure

    facts = AGENT.facts
    facts.clear()
    try:
        facts.add("robot-says", text)
    except (EslError, Failure):
        assert len(facts) == 0
        return
    [fact] = facts
    assert not isinstance(fact[1], list)
    assert f"(robot-says {text})" in facts
