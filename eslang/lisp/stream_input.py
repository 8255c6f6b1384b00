"""Reading characters and lines (CLHS 21.2), and asking the user.

Reading whole forms is reading.py.
"""

from __future__ import annotations

from eslang.base.failure import simple_error
from eslang.base.many import Values
from eslang.base.running import running
from eslang.base.symbols import Symbol, T, Value, truth
from eslang.base.text import Character, String, character
from eslang.compile.registry import function
from eslang.lisp.characters import check_character
from eslang.lisp.streams import InputStream, input_stream, output_stream

_QUERY = Symbol.intern("*QUERY-IO*", "COMMON-LISP")


def at_end(stream: InputStream, eof_error_p: Value, eof_value: Value) -> Value:
    """What a reading function returns at the end of STREAM: EOF-VALUE, or it fails."""
    if eof_error_p is not None:
        raise simple_error("end of input", stream, condition="END-OF-FILE")
    return eof_value


def _read_line(designator: Value, eof_error_p: Value, eof_value: Value) -> tuple[Value, Value]:
    stream = input_stream(designator, "read-line")
    text, ended = stream.line()
    if not text and not ended:
        return at_end(stream, eof_error_p, eof_value), T
    return String(text), truth(not ended)


def _read_line_many(
    stream: Value = None, eof_error_p: Value = T, eof_value: Value = None, recursive_p: Value = None
) -> Value:
    return Values(_read_line(stream, eof_error_p, eof_value))


@function("(read-line &optional stream (eof-error-p t) eof-value recursive-p)", many=_read_line_many)
def read_line(
    stream: Value = None, eof_error_p: Value = T, eof_value: Value = None, recursive_p: Value = None
) -> Value:
    """Return the next line of STREAM, without its end.

    Returns: the line and, as second value, T if the input ended before the line did.
    Fails:   :error at the end of the input, unless EOF-ERROR-P is NIL.
    """
    return _read_line(stream, eof_error_p, eof_value)[0]


@function("(read-char &optional stream (eof-error-p t) eof-value recursive-p)")
def read_char(
    designator: Value = None, eof_error_p: Value = T, eof_value: Value = None, recursive_p: Value = None
) -> Value:
    """Return the next character of STREAM.

    Fails: :error at the end of the input, unless EOF-ERROR-P is NIL.
    """
    stream = input_stream(designator, "read-char")
    char = stream.char()
    if not char:
        return at_end(stream, eof_error_p, eof_value)
    stream.skip(1)
    return character(char)


@function("(unread-char character &optional stream)")
def unread_char(char: Value, designator: Value = None) -> Value:
    """Give CHARACTER, the last one read, back to STREAM."""
    check_character(char, "unread-char")
    input_stream(designator, "unread-char").skip(-1)
    return None


@function("(peek-char &optional peek-type stream (eof-error-p t) eof-value recursive-p)")
def peek_char(
    peek_type: Value = None,
    designator: Value = None,
    eof_error_p: Value = T,
    eof_value: Value = None,
    recursive_p: Value = None,
) -> Value:
    """Return the next character of STREAM and leave it there.

    Under a PEEK-TYPE of T white space is skipped first; under a character,
    everything up to it.
    Fails: :error at the end of the input, unless EOF-ERROR-P is NIL.
    """
    stream = input_stream(designator, "peek-char")
    while True:
        char = stream.char()
        if not char:
            return at_end(stream, eof_error_p, eof_value)
        if peek_type is T:
            found = not char.isspace()
        else:
            found = peek_type.__class__ is not Character or char == peek_type.char
        if found:
            return character(char)
        stream.skip(1)


@function("(listen &optional stream)")
def listen(stream: Value = None) -> Value:
    """Return T if a character of STREAM has come in already."""
    return truth(bool(input_stream(stream, "listen").rest()))


@function("(clear-input &optional stream)")
def clear_input(designator: Value = None) -> Value:
    """Forget what has come in and is not read yet."""
    stream = input_stream(designator, "clear-input")
    stream.skip(len(stream.rest()))
    return None


def _ask(question: str, choices: str, answers: tuple[str, str]) -> Value:
    dialogue = running.session.image.cell(_QUERY).value
    output, source = output_stream(dialogue, "y-or-n-p"), input_stream(dialogue, "y-or-n-p")
    while True:
        output.fresh_line()
        output.write(f"{question}{' ' if question else ''}{choices} ")
        output.flush()
        text, ended = source.line()
        if not text and not ended:
            return at_end(source, T, None)
        answer = text.strip().lower()
        if answer in answers:
            return truth(answer == answers[0])


def _question(control: Value, arguments: tuple[Value, ...]) -> str:
    if control is None:
        return ""
    from eslang.lisp.format import formatted  # FORMAT stands on this file, too

    return formatted(control, arguments)


@function("(y-or-n-p &optional control &rest arguments)")
def y_or_n_p(control: Value = None, *arguments: Value) -> Value:
    """Ask the user, as FORMAT writes it; return T for y and NIL for n."""
    return _ask(_question(control, arguments), "(y or n)", ("y", "n"))


@function("(yes-or-no-p &optional control &rest arguments)")
def yes_or_no_p(control: Value = None, *arguments: Value) -> Value:
    """Ask the user, as FORMAT writes it; return T for yes and NIL for no."""
    return _ask(_question(control, arguments), "(yes or no)", ("yes", "no"))
