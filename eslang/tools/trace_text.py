"""A trace as text: the tree of its tasks, and a timeline with a lane for each task.

Lines fit the terminal, 80 columns if there is none. Of long runs only the
beginning, the end and what went wrong between them is told, unless all is
asked for.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import PurePath
from textwrap import wrap

from eslang.tools.trace_lives import Life, Lives, counts, now_doing, word
from eslang.tools.trace_reading import Record, Trace
from eslang.tools.trace_words import concerns, failure_words, sentence, subject

ENDS = 80  # lines at the beginning and at the end of a long timeline
TROUBLE = ("failure", "failure-passed", "deadlock", "aborted", "run-stopped", "period-missed")
TROUBLES = 40  # of them between beginning and end
SIBLINGS = 12  # tasks of one parent that are listed
LANES = 12
LINES = 3  # that one event may take
MARKS = {":SUCCEEDED": "✓", ":FAILED": "✗", ":ABORTED": "⊘", None: "…"}
SIGNS = {
    "task-started": "●",
    "wait": "○",
    "resume": "●",
    "recovery": "↻",
    "failure": "!",
    "failure-passed": "!",
    "failure-taken": "↻",
    "interrupt": "↯",
    "abort": "⊘",
    "signal": "▸",
    "checkpoint": "▸",
    "action": "»",
    "deactivated": "«",
    "goal-changed": "◦",
    "fact": "+",
    "lock": "▪",
    "resource": "▪",
    "deadlock": "!",
}
WAITING, WORKING = "┊", "│"


class Choice:
    """Which of the events are to be told."""

    def __init__(
        self,
        tasks: list[str],
        kinds: list[str],
        first: float | None = None,
        last: float | None = None,
        *,
        everything: bool = False,
    ) -> None:
        self.tasks = tasks
        self.kinds = kinds
        self.first = first
        self.last = last
        self.everything = everything

    def takes(self, record: Record) -> bool:
        """True if RECORD is to be told."""
        return (
            (not self.kinds or record.kind in self.kinds)
            and (not self.tasks or any(concerns(record, name) for name in self.tasks))
            and (self.first is None or record.time >= self.first)
            and (self.last is None or record.time <= self.last)
        )


def trace_text(trace: Trace, choice: Choice, columns: int = 80) -> Iterator[str]:
    """The lines that tell TRACE."""
    lives = Lives(trace)
    yield from summary(trace, lives)
    if not choice.kinds and choice.first is None and choice.last is None:
        yield from ("", "Tasks")
        yield from tree_lines(lives, choice, columns)
    yield from ("", "Timeline")
    yield from timeline(trace, lives, choice, columns)


def summary(trace: Trace, lives: Lives) -> Iterator[str]:
    """What kind of run it was, in a line or two."""
    header, found = trace.header, counts(lives)
    plans = ", ".join(map(str, header.get("plans") or [])) or trace.name
    ended = ", ".join(f"{number} {status}" for status, number in sorted(found.items()))
    clock = header.get("clock", "real")
    yield f"{plans}: {trace.last:.3f} s on the {clock} clock, seed {header.get('seed', 0)}"
    yield f"{len(trace.records)} events, {len(lives.lives)} tasks" + (f": {ended}" if ended else "")
    yield from (f"But {remark}." for remark in trace.remarks)


# --- the tree ------------------------------------------------------------------------


def tree_lines(lives: Lives, choice: Choice, columns: int) -> Iterator[str]:
    """The tasks, each below its parent."""
    rows = list(tree_rows(lives, choice))
    width = min(max([len(stem) for stem, _ in rows], default=0), columns // 2)
    for stem, life in rows:
        if life is None:
            yield cut(f"  {stem}", columns)
        else:
            yield cut(f"  {stem:<{width}}  {life_words(lives, life)}", columns)
            yield from place_line(life, columns)


def tree_rows(lives: Lives, choice: Choice) -> Iterator[tuple[str, Life | None]]:
    """Each task with its name behind the branches that lead to it; None with what stands for several."""
    pending: list[tuple[str, str, Life | str]] = [
        ("", "", each) for each in reversed(abridged(lives.roots, choice))
    ]
    while pending:
        branch, below, life = pending.pop()
        if isinstance(life, str):
            yield branch + life, None
            continue
        yield branch + life.name, life
        children = abridged(life.children, choice)
        for index in range(len(children) - 1, -1, -1):
            last = index == len(children) - 1
            pending.append(
                (below + ("└ " if last else "├ "), below + ("  " if last else "│ "), children[index])
            )


def abridged(siblings: list[Life], choice: Choice) -> list[Life | str]:
    """SIBLINGS, of many only the first, the last, and some that failed; a remark stands for the others."""
    if choice.tasks:
        siblings = [life for life in siblings if wanted(life, choice)]
    if choice.everything or len(siblings) <= SIBLINGS:
        return list(siblings)
    failed = [life for life in siblings[5:-2] if life.status == ":FAILED"][:5]
    kept = {life.name for life in (*siblings[:5], *failed, *siblings[-2:])}
    shown: list[Life | str] = [life for life in siblings if life.name in kept]
    left: dict[str, int] = {}
    for life in siblings:
        if life.name not in kept:
            left[word(life.status)] = left.get(word(life.status), 0) + 1
    total = sum(left.values())
    shown.insert(-2, f"… {total} more: " + ", ".join(f"{n} {status}" for status, n in sorted(left.items())))
    return shown


def wanted(life: Life, choice: Choice) -> bool:
    """True if LIFE, or a task below it, is one of those chosen."""
    pending = [life]
    while pending:
        one = pending.pop()
        if one.name in choice.tasks:
            return True
        pending += one.children
    return False


def life_words(lives: Lives, life: Life) -> str:
    """When a task lived, and how it ended."""
    records = lives.trace.records
    begun = records[life.started].time
    until = records[life.ended].time if life.ended is not None else lives.trace.last
    return f"{clock(begun)} –{clock(until)}  {MARKS.get(life.status, '?')} {fate(lives, life)}"


def fate(lives: Lives, life: Life) -> str:
    """How a task ended, or what it was doing."""
    if life.failure is not None:
        return failure_words(life.failure)
    if life.status is None:
        return now_doing(lives, life)
    if life.status == ":ABORTED" and life.aborted is not None:
        return sentence(lives.trace.records[life.aborted]).removeprefix("is ")
    return word(life.status) if life.status != ":SUCCEEDED" else "succeeded" if life.role == "main" else ""


def place_line(life: Life, columns: int) -> Iterator[str]:
    """Where a task failed, on a line of its own."""
    if life.status == ":FAILED" and life.place is not None:
        origin = (life.failure or {}).get("from")
        words = f"at {life.place}" + (f", as {origin} failed" if origin else "")
        yield cut(f"{words:>{max(columns - 2, len(words))}}", columns)


# --- the timeline --------------------------------------------------------------------


def timeline(trace: Trace, lives: Lives, choice: Choice, columns: int) -> Iterator[str]:
    """One line for each event, unless there are too many."""
    chosen = [record for record in trace.records if choice.takes(record)]
    if not chosen:
        yield "  (no such event)"
        return
    shown = chosen if choice.everything else abbreviated(chosen)
    lanes = Lanes(lives, shown)
    names = [subject(record) or "" for record in shown]
    width = min(max(map(len, names)), columns // 5 + 2)
    before = -1.0
    position = 0
    for record in shown:
        if chosen[position] is not record:
            left_out = position
            while chosen[position] is not record:
                position += 1
            yield f"  … {position - left_out} events left out; --all, --task, --kind, --from, --to choose"
        position += 1
        moment = clock(record.time) if record.time != before else " " * 9
        before = record.time
        head = f"{moment}  {lanes.drawn(record)}{cut(subject(record) or '', width):<{width}}  "
        first, *others = told(record, columns - len(head))
        yield head + first
        for line in others:
            yield f"{'':11}{lanes.between()}{'':{width}}  {line}"


def told(record: Record, width: int) -> list[str]:
    """What RECORD says, and at the right end where, in lines of WIDTH."""
    place = cut(short_place(record.form), width)
    lines = wrap(sentence(record), width)[:LINES] or [""]
    if place and len(lines[-1]) + 1 + len(place) > width:
        words, _, last = lines[-1].rpartition(" ")
        fits = bool(words) and len(last) + 1 + len(place) <= width
        lines[-1:] = [words, last] if fits else [lines[-1], ""]
    lines[-1] += f"{place:>{width - len(lines[-1])}}"
    return lines


def abbreviated(records: list[Record]) -> list[Record]:
    """RECORDS; of many the first, the last, and what went wrong between."""
    if len(records) <= 3 * ENDS:
        return records
    wrong = [record for record in records[ENDS:-ENDS] if record.kind in TROUBLE]
    return [*records[:ENDS], *wrong[:TROUBLES], *records[-ENDS:]]


class Lanes:
    """The columns that show which tasks are alive, and which of them wait."""

    def __init__(self, lives: Lives, shown: list[Record]) -> None:
        self.records = lives.trace.records
        self.lives = lives.lives
        self.position = 0  # the record that is the next to be followed
        self.columns: list[str | None] = []
        self.state: dict[str, str] = {}
        self.stood: dict[str, str] = {}  # the state in which a task was interrupted
        self.widest = self._widest()

    def _widest(self) -> int:
        alive = widest = 0
        for record in self.records:
            alive += (record.kind == "task-started") - (record.kind == "task-ended")
            widest = max(widest, alive)
        return min(widest, LANES)

    def drawn(self, record: Record) -> str:
        """The lanes at RECORD, all that came before followed."""
        while self.position <= record.number:
            self._follow(self.records[self.position], record)
            self.position += 1
        sign, about = SIGNS.get(record.kind, "•"), subject(record)
        if record.kind == "task-ended":
            sign = MARKS.get(record.told["status"], "?")
        elif record.kind == "fact" and not record.told["added"]:
            sign = "−"
        cells = [sign if name == about else self._cell(name) for name in self.columns[: self.widest]]
        if record.kind == "task-ended" and about in self.columns:
            self.columns[self.columns.index(about)] = None
        return self._joined(cells)

    def between(self) -> str:
        """The lanes on a line where nothing happens."""
        return self._joined([self._cell(name) for name in self.columns[: self.widest]])

    def _joined(self, cells: list[str]) -> str:
        return "".join(cells).ljust(self.widest) + ("  " if self.widest else "")

    def _cell(self, name: str | None) -> str:
        return " " if name is None else self.state.get(name, WORKING)

    def _follow(self, record: Record, drawn: Record) -> None:
        """Keep up with RECORD; a task whose end is the one that is DRAWN has its lane until then."""
        name = subject(record)
        if record.kind == "task-started" and name is not None:
            self._open(name)
        elif record.kind == "wait" and name is not None:
            self.state[name] = WAITING
        elif record.kind in ("resume", "interrupt") and name is not None:
            if record.kind == "interrupt":
                self.stood[name] = self.state.get(name, WORKING)
            self.state[name] = WORKING
        elif record.kind == "interrupt-ended" and name is not None:
            self.state[name] = self.stood.get(name, WORKING)
        elif record.kind == "task-ended" and record is not drawn and name in self.columns:
            self.columns[self.columns.index(name)] = None

    def _open(self, name: str) -> None:
        """Give the task NAME the first column that is free."""
        for index, other in enumerate(self.columns):
            if other is None:
                self.columns[index] = name
                return
        self.columns.append(name)


def clock(moment: float) -> str:
    """A moment in nine columns."""
    return f"{moment:9.3f}" if moment < 99999 else f"{moment:9.0f}"


def short_place(form: str | None) -> str:
    """A place without the folders of its file."""
    return PurePath(form).name if form else ""


def cut(text: str, width: int) -> str:
    """TEXT on one line, no wider than WIDTH."""
    text = " ".join(text.split("\n"))
    return text if len(text) <= width else text[: max(width - 1, 0)] + "…"
