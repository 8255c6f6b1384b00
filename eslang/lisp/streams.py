"""Streams: where characters go to and come from (CLHS 21).

An output stream knows its column, so that FRESH-LINE can tell; an input stream
gives lines one at a time, so that a prompt is answered before more is read.
The standard streams are made for each interpreter.
"""

from __future__ import annotations

import sys

from eslang.base.arguments import take_keys
from eslang.base.failure import simple_error, type_error
from eslang.base.hints import Any, Callable
from eslang.base.running import running
from eslang.base.symbols import Datum, Symbol, T, Value, truth
from eslang.base.text import String
from eslang.compile.registry import function, variable
from eslang.lisp.strings import bounds, check_string
from eslang.lisp.types import define_simple_type


class OutputStream(Datum):
    """Characters go to a Python text file; `column` counts from 0 at the start of a line."""

    __slots__ = ("_file", "closed", "column")
    kind = "OUTPUT-STREAM"

    def __init__(self, file: Any = None) -> None:
        self._file = file  # None: whatever sys.stderr is when something is written
        self.column = 0
        self.closed = False

    def put(self, text: str) -> None:
        """Send TEXT on its way; what `write` stands on."""
        (self._file or sys.stderr).write(text)

    def write(self, text: str) -> None:
        """Write TEXT and keep count of the column."""
        if self.closed:
            raise simple_error("the stream is closed", self)
        self.put(text)
        newline = text.rfind("\n")
        self.column = self.column + len(text) if newline < 0 else len(text) - newline - 1

    def fresh_line(self) -> bool:
        """Go to the start of a line; true if that took a newline."""
        if self.column:
            self.write("\n")
            return True
        return False

    def flush(self) -> None:
        """Let everything written so far arrive."""
        (self._file or sys.stderr).flush()

    def print_lisp(self, settings: Any) -> str:
        """How the printer shows a stream."""
        return f"#<{self.kind}>"


class StringOutputStream(OutputStream):
    """What is written is kept, until somebody takes it."""

    __slots__ = ("_pieces",)
    kind = "STRING-OUTPUT-STREAM"

    def __init__(self) -> None:
        super().__init__()
        self._pieces: list[str] = []

    def put(self, text: str) -> None:
        """Keep TEXT."""
        self._pieces.append(text)

    def flush(self) -> None:
        """Nothing waits to arrive."""

    def take(self) -> str:
        """All that was written since the last time."""
        text = "".join(self._pieces)
        self._pieces.clear()
        return text


class FillStream(OutputStream):
    """What is written lengthens a string with a fill pointer."""

    __slots__ = ("_string",)
    kind = "STRING-OUTPUT-STREAM"

    def __init__(self, string: String) -> None:
        super().__init__()
        self._string = string
        self.column = len(string.text) - string.text.rfind("\n") - 1

    def put(self, text: str) -> None:
        """Append TEXT to the string."""
        self._string.text += text

    def flush(self) -> None:
        """Nothing waits to arrive."""


class InputStream(Datum):
    """Characters come from `next_line`, a line at a time; it gives "" at the end."""

    __slots__ = ("_next_line", "_place", "_text", "closed")

    def __init__(self, next_line: Callable[[], str], text: str = "") -> None:
        self._next_line = next_line
        self._text = text
        self._place = 0
        self.closed = False

    def rest(self) -> str:
        """What has come in and is not read yet."""
        return self._text[self._place :]

    def more(self) -> bool:
        """Let another line come in; false at the end."""
        line = self._next_line()
        if line:
            self._text, self._place = self.rest() + line, 0
        return bool(line)

    def skip(self, count: int) -> None:
        """Count COUNT characters of `rest` as read; a negative COUNT gives some back."""
        self._place += count

    def char(self) -> str:
        """The next character, still unread; "" at the end."""
        if self.closed:
            raise simple_error("the stream is closed", self)
        if self._place >= len(self._text) and not self.more():
            return ""
        return self._text[self._place]

    def line(self) -> tuple[str, bool]:
        """The rest of the line, without its end, and whether it had one."""
        if not self.char():
            return "", False
        while True:
            end = self._text.find("\n", self._place)
            if end >= 0 or not self.more():
                break
        text = self._text[self._place : end] if end >= 0 else self.rest()
        self._place = end + 1 if end >= 0 else len(self._text)
        return text, end >= 0

    def print_lisp(self, settings: Any) -> str:
        """How the printer shows a stream."""
        return "#<INPUT-STREAM>"


class TwoWayStream(Datum):
    """An input and an output stream in one, for questions and answers."""

    __slots__ = ("input", "output")

    def __init__(self, source: InputStream, output: OutputStream) -> None:
        self.input = source
        self.output = output

    def print_lisp(self, settings: Any) -> str:
        """How the printer shows a stream."""
        return "#<TWO-WAY-STREAM>"


