"""An interpreter as the options of a command want it.

Shared by `esl run` and `esl repl`. What an option may say is checked here.
"""

from __future__ import annotations

import gc
import os
import sys

from eslang.base.control import Stop
from eslang.base.decoding import file_bytes
from eslang.base.failure import Failure
from eslang.base.hints import Any, Callable, TextIO
from eslang.tools.options import Chosen, Usage

YOUNG = 20_000  # objects made before Python looks for rings among them; a list makes as many as it is long


class OutputClosed(Stop):
    """Nobody reads the output any more."""

    def __init__(self) -> None:
        super().__init__("nobody reads the output", 0)


class Outlet:
    """Standard output. When it takes no more, the run is to end; what is still written then is dropped."""

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream
        self.taken = True

    def write(self, text: str) -> None:
        """Write TEXT."""
        try:
            if self.taken:
                self.stream.write(text)
        except OSError as trouble:
            raise self.refused(trouble) from None

    def flush(self) -> None:
        """Let everything written so far arrive."""
        try:
            if self.taken:
                self.stream.flush()
        except OSError as trouble:
            raise self.refused(trouble) from None

    def refused(self, trouble: OSError) -> Stop:
        """How the run is to end, now that the output cannot be written."""
        self.taken = False
        silence(self.stream)
        if isinstance(trouble, BrokenPipeError):
            return OutputClosed()
        return Stop(f"the output cannot be written: {reason(trouble)}", 1)


def silence(stream: TextIO) -> None:
    """Let what STREAM still holds, and all that will be written to it, vanish."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


class Opened:
    """An interpreter as CHOSEN wants it, where LISTENER speaks; closed at the end."""

    def __init__(self, chosen: Chosen, listener: Callable[[Any], None] | None) -> None:
        from eslang.interpreter import Interpreter

        for path in chosen.all("scenario"):
            if path == "-":
                raise Usage("`--scenario` names a file")
            readable(path)
        clock = chosen.value("clock") or "real"
        if clock not in ("real", "virtual"):
            raise Usage(f"`--clock` is `real` or `virtual`, not `{clock}`")
        seed = seed_of(chosen)
        choices = None
        if chosen.has("choices") or chosen.has("record-choices"):
            from eslang.tools.choosing import choices_of

            choices = choices_of(chosen)
        self.chosen = chosen
        self.tracer = tracer_of(chosen, clock, seed)
        self.watch = watch_of(chosen)
        self.outlet = Outlet(self.watch or (sys.stderr if chosen.value("trace") == "-" else sys.stdout))
        try:
            self.interp = Interpreter(
                seed=seed,
                clock=clock,
                output=self.outlet,
                shuffle=chosen.has("shuffle"),
                choices=choices,
                listeners=[each for each in (self.tracer, self.watch) if each is not None],
                facts=chosen.value("facts"),
            )
        except Failure as failure:  # the file of facts cannot be had
            raise Usage(str(failure.arguments[0])) from None
        if listener is not None:
            self.interp.hooks.speakers.append(listener)

    def __enter__(self) -> Any:
        if not gc.isenabled():
            gc.freeze()  # what is there from the start need never be looked at
            gc.set_threshold(YOUNG)
            gc.enable()
        return self.interp

    def __exit__(self, *error: object) -> None:
        try:
            self.interp.close()
        except Failure as failure:  # what the file of facts has not taken is lost
            sys.stderr.write(f"esl: {failure.arguments[0]}; the last changes are lost\n")
        if self.chosen.has("record-choices"):
            from eslang.tools.choosing import write_choices

            write_choices(self.chosen, self.interp)
        if self.tracer is not None:
            self.tracer.close(self.interp.clock.now())

    def shown(self, work: Callable[[], object]) -> None:
        """Do WORK; with `--watch`, show its tasks meanwhile."""
        if self.watch is None:
            work()
        else:
            self.watch.show(work, self.interp.clock.now)


def watch_of(chosen: Chosen) -> Any:
    """The live tree that CHOSEN asks for, on the terminal that is to be there."""
    if not chosen.has("watch"):
        return None
    if chosen.value("trace") == "-":
        raise Usage("standard output cannot be both watched and the trace")
    if not sys.stdout.isatty() or os.environ.get("TERM", "dumb") == "dumb":
        raise Usage("`--watch` needs a terminal; `--trace FILE` writes down what happens")
    from eslang.tools.watching import Watch

    return Watch(sys.stdout)


def seed_of(chosen: Chosen) -> int:
    """The seed that CHOSEN asks for; a random one is drawn and told."""
    word = chosen.value("seed")
    if word is None:
        return 0
    if word == "random":
        from eslang.runtime.chance import draw_seed

        seed = draw_seed()
        sys.stderr.write(f"esl: seed {seed}\n")
        return seed
    if not word.lstrip("-").isdecimal():
        raise Usage(f"`--seed` is a whole number or `random`, not `{word}`")
    return int(word)


def limit_of(chosen: Chosen) -> float | None:
    """The time limit that CHOSEN asks for, in seconds."""
    word = chosen.value("time-limit")
    if word is None:
        return None
    try:
        seconds = float(word)
    except ValueError:
        seconds = -1.0
    if not 0 < seconds < 1e9:
        raise Usage(f"`--time-limit` is a number of seconds above 0, not `{word}`")
    return seconds


def tracer_of(chosen: Chosen, clock: str, seed: int) -> Any:
    """The listener that writes the events to the file that CHOSEN names, opened."""
    path = chosen.value("trace")
    if path is None:
        return None
    others = [*chosen.words, *chosen.all("facts")]
    if any(word != "-" and os.path.realpath(word) == os.path.realpath(path) for word in others):
        raise Usage(f"the trace would take the place of `{path}`")
    if path == "-" and chosen.command.name != "run":
        raise Usage("standard output is the prompt's: let `--trace` name a file")
    from eslang.tools.tracing import Tracer

    try:
        stream = sys.stdout if path == "-" else open_trace(path)
        return Tracer(stream, {"clock": clock, "seed": seed, "plans": chosen.words})
    except OSError as trouble:
        raise Usage(f"cannot write `{path}`: {reason(trouble)}") from None


def begin_world(interp: Any, chosen: Chosen) -> None:
    """Let what the scenarios say that CHOSEN names happen. Raises EslError if one of them is wrong."""
    if chosen.has("scenario"):
        from eslang.devices.scenario import begin_scenario, read_scenario

        for scenario in [read_scenario(interp, path) for path in chosen.all("scenario")]:
            begin_scenario(interp, scenario)


def open_trace(path: str) -> TextIO:
    """The file PATH, to be written line by line; a character that cannot be is escaped, as JSON does it."""
    return open(path, "w", encoding="utf-8", errors="backslashreplace", buffering=1)


def readable(path: str) -> str:
    """PATH, if it is a file that can be read; Usage if not."""
    if path != "-":
        try:
            with open(path, "rb") as stream:
                stream.read(1)
        except OSError as trouble:
            raise Usage(f"cannot read `{path}`: {reason(trouble)}") from None
    return path


def bytes_of(path: str) -> bytes:
    """What the file at PATH holds; `-` is standard input."""
    if path != "-":
        return file_bytes(path)
    return sys.stdin.read().encode("utf-8", "surrogateescape")


def reason(trouble: OSError) -> str:
    """Why the operating system refused, in its own words."""
    return (trouble.strerror or str(trouble)).lower()
