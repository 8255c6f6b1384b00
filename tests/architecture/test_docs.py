"""The docs are complete: every name a plan can say is documented, and the pages are current."""

from __future__ import annotations

import importlib
import re
from pathlib import Path

import pytest

from architecture.sources import MODULES, ROOT, text_files
from eslang.compile.registry import CL, DEFINITIONS, Definition
from eslang.tools.docs import PAGES, Page, page_text

for module in MODULES:
    if module.name not in ("eslang.__main__",):
        importlib.import_module(module.name)

NAMES = sorted(DEFINITIONS, key=lambda definition: (definition.package, definition.name, definition.kind))
PARTS = ("Returns:", "Fails:", "Waits:", "Example:", "Source:")
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
TEST_PATH = re.compile(r"`(tests/[\w./-]+)`")
DECISION = re.compile(r"\b[Dd]ecision (\d+)")


def label(definition: Definition) -> str:
    """The test id of DEFINITION."""
    return f"{definition.package.lower()}:{definition.name.lower()}"


def is_internal(definition: Definition) -> bool:
    """True of names that plans do not say themselves."""
    return definition.name.startswith("%")


def parts_of(docstring: str) -> list[str]:
    """The parts that DOCSTRING has, in its order."""
    heads = (line.strip().split(" ")[0] for line in docstring.split("\n"))
    return [head for head in heads if head in PARTS]


def chosen(*, own: bool) -> list[Definition]:
    """Registered names: all, or those that are no part of Common Lisp."""
    return [each for each in NAMES if not is_internal(each) and (each.package != CL or not own)]


def test_every_name_has_a_signature() -> None:
    for definition in chosen(own=False):
        named = definition.signature.strip("()").split()[0].upper() if definition.signature else ""
        assert named == definition.name, label(definition)


def test_every_name_has_a_first_line_that_is_a_sentence() -> None:
    wrong = []
    for definition in chosen(own=False):
        first = definition.doc().strip().split("\n")[0]
        if not first.endswith(".") or len(first) > 72:
            wrong.append(f"{label(definition)}: {first!r}")
    assert wrong == []


def test_every_name_that_is_not_common_lisp_names_its_source() -> None:
    assert [label(each) for each in chosen(own=True) if "Source:" not in parts_of(each.doc())] == []


def test_the_parts_of_a_docstring_stand_in_order() -> None:
    wrong = []
    for definition in chosen(own=False):
        parts = parts_of(definition.doc())
        if parts != sorted(set(parts), key=PARTS.index):
            wrong.append(f"{label(definition)}: {parts}")
    assert wrong == []


def test_who_waits_or_fails_says_so_in_its_part() -> None:
    wrong = []
    for definition in chosen(own=True):
        prose, parts = definition.doc().split("Returns:")[0].split("Example:")[0], parts_of(definition.doc())
        if re.search(r"\b[Ff]ails with\b", prose) and "Fails:" not in parts:
            wrong.append(f"{label(definition)}: Fails:")
        if re.search(r"\b(suspended|blocks its task|waits until)\b", prose) and "Waits:" not in parts:
            wrong.append(f"{label(definition)}: Waits:")
    assert wrong == []


def test_no_name_is_registered_twice() -> None:
    # A name may be a special form and a function too: VALUES is open-coded where it is called.
    group = {"macro": "function", "constant": "variable"}
    seen = [(each.package, each.name, group.get(each.kind, each.kind)) for each in NAMES]
    assert [name for name in set(seen) if seen.count(name) > 1] == []


@pytest.mark.parametrize("definition", [each for each in NAMES if "Example:" in each.doc()], ids=label)
def test_the_example_of(definition: Definition) -> None:
    from eslang.tools.transcript import example_of, replay

    entries = example_of(definition.doc())
    assert entries, "an Example: without a prompt"
    found = replay(entries)
    assert found is None, found.text(label(definition))


def pages() -> list[Path]:
    """The Markdown files of the project."""
    return [path for path in text_files() if path.suffix == ".md"]


def test_every_link_in_the_docs_leads_somewhere() -> None:
    wrong = [
        f"{page.relative_to(ROOT)}: {link}"
        for page in pages()
        for link in LINK.findall(page.read_text(encoding="utf-8"))
        if "://" not in link and not (page.parent / link).exists()
    ]
    assert wrong == []


def test_every_test_that_the_docs_name_exists() -> None:
    wrong = [
        f"{page.relative_to(ROOT)}: {path}"
        for page in pages()
        for path in TEST_PATH.findall(page.read_text(encoding="utf-8"))
        if not (ROOT / path).exists()
    ]
    assert wrong == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.file)
def test_the_reference_page_is_current(page: Page) -> None:
    from eslang.interpreter import Interpreter

    with Interpreter() as interp:
        text = page_text(interp, page)
    written = (ROOT / "docs" / "reference" / page.file).read_text(encoding="utf-8")
    assert written == text, "python -m eslang.tools.docs docs/reference writes it anew"


def test_every_decision_is_numbered_once_and_indexed() -> None:
    index = (ROOT / "docs/explanation/where-the-papers-are-silent.md").read_text(encoding="utf-8")
    records = sorted(path.name for path in (ROOT / "docs/decisions").glob("0*.md"))
    assert [name[:4] for name in records] == [f"{number:04}" for number in range(len(records))]
    assert [name for name in records[1:] if name not in index] == []


def test_every_decision_that_a_docstring_names_exists() -> None:
    known = {int(path.name[:4]) for path in (ROOT / "docs/decisions").glob("0*.md")}
    wrong = [
        f"{path.relative_to(ROOT)}: {number}"
        for path in text_files()
        if path.suffix in (".py", ".esl") and "tests" not in path.parts
        for number in DECISION.findall(path.read_text(encoding="utf-8"))
        if int(number) not in known
    ]
    assert wrong == []


def test_every_fragment_is_named_and_written_as_the_rule_says() -> None:
    fragments = [path for path in (ROOT / "docs/changes").iterdir() if path.name != "README.md"]
    wrong = [
        path.name
        for path in fragments
        if not re.fullmatch(r"\d{3}[a-z]?\.(added|changed|fixed)\.md", path.name)
        or not path.read_text(encoding="utf-8").startswith("- ")
    ]
    assert wrong == []
