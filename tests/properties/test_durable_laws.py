"""Laws of the durable store: the file holds what memory holds, and the next run begins with it."""

from __future__ import annotations

import os
from collections.abc import Iterator
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from eslang import Interpreter
from eslang.base.lists import from_items
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.base.text import String

pytestmark = pytest.mark.slow
LAW = settings(max_examples=50)

names = st.sampled_from([Symbol("A"), Symbol("B"), Symbol("POWER")])
ground = st.sampled_from([Symbol("X"), Keyword("ON"), 1, 1.0, None, from_items([1, 2])]) | st.just("x").map(
    String
)
open_terms = ground | st.just(Symbol("?_"))


def lists(terms: st.SearchStrategy[Value]) -> st.SearchStrategy[Value]:
    """Facts, or patterns, of TERMS."""
    return st.builds(
        lambda name, row: from_items([name, *row]), names, st.lists(terms, min_size=2, max_size=2)
    )


facts, patterns = lists(ground), lists(open_terms)
changes = st.one_of(
    st.tuples(st.just("add"), facts),
    st.tuples(st.just("retract"), patterns),
    st.tuples(st.just("update"), patterns, facts),
    st.tuples(st.just("add_all"), st.lists(facts, max_size=4)),
    st.tuples(st.just("clear")),
    st.tuples(st.just("declare_property"), st.just(Symbol("POWER"))),
)
rounds = st.lists(
    st.tuples(st.sampled_from(["python", "one step", "steps", "again"]), st.lists(changes, max_size=6)),
    min_size=1,
    max_size=6,
)


@pytest.fixture(scope="module")
def folder() -> Iterator[str]:
    """A folder for one file after the other."""
    Interpreter().close()  # Python's limits are set by the first
    with TemporaryDirectory() as made:
        yield made


def rows(agent: Interpreter) -> dict[str, list[Any]]:
    """What AGENT knows, in its order, by relation."""
    found: dict[str, list[Any]] = {}
    for relation in agent.database.relations.values():
        if relation.rows:
            found[relation.name.name] = [(repr(row), number) for row, number in relation.rows.items()]
    return found


def opened(path: str) -> Interpreter:
    """An interpreter that does what changes say, in one step or in many."""
    agent = Interpreter(clock="virtual", facts=path)

    @agent.primitive(name="change")
    def change(what: int) -> None:
        name, *given = agent.pending[what]  # type: ignore[attr-defined]
        getattr(agent.database, name)(*given)

    agent.eval("""(defun one-step (many) (dotimes (i many) (change i)))
                  (defun steps (many)
                    (task-net (a (loop for i from 0 below many by 2 do (change i) (yield)))
                              (b (loop for i from 1 below many by 2 do (change i) (yield)))))""")
    return agent


@LAW
@given(rounds)
def test_the_file_holds_what_memory_holds(folder: str, rounds: list[Any]) -> None:
    path = os.path.join(folder, "agent.db")
    agent = opened(path)
    try:
        for how, changes in rounds:
            if how == "again":
                before = rows(agent)
                agent.close()
                agent = opened(path)
                assert rows(agent) == before
            elif how == "python":
                for name, *given in changes:
                    getattr(agent.database, name)(*given)
            else:
                agent.pending = changes  # type: ignore[attr-defined]
                agent.call(how.replace(" ", "-"), len(changes))
            journal: Any = agent.database.journal
            numbers = {number for each in rows(agent).values() for _, number in each}
            assert [number for number, _ in journal.file.facts()] == sorted(numbers)
        before = rows(agent)
        agent.close()
        agent = opened(path)
        assert rows(agent) == before
    finally:
        agent.close()
        os.remove(path)
