"""Conditions: what Common Lisp calls the things that can go wrong, and their types.

A failure is a condition. Its cause says of which standard type it is; a
condition that a program makes, of a standard type or of one that it defined,
is a Condition: a failure with a type of its own and slots.
"""

from __future__ import annotations

from eslang.base.failure import Failure, simple_error
from eslang.base.failure_text import message_of
from eslang.base.hints import Any
from eslang.base.lists import Cons, items
from eslang.base.printer import prin1
from eslang.base.running import running
from eslang.base.symbols import Datum, Keyword, Symbol, Value
from eslang.base.text import String
from eslang.lisp.streams import StringOutputStream
from eslang.lisp.types import LINE_OF, NAME_OF, define_simple_type, find_type, is_of_type


class Slot:
    """A slot of a condition type: its name, the keywords that give it a value, its first value."""

    __slots__ = ("default", "initargs", "name")

    def __init__(self, name: str, initargs: list[Value], default: Any = None) -> None:
        self.name = name
        self.initargs = initargs
        self.default = default  # a function without parameters; None: unbound


class ConditionType(Datum):
    """A type of conditions; called with a value, it says whether that is one of them."""

    __slots__ = ("defaults", "line", "name", "readers", "report", "slots", "standard")

    def __init__(
        self, name: Symbol, parents: list[ConditionType], slots: list[Slot], *, standard: bool = False
    ) -> None:
        self.name = name
        self.standard = standard  # one of Common Lisp's own
        self.line: list[ConditionType] = [self]  # itself and what it inherits from, nearest first
        for parent in parents:
            self.line += [kind for kind in parent.line if kind not in self.line]
        own = {slot.name for slot in slots}
        inherited: dict[str, Slot] = {}
        for kind in self.line[1:]:
            for slot in kind.slots:
                inherited.setdefault(slot.name, slot)
        self.slots: list[Slot] = slots + [slot for name, slot in inherited.items() if name not in own]
        self.readers: dict[Value, str] = {}  # the name of a reader -> that of its slot
        self.report: Any = None  # (condition, stream) -> anything
        self.defaults: list[tuple[Value, Any]] = []  # keyword, function without parameters

    def __call__(self, value: Value) -> bool:
        return isinstance(value, Failure) and self in type_of_condition(value).line

    def print_lisp(self, settings: Any) -> str:
        """A type that a program gets hold of prints as its name."""
        return prin1(self.name, settings)

    @property
    def cause(self) -> Keyword:
        """The cause of failures of this type."""
        cause = Symbol.intern(_CAUSES.get(self.name.name, self.name.name), "KEYWORD")
        assert isinstance(cause, Keyword)
        return cause


class Condition(Failure):
    """A condition that a program made."""

    def __init__(self, kind: ConditionType, slots: dict[str, Value]) -> None:
        super().__init__(kind.cause)
        self.kind = kind
        self.slots = slots
        self.arguments = self._arguments()

    def __repr__(self) -> str:
        return f"{self.__class__.__name__}({self.kind.name}, {self.slots})"

    def __str__(self) -> str:
        """For Python; it may be its own argument, and its report may be Lisp."""
        return super().__str__() if self.kind.standard else f"failure {self.cause}"

    def _arguments(self) -> tuple[Value, ...]:
        """What a recovery clause for it receives: as host errors give it, or the condition itself."""
        if not self.kind.standard:
            return (self,)
        filled = [slot.name for slot in self.kind.slots if slot.name in self.slots]
        own = [self.slots[name] for name in filled if not name.startswith("FORMAT-")]
        return (String(self._formatted()),) if filled and not own else tuple(own)

    def _formatted(self) -> str:
        control = self.slots["FORMAT-CONTROL"]
        arguments = items(self.slots.get("FORMAT-ARGUMENTS"))
        form = running.session.image.cell(FORMAT).function
        return str(form(None, control, *arguments).text)

    def print_lisp(self, settings: Any) -> str:
        """For people, its message; else #<TYPE>, with the message where that is all there is."""
        simple = self.kind.standard and "FORMAT-CONTROL" in self.slots
        if settings.escape:
            return f"#<{self.kind.name.name}{' ' + prin1(String(self._formatted())) if simple else ''}>"
        for kind in self.kind.line:
            if kind.report is not None:
                stream = StringOutputStream()
                kind.report(self, stream)
                return stream.take()
        if "FORMAT-CONTROL" in self.slots:
            return self._formatted()
        if self.kind.standard and self.arguments:
            return message_of(self)
        return f"Condition {self.kind.name.name} was signalled."


