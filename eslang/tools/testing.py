"""`esl test`: find tests, run each in an interpreter of its own, and report.

A test is a DEFTEST of an .esl file, an .esl file with `; expect` comments, a
transcript, or what runs of a Markdown page. All of them run on virtual time.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from eslang.base.failure import Failure
from eslang.base.printer import prin1
from eslang.base.render import render
from eslang.base.symbols import Keyword, Symbol
from eslang.tools.endings import to_the_end
from eslang.tools.expectations import Came, Expected, troubles
from eslang.tools.markdown import block_troubles, page_entries, read_page
from eslang.tools.opening import readable, seed_of
from eslang.tools.options import Chosen, Usage
from eslang.tools.report import failure_text, place_of
from eslang.tools.transcript import Stage, read_transcript, replay

SUFFIXES = (".esl", ".transcript", ".md")
TESTS = Symbol.intern("%*TESTS*", "ESL")
DOUBLES = Symbol.intern("%*DOUBLES*", "ESL")
EXPECTATION_FAILED = Keyword("EXPECTATION-FAILED")


class Result(NamedTuple):
    """How one test went; no troubles: it passed."""

    name: str
    troubles: list[str]


class Bench:
    """What all tests of one command share: the seed, and the files with doubles."""

    def __init__(self, seed: int, doubles: list[str]) -> None:
        self.seed = seed
        self.doubles = doubles

    def stage(self, came: Came) -> Stage:
        """A new interpreter, with the doubles in place; CAME hears of its events."""
        stage = Stage(seed=self.seed, listener=came.hear)
        for path in self.doubles:
            stage.interp.load(path)
        return stage


def test(chosen: Chosen) -> int:
    """Do what `esl test` was asked for; the exit code."""
    if not chosen.words:
        raise Usage("`esl test` needs a file or a folder")
    bench = Bench(seed_of(chosen), [readable(path) for path in chosen.all("doubles")])
    paths = list(found_files(chosen.words))
    if not chosen.has("coverage"):
        return run_files(paths, bench)
    from eslang.tools.coverage import Coverage

    with Coverage(leave_out=[*map(str, paths), *bench.doubles]) as coverage:
        code = run_files(paths, bench)
    sys.stdout.write(coverage.report())
    return code


def run_files(paths: list[Path], bench: Bench) -> int:
    """Run the tests of PATHS and report them; the exit code."""
    passed = failed = 0
    for path in paths:
        for result in results(path, bench):
            if result.troubles:
                failed += 1
                sys.stdout.write(f"FAILED  {path}: {result.name}\n")
                for trouble in result.troubles:
                    sys.stdout.write("".join(f"    {line}\n" for line in trouble.split("\n")))
            else:
                passed += 1
                sys.stdout.write(f"ok      {path}: {result.name}\n")
    sys.stdout.write(f"{passed} passed, {failed} failed\n")
    if not passed + failed:
        sys.stderr.write("esl: no tests found\n")
    return 1 if failed or not passed else 0


def found_files(words: list[str]) -> Iterator[Path]:
    """The files that WORDS name, those in folders that may hold tests among them."""
    for word in words:
        path = Path(word)
        if path.is_dir():
            for inside in sorted(path.rglob("*")):
                hidden = any(part.startswith(".") for part in inside.relative_to(path).parts)
                if inside.suffix in SUFFIXES and inside.is_file() and not hidden and holds_tests(inside):
                    yield inside
        else:
            yield Path(readable(word))


def holds_tests(path: Path) -> bool:
    """True if the file PATH looks as if it held tests."""
    text = path.read_text(encoding="utf-8", errors="replace")
    if path.suffix == ".md":
        return bool(read_page(text))
    return path.suffix == ".transcript" or "(deftest " in text or bool(Expected(text))


def results(path: Path, bench: Bench) -> Iterator[Result]:
    """Run the tests of the file PATH, one after the other."""
    if path.suffix == ".esl":
        yield from program_results(path, bench)
        return
    text = path.read_text(encoding="utf-8", errors="replace")
    if path.suffix == ".md":
        blocks = read_page(text)
        entries = page_entries(blocks)
        for block in blocks:
            if not block.is_transcript:
                yield Result(f"line {block.line}", block_troubles(block, str(path)))
    else:
        entries = read_transcript(text)
    if entries:
        differs = replay(entries)
        yield Result(f"{len(entries)} forms", [differs.text(str(path))] if differs else [])


def program_results(path: Path, bench: Bench) -> Iterator[Result]:
    """Run what the plan PATH expects, and its DEFTESTs."""
    expected = Expected(path.read_text(encoding="utf-8", errors="replace"))
    came = Came()
    with bench.stage(came) as stage:
        came.of(lambda: to_the_end(stage.interp, lambda: stage.interp.load(str(path))))
        came.output = stage.take()
        names = test_names(stage)
    if expected:
        yield Result("as expected", troubles(expected, came))
    elif came.failure or came.error or came.stop or not names:
        came.output, came.trace = "", []
        yield Result("loads", troubles(expected, came))
    for name in names:
        yield Result(name.name.lower(), deftest_troubles(path, name, bench))


def test_names(stage: Stage) -> list[Symbol]:
    """The names of the tests that were defined, in order."""
    return [entry.car for entry in stage.interp.image.cell(TESTS).value or ()]


def deftest_troubles(path: Path, name: Symbol, bench: Bench) -> list[str]:
    """Run the test NAME of the file PATH in an interpreter of its own."""
    came = Came()
    with bench.stage(came) as stage:

        def run() -> None:
            stage.interp.load(str(path))
            for double in stage.interp.image.cell(DOUBLES).value or ():
                double.install()  # the file may have defined what the double stands in for
            stage.interp.call("esl::%run-test", name)

        return test_troubles(came.of(lambda: to_the_end(stage.interp, run)))


def test_troubles(came: Came) -> list[str]:
    """What is to be said of a test that did not come to its end."""
    if came.error is not None:
        return [render(came.error.diagnostic)]
    if came.stop is not None:
        return [f"the test was ended: {came.stop.reason}"]
    return [failed_text(came.failure)] if came.failure is not None else []


def failed_text(failure: Failure) -> str:
    """How a test failed, and where."""
    place = place_of(failure)
    where = f"{place}: " if place else ""
    if failure.cause is EXPECTATION_FAILED and len(failure.values) == 3:
        form, expected, found = (prin1(argument) for argument in failure.values)
        return f"{where}`{form}`\n  expected  {expected}\n  found     {found}"
    return f"{where}failed with `{failure_text(failure)}`"
