"""`esl check`: what can be known of plans without running them.

The judgement is the analyser's (compile/check.py); this file finds the files,
prints the diagnostics and counts them.
"""

from __future__ import annotations

import sys

from eslang.base.render import render
from eslang.tools.opening import bytes_of, readable
from eslang.tools.options import Chosen, Usage

WRONG = 65


def check(chosen: Chosen) -> int:
    """Do what `esl check` was asked for; 65 if some plan is wrong, warnings alone are no reason."""
    from eslang.interpreter import Interpreter

    if not chosen.words:
        raise Usage("`esl check` needs a file")
    errors = warnings = 0
    for path in chosen.words:
        readable(path)
    with Interpreter(clock="virtual") as interp, interp.at_work():
        for diagnostic in interp.texts.analyse(chosen.words, bytes_of).finish():
            errors += diagnostic.severity == "error"
            warnings += diagnostic.severity != "error"
            sys.stderr.write(render(diagnostic) + "\n")
    if errors or warnings:
        sys.stderr.write(f"{counted(errors, 'error')}, {counted(warnings, 'warning')}\n")
    return WRONG if errors else 0


def counted(number: int, word: str) -> str:
    """NUMBER things called WORD."""
    return f"{number} {word}" + ("" if number == 1 else "s")
