"""Making, reading and signalling conditions.

HANDLER-BIND and its like stand on the chain of recovery procedures, so both
are asked in one order, from the innermost form outward. The macros, and the
restarts, are Lisp (stdlib/conditions.esl).
"""

from __future__ import annotations

from eslang.base.failure import TYPE_ERROR, Failure, simple_error
from eslang.base.failure_text import message_of
from eslang.base.hints import Any
from eslang.base.lists import from_items, items
from eslang.base.many import many_of
from eslang.base.running import running, to_function
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.base.text import String
from eslang.compile.registry import function
from eslang.lisp.condition_types import (
    STANDARD,
    Condition,
    ConditionType,
    Slot,
    condition_type,
    is_condition_of,
    type_of_condition,
)
from eslang.lisp.types import Type, define_type
from eslang.runtime.failures import Clause, Form, run_form, signal

# --- defining and making -------------------------------------------------------------


@function("(%define-condition name parents slots readers report defaults)")
def define_condition(
    name: Symbol, parents: Value, slots: Value, readers: Value, report: Value, defaults: Value
) -> Value:
    """Define the condition type NAME; return NAME.

    SLOTS are lists (name initargs . default-function), READERS conses (reader .
    slot), DEFAULTS conses (keyword . function).
    """
    inherited = [condition_type(parent) for parent in items(parents)] or [STANDARD["CONDITION"]]
    own = [Slot(slot.car.name, items(slot.cdr.car), slot.cdr.cdr) for slot in items(slots)]
    kind = ConditionType(name, inherited, own)
    for parent in reversed(kind.line[1:]):
        kind.readers.update(parent.readers)
    kind.readers.update({entry.car: entry.cdr.name for entry in items(readers)})
    kind.report = report
    kind.defaults = [(entry.car, entry.cdr) for entry in items(defaults)]
    define_type(name, Type(includes=kind))
    causes = tuple(parent.cause for parent in inherited if STANDARD["ERROR"] in parent.line)
    running.session.causes.define(kind.cause, causes)
    return name


@function("(make-condition type &rest slot-initializations)")
def make_condition(name: Value, *initializations: Value) -> Value:
    """Return a condition of TYPE, with its slots as SLOT-INITIALIZATIONS say.

    Fails: with :error if TYPE is no condition type, or has no such slot.
    """
    kind = condition_type(name)
    if len(initializations) % 2:
        raise simple_error("keyword arguments come in pairs; the last has no value", initializations[-1])
    given = dict(zip(reversed(initializations[::2]), reversed(initializations[1::2]), strict=True))
    for one in kind.line:
        for keyword, default in one.defaults:
            if keyword not in given:
                given[keyword] = default()
    slots: dict[str, Value] = {}
    for slot in kind.slots:
        keywords = [keyword for keyword in slot.initargs if keyword in given]
        if keywords:
            slots[slot.name] = given[keywords[0]]
        elif slot.default is not None:
            slots[slot.name] = slot.default()
    known = {keyword for slot in kind.slots for keyword in slot.initargs}
    for keyword in given:
        if keyword not in known:
            raise simple_error("this condition type has no such slot:", name, keyword)
    return Condition(kind, slots)


@function("(%condition datum arguments default-type)")
def condition_of(datum: Value, arguments: Value, default: Value) -> Value:
    """The condition that DATUM and ARGUMENTS, as ERROR takes them, designate."""
    if isinstance(datum, Failure):
        return datum
    if isinstance(datum, Keyword):
        return Failure(datum, *items(arguments))
    if isinstance(datum, Symbol):
        return make_condition(datum, *items(arguments))
    return Condition(condition_type(default), {"FORMAT-CONTROL": datum, "FORMAT-ARGUMENTS": arguments})


# --- reading -------------------------------------------------------------------------


def _slot_value(condition: Value, name: str, reader: Value) -> Value:
    """What is in the slot NAME of CONDITION; of a host error, the argument that stands for it."""
    if condition.__class__ is Condition:
        if name in condition.slots:
            return condition.slots[name]
    else:
        names = [slot.name for slot in type_of_condition(condition).slots]
        place = names.index(name)
        if name == "OPERANDS":
            return from_items(condition.arguments[place:])
        if place < len(condition.arguments):
            return condition.arguments[place]
    raise simple_error("this slot of a condition has no value:", reader, condition)


@function("(%condition-reader name)")
def condition_reader(reader: Symbol) -> Value:
    """The function READER of a condition: finds its slot by the condition's type."""

    def read(condition: Value) -> Value:
        return _slot_value(condition, _slot_of(condition, reader), reader)

    read.__name__ = read.__qualname__ = reader.name
    return read


