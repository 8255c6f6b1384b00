"""Reading whole forms from strings and streams (CLHS 23).

The reader is imported when something is first read. What is wrong with the text
is a failure here, not a diagnostic: the text is what the program came by. For
the same reason #. is refused.
"""

from __future__ import annotations

from eslang.base.arguments import take_keys
from eslang.base.diagnostics import EslError, IncompleteInput
from eslang.base.failure import Failure, simple_error
from eslang.base.hints import NamedTuple
from eslang.base.many import Values
from eslang.base.running import running
from eslang.base.symbols import Symbol, T, Value
from eslang.compile.registry import function, variable
from eslang.lisp.stream_input import at_end
from eslang.lisp.streams import InputStream, input_stream
from eslang.lisp.strings import bounds, check_string

variable(
    "*read-default-float-format*",
    Symbol.intern("DOUBLE-FLOAT", "COMMON-LISP"),
    "The type that floats are read as; all floats are doubles.",
)


class _Found(NamedTuple):
    form: Value
    end: int  # how many characters were read


def _read_text(text: str) -> _Found | None:
    """The first form of TEXT; None if there is none. Raises EslError for wrong text."""
    from eslang.base.resolve import resolve_in
    from eslang.base.spans import Source
    from eslang.reader.reader import read_at

    reading, end = read_at(Source("input", text), 0, resolve_in(running.session.image))
    return None if reading is None else _Found(reading.form, end)


def _wrong(error: EslError, source: Value) -> Failure:
    kind = "END-OF-FILE" if isinstance(error, IncompleteInput) else "READER-ERROR"
    return simple_error(f"READ: {error.diagnostic.message}", source, condition=kind)


def _read_string(string: Value, options: tuple[Value, ...]) -> tuple[Value, int]:
    """The first form of STRING, and the place behind it."""
    eof_error_p = options[0] if options else T
    eof_value = options[1] if len(options) > 1 else None
    start, end, preserve = take_keys(options[2:], ("START", "END", "PRESERVE-WHITESPACE"))
    text = check_string(string, "read-from-string").text
    first, last = bounds(string, len(text), start, end, "read-from-string")
    text = text[:last]
    try:
        found = _read_text(text[first:])
    except EslError as error:
        raise _wrong(error, string) from None
    if found is None:
        if eof_error_p is not None:
            raise simple_error("end of input", string, condition="END-OF-FILE")
        return eof_value, last
    place = first + found.end
    if preserve is None and place < last and text[place].isspace():
        place += 1
    return found.form, place


def _read_string_many(string: Value, *options: Value) -> Value:
    return Values(_read_string(string, options))


@function(
    "(read-from-string string &optional (eof-error-p t) eof-value &key start end preserve-whitespace)",
    many=_read_string_many,
)
def read_from_string(string: Value, *options: Value) -> Value:
    """Return the first form that STRING holds.

    Returns: the form and, as second value, the place behind it.
    Fails:   :error for what cannot be read, and at the end of STRING, unless
             EOF-ERROR-P is NIL.
    """
    return _read_string(string, options)[0]


def _read_stream(stream: InputStream) -> _Found | None:
    """The next form of STREAM; lines are let in until it is whole."""
    if not stream.char():
        return None
    while True:
        try:
            found = _read_text(stream.rest())
        except IncompleteInput as error:
            if not stream.more():
                raise _wrong(error, stream) from None
            continue
        except EslError as error:
            stream.skip(len(stream.rest()))
            raise _wrong(error, stream) from None
        if found is not None or not stream.more():
            return found


@function("(read &optional stream (eof-error-p t) eof-value recursive-p)")
def read(
    designator: Value = None, eof_error_p: Value = T, eof_value: Value = None, recursive_p: Value = None
) -> Value:
    """Return the next form of STREAM.

    Fails: :error for what cannot be read, and at the end of the input, unless
           EOF-ERROR-P is NIL.
    """
    form = _read_form(designator, eof_error_p, eof_value)
    stream = input_stream(designator, "read")
    if recursive_p is None and stream.rest()[:1].isspace():
        stream.skip(1)
    return form


def _read_form(designator: Value, eof_error_p: Value, eof_value: Value) -> Value:
    stream = input_stream(designator, "read")
    found = _read_stream(stream)
    if found is None:
        stream.skip(len(stream.rest()))
        return at_end(stream, eof_error_p, eof_value)
    stream.skip(found.end)
    return found.form


@function("(read-preserving-whitespace &optional stream (eof-error-p t) eof-value recursive-p)")
def read_preserving_whitespace(
    designator: Value = None, eof_error_p: Value = T, eof_value: Value = None, recursive_p: Value = None
) -> Value:
    """Return the next form of STREAM and leave the blank behind it.

    Fails: as READ does.
    """
    return _read_form(designator, eof_error_p, eof_value)
