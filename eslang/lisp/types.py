"""Types: what TYPEP, TYPE-OF and TYPECASE know.

A type is a symbol or a list (NAME . ARGUMENTS). The built-in ones are tables
here; those that a program defines hang from the cell of their name, as a Type.
"""

from __future__ import annotations

from eslang.base.calls import spread
from eslang.base.failure import simple_error
from eslang.base.hashing import HashTable
from eslang.base.hints import Any, Callable, NamedTuple
from eslang.base.lists import Cons, from_items, items
from eslang.base.number_kinds import is_number, is_ratio, is_rational
from eslang.base.packages import Package
from eslang.base.running import running, to_function
from eslang.base.sameness import is_eql
from eslang.base.symbols import Keyword, Symbol, T, Value, truth
from eslang.base.text import Array, Character, String, Vector
from eslang.compile.registry import function
from eslang.lisp.predicates import (
    is_array,
    is_function,
    is_list,
    is_symbol,
    is_vector,
)

Claim = Callable[[Value], bool]
_FIXNUM = 1 << 62


class Type(NamedTuple):
    """A type that a program defined: a test of its instances, or what it is short for."""

    includes: Claim | None = None
    expand: Callable[..., Value] | None = None  # DEFTYPE's: arguments -> a type specifier


NAME_OF: dict[type, Callable[[Value], Value]] = {}  # class -> what TYPE-OF says of its instances
LINE_OF: dict[
    type, Callable[[Any], list[Any]]
] = {}  # class of a claim -> the claims it goes with, itself first


def define_type(name: Symbol, kind: Type) -> None:
    """Let NAME be a type in the running interpreter."""
    running.session.image.cell(name).type = kind


def find_type(name: Value) -> Type | None:
    """The type that the running program defined as NAME."""
    if running.session is None or not isinstance(name, Symbol):
        return None
    kind: Type | None = running.session.image.cell(name).type
    return kind


def expand_type(specifier: Value) -> Value:
    """SPECIFIER with what DEFTYPE defined, at its head, replaced by what it is short for."""
    while True:
        head, arguments = _parted(specifier)
        kind = find_type(head)
        if kind is None or kind.expand is None:
            return specifier
        specifier = spread(kind.expand, arguments)


def _parted(specifier: Value) -> tuple[Value, list[Value]]:
    if specifier.__class__ is Cons:
        return specifier.car, items(specifier.cdr)
    return specifier, []


def is_of_type(value: Value, specifier: Value) -> bool:
    """Whether VALUE is of the type SPECIFIER."""
    claim = named_type(specifier)
    if claim is not None:
        return claim(value)
    specifier = expand_type(specifier)
    head, arguments = _parted(specifier)
    if not arguments:
        claim = named_type(head)
        if claim is not None:
            return claim(value)
    if head in _COMPOUND:
        return _COMPOUND[head](value, arguments)
    raise simple_error("unknown type specifier", specifier)


def named_type(name: Value) -> Claim | None:
    """What says whether a value is of the type NAME; None if it is no name of one."""
    if name.__class__ is Cons:
        return None
    claim = _SIMPLE.get(name)
    if claim is None:
        kind = find_type(name)
        return kind.includes if kind is not None else None
    return claim


def _names(*pairs: tuple[str, Claim]) -> dict[Value, Claim]:
    return {Symbol.intern(name, "COMMON-LISP"): claim for words, claim in pairs for name in words.split()}


def is_standard_char(value: Value) -> bool:
    """A printing ASCII character, a space or a newline."""
    return value.__class__ is Character and (" " <= value.char <= "~" or value.char == "\n")


def is_simple(value: Value) -> bool:
    """An array without a fill pointer."""
    return value.__class__ is Array or (is_vector(value) and (value.fill is None or value.fill is False))


