"""The file of the durable store: which files it takes, whom it lets in, and what it makes of damage."""

from __future__ import annotations

import os
import sqlite3
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

from eslang import Failure, Interpreter
from eslang.store_file import APPLICATION, StoreFile

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def path(tmp_path: Path) -> str:
    """Where a file may be."""
    return str(tmp_path / "agent.db")


def filled(path: str, count: int = 3) -> None:
    """Make a file of facts at PATH."""
    file = StoreFile(path)
    file.write([], [(number, f"(fact {number})") for number in range(1, count + 1)])
    file.close()


def content(path: str) -> list[tuple[int, str]]:
    """The facts in the file at PATH."""
    file = StoreFile(path)
    try:
        return list(file.facts())
    finally:
        file.close()


def refused(path: str) -> str:
    """Why there can be no interpreter with the file PATH, which stays as it is, as all around it does."""
    before = Path(path).read_bytes() if os.path.isfile(path) else None
    folder = os.path.dirname(path)
    around = os.listdir(folder) if os.path.isdir(folder) else []
    with pytest.raises(Failure) as caught:
        Interpreter(facts=path)
    words = str(caught.value.arguments[0])
    assert words.startswith(f"facts cannot be kept in `{path}`: ")
    if before is not None:
        assert Path(path).read_bytes() == before
    assert sorted(os.listdir(folder) if os.path.isdir(folder) else []) == sorted(around)
    return words.partition(": ")[2]


def raw(path: str, *statements: str) -> None:
    """Do STATEMENTS to the SQLite file at PATH."""
    connection = sqlite3.connect(path, isolation_level=None)
    for statement in statements:
        connection.execute(statement)
    connection.close()


def test_a_file_that_is_not_there_or_is_empty_is_made(path: str) -> None:
    assert content(path) == []
    filled(path)
    assert content(path) == [(1, "(fact 1)"), (2, "(fact 2)"), (3, "(fact 3)")]
    other = path + "2"
    Path(other).touch()
    assert content(other) == []


def test_facts_come_and_go_by_their_numbers(path: str) -> None:
    filled(path)
    file = StoreFile(path)
    file.write([2], [(4, "(fact 4)"), (5, "(é \x01)")])
    file.close()
    assert content(path) == [(1, "(fact 1)"), (3, "(fact 3)"), (4, "(fact 4)"), (5, "(é \x01)")]
    assert os.listdir(os.path.dirname(path)) == ["agent.db"]


def test_what_a_broken_transaction_has_done_is_undone(path: str) -> None:
    filled(path)
    file = StoreFile(path)

    def broken() -> Any:
        yield 4, "(fact 4)"
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        file.write([1], broken())
    assert [number for number, _ in file.facts()] == [1, 2, 3]
    file.write([1], [(5, "(fact 5)")])
    file.close()
    assert [number for number, _ in content(path)] == [2, 3, 5]


# --- files that are not taken ------------------------------------------------------------------


@pytest.mark.parametrize("text", ["x", "(is-a w1 widget)\n", "no database at all\n" * 1000])
def test_a_file_that_is_none_of_sqlite_is_refused(path: str, text: str) -> None:
    Path(path).write_text(text)
    assert refused(path) == "it is no SQLite file"


@pytest.mark.parametrize(
    "statements",
    [
        ["CREATE TABLE fact (number, text, sum)"],
        ["PRAGMA journal_mode = WAL", "CREATE TABLE mine (x)", "INSERT INTO mine VALUES (1)"],
        ["PRAGMA application_id = 77"],
        ["PRAGMA user_version = 1", "CREATE TABLE mine (x)"],
    ],
)
def test_a_database_of_another_program_is_refused(path: str, statements: list[str]) -> None:
    raw(path, *statements)
    assert refused(path) == "it is a database of another program"


def test_a_file_of_a_later_format_is_refused(path: str) -> None:
    filled(path)
    raw(path, "PRAGMA journal_mode = DELETE", "PRAGMA user_version = 2")
    assert refused(path) == "it has format 2, and this version of eslang knows 1 only"


def test_a_folder_and_what_cannot_be_a_file_are_refused(tmp_path: Path) -> None:
    assert refused(str(tmp_path)) == "it is a folder"
    assert refused(str(tmp_path / "no" / "agent.db")) == "there is no such folder"
    assert refused("") == "it is no name of a file"
    with pytest.raises(Failure, match="no name of a file"):
        StoreFile("a\0b")


READ_ONLY = """
import os, sys
from eslang.store_file import StoreFile
from eslang import Failure
os.chmod(sys.argv[1], 0o444)
os.chmod(os.path.dirname(sys.argv[1]), 0o555)
if os.getuid() == 0:
    os.setuid(65534)  # whom the system obeys would write it anyway
try:
    StoreFile(sys.argv[1])
except Failure as failure:
    print(failure.arguments[0].partition(": ")[2])
"""


