"""Code as it is run: a text's global names, its functions, and their variants.

A text that was compiled before is run from here alone; nothing of the compiler
is loaded for it (cache.py). Unit (unit.py) is the kind of code that can still
grow.
"""

from __future__ import annotations

from types import CodeType, FunctionType

from eslang.base.hints import Any, Callable
from eslang.base.image import Image
from eslang.base.symbols import Symbol, Value

SEPARATOR = "\0"  # in a qualified name, between the name of a function and its number

Shape = tuple[CodeType | None, tuple[int, ...]]  # a variant's code, and where it finds its cells


class Code:
    """The global names of one text, and the variants of its functions by number."""

    def __init__(self, image: Image, support: dict[str, Any]) -> None:
        self.image = image
        self.globals: dict[str, Any] = dict(support)
        self.globals["%many"] = self.variant
        self.make_variants: Callable[[], dict[int, CodeType]] | None = None
        self.variants: dict[int, CodeType] = {}
        self.shapes: dict[str, Shape] = {}  # of the variants that were wanted

    def load(self, code: CodeType) -> FunctionType:
        """The function of a top-level form's code."""
        return FunctionType(code, self.globals)

    def add_cell(self, name: str, symbol: Symbol) -> None:
        """Let the global NAME be the cell of SYMBOL."""
        self.globals[name] = self.image.cell(symbol)

    def add_constant(self, name: str, value: Value) -> None:
        """Let the global NAME be a constant."""
        self.globals[name] = value

    def variant(self, function: FunctionType) -> FunctionType:
        """The variant of FUNCTION, one of ours, that gives all its values."""
        name = function.__code__.co_qualname
        shape = self.shapes.get(name)
        if shape is None:
            shape = self.shapes[name] = self._shape(function.__code__)
        code, places = shape
        if code is None:
            return function
        cells = function.__closure__
        closure = tuple([cells[place] for place in places]) if cells is not None else ()
        variant = FunctionType(code, self.globals, function.__name__, function.__defaults__, closure)
        variant.__qualname__ = function.__qualname__
        return variant

    def _shape(self, code: CodeType) -> Shape:
        """What makes the variant of a function with CODE."""
        made = self.variant_code(int(code.co_qualname.partition(SEPARATOR)[2] or 0))
        if made is None:
            return None, ()
        return made, tuple([code.co_freevars.index(name) for name in made.co_freevars])

    def variant_code(self, number: int) -> CodeType | None:
        """The code of function NUMBER that gives all its values; None if it always gives one."""
        if self.make_variants is not None:
            self.variants = self.make_variants()
            self.make_variants = None
        return self.variants.get(number)
