"""Terms with variables inside a list: making them, and taking them apart."""

from __future__ import annotations

from eslang.base.hints import Callable, NamedTuple, Sequence
from eslang.base.lists import Cons
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.base.text import String
from eslang.facts.goals import ANYTHING, Constant, Nested, Term
from eslang.facts.terms import Code, Row, code_of, value_of
from eslang.facts.unify import is_variable

Leaf = Symbol | Constant
ITSELF = frozenset((int, float, Keyword, String, type(None)))  # classes of what is its own value for Lisp


class Written(NamedTuple):
    """An argument of a test as the program has it, and the values of the variables in it."""

    form: Value
    bindings: dict[Symbol, Value]


def filled(form: Value, bindings: dict[Symbol, Value]) -> Value:
    """FORM with the values of its variables."""
    if form.__class__ is Cons:
        return Cons(filled(form.car, bindings), filled(form.cdr, bindings))
    return bindings[form] if is_variable(form) else form


def written(code: Code) -> Value:
    """The argument of a test that is coded in CODE: itself, unless Lisp is to find out what it means."""
    value = value_of(code)
    return value if value.__class__ in ITSELF else Written(value, {})


def written_with(term: Nested) -> Callable[..., Written]:
    """What makes an argument of TERM, given codes for its leaves."""
    leaves = leaves_of(term)
    build = builder(term)

    def make(*codes: Code) -> Written:
        pairs = list(zip(leaves, codes, strict=True))
        form = build(*[leaf if isinstance(leaf, Symbol) else code for leaf, code in pairs])
        bindings = {leaf: value_of(code) for leaf, code in pairs if isinstance(leaf, Symbol)}
        return Written(value_of(form), bindings)

    return make


def leaves_of(term: Term | None) -> list[Leaf]:
    """The variables and constants in TERM, each once, in the order of their first occurrence; no ?_."""
    if term is None:
        return []
    if not isinstance(term, Nested):
        return [] if isinstance(term, Symbol) and term.name == ANYTHING else [term]
    found: dict[Leaf, None] = {}
    for part in (*term.parts, term.tail):
        found.update(dict.fromkeys(leaves_of(part)))
    return list(found)


def builder(term: Nested) -> Callable[..., Code]:
    """What makes the code of TERM of the codes of its leaves."""
    leaves = leaves_of(term)

    def value(part: Term, values: dict[Leaf, Value]) -> Value:
        if not isinstance(part, Nested):
            return values[part]
        result = None if part.tail is None else value(part.tail, values)
        for each in reversed(part.parts):
            result = Cons(value(each, values), result)
        return result

    def build(*codes: Code) -> Code:
        return code_of(value(term, dict(zip(leaves, map(value_of, codes), strict=True))))

    return build


Match = Callable[..., tuple[Code, ...] | None]


def matcher(terms: Sequence[Term], known: Sequence[Leaf], wanted: Sequence[Symbol]) -> Match:
    """What takes a row apart as TERMS say, given codes for KNOWN leaves: the codes of what is WANTED."""

    def match(row: Row, *codes: Code) -> tuple[Code, ...] | None:
        found: dict[Leaf, Code] = dict(zip(known, codes, strict=True))
        pending: list[tuple[Nested, Value]] = []
        for term, code in zip(terms, row, strict=True):
            if isinstance(term, Nested):
                pending.append((term, value_of(code)))
            elif not agrees(found, term, code):
                return None
        while pending:
            nested, value = pending.pop()
            for part in nested.parts:
                if value.__class__ is not Cons or not meets(part, value.car, found, pending):
                    return None
                value = value.cdr
            if not (value is None if nested.tail is None else meets(nested.tail, value, found, pending)):
                return None
        return tuple([found[variable] for variable in wanted])

    return match


def meets(part: Term, value: Value, found: dict[Leaf, Code], pending: list[tuple[Nested, Value]]) -> bool:
    """Whether PART may be VALUE, as far as can be said before what is PENDING."""
    if isinstance(part, Nested):
        pending.append((part, value))
        return True
    return agrees(found, part, code_of(value))


def agrees(found: dict[Leaf, Code], leaf: Leaf, code: Code) -> bool:
    """Whether LEAF stands for CODE by what was FOUND; if nothing was, it does from now on."""
    is_anything = isinstance(leaf, Symbol) and leaf.name == ANYTHING
    return is_anything or bool(found.setdefault(leaf, code) == code)
