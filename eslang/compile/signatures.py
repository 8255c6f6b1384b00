"""Signatures: what a registration says of the arguments, read once when needed.

A signature is a Lisp lambda list as text, such as "(member item list &key test)".
It is read here without the reader, since the compiler must not wait for it.
"""

from __future__ import annotations

from eslang.base.hints import Any, NamedTuple
from eslang.base.lists import Cons
from eslang.base.symbols import Value
from eslang.compile.registry import Definition

_CACHE: dict[str, Arity] = {}


class Arity(NamedTuple):
    """How many arguments: at least, at most (None: any number), and the keywords taken."""

    least: int
    most: int | None
    keywords: tuple[str, ...] | None  # None: no &key, or any keyword
    positional: int = 0  # how many stand before keywords

    def takes(self, count: int) -> bool:
        """True if COUNT arguments are right."""
        return count >= self.least and (self.most is None or count <= self.most)

    def phrase(self) -> str:
        """`2 arguments`, `1 to 3 arguments`, `at least 1 argument`."""
        if self.most is None:
            return f"at least {_count(self.least)}"
        if self.least == self.most:
            return _count(self.least) if self.least else "no arguments"
        return f"{self.least} to {self.most} arguments"


def _count(number: int) -> str:
    return f"{number} argument" if number == 1 else f"{number} arguments"


def arity(signature: str) -> Arity:
    """What SIGNATURE says of the number of arguments."""
    known = _CACHE.get(signature)
    if known is None:
        known = _CACHE[signature] = _arity(read_signature(signature)[1:])
    return known


def read_signature(text: str) -> list[Any]:
    """The elements of the lambda list TEXT: strings, and lists for what is nested."""
    stack: list[list[Any]] = [[]]
    for token in text.replace("(", " ( ").replace(")", " ) ").split():
        if token == "(":
            stack.append([])
        elif token == ")":
            inner = stack.pop()
            stack[-1].append(inner)
        else:
            stack[-1].append(token)
    result: list[Any] = stack[0][0]
    return result


def _arity(elements: list[Any]) -> Arity:
    least = most = 0
    section = ""
    keywords: list[str] = []
    unbounded = any_key = False
    for element in elements:
        if isinstance(element, str) and element.startswith("&"):
            section = element.lower()
            unbounded = unbounded or section in ("&rest", "&body", "&key")
            any_key = any_key or section == "&allow-other-keys"
        elif section == "":
            least, most = least + 1, most + 1
        elif section == "&optional":
            most += 1
        elif section == "&key":
            keywords.append(_keyword(element))
    has_keys = bool(keywords) and not any_key
    return Arity(least, None if unbounded else most, tuple(keywords) if has_keys else None, most)


def _keyword(element: Any) -> str:
    """The keyword, without its colon, of `name`, `(name default)` or `((:key name) default)`."""
    while not isinstance(element, str):
        element = element[0]
    return str(element).lstrip(":").upper()


def count_arguments(form: Cons) -> int | None:
    """How many arguments the form has; None if it is no proper list."""
    count = 0
    rest: Value = form.cdr
    while rest.__class__ is Cons:
        count += 1
        rest = rest.cdr
    return count if rest is None else None


def usage(definition: Definition) -> str:
    """`(name argument ...)`, as a person would write it."""
    return definition.signature.lower()