define_simple_type("STREAM", lambda value: isinstance(value, (OutputStream, InputStream, TwoWayStream)))
define_simple_type("STRING-STREAM", lambda value: isinstance(value, StringOutputStream))


def standard_output() -> OutputStream:
    """A stream to standard output as it is now."""
    return OutputStream(sys.stdout)


def _standard_output() -> Value:
    return running.session.output


def _standard_input() -> Value:
    return InputStream(lambda: sys.stdin.readline())


def _dialogue() -> Value:
    return TwoWayStream(_value("*STANDARD-INPUT*"), running.session.output)


def _value(name: str) -> Value:
    return running.session.image.cell(Symbol.intern(name, "COMMON-LISP")).value


variable("*standard-output*", _standard_output, "Where output goes that names no stream.")
variable("*trace-output*", _standard_output, "Where the trace of failures and goals goes.")
variable("*error-output*", lambda: OutputStream(), "Where warnings go.")
variable("*standard-input*", _standard_input, "Where input comes from that names no stream.")
variable("*query-io*", _dialogue, "Where questions are put to the user and answered.")
variable("*terminal-io*", _dialogue, "The user's own terminal.")

_OUTPUT = Symbol.intern("*STANDARD-OUTPUT*", "COMMON-LISP")
_INPUT = Symbol.intern("*STANDARD-INPUT*", "COMMON-LISP")


def output_stream(designator: Value, name: str) -> OutputStream:
    """The output stream that DESIGNATOR (a stream, or NIL or T for the standard one) means."""
    if designator is None or designator is T:
        designator = running.session.image.cell(_OUTPUT).value
    if isinstance(designator, TwoWayStream):
        return designator.output
    if isinstance(designator, OutputStream):
        return designator
    raise type_error(designator, "STREAM", name)


def input_stream(designator: Value, name: str) -> InputStream:
    """The input stream that DESIGNATOR (a stream, or NIL or T for the standard one) means."""
    if designator is None or designator is T:
        designator = running.session.image.cell(_INPUT).value
    if isinstance(designator, TwoWayStream):
        return designator.input
    if isinstance(designator, InputStream):
        return designator
    raise type_error(designator, "STREAM", name)


@function("(make-string-output-stream &key element-type)")
def make_string_output_stream(*options: Value) -> Value:
    """Return an output stream that keeps what is written to it."""
    take_keys(options, ("ELEMENT-TYPE",))
    return StringOutputStream()


@function("(get-output-stream-string stream)")
def get_output_stream_string(stream: Value) -> Value:
    """Return what was written to STREAM since the last time."""
    if not isinstance(stream, StringOutputStream):
        raise type_error(stream, "STRING-STREAM", "get-output-stream-string")
    return String(stream.take())


@function("(%make-fill-stream string)")
def make_fill_stream(string: Value) -> Value:
    """Return an output stream that lengthens STRING, which has a fill pointer."""
    if not check_string(string, "with-output-to-string").fill:
        raise simple_error("the string has no fill pointer", string)
    return FillStream(string)


@function("(make-string-input-stream string &optional (start 0) end)")
def make_string_input_stream(string: Value, start: Value = 0, end: Value = None) -> Value:
    """Return a stream that gives what is in STRING from START to END."""
    text = check_string(string, "make-string-input-stream").text
    first, last = bounds(string, len(text), start, end, "make-string-input-stream")
    return InputStream(lambda: "", text[first:last])


@function("(make-two-way-stream input-stream output-stream)")
def make_two_way_stream(source: Value, output: Value) -> Value:
    """Return a stream that reads INPUT-STREAM and writes OUTPUT-STREAM."""
    return TwoWayStream(
        input_stream(source, "make-two-way-stream"), output_stream(output, "make-two-way-stream")
    )


@function("(streamp object)")
def streamp(value: Value) -> Value:
    """Return T if OBJECT is a stream."""
    return truth(isinstance(value, (InputStream, OutputStream, TwoWayStream)))


@function("(input-stream-p stream)")
def input_stream_p(stream: Value) -> Value:
    """Return T if one can read from STREAM."""
    return truth(isinstance(stream, (InputStream, TwoWayStream)))


@function("(output-stream-p stream)")
def output_stream_p(stream: Value) -> Value:
    """Return T if one can write to STREAM."""
    return truth(isinstance(stream, (OutputStream, TwoWayStream)))


@function("(close stream &key abort)")
def close(stream: Value, *options: Value) -> Value:
    """Read from STREAM, or write to it, no more."""
    take_keys(options, ("ABORT",))
    if not isinstance(stream, (InputStream, OutputStream)):
        raise type_error(stream, "STREAM", "close")
    was_open, stream.closed = not stream.closed, True
    return truth(was_open)
