"""The image: all that one interpreter knows by name.

Each symbol that means something here has a Cell: its value, its function, its
macro. Compiled code holds cells as constants, so that a global call is one
attribute away and a redefinition takes effect everywhere at once. An unset
slot is an unbound name: reading it raises Python's AttributeError, which the
runtime turns into :unbound-variable or :undefined-function.
"""

from __future__ import annotations

from eslang.base.hints import Callable
from eslang.base.packages import Package
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.base.words import STANDARD_WORDS

Function = Callable[..., Value]


class Cell:
    """What one symbol means in one interpreter."""

    __slots__ = (
        "constant",
        "definition",
        "function",
        "macro",
        "plist",
        "setf_expander",
        "setf_function",
        "special",
        "symbol",
        "symbol_macro",
        "type",
        "value",
    )
    function: Function
    value: Value
    setf_function: Function

    def __init__(self, symbol: Symbol | None) -> None:
        self.symbol = symbol
        self.special = False  # proclaimed special: LET binds it dynamically
        self.constant = False
        self.macro: Function | None = None  # (form, environment) -> form
        self.symbol_macro: list[Value] | None = None  # [expansion]
        self.setf_expander: Value = None  # what DEFSETF and its like left here
        self.definition: Value = None  # signature, documentation and place, for people
        self.plist: Value = None
        self.type: Value = None  # of a type's name: a Type (lisp/types.py), left by DEFSTRUCT and its like


class Image:
    """Packages and cells of one interpreter, and what its top-level forms have declared."""

    def __init__(self) -> None:
        self.cells: dict[Symbol | None, Cell] = {}
        self.packages: dict[str, Package] = {}
        self.sealed = False  # the library is there: nobody redefines the standard's operators any more
        self.special_forms: dict[Symbol, Value] = {}  # registry.Definition of each
        self.printing: Value = None  # the printer variables and what they mean (lisp/output.py)
        self.counters: dict[str, int] = {}  # GENSYM and its like: deterministic per interpreter
        self._define_packages()

    def _define_packages(self) -> None:
        for name, nicknames in (("KEYWORD", ()), ("COMMON-LISP", ("CL",)), ("ESL", ()), ("SCS", ())):
            self.add_package(Package(name, nicknames))
        cl, esl, scs = (self.packages[name] for name in ("CL", "ESL", "SCS"))
        cl.present["NIL"] = None  # type: ignore[assignment]
        cl.external.add("NIL")
        for name in ("T", *STANDARD_WORDS):
            cl.export(name)
        for name in ("ASSERT", "SIGNAL", "ABORT"):
            esl.shadow(name)
            esl.export(name)
        esl.use(cl)
        for name in ("DO", "DO*"):
            scs.shadow(name)
            scs.export(name)
        scs.use(cl)
        for name in ("ASSERT", "SIGNAL", "ABORT"):
            scs.import_symbol(esl.present[name], shadowing=True)
        scs.use(esl)
        for name, uses in (("CL-USER", (cl,)), ("ESL-USER", (esl, cl, scs)), ("SCS-USER", (scs, esl, cl))):
            package = self.add_package(Package(name, ("COMMON-LISP-USER",) if name == "CL-USER" else ()))
            for used in uses:
                package.use(used)
        for name in ("DO", "DO*"):
            self.packages["ESL-USER"].import_symbol(cl.intern(name), shadowing=True)  # type: ignore[arg-type]

    def add_package(self, package: Package) -> Package:
        """Make PACKAGE known by its name and nicknames."""
        for name in (package.name, *package.nicknames):
            self.packages[name] = package
        return package

    @property
    def package(self) -> Package:
        """The current package: the value of *PACKAGE*."""
        package: Package = self.cell(PACKAGE).value
        return package

    def cell(self, symbol: Symbol | None) -> Cell:
        """The cell of SYMBOL, made when first asked for."""
        cell = self.cells.get(symbol)
        if cell is None:
            cell = self.cells[symbol] = Cell(symbol)
            if isinstance(symbol, Keyword):
                cell.value, cell.constant = symbol, True
        return cell

    def is_fixed(self, symbol: Symbol) -> bool:
        """True if SYMBOL names a function or macro of Common Lisp, which programs may not redefine."""
        if not self.sealed or symbol.package != "COMMON-LISP":
            return False
        cell = self.cell(symbol)
        return cell.macro is not None or hasattr(cell, "function")

    def count(self, counter: str) -> int:
        """The next number of COUNTER, from 1."""
        number = self.counters[counter] = self.counters.get(counter, 0) + 1
        return number


PACKAGE = Symbol.intern("*PACKAGE*", "COMMON-LISP")
