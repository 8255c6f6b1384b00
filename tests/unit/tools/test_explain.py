"""`esl explain`: the sections of the reference page, as a terminal shows them."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from eslang.tools.cli import main
from eslang.tools.explain import explanation, sections

ROOT = Path(__file__).resolve().parents[3]


def test_a_section_is_shown_without_its_markup():
    text = explanation("stray-close")
    assert text.startswith("stray-close\n\nThere is a `)` where no list is open.\n")
    assert "\n    (print (list 1 2)))\n" in text
    assert "```" not in text
    assert "; expect" not in text


def test_what_is_none():
    assert explanation("no-such-name") is None


def test_a_chapter_ends_the_section_before_it():
    assert "What the compiler says" not in "".join(sections().values())


def test_the_command(capsys):
    assert main(["explain", "unclosed-list", "unclosed-strng"]) == 1
    written = capsys.readouterr()
    assert written.out == explanation("unclosed-list")
    assert written.err == "esl: no diagnostic is called `unclosed-strng`; the nearest is `unclosed-string`\n"


@pytest.mark.slow
def test_a_wheel_carries_the_page(tmp_path):
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path)]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    (wheel,) = tmp_path.glob("*.whl")
    page = zipfile.ZipFile(wheel).read("eslang/errors.md").decode("utf-8")
    assert page == (ROOT / "docs" / "reference" / "errors.md").read_text(encoding="utf-8")
    assert "eslang/reader/esl.lark" in zipfile.ZipFile(wheel).namelist()
