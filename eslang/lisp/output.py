"""Writing values and characters (CLHS 21.2, 22.1).

What the printer variables say is gathered here and handed to base/printer.py,
which does the work.
"""

from __future__ import annotations

from eslang.base.arguments import UNSUPPLIED, take_keys
from eslang.base.failure import Failure, type_error
from eslang.base.image import PACKAGE, Image
from eslang.base.many import Values
from eslang.base.printer import READABLE, WriteSettings, write_text
from eslang.base.running import running
from eslang.base.symbols import Keyword, Symbol, T, Value, truth
from eslang.base.text import String
from eslang.compile.registry import function, variable
from eslang.lisp.characters import check_character, check_radix
from eslang.lisp.streams import output_stream
from eslang.lisp.strings import bounds, check_string

variable("*print-escape*", T, "Whether values print so that they read back.")
variable("*print-readably*", None, "Whether to fail for a value that cannot be read back.")
variable("*print-base*", 10, "The base that integers and ratios print in, from 2 to 36.")
variable("*print-radix*", None, "Whether integers and ratios print with a mark of their base.")
variable("*print-case*", Keyword("UPCASE"), "How symbols print: :upcase, :downcase or :capitalize.")
variable("*print-length*", None, "How many elements of a list or vector print; NIL is all.")
variable("*print-level*", None, "How many levels of lists and vectors print; NIL is all.")
variable("*print-circle*", None, "Whether shared parts print with labels.")
variable("*print-pretty*", None, "Accepted; output is not broken into lines.")

_NAMES = ("ESCAPE", "READABLY", "BASE", "RADIX", "CASE", "LENGTH", "LEVEL", "CIRCLE", "PRETTY")
_VARIABLES = tuple(Symbol.intern(f"*PRINT-{name}*", "COMMON-LISP") for name in _NAMES)


def _limit(value: Value) -> int | None:
    if value is None or (value.__class__ is int and value >= 0):
        limit: int | None = value
        return limit
    raise type_error(value, "(OR NULL UNSIGNED-BYTE)", "write")


def _settings_of(values: list[Value]) -> WriteSettings:
    escape, readably, base, radix, case, length, level, circle, pretty = values
    image = running.session.image
    return WriteSettings(
        escape=escape is not None or readably is not None,
        readably=readably is not None,
        base=10 if base == 10 else check_radix(base, "write"),
        radix=radix is not None,
        case=case.name if isinstance(case, Keyword) else "UPCASE",
        length=_limit(length),
        level=_limit(level),
        circle=circle is not None,
        pretty=pretty is not None,
        package=image.cell(PACKAGE).value,
        packages=image.packages,
    )


class _Kept:
    """The printer variables of one image, and the settings last made of them, by their ESCAPE."""

    __slots__ = ("cells", "settings", "values")

    def __init__(self, image: Image) -> None:
        self.cells = [image.cell(symbol) for symbol in (*_VARIABLES, PACKAGE)]
        self.values: list[Value] = []
        self.settings: dict[bool | None, WriteSettings] = {}


def current_settings(escape: bool | None = None) -> WriteSettings:
    """What the printer variables say now; ESCAPE, if given, stands above them."""
    image = running.session.image
    if image.printing is None:
        image.printing = _Kept(image)
    kept: _Kept = image.printing
    values = [cell.value for cell in kept.cells]
    if values != kept.values:
        kept.values, kept.settings = values, {}
    settings = kept.settings.get(escape)
    if settings is None:
        settings = _settings_of(values[:-1])
        if escape is not None and escape != settings.escape:
            settings = settings._replace(escape=escape, readably=settings.readably and escape)
        kept.settings[escape] = settings
    return settings


def prin1_text(value: Value) -> str:
    """VALUE as PRIN1 writes it now."""
    return write_text(value, current_settings(True))


def princ_text(value: Value) -> str:
    """VALUE as PRINC writes it now."""
    if value.__class__ is String:
        text: str = value.text
        return text
    return write_text(value, current_settings(False))


def shown(value: Value) -> str:
    """VALUE as the prompt shows it: as PRIN1 writes it now, or plainly where that fails."""
    try:
        return prin1_text(value)
    except Failure:
        pass
    try:
        return write_text(value, READABLE)
    except Failure:
        return "#<a value that cannot be printed>"


@function("(prin1 object &optional stream)")
def prin1(value: Value, stream: Value = None) -> Value:
    """Write OBJECT so that it reads back; return it."""
    output_stream(stream, "prin1").write(prin1_text(value))
    return value


