"""Lambda lists: parsed once, for functions, macros and destructuring alike.

A parsed lambda list is data; who binds it is functions.py (for code) and
destructuring.py (for macros). A destructuring lambda list may have a pattern
wherever an ordinary one has a variable, and may end in a dot.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from eslang.base.lists import Cons
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.compile.lambda_list_words import ALLOW, AUX, BODY, ENVIRONMENT, KEY, OPTIONAL, REST, WHOLE

_ORDER = {OPTIONAL: 1, REST: 2, BODY: 2, KEY: 3, ALLOW: 4, AUX: 5}


class BadLambdaList(Exception):
    """What is wrong with a lambda list, in words, and the element that is wrong."""

    def __init__(self, message: str, element: Value = None) -> None:
        super().__init__(message)
        self.message = message
        self.element = element


@dataclass(slots=True)
class Parameter:
    """An optional, keyword or auxiliary parameter."""

    name: Value  # a symbol; in destructuring, perhaps a pattern
    default: Value = None
    supplied: Symbol | None = None
    keyword: Symbol | None = None


@dataclass(slots=True)
class LambdaList:
    """The parts of a lambda list."""

    required: list[Value] = field(default_factory=list)
    optional: list[Parameter] = field(default_factory=list)
    rest: Value = None
    has_rest: bool = False
    keys: list[Parameter] | None = None
    allow_other_keys: bool = False
    aux: list[Parameter] = field(default_factory=list)
    whole: Symbol | None = None
    environment: Symbol | None = None

    @property
    def least(self) -> int:
        """The number of arguments there must be."""
        return len(self.required)

    @property
    def most(self) -> int | None:
        """The number of arguments there may be; None: any number."""
        if self.has_rest or self.keys is not None:
            return None
        return len(self.required) + len(self.optional)

    def names(self) -> list[Value]:
        """The names of all parameters but the auxiliary ones, in order."""
        found = list(self.required)
        for parameter in (
            *self.optional,
            *([Parameter(self.rest)] if self.has_rest else ()),
            *(self.keys or ()),
        ):
            found.append(parameter.name)
            if parameter.supplied is not None:
                found.append(parameter.supplied)
        return found


def parse_lambda_list(lst: Value, *, destructuring: bool = False) -> LambdaList:
    """The parts of LST; BadLambdaList says what is wrong with it."""
    return _Parser(destructuring).parse(lst)


class _Parser:
    """Walks a lambda list once, from section to section."""

    def __init__(self, destructuring: bool) -> None:
        self.destructuring = destructuring
        self.result = LambdaList()
        self.section = 0

    def parse(self, lst: Value) -> LambdaList:
        rest = lst
        while rest.__class__ is Cons:
            element = rest.car
            if isinstance(element, Symbol) and element.name.startswith("&") and len(element.name) > 1:
                rest = self.marker(element, rest)
            else:
                self.element(element)
                rest = rest.cdr
        if rest is not None:
            if not self.destructuring or self.result.has_rest:
                raise BadLambdaList("a lambda list ends in a dot", lst)
            self.result.rest, self.result.has_rest = rest, True
        return self.result

    def marker(self, marker: Symbol, rest: Cons) -> Value:
        """Enter the section that MARKER opens; the tail behind what it takes."""
        if marker in (WHOLE, ENVIRONMENT) and self.destructuring:
            if rest.cdr is None or not isinstance(rest.cdr.car, Symbol):
                raise BadLambdaList("a variable must follow this marker", marker)
            setattr(self.result, "whole" if marker is WHOLE else "environment", rest.cdr.car)
            return rest.cdr.cdr
        order = _ORDER.get(marker)
        if order is None:
            raise BadLambdaList("there is no such lambda list marker", marker)
        if order <= self.section or (marker is ALLOW and self.section != 3):
            raise BadLambdaList("this marker stands in the wrong place", marker)
        self.section = order
        if order == 2:
            if rest.cdr is None or rest.cdr.__class__ is not Cons:
                raise BadLambdaList("a variable must follow this marker", marker)
            self.result.rest, self.result.has_rest = self.name(rest.cdr.car), True
            return rest.cdr.cdr
        if order == 3:
            self.result.keys = []
        if order == 4:
            self.result.allow_other_keys = True
        return rest.cdr

    def element(self, element: Value) -> None:
        """Take one element of the section at hand."""
        if self.section == 0:
            self.result.required.append(self.name(element))
        elif self.section == 1:
            self.result.optional.append(self.parameter(element))
        elif self.section == 3 and self.result.keys is not None:
            self.result.keys.append(self.key_parameter(element))
        elif self.section == 5:
            self.result.aux.append(self.parameter(element))
        else:
            raise BadLambdaList("nothing but a marker can stand here", element)

    def name(self, element: Value) -> Value:
        """ELEMENT as what is bound: a variable, or a pattern where patterns may be."""
        if element.__class__ is Cons and self.destructuring:
            return element
        if element is None and self.destructuring:
            return None
        if not isinstance(element, Symbol) or isinstance(element, Keyword) or element.name == "T":
            raise BadLambdaList("this cannot be a parameter", element)
        return element

    def parameter(self, element: Value) -> Parameter:
        """`name`, `(name)`, `(name default)` or `(name default supplied-p)`."""
        if element.__class__ is not Cons:
            return Parameter(self.name(element))
        name, default, supplied = _three(element)
        return Parameter(self.name(name), default, supplied)

    def key_parameter(self, element: Value) -> Parameter:
        """As a parameter; its name may be `(keyword name)`."""
        name, default, supplied = _three(element) if element.__class__ is Cons else (element, None, None)
        if name.__class__ is Cons and isinstance(name.car, Symbol) and name.cdr.__class__ is Cons:
            return Parameter(self.name(name.cdr.car), default, supplied, name.car)
        variable = self.name(name)
        if not isinstance(variable, Symbol):
            raise BadLambdaList("a keyword parameter needs a name", element)
        return Parameter(variable, default, supplied, Keyword(variable.name))


def _three(element: Cons) -> tuple[Value, Value, Value]:
    """The one to three elements of a parameter specification."""
    parts: list[Value] = []
    rest: Value = element
    while rest.__class__ is Cons:
        parts.append(rest.car)
        rest = rest.cdr
    if rest is not None or len(parts) > 3:
        raise BadLambdaList("a parameter has a name, a default and a supplied-p variable, no more", element)
    parts += [None] * (3 - len(parts))
    if parts[2] is not None and not isinstance(parts[2], Symbol):
        raise BadLambdaList("a supplied-p parameter must be a variable", element)
    return parts[0], parts[1], parts[2]
