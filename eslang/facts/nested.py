"""Terms with variables inside a list: making them, and taking them apart."""

from __future__ import annotations

from eslang.base.hints import Callable, NamedTuple
from eslang.base.lists import Cons
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.base.text import String
from eslang.facts.goals import ANYTHING, Constant, Nested, Term
from eslang.facts.terms import Code, code_of, value_of
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


def matcher(term: Nested, known: list[Leaf], wanted: list[Symbol]) -> Callable[..., tuple[Code, ...] | None]:
    """What takes a code apart as TERM says, given codes for KNOWN leaves: the codes of what is WANTED."""

    def match(code: Code, *codes: Code) -> tuple[Code, ...] | None:
        found: dict[Leaf, Code] = dict(zip(known, codes, strict=True))
        pending: list[tuple[Term | None, Value]] = [(term, value_of(code))]
        while pending:
            part, value = pending.pop()
            if isinstance(part, Nested):
                for each in part.parts:
                    if value.__class__ is not Cons:
                        return None
                    pending.append((each, value.car))
                    value = value.cdr
                pending.append((part.tail, value))
            elif part is None:
                if value is not None:
                    return None
            elif not (isinstance(part, Symbol) and part.name == ANYTHING):
                seen = code_of(value)
                if found.setdefault(part, seen) != seen:
                    return None
        return tuple([found[variable] for variable in wanted])

    return match
