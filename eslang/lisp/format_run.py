"""One running of FORMAT: its arguments, one after the other, and where its text goes.

A directive answers how to go on: GO_ON, or what ~^ asked for, which each
enclosing directive passes outward or takes.
"""

from __future__ import annotations

from eslang.base.symbols import Value
from eslang.base.text import Character
from eslang.lisp.format_control import COUNT, Directive, Items, V
from eslang.lisp.streams import OutputStream, StringOutputStream

GO_ON = 0
LEAVE = 1  # ~^: out of the iteration's step, the justification or the whole string
LEAVE_ALL = 2  # ~:^: out of the iteration
_MOST = 10_000_000  # no width or count is larger


class Run:
    """The arguments of one control string, and the stream it writes to."""

    __slots__ = ("arguments", "out", "outer", "place")

    def __init__(self, out: OutputStream, arguments: list[Value], outer: Run | None = None) -> None:
        self.out = out
        self.arguments = arguments
        self.place = 0
        self.outer = outer  # of a step of ~:{, the run that holds the lists still to come

    def perform(self, items: Items) -> int:
        """Do what ITEMS say; how to go on afterwards."""
        for item in items:
            if item.__class__ is str:
                self.out.write(item)
            else:
                way: int = item.perform(self, item)
                if way:
                    return way
        return GO_ON

    def captured(self, items: Items) -> tuple[str, int]:
        """What ITEMS write, kept from the stream, and how to go on."""
        out = self.out
        self.out = kept = StringOutputStream()
        kept.column = out.column
        try:
            way = self.perform(items)
        finally:
            self.out = out
        return kept.take(), way

    @property
    def left(self) -> int:
        """How many arguments are left."""
        return len(self.arguments) - self.place

    def next(self, directive: Directive) -> Value:
        """The next argument; a failure of DIRECTIVE if there is none."""
        if self.place >= len(self.arguments):
            raise directive.wrong("no argument left")
        self.place += 1
        return self.arguments[self.place - 1]

    def parameters(self, directive: Directive, *defaults: Value) -> list[Value]:
        """The parameters of DIRECTIVE, V and # replaced, DEFAULTS for those left out."""
        values = list(defaults)
        for index, parameter in enumerate(directive.parameters):
            if parameter.__class__ is str:
                parameter = self._given(parameter, directive)
            if parameter is not None:
                values[index] = parameter
        for value, default in zip(values, defaults, strict=True):
            expected = Character if default.__class__ is Character else int
            if value is not None and value.__class__ is not expected and default is not ANY:
                what = "a character" if expected is Character else "an integer"
                raise directive.wrong(f"a parameter is not {what}", value)
            if value.__class__ is int and abs(value) > _MOST:
                raise directive.wrong("a parameter is too large", value)
        return values

    def _given(self, parameter: str, directive: Directive) -> Value:
        if parameter == COUNT:
            return self.left
        assert parameter == V
        return self.next(directive)


ANY: Value = object()  # the default of a parameter that may be an integer or a character
