"""Values as Lisp text.

PRIN1 writes what the reader reads back, PRINC what people read. The work is
kept on a list and not on Python's stack, so that structures of any depth and
length print; a structure that contains itself prints with labels (#1=). What
the printer variables say comes as WriteSettings; nothing here reads them.
"""

from __future__ import annotations

from types import BuiltinFunctionType, FunctionType

from eslang.base.character_names import character_name
from eslang.base.failure import simple_error
from eslang.base.hints import Any, Callable, NamedTuple
from eslang.base.lists import Cons
from eslang.base.number_text import float_text, integer_text, rational_text
from eslang.base.packages import Package
from eslang.base.sharing import COMPOUND, Part, contains_itself, is_compound, object_parts, shared_parts
from eslang.base.symbol_text import symbol_text
from eslang.base.symbols import Datum, Keyword, Symbol, Value, lisp_name
from eslang.base.text import Array, Character, String, Vector

_PREFIXES = {
    Symbol.intern(name, package): prefix
    for package in ("COMMON-LISP", "ESL")
    for name, prefix in (
        ("QUOTE", "'"),
        ("FUNCTION", "#'"),
        ("QUASIQUOTE", "`"),
        ("UNQUOTE", ","),
        ("UNQUOTE-SPLICING", ",@"),
    )
}
_BACKQUOTES = {"`": 1, ",": -1, ",@": -1}
_LOGICAL_BINDING = Symbol.intern("LOGICAL-BINDING", "ESL")
_SUSPICIOUS = 20_000  # conses printed before we look whether the structure contains itself
_NESTED_OBJECTS = 50  # objects that print themselves, whole, inside one another


class WriteSettings(NamedTuple):
    """How to write: the printer variables, and how deep inside other objects we are."""

    escape: bool = True
    readably: bool = False
    base: int = 10
    radix: bool = False
    case: str = "UPCASE"
    length: int | None = None
    level: int | None = None
    circle: bool = False
    pretty: bool = False
    package: Package | None = None  # symbols are prefixed as this package needs; None: bare names
    packages: dict[str, Package] | None = None  # those of the image, to know external symbols
    depth: int = 0
    inside: tuple[Any, ...] = ()  # the objects that are printing themselves around this one


READABLE = WriteSettings()
PLAIN = WriteSettings(escape=False)


def prin1(value: Value, settings: WriteSettings = READABLE) -> str:
    """VALUE so that the reader reads it back, where it has such a text."""
    return write_text(value, settings if settings.escape else settings._replace(escape=True))


def princ(value: Value, settings: WriteSettings = PLAIN) -> str:
    """VALUE as people read it: strings without quotes, characters as themselves."""
    return write_text(value, settings._replace(escape=False) if settings.escape else settings)


def write_text(value: Value, settings: WriteSettings) -> str:
    """VALUE written as SETTINGS say."""
    if value.__class__ in _ATOMS or not is_compound(value):
        return atom_text(value, settings)
    if settings.circle:
        return _Printer(settings, shared_parts(value)).text_of(value)
    try:
        return _Printer(settings, None).text_of(value)
    except _Circular:
        return _Printer(settings, shared_parts(value)).text_of(value)


def atom_text(value: Value, settings: WriteSettings) -> str:
    """The text of a VALUE that is not made of others, or prints itself whole."""
    writer = _ATOMS.get(value.__class__)
    return writer(value, settings) if writer is not None else _object(value, settings)


def _symbol(value: Symbol | None, settings: WriteSettings) -> str:
    return symbol_text(value, settings.escape, settings.case, settings.package, settings.packages)


def _integer(value: int, settings: WriteSettings) -> str:
    if settings.radix:
        return rational_text(value, settings.base, True)
    return integer_text(value, settings.base)


def _float(value: float, settings: WriteSettings) -> str:
    return float_text(value)


def _string(value: Any, settings: WriteSettings) -> str:
    text: str = value if value.__class__ is str else value.text
    if not settings.escape:
        return text
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _character(value: Character, settings: WriteSettings) -> str:
    if not settings.escape:
        return value.char
    return "#\\" + (character_name(value.char) or value.char)


def _package(value: Package, settings: WriteSettings) -> str:
    return unreadable(f'PACKAGE "{value.name}"', value, settings)