_SIMPLE: dict[Value, Claim] = {
    T: lambda value: True,
    None: lambda value: False,
    **_names(
        ("NULL", lambda value: value is None),
        ("ATOM", lambda value: value.__class__ is not Cons),
        ("CONS", lambda value: value.__class__ is Cons),
        ("LIST", is_list),
        ("SYMBOL", is_symbol),
        ("KEYWORD", lambda value: value.__class__ is Keyword),
        ("BOOLEAN", lambda value: value is None or value is T),
        ("NUMBER REAL", is_number),
        ("RATIONAL", is_rational),
        ("RATIO", is_ratio),
        ("INTEGER SIGNED-BYTE", lambda value: value.__class__ is int),
        ("UNSIGNED-BYTE", lambda value: value.__class__ is int and value >= 0),
        ("BIT", lambda value: value.__class__ is int and 0 <= value <= 1),
        ("FIXNUM", lambda value: value.__class__ is int and -_FIXNUM <= value < _FIXNUM),
        ("BIGNUM", lambda value: value.__class__ is int and not -_FIXNUM <= value < _FIXNUM),
        ("FLOAT DOUBLE-FLOAT SINGLE-FLOAT SHORT-FLOAT LONG-FLOAT", lambda value: value.__class__ is float),
        ("COMPLEX BIT-VECTOR SIMPLE-BIT-VECTOR EXTENDED-CHAR PATHNAME", lambda value: False),
        ("CHARACTER BASE-CHAR", lambda value: value.__class__ is Character),
        ("STANDARD-CHAR", is_standard_char),
        ("STRING BASE-STRING", lambda value: value.__class__ is String),
        ("SIMPLE-STRING SIMPLE-BASE-STRING", lambda value: value.__class__ is String and not value.fill),
        ("VECTOR", is_vector),
        ("SIMPLE-VECTOR", lambda value: value.__class__ is Vector and value.fill is None),
        ("ARRAY", is_array),
        ("SIMPLE-ARRAY", is_simple),
        ("SEQUENCE", lambda value: is_list(value) or is_vector(value)),
        ("FUNCTION COMPILED-FUNCTION", is_function),
        ("HASH-TABLE", lambda value: value.__class__ is HashTable),
        ("PACKAGE", lambda value: value.__class__ is Package),
    ),
}


def define_simple_type(names: str, claim: Claim, package: str = "COMMON-LISP") -> None:
    """Make NAMES built-in types of PACKAGE: for the files below this one."""
    _SIMPLE.update({Symbol.intern(name, package): claim for name in names.split()})


def _ask(value: Value, specifiers: list[Value], answer: bool) -> bool:
    """ANSWER, if VALUE gives it to one of SPECIFIERS; else the opposite."""
    for specifier in specifiers:
        if is_of_type(value, specifier) is answer:
            return answer
    return not answer


def _member(value: Value, arguments: list[Value]) -> bool:
    return any(is_eql(value, argument) for argument in arguments)


def _satisfies(value: Value, arguments: list[Value]) -> bool:
    return to_function(arguments[0])(value) is not None


def _is_star(argument: Value) -> bool:
    return isinstance(argument, Symbol) and argument.name == "*"


def _within(value: Value, limits: list[Value]) -> bool:
    """Whether VALUE lies between the limits (LOW HIGH): numbers, (EXCLUSIVE) or *."""
    for limit, sign in zip(limits, (1, -1), strict=False):
        if limit.__class__ is Cons:
            if sign * (value - limit.car) <= 0:
                return False
        elif not _is_star(limit) and sign * (value - limit) < 0:
            return False
    return True


def _limited(claim: Claim) -> Callable[[Value, list[Value]], bool]:
    return lambda value, arguments: claim(value) and _within(value, arguments)


def _bytes(low: int, high: int) -> Callable[[Value, list[Value]], bool]:
    def includes(value: Value, arguments: list[Value]) -> bool:
        if value.__class__ is not int:
            return False
        if not arguments or _is_star(arguments[0]):
            return low < 0 or bool(value >= 0)
        bits = arguments[0]
        return bool(low << (bits - 1) <= value < high << (bits - 1))

    return includes


def _cons(value: Value, arguments: list[Value]) -> bool:
    if value.__class__ is not Cons:
        return False
    for part, specifier in zip((value.car, value.cdr), arguments, strict=False):
        if not _is_star(specifier) and not is_of_type(part, specifier):
            return False
    return True


def _has_elements(value: Value, specifier: Value) -> bool:
    if _is_star(specifier):
        return True
    holds_characters = isinstance(specifier, Symbol) and specifier.name.endswith(("CHARACTER", "CHAR"))
    return holds_characters == (value.__class__ is String)


def _dimensions(value: Value) -> list[int]:
    if value.__class__ is Array:
        return list(value.dimensions)
    return [len(value.text if value.__class__ is String else value.items)]


def _array(claim: Claim) -> Callable[[Value, list[Value]], bool]:
    def includes(value: Value, arguments: list[Value]) -> bool:
        if not claim(value) or (arguments and not _has_elements(value, arguments[0])):
            return False
        if len(arguments) < 2 or _is_star(arguments[1]):
            return True
        actual, wanted = _dimensions(value), arguments[1]
        if wanted.__class__ is int:
            return len(actual) == wanted
        sizes = items(wanted)
        return len(sizes) == len(actual) and all(
            _is_star(size) or size == length for size, length in zip(sizes, actual, strict=True)
        )

    return includes


def _sized(name: str) -> Callable[[Value, list[Value]], bool]:
    """Types such as (STRING N): what NAME includes, with so many elements."""
    claim = _SIMPLE[Symbol.intern(name, "COMMON-LISP")]
    return lambda value, sizes: claim(value) and (_is_star(sizes[0]) or _dimensions(value) == [sizes[0]])


