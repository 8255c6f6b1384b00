"""Wording: how Python code writes facts, patterns and queries.

A str is an atom as a plan would write it: a name, a keyword, a number, a
variable; what is text is a Text. A list is a list. A whole form may also be
one str, which begins with a parenthesis. No database is known here.
"""

from __future__ import annotations

from eslang.base.border import Text, to_lisp
from eslang.base.diagnostics import EslError
from eslang.base.failure import STACK_EXHAUSTED, Failure, simple_error, type_error
from eslang.base.hints import TYPE_CHECKING, Any, Iterable, Sequence
from eslang.base.image import Image
from eslang.base.lists import Cons, from_items
from eslang.base.resolve import Resolve, resolve_in
from eslang.base.spans import Source
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.base.text import String, Vector

if TYPE_CHECKING:
    from eslang.reader.reader import Reading

PLAIN = frozenset("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.:?*+/<>=!%&$")
DIRECT = frozenset((int, float, Symbol, Keyword, type(None), String, Cons))  # they stay what they are
DEEPEST = 5000  # lists inside one another; what is deeper may have no end
NO_TERMS: tuple[Any, ...] = ()


class Wording:
    """Makes Lisp's values of Python's; RESOLVE tells which symbol a name means."""

    __slots__ = ("_depth", "_known", "resolve")

    def __init__(self, resolve: Resolve) -> None:
        self.resolve = resolve
        self._known: dict[str, Value] = {}
        self._depth = 0  # of lists inside one another

    def form(self, first: Any, terms: Sequence[Any] = NO_TERMS) -> Value:
        """A fact, pattern or query: a whole one, or what it begins with and its TERMS."""
        if not terms:
            if isinstance(first, str) and first.__class__ is not Text and first.lstrip().startswith("("):
                return self._read(first)
            if first.__class__ is Cons:
                return first
            if isinstance(first, list | tuple):
                return self.listed(first)
        return self.listed((first, *terms))

    def relation(self, name: Any) -> Symbol:
        """The symbol that names a relation."""
        found = self.term(name)
        if not isinstance(found, Symbol):
            raise type_error(found, "SYMBOL")
        return found

    def row(self, row: Any, relation: Symbol | None) -> Value:
        """The fact that ROW is; or that its terms are, or it as the only one, if RELATION is told."""
        several = isinstance(row, list | tuple)
        if relation is None:
            if several or isinstance(row, str) or row.__class__ is Cons:
                return self.form(row)
        elif several:
            return Cons(relation, self.listed(row))
        elif row is None or isinstance(row, str | int | float | Symbol):
            return Cons(relation, self.listed((row,)))
        raise simple_error(f"a row is a list or a tuple, not of type {row.__class__.__name__}")

    def listed(self, terms: Iterable[Any]) -> Value:
        """TERMS as a Lisp list."""
        self._depth += 1
        if self._depth > DEEPEST:
            raise Failure(STACK_EXHAUSTED)
        made = from_items([self.term(term) for term in terms])
        self._depth -= 1
        return made

    def term(self, value: Any) -> Value:
        """What VALUE is for Lisp."""
        kind = value.__class__
        if kind is str:
            known = self._known
            if value not in known:
                known[value] = self._atom(value)
            return known[value]
        if kind in DIRECT:
            return value
        if kind is Text:
            return String(str.__str__(value))
        if isinstance(value, list | tuple):
            return self.listed(value)
        return self._atom(str.__str__(value)) if isinstance(value, str) else to_lisp(plain_number(value))

    def _atom(self, text: str) -> Value:
        """The atom that TEXT writes."""
        if text and PLAIN.issuperset(text):
            from eslang.reader.atoms import Unreadable, read_token

            try:
                return read_token(text, self.resolve)
            except Unreadable:
                return self._read(text)  # which tells the place, too
        text = text.strip()
        try:
            readings = self._readings(text)
        except EslError:
            readings = []
        if len(readings) != 1 or not is_atom(readings[0], text):
            raise simple_error(f"{text!r} is no name; for text, write Text({text!r})")
        return readings[0].form

    def _read(self, text: str) -> Value:
        """The one form in TEXT. Raises EslError if it cannot be read."""
        found = self._readings(text)
        if len(found) != 1:
            raise simple_error(f"one fact or query is expected, and here are {len(found)}", String(text))
        return found[0].form

    def _readings(self, text: str) -> list[Reading]:
        from eslang.reader.reader import read_forms

        return list(read_forms(Source("<fact>", text), self.resolve))


def is_atom(reading: Reading, text: str) -> bool:
    """Whether READING is an atom that can be named again, and all of TEXT: no comment stands beside it."""
    end = text.count("\n") + 1, len(text) - text.rfind("\n")
    is_whole = reading.span[1:] == (1, 1, *end)
    return is_whole and reading.form.__class__ not in (Cons, Vector) and not text.startswith("#:")


def resolve_unmade(image: Image) -> Resolve:
    """The function that finds the symbols that names mean in IMAGE, and makes none there.

    Where there is none, a symbol without a home stands for it.
    """
    known = resolve_in(image)

    def resolve(package_name: str | None, name: str, external_only: bool) -> Symbol | None:
        if package_name == "KEYWORD":
            return Symbol.intern(name, package_name)
        package = image.package if package_name is None else image.packages.get(package_name)
        if package is None or external_only:
            return known(package_name, name, external_only)
        symbol, found = package.find(name)
        return symbol if found else Symbol.uninterned(name)

    return resolve


def plain_number(value: Any) -> Any:
    """VALUE; as Python's own number, if it is one of another library's (of numpy's, say)."""
    if value.__class__ is bool:
        return value
    from numbers import Integral, Rational, Real

    if isinstance(value, Integral):
        return int(value)
    if isinstance(value, Real) and not isinstance(value, Rational):
        return float(value)
    return value


def key_of(variable: Symbol) -> str:
    """What a logic variable is called in Python: ?SENSOR is "sensor"."""
    return variable.name[1:].lower()


def copied(value: Any) -> Any:
    """VALUE as it is now, if it is made of lists: whoever made these may change them."""
    if isinstance(value, list | tuple):
        return [copied(each) for each in value]
    return value
