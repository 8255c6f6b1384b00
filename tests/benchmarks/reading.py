"""Reading: text to forms, beside Lark alone with the same grammar.

Lark gets a transformer that it calls while it parses, and which makes the same
lists and atoms; it notes no places and tells no mistakes. That is how the
grammar would be read if the reader were Lark's own parser.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from eslang import Interpreter
from eslang.base.lists import Cons, from_items
from eslang.base.resolve import resolve_in
from eslang.base.spans import Source
from eslang.prelude import stdlib_files
from eslang.reader.atoms import read_character, read_radix, read_string, read_token, read_uninterned
from eslang.reader.building import LOGICAL_BINDING, PREFIXES
from eslang.reader.reader import read_forms
from eslang.reader.tables import GRAMMAR
from tests.benchmarks.measure import Peer, Work


def works() -> Iterator[Work]:
    """The one work of this file: the library's own text, as often as makes half a megabyte."""
    agent = Interpreter()
    text = "".join(Path(path).read_text(encoding="utf-8") for path in stdlib_files())
    text = "".join(line for line in text.splitlines(keepends=True) if "#|" not in line)
    text *= max(1, 500_000 // len(text))
    resolve = resolve_in(agent.image)

    def ours() -> int:
        return sum(1 for _ in read_forms(Source("<benchmark>", text), resolve))

    lark = lark_parser(resolve)
    yield Work(
        f"reading {len(text) / 1e6:.1f} MB of text",
        ours,
        [Peer("Lark with an inlined transformer", lambda: len(lark.parse(text)), 1.3)],
    )


def lark_parser(resolve: Any) -> Any:
    """Lark's own parser for the grammar of ESL, for many forms."""
    from lark import Lark

    grammar = GRAMMAR.read_text(encoding="utf-8").replace("start: form\n", "start: form*\n")
    return Lark(grammar, parser="lalr", lexer="basic", transformer=transformer(resolve))


def transformer(resolve: Any) -> Any:
    """What makes lists and atoms while Lark parses: one function for each alias and terminal."""
    from lark import Transformer

    known: dict[str, Any] = {}

    def atom(token: str) -> Any:
        if token not in known:
            known[token] = read_token(str(token), resolve)
        return known[token]

    def more(parts: Any) -> Any:
        parts[0].append(parts[1])
        return parts[0]

    functions: dict[str, Callable[[Any], Any]] = {
        "ATOM": atom,
        "STRING": lambda token: read_string(str(token)),
        "CHARACTER": lambda token: read_character(str(token)),
        "RADIX": lambda token: read_radix(str(token)),
        "UNINTERNED": lambda token: read_uninterned(str(token)),
        "start": lambda parts: parts,
        "form": lambda parts: parts[0],
        "list": lambda parts: parts[0],
        "first": lambda parts: [parts[1]],
        "next": more,
        "empty": lambda parts: None,
        "proper": lambda parts: from_items(parts[0]),
        "dotted": lambda parts: from_items(parts[0], parts[2]),
        "quoted": lambda parts: Cons(PREFIXES[parts[0]], Cons(parts[1], None)),
        "logical": lambda parts: Cons(LOGICAL_BINDING, Cons(parts[0], None)),
    }
    made = {name: staticmethod(function) for name, function in functions.items()}
    return type("Forms", (Transformer,), made)()