def _vector(value: Value, arguments: list[Value]) -> bool:
    if not is_vector(value) or (arguments and not _has_elements(value, arguments[0])):
        return False
    return len(arguments) < 2 or _is_star(arguments[1]) or _dimensions(value) == [arguments[1]]


_COMPOUND: dict[Value, Callable[[Value, list[Value]], bool]] = {
    Symbol.intern(name, "COMMON-LISP"): test
    for words, test in (
        ("AND", lambda value, arguments: _ask(value, arguments, False)),
        ("OR", lambda value, arguments: _ask(value, arguments, True)),
        ("NOT", lambda value, arguments: not is_of_type(value, arguments[0])),
        ("MEMBER EQL", _member),
        ("SATISFIES", _satisfies),
        ("INTEGER", _limited(lambda value: value.__class__ is int)),
        ("RATIONAL", _limited(is_rational)),
        ("REAL", _limited(is_number)),
        (
            "FLOAT SINGLE-FLOAT DOUBLE-FLOAT SHORT-FLOAT LONG-FLOAT",
            _limited(lambda value: value.__class__ is float),
        ),
        ("MOD", lambda value, arguments: value.__class__ is int and 0 <= value < arguments[0]),
        ("UNSIGNED-BYTE", _bytes(0, 2)),
        ("SIGNED-BYTE", _bytes(-1, 1)),
        ("CONS", _cons),
        ("ARRAY", _array(is_array)),
        ("SIMPLE-ARRAY", _array(is_simple)),
        ("VECTOR", _vector),
        ("STRING BASE-STRING", _sized("STRING")),
        ("SIMPLE-STRING SIMPLE-BASE-STRING", _sized("SIMPLE-STRING")),
        ("SIMPLE-VECTOR", _sized("SIMPLE-VECTOR")),
        ("FUNCTION", lambda value, arguments: is_function(value)),
    )
    for name in words.split()
}


@function("(typep object type-specifier &optional environment)")
def typep(value: Value, specifier: Value, _environment: Value = None) -> Value:
    """True if OBJECT is of the type TYPE-SPECIFIER.

    Fails: :error, where TYPE-SPECIFIER is no type.
    """
    return truth(is_of_type(value, specifier))


def _symbol(name: str) -> Symbol:
    return Symbol.intern(name, "COMMON-LISP")


def _type_of_integer(value: Value) -> Value:
    if 0 <= value <= 1:
        return _symbol("BIT")
    return _symbol("FIXNUM" if -_FIXNUM <= value < _FIXNUM else "BIGNUM")


def _type_of_array(value: Value) -> Value:
    sizes = from_items(_dimensions(value))
    if value.__class__ is Vector and value.fill is None:
        return from_items([_symbol("SIMPLE-VECTOR"), sizes.car])
    element = _symbol("CHARACTER") if value.__class__ is String else T
    if is_simple(value):
        return from_items([_symbol("SIMPLE-ARRAY"), element, sizes])
    return from_items([_symbol("VECTOR"), element, sizes.car])


NAME_OF.update(
    {
        type(None): lambda value: _symbol("NULL"),
        Symbol: lambda value: _symbol("BOOLEAN" if value is T else "SYMBOL"),
        Keyword: lambda value: _symbol("KEYWORD"),
        Cons: lambda value: _symbol("CONS"),
        int: _type_of_integer,
        float: lambda value: _symbol("DOUBLE-FLOAT"),
        Character: lambda value: _symbol("STANDARD-CHAR" if is_standard_char(value) else "CHARACTER"),
        String: _type_of_array,
        Vector: _type_of_array,
        Array: _type_of_array,
        HashTable: lambda value: _symbol("HASH-TABLE"),
        Package: lambda value: _symbol("PACKAGE"),
    }
)


@function("(type-of object)")
def type_of(value: Value) -> Value:
    """Return the most specific type of OBJECT that has a name.

    Of a foreign object, the name of its class.
    """
    name_of = NAME_OF.get(value.__class__)
    if name_of is not None:
        return name_of(value)
    if is_ratio(value):
        return _symbol("RATIO")
    if is_function(value):
        return _symbol("FUNCTION")
    return Symbol(value.__class__.__name__)


@function("(%define-type name expander)")
def _define_type(name: Symbol, expander: Value) -> Value:
    """Let the type NAME be short for what EXPANDER makes of its arguments."""
    _check_type_name(name)
    define_type(name, Type(expand=to_function(expander)))
    return name


@function("(%check-type-name name)")
def _check_type_name(name: Symbol) -> Value:
    """Fail if NAME is that of a type which a program cannot define."""
    if name in _SIMPLE or name in _COMPOUND:
        owner = "ESL" if name.package == "ESL" else "Common Lisp"
        remedy = "choose another name, or shadow it in a package of your own"
        raise simple_error(f"{name.name} is a type of {owner}; {remedy}")
    return None
