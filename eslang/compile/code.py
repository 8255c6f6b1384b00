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


class Code:
    """The global names of one text, and the variants of its functions by number."""

    def __init__(self, image: Image, support: dict[str, Any]) -> None:
        self.image = image
        self.globals: dict[str, Any] = dict(support)
        self.globals["%many"] = self.variant
        self.make_variants: Callable[[], dict[int, CodeType]] | None = None
        self.variants: dict[int, CodeType] = {}

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
        code = self.variant_code(int(function.__code__.co_qualname.partition(SEPARATOR)[2] or 0))
        if code is None:
            return function
        cells = dict(zip(function.__code__.co_freevars, function.__closure__ or (), strict=True))
        closure = tuple(cells[name] for name in code.co_freevars)
        variant = FunctionType(code, self.globals, function.__name__, function.__defaults__, closure)
        variant.__qualname__ = function.__qualname__
        return variant

    def variant_code(self, number: int) -> CodeType | None:
        """The code of function NUMBER that gives all its values; None if it always gives one."""
        if self.make_variants is not None:
            self.variants = self.make_variants()
            self.make_variants = None
        return self.variants.get(number)
