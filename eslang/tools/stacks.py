"""The Lisp stack of a failure, for people.

A failure that came from another task has a stack in each of the tasks that it
went through. The body of a construct is a function without a name: it is
called as the construct is, where the text can be read.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from eslang.base.failure import Failure
from eslang.runtime.story import Frame, Place
from eslang.tools.names import find_symbol
from eslang.tools.tokens import incomplete_word

SHOWN_FRAMES = 10  # of a deeper stack, as many at both ends together
NAMELESS = "lambda"


def passed_on(failure: Failure) -> list[Failure]:
    """FAILURE in each of the tasks that it went through: as it was raised, then as it was passed on."""
    found = [failure]
    while (origin := found[-1].origin) is not None and origin.failure not in (None, *found):
        found.append(origin.failure)
    return found[::-1]


def stack_lines(failure: Failure, interp: Any = None) -> list[str]:
    """The stack of FAILURE, innermost first: that of the task that failed first, then of its owner, …"""
    stages = passed_on(failure)
    tasks = [*[each.origin.name for each in stages[1:]], ""]
    stacks = [each.story.stack if each.story is not None else () for each in stages]
    called = [stack_names(stack, task, interp) for stack, task in zip(stacks, tasks, strict=True)]
    width = max([len(name) for names in called for name, _ in names], default=0)
    return [
        line
        for names in called
        for line in shortened([f"in {name:<{width}}  {place}".rstrip() for name, place in names])
    ]


def stack_names(stack: Sequence[Frame], task: str, interp: Any) -> list[tuple[str, str]]:
    """What stands on STACK, and where; the outermost is the body of TASK, where it is a task's."""
    called = []
    for index, frame in enumerate(stack):
        name = frame.name.lower()
        if name == NAMELESS and index + 1 < len(stack):
            name = construct_at(stack[index + 1].place, interp) or name
        called.append((name, str(frame.place)))
    if task:
        place = called.pop()[1] if called and called[-1][0] == NAMELESS else ""
        called.append((f"task {task}", place))
    return called


def construct_at(place: Place, interp: Any) -> str | None:
    """The macro whose form stands at PLACE, in a file that can be read; else None."""
    if interp is None:
        return None
    try:
        with open(place.file, encoding="utf-8", errors="replace") as stream:
            line = next((line for number, line in enumerate(stream, 1) if number == place.line), "")
    except OSError:
        return None
    words = line[place.column :].split(None, 1)
    word = incomplete_word(words[0]) if line[place.column - 1 : place.column] == "(" and words else ""
    symbol = find_symbol(interp, word) if word else None
    return word.lower() if symbol is not None and interp.image.cell(symbol).macro is not None else None


def shortened(lines: list[str]) -> list[str]:
    """LINES, of many both ends."""
    left_out = len(lines) - SHOWN_FRAMES
    if left_out > 1:
        half = SHOWN_FRAMES // 2
        lines[half:-half] = [f"... {left_out} more ..."]
    return lines