def _function(value: Any, settings: WriteSettings) -> str:
    name = getattr(value, "lisp_name", None) or _name_of_function(value)
    shown = name if name.__class__ is str else write_text(name, settings)
    return unreadable(f"FUNCTION {shown}", value, settings)


def _name_of_function(function: Any) -> str:
    """What Lisp calls a function: registered and compiled ones carry it in their __qualname__."""
    name: str = function.__qualname__.partition("\0")[0]
    if name == name.upper() or name != function.__qualname__:
        return name.upper()
    return "LAMBDA" if function.__name__ == "<lambda>" else lisp_name(function.__name__)


def unreadable(text: str, value: Value, settings: WriteSettings) -> str:
    """#<TEXT>, for a VALUE that cannot be read back; a failure under *PRINT-READABLY*."""
    if settings.readably:
        raise simple_error("cannot be printed readably", value)
    return f"#<{text}>"


def _object(value: Value, settings: WriteSettings) -> str:
    if value.__class__.__name__ == "Ratio":
        return rational_text(value, settings.base, settings.radix)
    write_itself = getattr(type(value), "print_lisp", None)
    if write_itself is None:
        return unreadable(foreign_text(value), value, settings)
    if len(settings.inside) > _NESTED_OBJECTS or any(around is value for around in settings.inside):
        return "..."
    text = write_itself(value, settings._replace(inside=(*settings.inside, value)))
    return text if text.__class__ is str else str(text)


def foreign_text(value: Value) -> str:
    """A few words for a Python object that is no Lisp value."""
    if isinstance(value, Datum):  # one of ours, which asks the printer for its own text
        return type(value).__name__.upper()
    try:
        shown = " ".join(repr(value).split())
    except Exception:
        shown = "that cannot show itself"
    if len(shown) > 60:
        shown = shown[:57] + "..."
    return f"PYTHON {type(value).__name__} {shown}"


_Writer = Callable[[Any, WriteSettings], str]
_ATOMS: dict[type, _Writer] = {
    type(None): _symbol,
    Symbol: _symbol,
    Keyword: _symbol,
    int: _integer,
    float: _float,
    String: _string,
    str: _string,
    Character: _character,
    Package: _package,
    FunctionType: _function,
    BuiltinFunctionType: _function,
}


class _Circular(Exception):
    """The structure contains itself: print it again, with labels."""


class _Row(list[Value]):
    """One row of an array, printed as a list."""