@function("(princ object &optional stream)")
def princ(value: Value, stream: Value = None) -> Value:
    """Write OBJECT for people: strings without quotes; return it."""
    output_stream(stream, "princ").write(princ_text(value))
    return value


@function("(print object &optional stream)")
def print_(value: Value, stream: Value = None) -> Value:
    """Write a newline, OBJECT as PRIN1 does, and a space; return OBJECT."""
    output_stream(stream, "print").write(f"\n{prin1_text(value)} ")
    return value


def _pprint_many(value: Value, stream: Value = None) -> Value:
    pprint(value, stream)
    return Values(())


@function("(pprint object &optional stream)", many=_pprint_many)
def pprint(value: Value, stream: Value = None) -> Value:
    """Write a newline and OBJECT as PRIN1 does; return no values."""
    output_stream(stream, "pprint").write("\n" + prin1_text(value))
    return None


def _given_settings(options: tuple[Value, ...], *more: str) -> tuple[WriteSettings, Value]:
    given = take_keys(options, (*_NAMES, *_IGNORED, *more), UNSUPPLIED)
    cell = running.session.image.cell
    values = [
        cell(symbol).value if value is UNSUPPLIED else value
        for symbol, value in zip(_VARIABLES, given, strict=False)
    ]
    stream = given[-1] if more and given[-1] is not UNSUPPLIED else None
    return _settings_of(values), stream


_IGNORED = ("ARRAY", "GENSYM", "LINES", "MISER-WIDTH", "PPRINT-DISPATCH", "RIGHT-MARGIN")


@function("(write object &key stream escape readably base radix case length level circle pretty)")
def write(value: Value, *options: Value) -> Value:
    """Write OBJECT as the printer variables and the keywords say; return it."""
    settings, stream = _given_settings(options, "STREAM")
    output_stream(stream, "write").write(write_text(value, settings))
    return value


@function("(write-to-string object &key escape readably base radix case length level circle pretty)")
def write_to_string(value: Value, *options: Value) -> Value:
    """Return what WRITE would write of OBJECT, as a string."""
    return String(write_text(value, _given_settings(options)[0]))


@function("(prin1-to-string object)")
def prin1_to_string(value: Value) -> Value:
    """Return what PRIN1 would write of OBJECT, as a string."""
    return String(prin1_text(value))


@function("(princ-to-string object)")
def princ_to_string(value: Value) -> Value:
    """Return what PRINC would write of OBJECT, as a string."""
    return String(princ_text(value))


@function("(write-char character &optional stream)")
def write_char(char: Value, stream: Value = None) -> Value:
    """Write CHARACTER as it is; return it."""
    output_stream(stream, "write-char").write(check_character(char, "write-char"))
    return char


def _part(string: Value, options: tuple[Value, ...], name: str) -> tuple[str, Value]:
    stream, keys = (options[0], options[1:]) if options else (None, ())
    text = check_string(string, name).text
    start, end = take_keys(keys, ("START", "END"))
    first, last = bounds(string, len(text), start, end, name)
    return text[first:last], stream


@function("(write-string string &optional stream &key start end)")
def write_string(string: Value, *options: Value) -> Value:
    """Write STRING, or its part from START to END, as it is; return it."""
    text, stream = _part(string, options, "write-string")
    output_stream(stream, "write-string").write(text)
    return string


@function("(write-line string &optional stream &key start end)")
def write_line(string: Value, *options: Value) -> Value:
    """Write STRING, or its part from START to END, and a newline; return it."""
    text, stream = _part(string, options, "write-line")
    output_stream(stream, "write-line").write(text + "\n")
    return string


@function("(terpri &optional stream)")
def terpri(stream: Value = None) -> Value:
    """Write a newline."""
    output_stream(stream, "terpri").write("\n")
    return None


@function("(fresh-line &optional stream)")
def fresh_line(stream: Value = None) -> Value:
    """Write a newline unless the line is empty; return T if it was not."""
    return truth(output_stream(stream, "fresh-line").fresh_line())


@function("(finish-output &optional stream)")
def finish_output(stream: Value = None) -> Value:
    """Let everything written to STREAM arrive."""
    output_stream(stream, "finish-output").flush()
    return None


@function("(force-output &optional stream)")
def force_output(stream: Value = None) -> Value:
    """Let everything written to STREAM arrive soon."""
    output_stream(stream, "force-output").flush()
    return None


@function("(clear-output &optional stream)")
def clear_output(stream: Value = None) -> Value:
    """Do nothing: what is written is on its way at once."""
    output_stream(stream, "clear-output")
    return None
