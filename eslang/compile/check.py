"""The checker: what can be known of a program without running it.

Definitions are run, since later forms may be written in what they define; all
else is analysed only. Then every global name that was met is looked up: is
there such a function, does it take so many arguments, is there such a variable?
"""

from __future__ import annotations

from types import CodeType

from eslang.base.diagnostics import Diagnostic, EslError, Label
from eslang.base.failure import Failure
from eslang.base.hints import Any, Callable, Iterable
from eslang.base.image import Image
from eslang.base.lists import Cons
from eslang.base.spans import Span, Spans
from eslang.base.suggest import nearest
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.compile.analyser import Use
from eslang.compile.core import Const
from eslang.compile.signatures import Arity, arity
from eslang.compile.toplevel import Compiler

VARIABLES = frozenset(("DEFVAR", "DEFPARAMETER", "DEFCONSTANT", "DEFEVENT"))
DEFINITIONS = frozenset(
    [
        "DEFUN",
        "DEFMACRO",
        "DEFSTRUCT",
        "DEFSETF",
        "DEFINE-SETF-EXPANDER",
        "DEFINE-MODIFY-MACRO",
        "DEFINE-CONDITION",
        "DEFPACKAGE",
        "DEFTYPE",
        "IN-PACKAGE",
        "DEFINE-SYMBOL-MACRO",
        "DEFINE-FAILURE",
        "EXPORT",
        "IMPORT",
        "USE-PACKAGE",
        "SHADOW",
        "SHADOWING-IMPORT",
        "DEFRELATION",
        "DEFPROPERTY",
        "DEFRULE",
        "DEFACTION",
        "DEFSTEP",
    ]
)


class Judge:
    """What is known of a program from all its uses of global names, if some of it could be analysed."""

    def __init__(self, image: Image, uses: list[Use], is_whole: bool) -> None:
        self.image = image
        self.uses = uses
        self.is_whole = is_whole  # all of it could

    def is_called(self, operator: Symbol) -> bool:
        """Whether a form that is a call or something else is a call, with OPERATOR."""
        return hasattr(self.image.cell(operator), "function")

    def told(self, diagnostic: Diagnostic, use: Use) -> Diagnostic | None:
        """How DIAGNOSTIC of USE is told, by who knows more of the program; None: not at all."""
        return diagnostic

    def verdicts(self) -> Iterable[Diagnostic]:
        """What else is wrong with the program."""
        return ()


