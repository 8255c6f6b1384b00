"""The words of the command line: each command, its options, its help.

One table serves the parsing, `--help` and docs/reference/cli.md. There is no
argparse here, because `esl run` must start fast; this file imports nothing.
"""

from __future__ import annotations

WIDTH = 24  # of the column of options in a help text


class Usage(Exception):
    """The command was used wrongly (exit code 2)."""


class Option:
    """One option: its names (the last is its key), what follows it, and what it means."""

    __slots__ = ("key", "meaning", "names", "value")

    def __init__(self, names: str, value: str | None, meaning: str) -> None:
        self.names = names.split()
        self.key = self.names[-1].lstrip("-")
        self.value = value
        self.meaning = meaning


class Command:
    """One command: its name, arguments, one-line summary, options, and some more words."""

    __slots__ = ("arguments", "details", "name", "options", "summary")

    def __init__(
        self, name: str, arguments: str, summary: str, options: tuple[Option, ...], details: str = ""
    ) -> None:
        self.name = name
        self.arguments = arguments
        self.summary = summary
        self.options = options
        self.details = details


class Chosen:
    """What one command line says: the options given, by key, and the other words."""

    __slots__ = ("command", "given", "words")

    def __init__(self, command: Command) -> None:
        self.command = command
        self.given: dict[str, list[str]] = {}
        self.words: list[str] = []

    def has(self, key: str) -> bool:
        """True if option KEY was given."""
        return key in self.given

    def value(self, key: str) -> str | None:
        """What followed option KEY, the last time it was given; None without it."""
        values = self.given.get(key)
        return values[-1] if values else None

    def all(self, key: str) -> list[str]:
        """What followed option KEY, each time it was given."""
        return self.given.get(key, [])


HELP = Option("-h --help", None, "print this text")
SEED = Option("--seed", "N", "seed of all chance, a whole number (default 0); `random` draws and prints one")
CLOCK = Option("--clock", "KIND", "`real` (default), or `virtual`: time jumps while all wait")
QUIET = Option("-q --quiet", None, "print no trace lines")
TRACE = Option("--trace", "FILE", "write the events of the run to FILE (see `esl trace`)")
WATCH = Option("--watch", None, "keep a live tree of the tasks at the bottom of the terminal")
SHUFFLE = Option("--shuffle", None, "let ready tasks take turns in an order drawn from the seed")
LIMIT = Option("--time-limit", "S", "end the run after S seconds of wall time (exit 124)")
CHOICES = Option("--choices", "FILE", "who has the turn where more than one is ready: a task a line")
RECORD = Option("--record-choices", "FILE", "write down who had the turn, for `--choices`")
SCENARIO = Option("--scenario", "FILE", "what the world does to the plan, and when; may be repeated")
FACTS = Option("--facts", "FILE", "begin with the facts in FILE, a database, and keep all facts there")
EVAL = Option("-e", "FORM", "evaluate FORM and print its values; may be repeated")
DOUBLES = Option("--doubles", "FILE", "let the doubles that FILE defines stand in for devices")
COVERAGE = Option("--coverage", None, "report what of the plans did not run")
OF = Option("--of", "NAME", "draw only the definitions of NAME; may be repeated")
SVG = Option("--svg", None, "draw a picture, SVG, rather than a flowchart of Mermaid")
PICTURE = Option("-o", "FILE", "write the drawing to FILE; SVG, if it ends in .svg")
TELLING = (
    Option("--task", "NAME", "tell only what concerns this task; may be repeated"),
    Option("--kind", "KIND", "tell only events of this kind; may be repeated"),
    Option("--from", "S", "tell only what happened S seconds after the start, or later"),
    Option("--to", "S", "tell only what happened until then"),
    Option("--all", None, "leave nothing out of a long run"),
    Option("--html", None, "write a page that shows the tasks as lanes over time"),
    Option("--perfetto", None, "write the format of Chrome's and Perfetto's trace viewers"),
    Option("-o", "FILE", "write the page, or the format, to FILE (`-` is standard output)"),
)

_RUN = (SEED, SHUFFLE, CHOICES, RECORD, CLOCK, QUIET, TRACE, LIMIT, SCENARIO, FACTS)