@function("(%condition-writer name)")
def condition_writer(reader: Symbol) -> Value:
    """The function (SETF READER) of a value and a condition."""

    def write(value: Value, condition: Value) -> Value:
        condition.slots[_slot_of(condition, reader)] = value
        return value

    write.__name__ = write.__qualname__ = reader.name
    return write


def _slot_of(condition: Value, reader: Symbol) -> str:
    if condition.__class__ is Condition and reader in condition.kind.readers:
        name: str = condition.kind.readers[reader]
        return name
    raise simple_error("this condition has no such slot:", reader, condition)


def _define_standard_readers(*lines: str) -> None:
    """Each line: the name of a type, then pairs of a reader and the slot it reads."""
    for line in lines:
        owner, *pairs = line.split()
        for reader, slot in zip(pairs[::2], pairs[1::2], strict=True):
            _define_standard_reader(STANDARD[owner], reader, slot)


def _define_standard_reader(kind: ConditionType, reader: str, slot: str) -> None:
    def read(condition: Value) -> Value:
        if not kind(condition):
            raise Failure(TYPE_ERROR, condition, kind.name, Symbol.intern(reader, "COMMON-LISP"))
        if slot.startswith("FORMAT-") and condition.__class__ is not Condition:
            text = message_of(condition).replace("~", "~~")
            return String(text) if slot == "FORMAT-CONTROL" else None
        return _slot_value(condition, slot, Symbol.intern(reader, "COMMON-LISP"))

    read.__name__ = read.__qualname__ = reader
    read.__doc__ = f"Return the {slot.lower().replace('-', ' ')} of CONDITION, a {kind.name.name}."
    function(f"({reader.lower()} condition)")(read)


_define_standard_readers(
    "SIMPLE-CONDITION SIMPLE-CONDITION-FORMAT-CONTROL FORMAT-CONTROL",
    "SIMPLE-CONDITION SIMPLE-CONDITION-FORMAT-ARGUMENTS FORMAT-ARGUMENTS",
    "TYPE-ERROR TYPE-ERROR-DATUM DATUM TYPE-ERROR-EXPECTED-TYPE EXPECTED-TYPE",
    "ARITHMETIC-ERROR ARITHMETIC-ERROR-OPERATION OPERATION ARITHMETIC-ERROR-OPERANDS OPERANDS",
    "CELL-ERROR CELL-ERROR-NAME NAME",
    "PACKAGE-ERROR PACKAGE-ERROR-PACKAGE PACKAGE",
    "FILE-ERROR FILE-ERROR-PATHNAME PATHNAME",
    "STREAM-ERROR STREAM-ERROR-STREAM STREAM",
)

# --- signalling ----------------------------------------------------------------------


def _clauses(entries: Value) -> tuple[tuple[Clause, ...], tuple[Any, ...]]:
    """The clauses of HANDLER-BIND, a list of conses (type . function), and their functions."""
    listed = items(entries)
    return tuple([_clause(entry.car) for entry in listed]), tuple(
        [to_function(entry.cdr) for entry in listed]
    )


def _clause(specifier: Value) -> Clause:
    return Clause(specifier, None, None, lambda failure: is_condition_of(failure, specifier))


def _call_with_clauses_many(clauses: Value, thunk: Value) -> Value:
    listed, functions = _clauses(clauses)
    return run_form(Form(), listed, functions, many_of(thunk))


@function("(%call-with-clauses clauses thunk)", many=_call_with_clauses_many)
def call_with_clauses(clauses: Value, thunk: Value) -> Value:
    """Call THUNK while CLAUSES, conses (type . function), are told of conditions; they may jump."""
    listed, functions = _clauses(clauses)
    return run_form(Form(), listed, functions, thunk)


@function("(error datum &rest arguments)")
def error(datum: Value, *arguments: Value) -> Value:
    """Fail, with the condition that DATUM and ARGUMENTS designate.

    DATUM is a format control for ARGUMENTS, the name of a condition type whose
    slots they fill, a condition, or a cause, as FAIL takes it.

    Returns: nothing; with a cause, what the recovery procedure returns.
    Fails:   with :error for a format control; with the keyword of the name for a type.
    """
    if isinstance(datum, Keyword):
        return signal(Failure(datum, *arguments), continuable=True)
    simple = Symbol.intern("SIMPLE-ERROR", "COMMON-LISP")
    return signal(condition_of(datum, from_items(arguments), simple), continuable=False)


@function("(%offer condition)")
def offer(condition: Value) -> Value:
    """Call what HANDLER-BIND and its like have for CONDITION, innermost first; NIL if none jumps."""
    dynamic = running.session.dynamic
    innermost = form = dynamic.forms
    try:
        while form is not None:
            dynamic.forms = form.outer
            for clause, procedure in zip(form.clauses, form.procedures, strict=True):
                if clause.takes is not None and clause.takes(condition):
                    procedure(condition)
            form = form.outer
    finally:
        dynamic.forms = innermost
    return None
