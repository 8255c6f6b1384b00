"""Structures: the objects that DEFSTRUCT defines, and what is generated for them.

A structure is its type and a list of slot values. Readers, writers and the
like are closures made here; the macro, in stdlib/structures.esl, names them
and compiles the constructors.
"""

from __future__ import annotations

from eslang.base.arguments import UNSUPPLIED, take_keys
from eslang.base.failure import TYPE_ERROR, Failure, simple_error
from eslang.base.hashing import STRUCTURED
from eslang.base.hints import Any, Callable
from eslang.base.lists import items
from eslang.base.sharing import Part
from eslang.base.symbols import Datum, Symbol, Value, truth
from eslang.compile.registry import function
from eslang.lisp.streams import StringOutputStream
from eslang.lisp.types import LINE_OF, NAME_OF, Type, define_simple_type, define_type, find_type


class StructureType(Datum):
    """What a DEFSTRUCT defined; called with a value, it says whether that is one of its structures."""

    __slots__ = ("ancestors", "name", "printer", "slots")

    def __init__(self, name: Symbol, slots: Value, parent: StructureType | None) -> None:
        self.name = name
        self.slots = slots  # a list of (name default read-only accessor), inherited ones first
        self.ancestors: tuple[StructureType, ...] = (*parent.ancestors, parent) if parent is not None else ()
        self.printer: Any = None  # (structure, stream, escape) -> anything

    def __call__(self, value: Value) -> bool:
        return value.__class__ is Structure and (value.type is self or self in value.type.ancestors)

    def slot_names(self) -> list[str]:
        """The names of the slots, in order."""
        return [slot.car.name for slot in items(self.slots)]


class Structure(Datum):
    """One object of a structure type: its slots' values, in order."""

    __slots__ = ("items", "type")

    def __init__(self, kind: StructureType, values: list[Value]) -> None:
        self.type = kind
        self.items = values

    def lisp_parts(self) -> list[Any] | None:
        """#S(NAME :SLOT value ...) for the printer, unless the type has a printer of its own."""
        if self.printer() is not None:
            return None
        parts: list[Any] = ["#S(", Part(self.type.name)]
        for name, value in zip(self.type.slot_names(), self.items, strict=True):
            parts += [f" :{name} ", Part(value)]
        return [*parts, ")"]

    def print_lisp(self, settings: Any) -> str:
        """What the type's own printer writes."""
        stream = StringOutputStream()
        self.printer()(self, stream, truth(settings.escape))
        return stream.take()

    def printer(self) -> Any:
        """The innermost printer of this structure's type and those it includes."""
        for kind in (self.type, *reversed(self.type.ancestors)):
            if kind.printer is not None:
                return kind.printer
        return None


STRUCTURED[Structure] = lambda structure: [structure.type, *structure.items]
LINE_OF[StructureType] = lambda kind: [kind, *kind.ancestors]
NAME_OF[Structure] = lambda structure: structure.type.name
define_simple_type("STRUCTURE-OBJECT", lambda value: value.__class__ is Structure)


def find_structure_type(name: Value) -> StructureType | None:
    """The structure type called NAME, if the running program defined one."""
    kind = find_type(name)
    claim: Any = kind.includes if kind is not None else None
    return claim if claim.__class__ is StructureType else None


@function("(%structure-type name)")
def structure_type(name: Value) -> Value:
    """The structure type called NAME.

    Fails: with :error if there is none.
    """
    kind = find_structure_type(name)
    if kind is None:
        raise simple_error("this names no structure type:", name)
    return kind


@function("(%structure-slots name)")
def structure_slots(name: Value) -> Value:
    """The slots of the structure type NAME, each (name default read-only accessor)."""
    return structure_type(name).slots


@function("(%define-structure name parent slots printer)")
def define_structure(name: Symbol, parent: Value, slots: Value, printer: Value) -> Value:
    """Define the structure type NAME; return NAME.

    If it is defined as it was, the structures there are remain of the type.
    """
    included = structure_type(parent) if parent is not None else None
    kind = StructureType(name, slots, included)
    known = find_structure_type(name)
    if known is not None and known.ancestors == kind.ancestors and known.slot_names() == kind.slot_names():
        known.slots, kind = slots, known
    kind.printer = printer
    define_type(name, Type(includes=kind))
    return name


