"""A trace as one page for a browser, which needs nothing else: tasks as lanes over time.

The page's text, look and behaviour stand in the folder `page`; here is what it
is filled with. The events go in as columns, since there may be very many.
"""

from __future__ import annotations

import json
from html import escape
from pathlib import Path
from typing import Any

from eslang.tools.trace_lives import Life, Lives, counts, word
from eslang.tools.trace_reading import Trace
from eslang.tools.trace_words import failure_words, sentence, subject

FOLDER = Path(__file__).with_name("page")
STATES = ("run", "wait", "sleep", "recover", "cleanup", "interrupt")  # as drawing.js has them
ARROWS = ("start", "signal", "abort", "interrupt", "failure", "join")  # as drawing.js has them
ROWS = 500  # tasks in the table for browsers that run no scripts


class Strings:
    """Texts by number, each once."""

    def __init__(self) -> None:
        self.texts: dict[str, int] = {}

    def number(self, text: str | None) -> int:
        """The number of TEXT; -1 for none."""
        return -1 if text is None else self.texts.setdefault(text, len(self.texts))


def page(trace: Trace) -> str:
    """TRACE as a page."""
    lives = Lives(trace)
    parts = {
        "style": read("page.css"),
        "script": read("drawing.js") + "\n" + read("asking.js"),
        "title": escape(title_of(trace)),
        "about": escape(about(trace, lives)),
        "counts": "".join(
            f'<span class="count {status}"><b>{number}</b> {status}</span>'
            for status, number in sorted(counts(lives).items(), reverse=True)
        ),
        "remarks": "".join(f'<p class="remark">{escape(remark)}</p>\n' for remark in trace.remarks),
        "table": table(lives),
        "run": json.dumps(columns(trace, lives), ensure_ascii=False, separators=(",", ":")).replace(
            "<", "\\u003c"
        ),
    }
    text = read("page.html")
    pieces = text.split("{{")
    filled = [pieces[0]]
    for piece in pieces[1:]:
        name, _, rest = piece.partition("}}")
        filled += [parts[name], rest]
    return "".join(filled)


def read(name: str) -> str:
    """The text of one file of the page."""
    return (FOLDER / name).read_text(encoding="utf-8").rstrip("\n")


def title_of(trace: Trace) -> str:
    """What the run was of."""
    return ", ".join(map(str, trace.header.get("plans") or [])) or trace.name


def about(trace: Trace, lives: Lives) -> str:
    """The run in one line."""
    header = trace.header
    return (
        f"{trace.last:.3f} s on the {header.get('clock', 'real')} clock · seed {header.get('seed', 0)} · "
        f"{len(trace.records):,} events · {len(lives.lives):,} tasks"
    )


def table(lives: Lives) -> str:
    """The tasks as a table."""
    rows = [
        f"<tr><td>{escape('· ' * depth + life.name)}</td><td>{word(life.status)}</td>"
        f"<td>{escape(failure_words(life.failure) if life.failure else '')}</td></tr>"
        for life, depth in list(lives.in_tree_order())[:ROWS]
    ]
    return "<table><tr><th>task</th><th>status</th><th>failure</th></tr>" + "".join(rows) + "</table>"


def columns(trace: Trace, lives: Lives) -> dict[str, Any]:
    """What the page's script shows."""
    strings, kinds = Strings(), Strings()
    order = list(lives.in_tree_order())
    number = {life.name: position for position, (life, _) in enumerate(order)}
    records = trace.records
    spans = [
        (number[life.name], STATES.index(span.state), span.first, span.last, span.cause)
        for life, _ in order
        for span in life.spans
    ]
    arrows = [
        (ARROWS.index(arrow.kind), number[arrow.source], arrow.first, number[arrow.target], arrow.last)
        for arrow in sorted(lives.arrows, key=lambda arrow: arrow.last)
    ]
    return {
        "times": [*[record.time for record in records], trace.last],
        "fine": 0 < trace.last < 1,
        "subject": [number.get(subject(record) or "", -1) for record in records],
        "kind": [kinds.number(record.kind) for record in records],
        "text": [strings.number(sentence(record)) for record in records],
        "place": [strings.number(record.form) for record in records],
        "tasks": [task(lives, life, depth, number) for life, depth in order],
        "spans": spans,
        "arrows": arrows,
        "kinds": list(kinds.texts),
        "strings": list(strings.texts),
    }


def task(lives: Lives, life: Life, depth: int, number: dict[str, int]) -> dict[str, Any]:
    """What the page shows of one task."""
    records = lives.trace.records
    return {
        "name": life.name,
        "depth": depth,
        "parent": number.get(life.parent or "", -1),
        "role": life.role + (", daemon" if life.daemon else ""),
        "status": word(life.status),
        "started": life.started,
        "ended": len(records) if life.ended is None else life.ended,
        "failure": failure_words(life.failure) if life.failure else None,
        "why": sentence(records[life.aborted]) if life.aborted is not None else None,
        "place": life.place if life.failure else None,
        "children": len(life.children),
    }