FORMAT = Symbol.intern("FORMAT", "COMMON-LISP")

# --- the standard types --------------------------------------------------------------

_CAUSES = {"SIMPLE-ERROR": "ERROR", "SIMPLE-TYPE-ERROR": "TYPE-ERROR"}  # a type's cause, if not its own name
_TYPE_NAMES = {  # a cause's type, if not its own name
    "ERROR": "SIMPLE-ERROR",
    "WRONG-NUMBER-OF-ARGUMENTS": "PROGRAM-ERROR",
    "STACK-EXHAUSTED": "STORAGE-CONDITION",
}
STANDARD: dict[str, ConditionType] = {}


def _define_standard_types(*lines: str) -> None:
    """Each line: the name of a type, its parents, and its slots in parentheses."""
    for line in lines:
        words, _, slots = line.partition("(")
        name, *parents = words.split()
        kind = ConditionType(
            Symbol.intern(name, "COMMON-LISP"),
            [STANDARD[parent] for parent in parents],
            [Slot(slot, [Keyword(slot)]) for slot in slots.rstrip(")").split()],
            standard=True,
        )
        STANDARD[name] = kind
        define_simple_type(name, kind)


_define_standard_types(
    "CONDITION",
    "SIMPLE-CONDITION CONDITION (FORMAT-CONTROL FORMAT-ARGUMENTS)",
    "WARNING CONDITION",
    "STYLE-WARNING WARNING",
    "SIMPLE-WARNING SIMPLE-CONDITION WARNING",
    "SERIOUS-CONDITION CONDITION",
    "ERROR SERIOUS-CONDITION",
    "STORAGE-CONDITION ERROR",
    "SIMPLE-ERROR SIMPLE-CONDITION ERROR",
    "TYPE-ERROR ERROR (DATUM EXPECTED-TYPE)",
    "SIMPLE-TYPE-ERROR SIMPLE-CONDITION TYPE-ERROR",
    "ARITHMETIC-ERROR ERROR (OPERATION OPERANDS)",
    "DIVISION-BY-ZERO ARITHMETIC-ERROR",
    "FLOATING-POINT-OVERFLOW ARITHMETIC-ERROR",
    "PROGRAM-ERROR ERROR",
    "CONTROL-ERROR ERROR",
    "CELL-ERROR ERROR (NAME)",
    "UNBOUND-VARIABLE CELL-ERROR",
    "UNDEFINED-FUNCTION CELL-ERROR",
    "PARSE-ERROR ERROR",
    "PACKAGE-ERROR ERROR (PACKAGE)",
    "FILE-ERROR ERROR (PATHNAME)",
    "STREAM-ERROR ERROR (STREAM)",
    "END-OF-FILE STREAM-ERROR",
    "READER-ERROR PARSE-ERROR STREAM-ERROR",
)


def type_of_condition(failure: Failure) -> ConditionType:
    """The type of FAILURE: its own, or the one that its cause names, or ERROR."""
    if failure.__class__ is Condition:
        kind: ConditionType = failure.kind
        return kind
    name = failure.condition or failure.cause.name
    return STANDARD.get(_TYPE_NAMES.get(name, name), STANDARD["ERROR"])


LINE_OF[ConditionType] = lambda kind: kind.line
NAME_OF[Failure] = NAME_OF[Condition] = lambda value: type_of_condition(value).name


def find_condition_type(name: Value) -> ConditionType | None:
    """The condition type called NAME."""
    kind = find_type(name)
    claim: Any = kind.includes if kind is not None else None
    if claim.__class__ is ConditionType:
        found: ConditionType = claim
        return found
    if isinstance(name, Symbol) and name.package == "COMMON-LISP":
        return STANDARD.get(name.name)
    return None


def condition_type(name: Value) -> ConditionType:
    """The condition type called NAME; a failure if there is none."""
    kind = find_condition_type(name)
    if kind is None:
        raise simple_error("this names no condition type:", name)
    return kind


def is_condition_of(failure: Value, specifier: Value) -> bool:
    """Whether FAILURE is of the type SPECIFIER, in which a keyword means a cause."""
    if isinstance(specifier, Keyword):
        return bool(running.session.causes.answers(specifier, failure.cause))
    if specifier.__class__ is Cons and specifier.car is OR:
        return any(is_condition_of(failure, part) for part in items(specifier.cdr))
    return is_of_type(failure, specifier)


OR = Symbol.intern("OR", "COMMON-LISP")
