"""Every diagnostic, beside the program that it is about.

`NAME.esl`, or `NAME-and-something-more.esl`, is wrong; `NAME.expected` is what
is said of it. What lies in reader/ is only read, and what lies in scenario/ is
read as a scenario; what lies in any other folder is loaded, and checked if the
loading finds nothing. write_expected.py writes the expectations anew.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from io import StringIO
from pathlib import Path

import pytest
from diagnostics.names import names_in_the_source

from eslang.base.decoding import decode
from eslang.base.diagnostics import Diagnostic, EslError
from eslang.base.image import PACKAGE, Image
from eslang.base.render import render
from eslang.base.resolve import resolve_in
from eslang.reader.reader import read_forms
from eslang.reader.tables import tables
from eslang.tools.explain import explanation, sections

HERE = Path(__file__).parent
PROGRAMS = sorted(HERE.glob("*/*.esl"))
EXCERPT = re.compile(r"^ *(\d+ \|.*|: .*)$", re.M)  # the user's own words
INSIDES = re.compile(
    r"Traceback|NoneType|\w+(Error|Exception)\b|<class|0x[0-9a-f]{6}|__|\b_\w|%[a-z]|\b[A-Z][a-z]+[A-Z]\w*"
    r"|\b(str|int|bool|dict|tuple|bytes|lambda_|Cons|Ratio)\b"
)


def read_only(path: Path) -> Iterator[Diagnostic]:
    """The mistake that the reader finds."""
    image = Image()
    image.cell(PACKAGE).value = image.packages["ESL-USER"]
    try:
        for _ in read_forms(decode(path.read_bytes(), path.name), resolve_in(image)):
            pass
    except EslError as error:
        yield error.diagnostic


def read_as_scenario(path: Path) -> Iterator[Diagnostic]:
    """The mistake that is found in a scenario before the run."""
    from eslang.devices.scenario import read_scenario
    from eslang.interpreter import Interpreter

    with Interpreter(clock="virtual", output=StringIO()) as interp:
        try:
            read_scenario(interp, path.name)
        except EslError as error:
            yield error.diagnostic


READINGS = {"reader": read_only, "scenario": read_as_scenario}


def load_or_check(path: Path) -> Iterator[Diagnostic]:
    """The mistake that shows when PATH is loaded, or what `esl check` finds without that."""
    from eslang.base.failure import Failure
    from eslang.interpreter import Interpreter

    with Interpreter(clock="virtual", output=StringIO()) as interp:
        try:
            interp.load(path.name)
        except EslError as error:
            yield error.diagnostic
            return
        except Failure:
            pass
    with Interpreter(clock="virtual", output=StringIO()) as interp:
        yield from interp.check([path.name])


def said_of(path: Path) -> tuple[str, list[str]]:
    """What is said of the program at PATH, and by diagnostics of which names."""
    found = list(READINGS.get(path.parent.name, load_or_check)(path))
    text = "\n".join([render(diagnostic) for diagnostic in found]) + "\n"
    return text, [diagnostic.name for diagnostic in found]


def name_of(path: Path) -> str:
    """The longest name of a diagnostic that PATH's name begins with."""
    names = [name for name in names_in_the_source() if f"{path.stem}-".startswith(f"{name}-")]
    return max(names, key=len, default="")


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_what_is_said_of(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(path.parent)
    text, names = said_of(path)
    assert text == path.with_suffix(".expected").read_text(encoding="utf-8")
    assert name_of(path) in names


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.stem)
def test_no_insides_show_in_what_is_said_of(path: Path) -> None:
    said = EXCERPT.sub("", path.with_suffix(".expected").read_text(encoding="utf-8"))
    words = re.sub(r"`[^`]*`", "", said)
    assert INSIDES.search(words) is None
    assert set(re.findall(r"\w+", words)).isdisjoint(tables().pattern.groupindex)


def test_every_diagnostic_has_a_program_that_shows_it() -> None:
    assert sorted(names_in_the_source() - {name_of(path) for path in PROGRAMS}) == []


def test_every_diagnostic_is_explained_and_nothing_else() -> None:
    assert sorted(names_in_the_source() ^ set(sections())) == []
    assert [name for name in sections() if not explanation(name)] == []