def _refuse(kind: StructureType, value: Value, accessor: Value) -> Failure:
    return Failure(TYPE_ERROR, value, kind.name, accessor)


def _named(function: Callable[..., Value], name: Value) -> Callable[..., Value]:
    """FUNCTION, called NAME in reports."""
    function.__name__ = function.__qualname__ = name.name
    return function


@function("(%structure type &rest values)")
def structure(kind: StructureType, *values: Value) -> Value:
    """A structure of TYPE with VALUES in its slots."""
    return Structure(kind, list(values))


@function("(%structure-constructor name constructor defaults)")
def structure_constructor(name: Value, constructor: Value, defaults: Value) -> Value:
    """The function CONSTRUCTOR, which makes structures of the type NAME from keywords.

    DEFAULTS has a cons (value . function) for each slot: what it holds by
    default, or the function that finds that.
    """
    kind = structure_type(name)
    names = tuple(kind.slot_names())
    places = {Symbol.intern(slot, "KEYWORD"): place for place, slot in enumerate(names)}
    given = [pair.car if pair.cdr is None else UNSUPPLIED for pair in items(defaults)]
    computed = [(place, pair.cdr) for place, pair in enumerate(items(defaults)) if pair.cdr is not None]

    def make(*options: Value) -> Value:
        values = given.copy()
        for index in range(len(options) - 2, -1, -2):
            place = places.get(options[index])
            if place is None:
                take_keys(options, names)  # fails, unless other keys are allowed
            else:
                values[place] = options[index + 1]
        if len(options) % 2:
            take_keys(options, names)
        for place, default in computed:
            if values[place] is UNSUPPLIED:
                values[place] = default()
        return Structure(kind, values)

    return _named(make, constructor)


@function("(%structure-reader name index accessor)")
def structure_reader(name: Value, index: int, accessor: Value) -> Value:
    """The function ACCESSOR, which reads slot INDEX of structures of the type NAME."""
    kind = structure_type(name)

    def read(structure: Value) -> Value:
        if structure.__class__ is Structure and (structure.type is kind or kind in structure.type.ancestors):
            return structure.items[index]
        raise _refuse(kind, structure, accessor)

    return _named(read, accessor)


@function("(%structure-writer name index accessor)")
def structure_writer(name: Value, index: int, accessor: Value) -> Value:
    """The function (SETF ACCESSOR), which writes slot INDEX of structures of the type NAME."""
    kind = structure_type(name)

    def write(value: Value, structure: Value) -> Value:
        if structure.__class__ is Structure and (structure.type is kind or kind in structure.type.ancestors):
            structure.items[index] = value
            return value
        raise _refuse(kind, structure, accessor)

    return _named(write, accessor)


@function("(%structure-predicate name predicate)")
def structure_predicate(name: Value, predicate: Value) -> Value:
    """The function PREDICATE, true of the structures of the type NAME."""
    kind = structure_type(name)
    return _named(lambda value: truth(kind(value)), predicate)


@function("(%structure-copier name copier)")
def structure_copier(name: Value, copier: Value) -> Value:
    """The function COPIER, which copies structures of the type NAME."""
    kind = structure_type(name)

    def copy(structure: Value) -> Value:
        if not kind(structure):
            raise _refuse(kind, structure, copier)
        return copy_structure(structure)

    return _named(copy, copier)


@function("(copy-structure structure)")
def copy_structure(structure: Value) -> Value:
    """Return a copy of STRUCTURE, with the same things in its slots.

    Fails: with :type-error if STRUCTURE is none.
    """
    if structure.__class__ is not Structure:
        raise Failure(TYPE_ERROR, structure, Symbol.intern("STRUCTURE-OBJECT", "COMMON-LISP"))
    return Structure(structure.type, list(structure.items))
