"""The tables of names: what a plan can say, each with its Lisp signature.

A registration is data. It happens once, when a room is imported; every
interpreter installs the tables into its own image. The signature is the only
source of arity checks, usage messages, completion and the reference pages; it
is parsed when one of them first asks (signatures.py). The docstring is the
documentation.
"""

from __future__ import annotations

from eslang.base.hints import Any, Callable, F

CL, ESL, SCS = "COMMON-LISP", "ESL", "SCS"


class Definition:
    """One name a plan can say: kind is function, macro, special form or variable."""

    __slots__ = ("documentation", "implementation", "kind", "many", "name", "package", "signature", "where")

    def __init__(
        self, kind: str, name: str, package: str, signature: str, implementation: Any, many: Any = None
    ) -> None:
        self.kind = kind
        self.name = name
        self.package = package
        self.signature = signature
        self.implementation = implementation
        self.many = many
        self.documentation: str | None = None  # None: the implementation's docstring
        self.where: str | None = None  # file:line:column, for what Lisp defined

    def doc(self) -> str:
        """The docstring, as the author wrote it."""
        return self.documentation or getattr(self.implementation, "__doc__", None) or ""


DEFINITIONS: list[Definition] = []


def _register(kind: str, signature: str, package: str, many: Any) -> Callable[[F], F]:
    name = signature[1:].split(None, 1)[0].rstrip(")").upper()

    def decorate(implementation: F) -> F:
        if kind == "function":
            _call_by_name(name, implementation, many)
        DEFINITIONS.append(Definition(kind, name, package, signature, implementation, many))
        return implementation

    return decorate


def _call_by_name(name: str, *implementations: Any) -> None:
    """Let Python, when the arguments are too few or too many, speak of NAME; the first one stays."""
    for implementation in implementations:
        if implementation is not None and not implementation.__qualname__.isupper():
            implementation.__qualname__ = name


def function(
    signature: str, package: str = CL, *, many: Callable[..., Any] | None = None
) -> Callable[[F], F]:
    """Register a Lisp function. It takes Lisp values by position; keyword arguments come in *options.

    `many`, if given, is the variant that returns a `Values` (base/many.py) to whoever asks
    for multiple values; the function itself returns the primary value alone.
    """
    return _register("function", signature, package, many)


def macro(signature: str, package: str = CL) -> Callable[[F], F]:
    """Register a macro: a Python function (form, environment) -> form."""
    return _register("macro", signature, package, None)


def special_form(signature: str, package: str = CL) -> Callable[[F], F]:
    """Register a special form: a Python function (analyser, form, scope) -> Node."""
    return _register("special form", signature, package, None)


def variable(name: str, value: Any, doc: str, package: str = CL, *, constant: bool = False) -> None:
    """Register a global special variable (or constant) with its first value; a callable makes it."""
    definition = Definition("constant" if constant else "variable", name.upper(), package, name, value)
    definition.documentation = doc
    DEFINITIONS.append(definition)
