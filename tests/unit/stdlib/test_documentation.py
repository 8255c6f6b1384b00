"""What the library defines in Lisp is documented as what is registered in Python, and its examples run."""

from __future__ import annotations

import pytest

from eslang.compile.registry import Definition
from eslang.interpreter import Interpreter
from eslang.tools.transcript import example_of, replay


def library_definitions() -> list[Definition]:
    """What stdlib/ defines under names that plans say, in their order."""
    with Interpreter() as agent:
        agent.compiler("<test>")  # brings all of the library
        cells = list(agent.image.cells.items())
    found = [
        cell.definition
        for symbol, cell in cells
        if symbol is not None
        and symbol.package in ("COMMON-LISP", "ESL", "SCS")
        and not symbol.name.startswith("%")
        and cell.definition is not None
        and str(cell.definition.where or "").startswith("<stdlib>")
    ]
    return sorted(found, key=lambda definition: (definition.package, definition.name))


LIBRARY = library_definitions()


def test_the_library_defines_what_it_should() -> None:
    names = {definition.name for definition in LIBRARY}
    assert {"LOOP", "SETF", "DEFSTRUCT", "HANDLER-CASE", "DOLIST", "RETRYING"} <= names


@pytest.mark.parametrize("definition", LIBRARY, ids=lambda each: each.name.lower())
def test_it_begins_with_a_sentence(definition: Definition) -> None:
    first = definition.doc().strip().split("\n")[0]
    assert first.endswith((".", ":")), first
    assert len(first) <= 72, first


@pytest.mark.parametrize(
    "definition",
    [each for each in LIBRARY if each.package != "COMMON-LISP"],
    ids=lambda each: each.name.lower(),
)
def test_it_names_its_source(definition: Definition) -> None:
    assert "Source:" in definition.doc()


@pytest.mark.parametrize(
    "definition", [each for each in LIBRARY if "Example:" in each.doc()], ids=lambda each: each.name.lower()
)
def test_its_example_is_true(definition: Definition) -> None:
    entries = example_of(definition.doc())
    assert entries, "an Example: without a prompt"
    found = replay(entries)
    assert found is None, found.text(definition.name.lower())
