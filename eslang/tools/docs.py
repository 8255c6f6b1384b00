"""Signature and documentation of any name: `esl doc`, and the reference pages.

All of it comes from the registry, where each name stands once, with its
signature and its docstring.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from inspect import cleandoc
from typing import Any, NamedTuple

from eslang.base.suggest import nearest
from eslang.base.symbols import Keyword, Symbol
from eslang.compile.registry import Definition
from eslang.constructs.esl.documentation import documentation_text
from eslang.runtime.kinds import TABLE
from eslang.tools.names import find_symbol, known_names
from eslang.tools.options import COMMANDS, Chosen, Usage, help_text, overview

NOT_FOUND = 1


class Page(NamedTuple):
    """One generated page: its file, its title, what stands first, and the packages it tells of, if any."""

    file: str
    title: str
    opening: str
    packages: tuple[str, ...]


PAGES = (
    Page(
        "constructs.md",
        "The constructs",
        "What ESL adds to Common Lisp.\n"
        "This page is made from the docstrings; `esl doc NAME` prints one of them.",
        ("ESL", "SCS"),
    ),
    Page(
        "lisp-subset.md",
        "The Common Lisp that plans can use",
        "Each name means what the standard says.\n"
        "This page is made from the registry; `esl doc NAME` tells more.",
        ("COMMON-LISP",),
    ),
    Page(
        "cli.md",
        "The command",
        "This page is what `esl --help` and its like print.\n"
        "How to use the command: [run a plan](../how-to/run-a-plan.md), "
        "[trace a run](../how-to/trace-a-run.md), [talk at the prompt](../how-to/talk-at-the-prompt.md), "
        "[test a plan](../how-to/test-a-plan.md), [draw a plan](../how-to/draw-a-plan.md).",
        (),
    ),
    Page(
        "events.md",
        "What listeners hear",
        "A listener is a callable that gets every event of an interpreter: "
        "`Interpreter(listeners=[listener])`, or `agent.hooks.listeners.append(listener)`.\n"
        "An event has a `kind`; the `time` on the interpreter's clock; the `task` whose turn it is, or None; "
        "the `form`, a place in the source (`file`, `line`, `column`) or None; and its parts, in `data`.\n"
        "`esl run --trace FILE` writes the same, one JSON object a line, with the parts beside the others "
        "([how it looks](../how-to/trace-a-run.md#the-file)).\n"
        "This page is made from the table in `eslang/runtime/kinds.py`.",
        (),
    ),
)


def doc(chosen: Chosen) -> int:
    """Do what `esl doc` was asked for; the exit code."""
    from eslang.interpreter import Interpreter

    if not chosen.words:
        raise Usage("`esl doc` needs a name")
    code = 0
    with Interpreter() as interp:
        for position, name in enumerate(chosen.words):
            definition = definition_of(interp, name)
            if definition is None:
                sys.stderr.write(unknown_name(interp, name))
                code = NOT_FOUND
            else:
                sys.stdout.write("\n" * bool(position) + documentation_text(definition))
    return code


def definition_of(interp: Any, name: str) -> Definition | None:
    """What is registered of the name NAME."""
    symbol = find_symbol(interp, name)
    definition: Definition | None = interp.definition(symbol) if symbol is not None else None
    return definition


def unknown_name(interp: Any, name: str) -> str:
    """What to say of a NAME that means nothing."""
    near = nearest(name, [known.lower() for known, _ in known_names(interp)])
    return f"esl: nothing is called `{name}`" + (f"; the nearest is `{near}`" if near else "") + "\n"


def definitions(interp: Any, package: str) -> list[Definition]:
    """All that is registered of the external names of PACKAGE, in alphabetical order."""
    found = []
    interp.compiler("<names>")  # brings the special forms
    home = interp.image.packages[package]
    for name in sorted(home.external):
        symbol = home.present.get(name)
        if isinstance(symbol, Symbol) and not isinstance(symbol, Keyword) and symbol.package == package:
            definition = interp.definition(symbol)
            if definition is not None:
                found.append(definition)
    return found


def page_text(interp: Any, page: Page) -> str:
    """The text of PAGE, as it should stand in docs/reference."""
    lines = [f"# {page.title}", "", page.opening, ""]
    if page.file == "events.md":
        lines += event_lines()
    elif not page.packages:
        lines += command_lines()
    for package in page.packages:
        if package == "COMMON-LISP":
            lines += lisp_lines(definitions(interp, package))
        else:
            for definition in definitions(interp, package):
                lines += construct_lines(definition)
    return "\n".join(lines).rstrip() + "\n"


def command_lines() -> Iterator[str]:
    """The sections of the page about the command."""
    yield from ("```text", *overview().rstrip().split("\n"), "```", "")
    for command in COMMANDS.values():
        yield from (
            f"## esl {command.name}",
            "",
            "```text",
            *help_text(command).rstrip().split("\n"),
            "```",
            "",
        )


def event_lines() -> Iterator[str]:
    """The sections of the page about events."""
    for kind in TABLE:
        yield from (f"## {kind.name}", "", f"Told when {kind.when}.")
        yield f"Its form is {kind.form}." if kind.form != "none" else "It has no form."
        if kind.parts:
            yield from ("", "| part | type | what it is |", "|---|---|---|")
            for part in kind.parts:
                kept = part.type.replace("|", "\\|")
                yield f"| `{part.name}` | `{kept}` | {part.meaning} |"
        yield ""


def construct_lines(definition: Definition) -> Iterator[str]:
    """The section of the constructs page about DEFINITION."""
    yield f"## {definition.name.lower()}"
    yield ""
    yield f"`{definition.signature.lower()}` · {definition.kind}"
    yield ""
    for line in cleandoc(definition.doc()).split("\n"):
        yield f"    {line}".rstrip()
    yield ""


def lisp_lines(found: list[Definition]) -> Iterator[str]:
    """The tables of the Common Lisp page, by kind."""
    for kind in ("special form", "macro", "function", "variable", "constant"):
        chosen = [definition for definition in found if definition.kind == kind]
        if chosen:
            yield from (f"## {kind.capitalize()}s", "", "| name | what it does |", "|---|---|")
            for definition in chosen:
                first = cleandoc(definition.doc()).split("\n")[0].replace("|", "\\|")
                yield f"| `{definition.signature.lower()}` | {first} |".replace("`|", "`\\|")
            yield ""


def write_pages(folder: str) -> None:
    """Write the generated pages into FOLDER."""
    from pathlib import Path

    from eslang.interpreter import Interpreter

    with Interpreter() as interp:
        for page in PAGES:
            Path(folder, page.file).write_text(page_text(interp, page), encoding="utf-8")


if __name__ == "__main__":
    write_pages(sys.argv[1])
