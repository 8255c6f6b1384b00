"""Bytes of a file → the text of a source.

All texts are UTF-8. This is apart from the reader, so that a file whose
compiled code is kept can be opened without loading it.
"""

from __future__ import annotations

import os
from codecs import BOM_UTF8

from eslang.base.diagnostics import EslError, error_at
from eslang.base.hints import TYPE_CHECKING
from eslang.base.spans import Source, Span
from eslang.base.symbols import Value

if TYPE_CHECKING:
    from os import PathLike


def file_bytes(path: str | PathLike[str]) -> bytes:
    """What the file at PATH holds. Raises OSError."""
    with open(path, "rb") as file:
        return file.read()


def find_file(name: str, loading: Value) -> str | None:
    """Where the file NAME is: beside the file LOADING, a string, if any, or from the current folder."""
    beside = os.path.join(os.path.dirname(loading.text), name) if loading is not None else name
    return next((path for path in (beside, name) if os.path.isfile(path)), None)


def decode(text: bytes, name: str) -> Source:
    """The source of that name, out of the bytes of a file; a byte order mark is dropped."""
    try:
        return Source(name, text.removeprefix(BOM_UTF8).decode())
    except UnicodeDecodeError as wrong:
        source = Source(name, text.removeprefix(BOM_UTF8).decode(errors="replace"))
        before = wrong.object[: wrong.start].decode("utf-8")  # without the mark
        raise _wrong_encoding(source, before, wrong.object[wrong.start]) from None


def _wrong_encoding(source: Source, before: str, byte: int) -> EslError:
    line, column = before.count("\n") + 1, len(before) - before.rfind("\n")
    return error_at(
        "wrong-encoding",
        f"the byte {byte:02X} is no UTF-8 here",
        Span(source, line, column, line, column + 1),
        hint="save the file as UTF-8",
    )
