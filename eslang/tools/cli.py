"""The command `esl`: find the command meant, run it, exit with its code.

Python's own words never reach a person from here, except for a bug of ours.
Each command lives in a file of its own and is imported when it is asked for.
"""

from __future__ import annotations

import gc
import os
import sys

from eslang.tools.options import COMMANDS, Chosen, Usage, choose, help_text, overview

FAILED, USAGE, BUG, INTERRUPTED = 1, 2, 70, 130


def main(arguments: list[str] | None = None) -> int:
    """Run the command line ARGUMENTS; the exit code. Without them, run that of the process, and end it."""
    prepare_streams()
    if arguments is None:
        gc.disable()  # nothing of what starting makes is garbage; `Opened` enables it again
    code = guarded(sys.argv[1:] if arguments is None else arguments)
    try:
        sys.stdout.flush()
    except OSError as trouble:
        code = output_refused(trouble)
    if arguments is None and sys.gettrace() is None:
        end(code)
    return code


def guarded(arguments: list[str]) -> int:
    """Run the command line ARGUMENTS; whatever happens, the exit code."""
    try:
        return dispatch(arguments)
    except Usage as mistake:
        sys.stderr.write(f"esl: {mistake}\nTry `esl --help`.\n")
        return USAGE
    except BrokenPipeError as trouble:
        return output_refused(trouble)
    except KeyboardInterrupt:
        return INTERRUPTED
    except Exception as bug:
        return bug_found(bug)


def end(code: int) -> None:
    """End the process: all is closed, and Python's own way of tidying up takes as long as its start."""
    sys.stderr.flush()
    os._exit(code)


def dispatch(arguments: list[str]) -> int:
    """Find the command that ARGUMENTS mean, and run it."""
    first = arguments[0] if arguments else "repl"
    if first in ("-h", "--help", "help"):
        return print_help(arguments[1:])
    if first in ("-V", "--version"):
        from eslang import __version__

        print(f"eslang {__version__}")
        return 0
    if first == "-e":
        arguments = ["run", *arguments]
    elif first.startswith("--"):
        arguments = ["repl", *arguments]
    name, rest = (arguments[0], arguments[1:]) if arguments else ("repl", [])
    command = COMMANDS.get(name)
    if command is None:
        raise Usage(unknown_command(name))
    if "-h" in rest or "--help" in rest:
        return print_help([name])
    return perform(choose(command, rest))


def perform(chosen: Chosen) -> int:
    """Run the command CHOSEN, which is imported only now."""
    name = chosen.command.name
    if name == "run":
        from eslang.tools.run import run

        return run(chosen)
    if name == "repl":
        from eslang.tools.repl import repl

        return repl(chosen)
    gc.enable()
    if name == "test":
        from eslang.tools.testing import test

        return test(chosen)
    if name == "check":
        from eslang.tools.checking import check

        return check(chosen)
    if name == "trace":
        from eslang.tools.traces import trace

        return trace(chosen)
    if name == "graph":
        from eslang.tools.graph import graph

        return graph(chosen)
    if name == "doc":
        from eslang.tools.docs import doc

        return doc(chosen)
    from eslang.tools.explain import explain

    return explain(chosen)


def print_help(names: list[str]) -> int:
    """Print the help of the commands NAMES, or of `esl` itself."""
    for name in names:
        if name not in COMMANDS:
            raise Usage(unknown_command(name))
    texts = [help_text(COMMANDS[name]) for name in names] or [overview()]
    sys.stdout.write("\n".join(texts))
    return 0


def unknown_command(name: str) -> str:
    """What to say to a word that is no command."""
    if name.endswith(".esl") or os.path.exists(name):
        return f"`{name}` is no command; to run it: esl run {name}"
    from eslang.base.suggest import nearest

    near = nearest(name, COMMANDS)
    return f"there is no command `{name}`" + (f"; the nearest is `{near}`" if near else "")


def prepare_streams() -> None:
    """Let output appear line by line, and no character be too strange to be written.

    A stream that was closed from the start is replaced by one that takes all and gives nothing.
    """
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode, encoding="utf-8"))  # noqa: SIM115 (until the end)
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(encoding="utf-8", errors="backslashreplace", line_buffering=True)
    reconfigure = getattr(sys.stdin, "reconfigure", None)
    if reconfigure is not None:
        reconfigure(encoding="utf-8", errors="surrogateescape")  # wrong bytes get a diagnostic later


def output_refused(trouble: OSError) -> int:
    """Standard output takes no more: nothing to say if nobody reads it, else why."""
    from eslang.tools.opening import reason, silence

    silence(sys.stdout)
    if isinstance(trouble, BrokenPipeError):
        return 0
    sys.stderr.write(f"esl: the output cannot be written: {reason(trouble)}\n")
    return FAILED


def bug_found(bug: Exception) -> int:
    """Say that we are wrong, and what to send us."""
    from eslang.tools.report import bug_report

    sys.stderr.write(bug_report(bug))
    return BUG