class Checker:
    """Checks one program, of one text or more."""

    def __init__(
        self, image: Image, run: Callable[[Any, CodeType], Value], judge: Callable[..., Judge] = Judge
    ) -> None:
        self.image = image
        self.run = run  # runs code of a unit
        self.make_judge = judge
        self.is_whole = True  # all of the program could be analysed
        self.found: list[Diagnostic] = []
        self.uses: list[Use] = []
        self.assigned: set[Symbol] = set()

    def text(self, readings: Iterable[Any], compiler: Compiler) -> None:
        """Check the forms of one text, as far as it can be read."""
        compiler.uses = self.uses
        compiler.notices = self.found
        try:
            for reading in readings:
                self.form(compiler, reading.form, reading.spans, reading.span)
        except EslError as error:
            self.found.append(error.diagnostic)
            self.is_whole = False

    def form(self, compiler: Compiler, form: Value, spans: Spans, span: Span | None) -> None:
        """Check one top-level form; what is wrong with it does not keep the next from being checked."""
        name = form.car.name if form.__class__ is Cons and isinstance(form.car, Symbol) else ""
        before = len(self.uses)
        try:
            if name in VARIABLES and form.cdr.__class__ is Cons and isinstance(form.cdr.car, Symbol):
                self.image.cell(form.cdr.car).special = True
            for code in compiler.pieces(form, spans, span):
                if name in DEFINITIONS:
                    self.run(compiler.unit, code)
        except EslError as error:
            if not _is_for_want_of_a_value(error):
                self.found.append(error.diagnostic)
            del self.uses[before:]
            self.is_whole = False
        except Failure:
            pass  # a definition that cannot be made without running the program

    def finish(self) -> list[Diagnostic]:
        """All that was found, in the order of the text."""
        self.assigned = {use.symbol for use in self.uses if use.kind == "assignment"}
        judge = self.make_judge(self.image, self.uses, self.is_whole)
        for use in self.uses:
            diagnostic = self.judge(use) if all(map(judge.is_called, use.supposed)) else None
            diagnostic = judge.told(diagnostic, use) if diagnostic is not None else None
            if diagnostic is not None:
                self.found.append(diagnostic)
        self.found += judge.verdicts()
        return sorted(dict.fromkeys(self.found), key=_place)

    def judge(self, use: Use) -> Diagnostic | None:
        """What is wrong with the use of a global name, if anything is."""
        if use.kind == "call":
            return self.call(use)
        if use.kind == "function":
            return None if self.has_function(use.symbol) else self.unknown_function(use)
        cell = self.image.cell(use.symbol)
        known = cell.special or hasattr(cell, "value") or use.symbol in self.assigned
        if use.kind != "variable" or known:
            return None
        return self.unknown("variable", use, [*use.scope.visible("variable"), *self.variables()])

    def has_function(self, symbol: Symbol) -> bool:
        """True if SYMBOL names a function, a macro or a special form, now that all is defined."""
        cell = self.image.cell(symbol)
        return hasattr(cell, "function") or cell.macro is not None or symbol in self.image.special_forms

    def call(self, use: Use) -> Diagnostic | None:
        """A call of a global function: is there one, and does it take these arguments?"""
        if not self.has_function(use.symbol):
            return self.unknown_function(use)
        definition = self.image.cell(use.symbol).definition
        if definition is None or definition.kind != "function" or use.arguments is None:
            return None
        expected = arity(definition.signature)
        if not expected.takes(len(use.arguments)):
            message = f"`{_shown(use.symbol)}` takes {expected.phrase()}, found {len(use.arguments)}"
            return _diagnostic(
                "wrong-number-of-arguments", message, use, f"write `{definition.signature.lower()}`"
            )
        return self.keywords(use, expected, definition.signature)

    def keywords(self, use: Use, expected: Arity, signature: str) -> Diagnostic | None:
        """The keyword arguments of a call, where they can be seen."""
        if expected.keywords is None or "&rest" in signature.lower() or use.arguments is None:
            return None
        first = expected.positional
        for node in use.arguments[first::2]:
            if not isinstance(node, Const) or not isinstance(node.value, Keyword):
                return None
            name = node.value.name
            if name not in expected.keywords and name != "ALLOW-OTHER-KEYS":
                close = nearest(name, expected.keywords)
                hint = f"write `:{close.lower()}`" if close else None
                operator = _shown(use.symbol).removeprefix("%")  # the macro, not what it expands into
                message = f"`{operator}` has no keyword argument `:{name.lower()}`"
                return _diagnostic("unknown-keyword", message, use, hint)
        return None

    def unknown_function(self, use: Use) -> Diagnostic:
        """There is no function of that name."""
        return self.unknown("function", use, [*use.scope.visible("function"), *self.functions()])

    def unknown(self, kind: str, use: Use, names: Iterable[str]) -> Diagnostic:
        """There is nothing of that name; the hint tells the nearest name that there is."""
        close = nearest(use.symbol.name, names)
        hint = f"write `{close.lower()}`" if close else None
        if kind == "variable" and use.symbol.name.startswith("?"):
            hint = f"write `#{_shown(use.symbol)}` for what this logic variable is bound to"
        return _diagnostic(f"unknown-{kind}", f"there is no {kind} `{_shown(use.symbol)}`", use, hint)

    def functions(self) -> list[str]:
        """The names that can stand first in a form here."""
        return [s.name for s in self.image.package.accessible() if s is not None and self.has_function(s)]

    def variables(self) -> list[str]:
        """The names of the global variables here."""
        return [
            s.name for s in self.image.package.accessible() if s is not None and self.image.cell(s).special
        ]


def _shown(symbol: Symbol) -> str:
    return str(symbol).lower()


def _diagnostic(name: str, message: str, use: Use, hint: str | None) -> Diagnostic:
    labels = (Label(use.span),) if use.span is not None else ()
    return Diagnostic(name, message, labels, within=use.within, hint=hint)


def _is_for_want_of_a_value(error: EslError) -> bool:
    """True if a macro could not be expanded because a variable has no value before the program runs."""
    diagnostic = error.diagnostic
    return diagnostic.name == "macro-failed" and ":UNBOUND-VARIABLE" in diagnostic.message


def _place(diagnostic: Diagnostic) -> tuple[str, int, int]:
    if not diagnostic.labels:
        return "", 0, 0
    span = diagnostic.labels[0].span
    return span.source.name, span.line, span.column
