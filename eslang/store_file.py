"""The file of the durable store: facts in an SQLite database, in the order of assertion.

Each row has a number, a fact as text (constructs/esl/fact_text.py), and a sum
of both, because SQLite does not notice a letter that is not what was written.
The file is held for as long as it is open: nobody else can open it meanwhile.
It is written ahead (WAL), one transaction after the other; what a transaction
has written survives the end of the process at any moment, and a loss of power
takes at most the last few, whole.
"""

from __future__ import annotations

import os
import sqlite3
from binascii import crc32
from weakref import WeakSet

from eslang.base.failure import Failure, simple_error
from eslang.base.hints import Iterable, Iterator

APPLICATION = 0x45534C46  # "ESLF": how SQLite's header says whose file it is
VERSION = 1
WORDS = {  # of SQLite's errors
    "SQLITE_BUSY": "another interpreter, or another program, has it open",
    "SQLITE_NOTADB": "it is no SQLite file",
    "SQLITE_CORRUPT": "it is damaged",
    "SQLITE_READONLY": "it cannot be written",
    "SQLITE_FULL": "the disk is full",
    "SQLITE_IOERR": "the disk does not do what it is asked to",
}
Stored = tuple[int, str]  # the number of a fact, and its text
OPEN: WeakSet[StoreFile] = WeakSet()


class StoreFile:
    """One such file, open and held."""

    def __init__(self, path: str) -> None:
        self.path = path
        self._process = os.getpid()
        place = os.path.abspath(path) if path and "\0" not in path else ""
        found = obstacle(place)
        if found is not None:
            raise self.trouble(found)
        try:
            self._connection = sqlite3.connect(
                place, timeout=0, isolation_level=None, check_same_thread=False
            )
        except sqlite3.Error as error:
            raise self.trouble(words_of(error)) from None
        try:
            self._open()
        except BaseException:
            self._connection.close()
            raise
        OPEN.add(self)

    def _open(self) -> None:
        """Make sure that the file is ours, whole, and can be written; a new one is furnished."""
        do = self._connection.execute
        try:
            do("PRAGMA locking_mode = EXCLUSIVE")
            do("PRAGMA page_size = 1024")  # of a new file: what a small transaction writes
            application, version = self._number("application_id"), self._number("user_version")
            new = application == version == 0 and not do("SELECT 1 FROM sqlite_schema").fetchall()
            if not new and application != APPLICATION:
                raise self.trouble("it is a database of another program")
            if not new and version != VERSION:
                raise self.trouble(
                    f"it has format {version}, and this version of eslang knows {VERSION} only"
                )
            if do("PRAGMA journal_mode = WAL").fetchone()[0] != "wal":
                raise self.trouble("SQLite cannot write it ahead")
            do("PRAGMA synchronous = NORMAL")
            do("PRAGMA wal_autocheckpoint = 4000")
            if new:
                self._furnish()
            if do("PRAGMA quick_check(1)").fetchone()[0] != "ok":
                raise self.trouble("it is damaged")
            do("BEGIN IMMEDIATE")
            do("ROLLBACK")
        except sqlite3.Error as error:
            raise self.trouble(words_of(error)) from None

    def _number(self, name: str) -> int:
        number: int = self._connection.execute(f"PRAGMA {name}").fetchone()[0]
        return number

    def _furnish(self) -> None:
        self._connection.executescript(
            f"""BEGIN EXCLUSIVE;
            CREATE TABLE fact (number INTEGER PRIMARY KEY, text TEXT NOT NULL, sum INTEGER NOT NULL);
            PRAGMA application_id = {APPLICATION};
            PRAGMA user_version = {VERSION};
            COMMIT"""
        )

    def facts(self) -> Iterator[Stored]:
        """All that the file holds, in order. Raises Failure if it is damaged."""
        try:
            for number, text, total in self._connection.execute("SELECT * FROM fact ORDER BY number"):
                if total != sum_of(number, text):
                    raise self.trouble(f"it is damaged: fact {number} is not what was written")
                yield number, text
        except sqlite3.Error as error:
            raise self.trouble(words_of(error)) from None

    def write(self, removed: Iterable[int], added: Iterable[Stored]) -> None:
        """One transaction: take away the facts of those numbers, and write others. Raises Failure."""
        if os.getpid() != self._process:
            raise self.trouble("it belongs to the process that has opened it")
        connection = self._connection
        try:
            connection.execute("BEGIN IMMEDIATE")
            connection.executemany("DELETE FROM fact WHERE number = ?", [(number,) for number in removed])
            connection.executemany(
                "INSERT OR REPLACE INTO fact VALUES (?, ?, ?)",
                [(number, text, sum_of(number, text)) for number, text in added],
            )
            connection.execute("COMMIT")
        except BaseException as error:
            if connection.in_transaction:
                connection.execute("ROLLBACK")
            if isinstance(error, sqlite3.Error):
                raise self.trouble(words_of(error)) from None
            raise

    def close(self) -> None:
        """Let go of the file."""
        if os.getpid() == self._process:
            self._connection.close()

    def abandon(self) -> None:
        """This process is a child of the one that has the file open: it is not even to close it."""
        from ctypes import py_object, pythonapi

        pythonapi.Py_IncRef(py_object(self._connection))  # SQLite would close it when nobody holds it

    def trouble(self, words: str) -> Failure:
        """The failure that the facts cannot be kept here, and why."""
        return simple_error(f"facts cannot be kept in `{self.path}`: {words}", condition="FILE-ERROR")


def abandon_all() -> None:
    """This process has just been made by fork."""
    for file in OPEN:
        file.abandon()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=abandon_all)


def sum_of(number: int, text: str) -> int:
    """What tells that a row is as it was written."""
    return crc32(b"%d %s" % (number, text.encode()))


def words_of(error: sqlite3.Error) -> str:
    """What SQLite's ERROR means."""
    name = getattr(error, "sqlite_errorname", "")
    known = next((words for kind, words in WORDS.items() if name.startswith(kind)), None)
    return known or str(error).lower()


def obstacle(place: str) -> str | None:
    """Why there can be no file of facts at PLACE, if that is plain to see."""
    folder = os.path.dirname(place)
    if not place:
        return "it is no name of a file"
    if os.path.isdir(place):
        return "it is a folder"
    if not os.path.isdir(folder):
        return "there is no such folder"
    if os.path.exists(place) and not os.access(place, os.R_OK | os.W_OK):
        return "it cannot be written"
    if not os.access(folder, os.W_OK | os.X_OK):
        return "its folder cannot be written"
    if os.path.exists(place) and os.path.getsize(place) == 1:  # SQLite would take it for an empty one
        return WORDS["SQLITE_NOTADB"]
    return None