COMMANDS = {
    command.name: command
    for command in (
        Command(
            "run",
            "[options] FILE... | -e FORM",
            "run plans",
            (EVAL, *_RUN, WATCH, HELP),
            "Loads each FILE (`-` is standard input), then calls the function MAIN if one of them\n"
            "defined it. With -e, evaluates the forms after loading, and does not call MAIN.\n"
            "Trace lines and results go to standard output, diagnostics to standard error.",
        ),
        Command(
            "repl",
            "[options] [FILE...]",
            "talk to ESL at the prompt",
            (SEED, SHUFFLE, CLOCK, QUIET, TRACE, SCENARIO, FACTS, HELP),
            "Loads each FILE first. At the prompt, :help tells what else can be said there.\n"
            "From a pipe, each form is printed behind its prompt, so that the output is a transcript.",
        ),
        Command(
            "test",
            "[options] PATH...",
            "run test files and transcripts",
            (DOUBLES, COVERAGE, SEED, HELP),
            "PATH is a file, or a folder to search: .esl files with DEFTEST or `; expect` lines,\n"
            ".transcript files, and Markdown files with `? ` prompts or ```esl blocks.",
        ),
        Command(
            "trace",
            "[options] FILE",
            "tell a run that was traced",
            (*TELLING, HELP),
            "FILE is what `esl run --trace FILE` has written; `-` is standard input. Without --html or\n"
            "--perfetto, prints the tasks as a tree, and what happened as a timeline.",
        ),
        Command(
            "graph",
            "[options] FILE...",
            "draw the structure of plans",
            (OF, SVG, PICTURE, HELP),
            "Draws definitions, their steps, conditions and tasks, and who calls whom, as a flowchart of\n"
            "Mermaid, or as SVG. The plans are checked, as `esl check` does it, and not run.",
        ),
        Command("check", "FILE...", "say what can be known of plans without running them", (HELP,)),
        Command("doc", "NAME...", "print the signature and documentation of names", (HELP,)),
        Command("explain", "DIAGNOSTIC", "explain a diagnostic, such as unclosed-list", (HELP,)),
    )
}

EXITS = """\
Exit codes:
  0    all went well
  1    the plan failed, or a test did
  2    the command was used wrongly
  65   the program is wrong
  70   a bug of ours
  124  the time limit
  130  Ctrl-C
"""


def choose(command: Command, arguments: list[str]) -> Chosen:
    """What ARGUMENTS say to COMMAND; Usage if they say it wrongly."""
    chosen = Chosen(command)
    table = {name: option for option in command.options for name in option.names}
    rest = list(arguments)
    while rest:
        word = rest.pop(0)
        if word == "--":
            chosen.words += rest
            break
        if word == "-" or not word.startswith("-"):
            chosen.words.append(word)
            continue
        name, equals, value = word.partition("=") if word.startswith("--") else (word, "", "")
        option = table.get(name)
        if option is None:
            raise Usage(f"`esl {command.name}` has no option `{name}`")
        if option.value is None:
            if equals:
                raise Usage(f"`{name}` takes no value")
        elif not equals:
            if not rest:
                raise Usage(f"`{name}` needs a value: `{name} {option.value}`")
            value = rest.pop(0)
        chosen.given.setdefault(option.key, []).append(value)
    return chosen


def help_text(command: Command) -> str:
    """What `esl COMMAND --help` prints."""
    lines = [f"usage: esl {command.name} {command.arguments}", "", _sentence(command.summary), ""]
    if command.details:
        lines += [*command.details.split("\n"), ""]
    lines.append("Options:")
    for option in command.options:
        names = ", ".join(option.names) + (f" {option.value}" if option.value else "")
        lines.append(f"  {names:<{WIDTH}}{option.meaning}")
    return "\n".join(lines) + "\n"


def overview() -> str:
    """What `esl --help` prints."""
    lines = ["usage: esl [COMMAND] ...", "", "ESL, a language for plans that notice their failures.", ""]
    lines += ["Commands:", *(f"  {c.name:<{WIDTH}}{c.summary}" for c in COMMANDS.values()), ""]
    lines += ["Without a command:"]
    lines += [f"  {'esl':<{WIDTH}}is `esl repl`", f"  {'esl -e FORM':<{WIDTH}}is `esl run -e FORM`"]
    lines += [f"  {'-h, --help':<{WIDTH}}print this text", f"  {'-V, --version':<{WIDTH}}print the version"]
    lines += ["", "`esl COMMAND --help` tells about one command.", "", EXITS.rstrip()]
    return "\n".join(lines) + "\n"


def _sentence(words: str) -> str:
    return words[0].upper() + words[1:] + "."
