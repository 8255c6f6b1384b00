"""Where something happened, for people: places and the Lisp stack.

Compiled functions are ordinary Python code with Lisp lines, so the stack is
read from Python's frames; frames of ours that no plan wrote are left out.
"""

from __future__ import annotations

import sys
from itertools import islice
from types import CodeType, FrameType, TracebackType

from eslang.base.hints import NamedTuple
from eslang.base.symbols import Value

DEEPEST = 50  # frames that a story tells
FAR = 500  # frames that a failure has passed
KEPT = 10_000  # places that were looked up


class Place(NamedTuple):
    """A place in a source: what file:line:column names, both ends."""

    file: str
    line: int
    column: int
    end_line: int
    end_column: int

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}"


def as_place(noted: Value) -> Place | None:
    """The place that the compiler noted as a list (file line column end-line end-column)."""
    if noted is None:
        return None
    file, *numbers = noted
    return Place(file.text, *numbers)


class Frame(NamedTuple):
    """One function on the Lisp stack, and where in it the plan stood."""

    name: str
    place: Place


class Asked(NamedTuple):
    """A recovery procedure that was active: whether it takes the cause, and what it had left."""

    cause: Value
    place: Place | None
    takes: bool
    used: int
    left: int | None  # None: :infinite


class Story(NamedTuple):
    """What is known of a failure: who was asked, and the stack, innermost first."""

    asked: tuple[Asked, ...]
    stack: tuple[Frame, ...]

    @property
    def place(self) -> Place | None:
        """Where it was raised."""
        return self.stack[0].place if self.stack else None


_PLACES: dict[tuple[int, int], tuple[CodeType, Place | None]] = {}  # with the code, which so keeps its id


def is_lisp(frame: FrameType) -> bool:
    """True if FRAME runs code compiled from Lisp text that a person wrote."""
    return "%many" in frame.f_globals and not frame.f_code.co_filename.startswith("<stdlib>")


def place_of(code: CodeType, instruction: int) -> Place | None:
    """The place of one instruction of CODE; those found before are kept."""
    key = id(code), instruction
    known = _PLACES.get(key)
    if known is None:
        if len(_PLACES) >= KEPT:
            _PLACES.clear()
        known = _PLACES[key] = code, look_up_place(code, instruction)
    return known[1]


def look_up_place(code: CodeType, instruction: int) -> Place | None:
    """The place of one instruction of CODE, from its table of positions."""
    found = next(islice(code.co_positions(), instruction // 2, None), None)
    if found is None or found[0] is None:
        return None
    line, end_line, column, end_column = found
    return Place(code.co_filename, line or 0, (column or 0) + 1, end_line or 0, (end_column or 0) + 1)


def capture_stack(error: BaseException | None = None) -> tuple[Frame, ...]:
    """The Lisp stack: the frames ERROR has come through already, then those still running."""
    found: list[Frame] = []
    trace: TracebackType | None = error.__traceback__ if error is not None else None
    passed: list[tuple[FrameType, int]] = []
    while trace is not None:
        passed.append((trace.tb_frame, trace.tb_lasti))
        trace = trace.tb_next
    for frame, instruction in reversed(passed[-DEEPEST:]):
        _note(found, frame, instruction)
    outermost = passed[0][0] if passed else None
    running: FrameType | None = sys._getframe(1)
    seen = {id(outermost)} if outermost is not None else set()
    while running is not None and len(found) < DEEPEST:
        if id(running) not in seen:
            _note(found, running, running.f_lasti)
        running = running.f_back
    return tuple(found)


def nearest_place(frame: FrameType | None) -> Place | None:
    """The place where the innermost plan that FRAME is within stands."""
    while frame is not None:
        if is_lisp(frame):
            place = place_of(frame.f_code, frame.f_lasti)
            if place is not None:
                return place
        frame = frame.f_back
    return None


def place_here() -> Place | None:
    """The place where the running plan stands."""
    return nearest_place(sys._getframe(1))


def place_raised(error: BaseException) -> Place | None:
    """The innermost place that ERROR has passed; if none yet, where the running plan stands."""
    innermost: TracebackType | None = None
    trace: TracebackType | None = error.__traceback__
    while trace is not None:
        if is_lisp(trace.tb_frame):
            innermost = trace
        trace = trace.tb_next
    place = None if innermost is None else place_of(innermost.tb_frame.f_code, innermost.tb_lasti)
    return place or place_here()


def has_come_far(error: BaseException) -> bool:
    """True if ERROR has passed so many frames that to look at them at each border would take too long."""
    trace: TracebackType | None = error.__traceback__
    for _ in range(FAR):
        if trace is None:
            return False
        trace = trace.tb_next
    return True


def _note(found: list[Frame], frame: FrameType, instruction: int) -> None:
    if is_lisp(frame):
        place = place_of(frame.f_code, instruction)
        if place is not None:
            found.append(Frame(frame.f_code.co_name, place))