class _Printer:
    """One printing of one compound value: the text so far, and the work still to do."""

    def __init__(self, settings: WriteSettings, shared: dict[int, int] | None) -> None:
        self.settings = settings
        self.shared = shared  # id of each part met twice → its label, 0 until it is printed
        self.labels = 0
        self.backquotes = 0  # how many are open here
        self.around: set[int] = set()  # the ids of the objects that are being written
        self.conses = 0
        self.out: list[str] = []
        self.work: list[tuple[Any, ...]] = []

    def text_of(self, value: Value) -> str:
        """The text of VALUE."""
        work = self.work
        work.append((self.write, value, self.settings.depth))
        if self.shared is None:
            self.value = value
        while work:
            job = work.pop()
            job[0](*job[1:])
        return "".join(self.out)

    def write(self, value: Value, depth: int) -> None:
        """Write VALUE, DEPTH levels down."""
        kind = value.__class__
        if kind in _ATOMS:
            self.out.append(atom_text(value, self.settings))
            return
        if self.shared is not None and id(value) in self.shared and self.labelled(value):
            return
        if kind is Cons and self.abbreviated(value, depth):
            return
        level = self.settings.level
        if level is not None and depth >= level and (kind in COMPOUND or kind is _Row):
            self.out.append("#")
        elif kind is Cons:
            self.out.append("(")
            self.write_list(value, depth + 1, 0)
        elif kind is Array:
            self.out.append(f"#{len(value.dimensions)}A")
            self.write(rows(value), depth)
        elif kind is Vector or kind is _Row:
            self.out.append("(" if kind is _Row else "#(")
            self.write_items(value if kind is _Row else value.active(), 0, depth + 1)
        else:
            self.write_object(value, depth)

    def write_object(self, value: Value, depth: int) -> None:
        """Write an object by its parts, if it tells them, else whole."""
        parts = object_parts(value)
        if parts is None:
            self.out.append(atom_text(value, self.settings._replace(depth=depth)))
            return
        if self.settings.level is not None and depth >= self.settings.level:
            self.out.append("#")
            return
        if id(value) in self.around:
            raise _Circular
        self.around.add(id(value))
        self.work.append((self.around.discard, id(value)))
        for part in reversed(parts):
            if part.__class__ is Part:
                self.work.append((self.write, part.value, depth + 1))
            else:
                self.work.append((self.out.append, part))

    def labelled(self, value: Value) -> bool:
        """Write the label of a shared VALUE; true if that is all there is to write."""
        assert self.shared is not None
        label = self.shared[id(value)]
        if label:
            self.out.append(f"#{label}#")
            return True
        self.labels += 1
        self.shared[id(value)] = self.labels
        self.out.append(f"#{self.labels}=")
        return False

    def abbreviated(self, lst: Cons, depth: int) -> bool:
        """Write 'x for (quote x), and its like; true if LST is of that kind."""
        prefix = _PREFIXES.get(lst.car) if isinstance(lst.car, Symbol) else None
        if prefix is None and lst.car is not _LOGICAL_BINDING:
            return False
        rest = lst.cdr
        if rest.__class__ is not Cons or rest.cdr is not None or (self.shared and id(rest) in self.shared):
            return False
        name = _symbol(rest.car, self.settings) if isinstance(rest.car, Symbol) else ""
        if prefix is None:
            if name.startswith("?"):
                self.out.append("#" + name)
            return name.startswith("?")
        step = _BACKQUOTES.get(prefix, 0)
        if self.backquotes + step < 0:  # a comma outside of any backquote would not read back
            return False
        self.out.append(", " if prefix == "," and name.startswith(("@", ".")) else prefix)
        self.backquotes += step
        self.work += [(self.leave, step), (self.write, rest.car, depth)]
        return True

    def leave(self, step: int) -> None:
        """Behind a backquote or comma, as many backquotes are open as before it."""
        self.backquotes -= step

    def write_list(self, rest: Value, depth: int, count: int) -> None:
        """Write the elements from REST on, COUNT having been written, and the closing parenthesis."""
        out, settings, length = self.out, self.settings, self.settings.length
        while rest.__class__ is Cons:
            if count:
                out.append(" ")
                if self.shared is not None and id(rest) in self.shared:
                    out.append(". ")
                    self.work += [(out.append, ")"), (self.write, rest, depth)]
                    return
            if length is not None and count >= length:
                out.append("...)")
                return
            car, rest, count = rest.car, rest.cdr, count + 1
            self.conses += 1
            if self.conses == _SUSPICIOUS and self.shared is None and contains_itself(self.value):
                raise _Circular
            if car.__class__ in _ATOMS:
                out.append(atom_text(car, settings))
            else:
                self.work += [(self.write_list, rest, depth, count), (self.write, car, depth)]
                return
        if rest is not None:
            out.append(" . ")
            self.work += [(out.append, ")"), (self.write, rest, depth)]
        else:
            out.append(")")

    def write_items(self, elements: list[Value], index: int, depth: int) -> None:
        """Write ELEMENTS from INDEX on, and the closing parenthesis."""
        out, length = self.out, self.settings.length
        for position in range(index, len(elements)):
            if position:
                out.append(" ")
            if length is not None and position >= length:
                out.append("...")
                break
            self.conses += 1
            if self.conses == _SUSPICIOUS and self.shared is None and contains_itself(self.value):
                raise _Circular
            if elements[position].__class__ in _ATOMS:
                out.append(atom_text(elements[position], self.settings))
            else:
                self.work.append((self.write_items, elements, position + 1, depth))
                self.work.append((self.write, elements[position], depth))
                return
        out.append(")")


def rows(array: Array) -> Value:
    """The elements of ARRAY as rows of rows; the element itself where the rank is 0."""
    level: list[Value] = list(array.items)
    if not array.dimensions:
        return level[0]
    for position in range(len(array.dimensions) - 1, 0, -1):
        size = array.dimensions[position]
        outer = 1
        for dimension in array.dimensions[:position]:
            outer *= dimension
        level = [_Row(level[i * size : (i + 1) * size]) for i in range(outer)]
    return _Row(level)
