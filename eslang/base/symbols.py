"""Symbols: names that are compared by identity.

A symbol is interned by its home package and name, once per process; what it
names (value, function, macro) differs from interpreter to interpreter and is
kept in an Image (image.py). NIL is Python's None, so that a Lisp test is an
`is` test; T is an ordinary symbol. Packages are packages.py.
"""

from __future__ import annotations

from eslang.base.hints import Any

Value = Any  # any Lisp value; the one place where Any is honest
NIL = None


class Datum:
    """Base of all our values that are no numbers: they refuse arithmetic.

    Compiled code adds with Python's +; this is what makes (+ "a" 1) a failure
    that names the datum instead of a surprise.
    """

    __slots__ = ()

    def __add__(self, other: Value) -> Value:
        raise _no_number(self, "+")

    def __sub__(self, other: Value) -> Value:
        raise _no_number(self, "-")

    def __mul__(self, other: Value) -> Value:
        raise _no_number(self, "*")

    def __truediv__(self, other: Value) -> Value:
        raise _no_number(self, "/")

    def __floordiv__(self, other: Value) -> Value:
        raise _no_number(self, "floor")

    def __mod__(self, other: Value) -> Value:
        raise _no_number(self, "mod")

    def __neg__(self) -> Value:
        raise _no_number(self, "-")

    def __lt__(self, other: Value) -> bool:
        raise _no_number(self, "<")

    def __le__(self, other: Value) -> bool:
        raise _no_number(self, "<=")

    def __gt__(self, other: Value) -> bool:
        raise _no_number(self, ">")

    def __ge__(self, other: Value) -> bool:
        raise _no_number(self, ">=")

    def __repr__(self) -> str:
        from eslang.base.printer import prin1  # for people at a Python prompt

        return prin1(self)

    __radd__, __rsub__, __rmul__ = __add__, __sub__, __mul__
    __rtruediv__, __rfloordiv__, __rmod__ = __truediv__, __floordiv__, __mod__


def _no_number(datum: Datum, operator: str) -> Exception:
    from eslang.base.failure import type_error  # failures are made of symbols

    return type_error(datum, "NUMBER", operator)


class Symbol(Datum):
    """An interned name. `Symbol("is-a")` is ESL-USER's; `.name` is the bare name."""

    __slots__ = ("name", "package")
    name: str
    package: str | None  # the name of the home package; None: uninterned

    _table: dict[tuple[str, str], Symbol] = {}

    def __new__(cls, name: str, package: str = "ESL-USER") -> Symbol:
        return Symbol.intern(name.upper(), package.upper())

    @staticmethod
    def intern(name: str, package: str) -> Symbol:
        """The one symbol NAME (as it stands, not upcased) whose home is PACKAGE."""
        key = (package, name)
        symbol = Symbol._table.get(key)
        if symbol is None:
            symbol = object.__new__(Keyword if package == "KEYWORD" else Symbol)
            symbol.name, symbol.package = name, package
            symbol = Symbol._table.setdefault(key, symbol)
        return symbol

    @staticmethod
    def uninterned(name: str) -> Symbol:
        """A fresh symbol without a home, as GENSYM makes them."""
        symbol = object.__new__(Symbol)
        symbol.name, symbol.package = name, None
        return symbol

    def __str__(self) -> str:
        return f"#:{self.name}" if self.package is None else self.name

    def __repr__(self) -> str:
        return f"Symbol({str(self)!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        if self.package is None:
            return Symbol.uninterned, (self.name,)
        return Symbol.intern, (self.name, self.package)

    def __copy__(self) -> Symbol:
        return self

    def __deepcopy__(self, memo: Any) -> Symbol:
        return self


class Keyword(Symbol):
    """A symbol that means itself: `Keyword("two")` is :TWO."""

    __slots__ = ()

    def __new__(cls, name: str) -> Keyword:
        keyword = Symbol.intern(name.upper(), "KEYWORD")
        assert isinstance(keyword, Keyword)
        return keyword

    def __str__(self) -> str:
        return f":{self.name}"

    def __repr__(self) -> str:
        return f"Keyword({self.name!r})"


T = Symbol.intern("T", "COMMON-LISP")


def lisp_name(python_name: str) -> str:
    """The Lisp name of a Python one: with_recovery_procedures → WITH-RECOVERY-PROCEDURES."""
    return python_name.strip("_").replace("_", "-").upper()


def truth(flag: bool) -> Value:
    """Python's truth as Lisp's: T or NIL."""
    return T if flag else None
