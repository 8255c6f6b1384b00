"""`esl run`: load plans, call MAIN, and say by the exit code how it went.

Imports as little as it can: the time from the command to the first form of a
plan is a promise.
"""

from __future__ import annotations

import sys

from eslang.base.control import Stop
from eslang.base.diagnostics import EslError
from eslang.base.failure import Failure
from eslang.base.hints import Any, Callable
from eslang.tools.endings import QUIT, to_the_end
from eslang.tools.interrupts import Interrupts, Turns
from eslang.tools.narrator import narrate
from eslang.tools.opening import Opened, OutputClosed, begin_world, limit_of, readable
from eslang.tools.options import Chosen, Usage

FAILED, WRONG = 1, 65


def run(chosen: Chosen) -> int:
    """Do what `esl run` was asked for; the exit code."""
    if not chosen.words and not chosen.has("e"):
        raise Usage("`esl run` needs a file, or -e FORM")
    for path in chosen.words:
        readable(path)
    limit = limit_of(chosen)
    opened = Opened(chosen, None if chosen.has("quiet") else narrate)
    with opened as interp:
        with Interrupts(interp, limit) as interrupts, Turns(interp):
            code = outcome(interp, lambda: opened.shown(lambda: whole(interp, chosen)))
        return code if interrupts.code is None else interrupts.code


def whole(interp: Any, chosen: Chosen) -> None:
    """The plan, and then what it has spawned, to the end."""
    to_the_end(interp, lambda: plan(interp, chosen))


def plan(interp: Any, chosen: Chosen) -> None:
    """Let the world begin, load the files, then evaluate the forms of -e, or else call MAIN."""
    begin_world(interp, chosen)
    main = None
    for path in chosen.words:
        main = main_function(interp, load(interp, path)) or main
    for text in chosen.all("e"):
        evaluate_text(interp, text)
    if main is not None and not chosen.has("e"):
        interp.call(main)


def load(interp: Any, path: str) -> Any:
    """Load the file PATH, `-` for standard input; the package that was current at its end."""
    if path != "-":
        return interp.load(path)
    from eslang.tools.conversation import source_of

    for reading in interp.readings(source_of(sys.stdin.read(), "<stdin>")):
        interp.evaluate(reading)
    return interp.image.package


def evaluate_text(interp: Any, text: str) -> None:
    """Evaluate the forms of TEXT and print their values, one a line."""
    from eslang.lisp.output import shown
    from eslang.tools.conversation import source_of

    for reading in interp.readings(source_of(text, "-e")):
        for value in interp.evaluate(reading):
            interp.output.fresh_line()
            with interp.at_work():
                interp.output.write(shown(value) + "\n")


def main_function(interp: Any, package: Any) -> Any:
    """The name MAIN in PACKAGE, where a file ended, if it names a function; else None."""
    symbol, found = package.find("MAIN")
    return symbol if found and hasattr(interp.image.cell(symbol), "function") else None


def outcome(interp: Any, work: Callable[[], None]) -> int:
    """Do WORK; the exit code that tells how it went, after a report on standard error."""
    try:
        work()
        code = 0
    except Failure as failure:
        from eslang.tools.report import failure_report, wants_colour

        code = complain(interp, failure_report(failure, interp, wants_colour(sys.stderr)), FAILED)
    except EslError as error:
        from eslang.base.render import render
        from eslang.tools.report import wants_colour

        code = complain(interp, render(error.diagnostic, wants_colour(sys.stderr)), WRONG)
    except OutputClosed:
        return 0
    except Stop as stop:
        code = stop.code if stop.reason == QUIT else complain(interp, f"esl: {stop.reason}", stop.code)
    finish_output(interp)
    return code


def finish_output(interp: Any) -> None:
    """Let all that was printed arrive, its last line ended."""
    interp.output.fresh_line()
    interp.output.flush()


def complain(interp: Any, text: str, code: int) -> int:
    """Write TEXT to standard error, behind all that was printed; CODE."""
    finish_output(interp)
    sys.stderr.write(text.rstrip("\n") + "\n")
    return code
