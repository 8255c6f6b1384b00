"""Plan coverage: which forms and recovery clauses of the plans ran.

Compiled code carries the places of the forms it came from; while a Coverage is
entered, Python tells us each instruction that runs in a plan's code. A form ran
if an instruction of its own did.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

from eslang.tools.outline import Clause, Node, Place, clauses_of, outline

SHOWN = 60  # columns of a form in the report
LIBRARY = "stdlib"
TOOL = 4  # one of the numbers that Python leaves to tools without a name of their own


class Coverage:
    """What ran of the plans between entering and leaving, except of the files to LEAVE OUT."""

    def __init__(self, leave_out: Iterable[str] = ()) -> None:
        self.left_out = {str(Path(path).resolve()) for path in leave_out}
        self.ran: set[tuple[CodeType, int]] = set()
        self.codes: dict[str, set[CodeType]] = {}
        self.kinds: dict[CodeType, bool] = {}

    def __enter__(self) -> Coverage:
        if sys.version_info >= (3, 12):
            monitoring = sys.monitoring
            monitoring.use_tool_id(TOOL, "eslang")
            monitoring.register_callback(TOOL, monitoring.events.INSTRUCTION, self._on_place)
            monitoring.set_events(TOOL, monitoring.events.INSTRUCTION)
            monitoring.restart_events()
        else:
            self._before = sys.gettrace()
            sys.settrace(self._on_call)
        return self

    def __exit__(self, *_: object) -> None:
        if sys.version_info >= (3, 12):
            sys.monitoring.set_events(TOOL, 0)
            sys.monitoring.free_tool_id(TOOL)
        else:
            sys.settrace(self._before)

    def _on_place(self, code: CodeType, offset: int) -> Any:
        """An instruction is about to run: once is enough, so that what runs often costs nothing."""
        if self._watches(code):
            self.ran.add((code, offset))
        return sys.monitoring.DISABLE  # type: ignore[attr-defined,unused-ignore]  # from 3.12 on

    def _on_call(self, frame: FrameType, event: str, argument: Any) -> Any:
        if not self._watches(frame.f_code):
            return None
        frame.f_trace_opcodes, frame.f_trace_lines = True, False
        return self._on_instruction

    def _on_instruction(self, frame: FrameType, event: str, argument: Any) -> Any:
        if event == "opcode":
            self.ran.add((frame.f_code, frame.f_lasti))
        return self._on_instruction

    def _watches(self, code: CodeType) -> bool:
        if code not in self.kinds:
            self.kinds[code] = self._is_plan(code.co_filename)
            if self.kinds[code]:
                self.codes.setdefault(code.co_filename, set()).update(codes_in(code))
        return self.kinds[code]

    def _is_plan(self, name: str) -> bool:
        path = Path(name)
        return (
            path.suffix == ".esl" and LIBRARY not in path.parts and str(path.resolve()) not in self.left_out
        )

    def files(self) -> list[FileCoverage]:
        """What ran, file by file."""
        return [self.file(name) for name in sorted(self.codes) if Path(name).is_file()]

    def file(self, name: str) -> FileCoverage:
        """What ran of the file NAME."""
        known: set[Place] = set()
        ran: set[Place] = set()
        for code in self.codes.get(name, ()):
            for index, place in enumerate(places_of(code)):
                if place is not None:
                    known.add(place)
                    if (code, 2 * index) in self.ran:
                        ran.add(place)
        return FileCoverage(name, Path(name).read_text(encoding="utf-8"), known, ran)

    def report(self) -> str:
        """What did not run, for a person."""
        files = self.files()
        if not files:
            return "coverage: no plan was loaded (the test files themselves are left out)\n"
        return "".join(file.report() for file in files)


class FileCoverage:
    """What ran of one file: its forms that code was made of, and its recovery clauses."""

    def __init__(self, name: str, text: str, known: set[Place], ran: set[Place]) -> None:
        self.name = name
        self.known = known
        self.ran = ran
        self.clauses: list[Clause] = []
        self.idle_clauses: list[Clause] = []
        self.idle_functions: list[Node] = []
        self.idle_forms: list[Node] = []
        self.forms = 0
        self.forms_run = 0
        self.unlisted = 0  # clauses inside of what did not run
        for node in outline(text):
            self._count(node)
            if self._is_idle_function(node):
                self.idle_functions.append(node)
                self._count_clauses(node)
            else:
                self._look_at(node)

    def _count(self, top: Node) -> None:
        for node in top.all():
            if node.place in self.known:
                self.forms += 1
                self.forms_run += node.place in self.ran

    def _is_idle_function(self, node: Node) -> bool:
        """True if NODE defines a function of which no form ran."""
        inside = [part for part in node.all() if part is not node and part.place in self.known]
        return (
            node.operator == "defun" and bool(inside) and not any(part.place in self.ran for part in inside)
        )

    def _count_clauses(self, idle: Node) -> None:
        found = [clause for node in idle.all() for clause in clauses_of(node)]
        self.clauses += found
        self.unlisted += len(found)

    def _look_at(self, node: Node) -> None:
        """Note what of NODE did not run; of a form that did not, only the form itself."""
        if node.place in self.known and node.place not in self.ran and not self._ran_inside(node):
            self.idle_forms.append(node)
            self._count_clauses(node)
            return
        skipped: list[Node] = []
        for clause in clauses_of(node):
            self.clauses.append(clause)
            if clause.body and not any(self._ran_inside(part) for part in clause.body):
                self.idle_clauses.append(clause)
                skipped.append(clause.node)
        for part in self._parts(node):
            if part not in skipped:
                self._look_at(part)

    def _parts(self, node: Node) -> Iterator[Node]:
        """The lists inside NODE; those of a list of clauses one by one."""
        for part in node.lists():
            if clauses_of(node) and part is node.parts[1] and not part.operator:
                yield from part.lists()
            else:
                yield part

    def _ran_inside(self, node: Node) -> bool:
        return any(part.place in self.ran for part in node.all())

    def report(self) -> str:
        """What did not run of the file."""
        share = 100 * self.forms_run // self.forms if self.forms else 100
        text = f"{self.name}: {self.forms_run} of {self.forms} forms ran ({share} %)"
        if self.clauses:
            invoked = len(self.clauses) - len(self.idle_clauses) - self.unlisted
            text += f", {invoked} of {len(self.clauses)} recovery clauses were invoked"
        lines = [text]
        for node in self.idle_functions:
            lines.append(f"  {self.place(node)}: `{node.parts[1]}` was never called")
        for clause in self.idle_clauses:
            lines.append(f"  {self.place(clause.node)}: the clause for `{clause.cause}` was never invoked")
        for node in self.idle_forms:
            lines.append(f"  {self.place(node)}: `{shortened(node.text)}` did not run")
        return "\n".join(lines) + "\n"

    def place(self, node: Node) -> str:
        """Where NODE stands, as a diagnostic says it."""
        return f"{self.name}:{node.place[0]}:{node.place[1] + 1}"


def codes_in(code: CodeType) -> Iterator[CodeType]:
    """CODE and the code of all functions defined inside it."""
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from codes_in(constant)


def places_of(code: CodeType) -> Iterator[Place | None]:
    """The place of each instruction of CODE, in order."""
    for line, end_line, column, end_column in code.co_positions():
        if line is None or end_line is None or column is None or end_column is None:
            yield None
        else:
            yield line, column, end_line, end_column


def shortened(text: str) -> str:
    """TEXT on one line, cut where it is long."""
    line = " ".join(text.split())
    return line if len(line) <= SHOWN else line[: SHOWN - 4] + " ..."