def test_a_file_that_cannot_be_written_is_refused() -> None:
    with TemporaryDirectory() as folder:
        path = os.path.join(folder, "agent.db")
        filled(path)
        before = Path(path).read_bytes()
        ended = subprocess.run(
            [sys.executable, "-c", READ_ONLY, path], cwd=ROOT, capture_output=True, text=True
        )
        os.chmod(folder, 0o755)
        assert ended.stdout.strip() == "it cannot be written", ended.stderr
        assert Path(path).read_bytes() == before


# --- one at a time -----------------------------------------------------------------------------


def test_a_second_interpreter_is_refused_as_long_as_the_first_is_open(path: str) -> None:
    first = Interpreter(facts=path)
    words = "another interpreter, or another program, has it open"
    with pytest.raises(Failure, match=words):
        Interpreter(facts=path)
    script = f"from eslang import Interpreter; Interpreter(facts={path!r})"
    ended = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True)
    assert words in ended.stderr
    first.eval("(assert '(a b))")
    first.close()
    with Interpreter(facts=path) as second:
        assert second.eval("(db-query '(a b))")


def test_a_file_that_another_program_reads_is_refused(path: str) -> None:
    filled(path)
    other = sqlite3.connect(path, isolation_level=None)
    other.execute("BEGIN")
    other.execute("SELECT * FROM fact").fetchone()
    with pytest.raises(Failure, match="has it open"):
        StoreFile(path)
    other.close()
    assert len(content(path)) == 3


FORKING = """
import gc, os, sys
from eslang import Interpreter
path = sys.argv[1]
agent = Interpreter(facts=path)
agent.facts.add("a", 1)
if os.fork() == 0:
    if sys.argv[2] == "close":
        agent.close()
    agent = None
    gc.collect()
    sys.exit()
os.wait()
print(sorted(os.listdir(os.path.dirname(path))), flush=True)
agent.facts.add("a", 2)
os._exit(0)
"""


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes are made by fork")
@pytest.mark.parametrize("way", ["close", "leave"])
def test_a_child_made_by_fork_leaves_the_file_to_its_parent(path: str, way: str) -> None:
    ended = subprocess.run(
        [sys.executable, "-c", FORKING, path, way], cwd=ROOT, capture_output=True, text=True
    )
    assert (ended.stdout, ended.stderr) == ("['agent.db', 'agent.db-wal']\n", "")
    assert [text for _, text in content(path)] == ["(a 1)", "(a 2)"]


# --- damage ------------------------------------------------------------------------------------


def damaged(path: str, harm: Callable[[bytearray], object]) -> None:
    """Do HARM to the bytes of the file at PATH."""
    held = bytearray(Path(path).read_bytes())
    harm(held)
    Path(path).write_bytes(held)


def test_a_torn_page_is_told_of(path: str) -> None:
    filled(path, 500)
    damaged(path, lambda held: held.__setitem__(slice(3000, 4000), b"\0" * 1000))
    assert refused(path).startswith("it is damaged")


def test_a_file_that_ends_too_soon_is_told_of(path: str) -> None:
    filled(path, 500)
    damaged(path, lambda held: held.__delitem__(slice(5000, None)))
    assert refused(path).startswith("it is damaged")


def test_a_letter_that_is_not_what_was_written_is_told_of(path: str) -> None:
    filled(path)
    damaged(path, lambda held: held.__setitem__(held.index(b"(fact 2)") + 1, ord("p")))
    assert refused(path) == "it is damaged: fact 2 is not what was written"


def test_what_is_no_fact_is_told_of(path: str) -> None:
    for text in ("(fact ?x)", "5", "(fact", "(fact) (fact)", ""):
        file = StoreFile(path)
        file.write([], [(7, text)])
        file.close()
        assert refused(path) == f"it is damaged: fact 7 is no fact: {text}"


@pytest.mark.slow
def test_whatever_bit_is_wrong_it_is_told_of_or_all_facts_are_there(path: str) -> None:
    filled(path, 40)
    before, sound = Path(path).read_bytes(), content(path)
    told = 0
    for place in range(0, len(before), 7):
        Path(path).write_bytes(before[:place] + bytes([before[place] ^ 1 << place % 8]) + before[place + 1 :])
        try:
            assert content(path) == sound, place
        except Failure:
            told += 1
    assert told > len(sound)


def test_the_file_says_whose_it_is(path: str) -> None:
    filled(path)
    assert Path(path).read_bytes()[68:72] == APPLICATION.to_bytes(4, "big") == b"ESLF"
