"""Goals: what a query is made of, and what of it makes two queries alike.

A query is read into tokens, which say everything but the constants: queries
that differ in their constants only have the same tokens, and are compiled
once. From the tokens come the goals, with numbered places for the constants.
"""

from __future__ import annotations

from eslang.base.failure import STACK_EXHAUSTED, Failure, simple_error, type_error
from eslang.base.hints import Any, NamedTuple
from eslang.base.lists import Cons, items
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.facts.terms import DIRECT, Code, code_of, value_of
from eslang.facts.unify import is_variable

CL = "COMMON-LISP"
AND, OR, NOT = (Symbol.intern(name, CL) for name in ("AND", "OR", "NOT"))
FACT, RELATION = (Symbol.intern(name, "ESL") for name in ("FACT", "RELATION"))  # types, for messages
UNBOUND = Keyword("UNBOUND-LOGIC-VARIABLE")
DEEPEST = 500  # goals and terms with variables inside one another; what is made of them uses the C stack
CONNECTIVES = frozenset((AND, OR, NOT))
ANYTHING = "?_"

Tokens = tuple[Any, ...]
Constants = list[Code]
Given = dict[Symbol, Value]  # variables that are bound from outside


class _Mark:
    """A token that is no symbol."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __repr__(self) -> str:
        return self.name


OPEN, CLOSE, CONSTANT, GIVEN, LAST = (_Mark(each) for each in ("(", ")", "constant", "given", "."))
NOTHING_GIVEN: Given = {}


class Constant(NamedTuple):
    """A term that is known when the query is asked: the numbered constant."""

    number: int


class Nested(NamedTuple):
    """A term with variables inside a list: its parts, and what stands behind the last one."""

    parts: tuple[Term, ...]
    tail: Term | None


Term = Symbol | Constant | Nested  # a symbol is a variable


class Atom(NamedTuple):
    """A pattern, or the call of a test: a name and what it is said of."""

    name: Symbol
    terms: tuple[Term, ...]
    is_direct: bool = False  # what transitive rules derive is not asked for (transitive.py)


class Both(NamedTuple):
    """AND."""

    goals: tuple[Goal, ...]


class Either(NamedTuple):
    """OR."""

    goals: tuple[Goal, ...]


class Never(NamedTuple):
    """NOT."""

    goal: Goal


Goal = Atom | Both | Either | Never


def read_query(query: Value, given: Given = NOTHING_GIVEN) -> tuple[Tokens, Constants]:
    """The tokens of QUERY and its constants; variables that are GIVEN count as constants."""
    tokens: list[Any] = []
    constants: Constants = []
    _read_goal(query, given, tokens, constants, DEEPEST)
    tokens.pop()  # the last list's end is the query's
    return tuple(tokens), constants


def _read_goal(goal: Value, given: Given, tokens: list[Any], constants: Constants, room: int) -> None:
    if not room:
        raise Failure(STACK_EXHAUSTED)
    if goal.__class__ is not Cons:
        raise type_error(goal, "LIST")
    name = goal.car
    if not isinstance(name, Symbol) or is_variable(name):
        raise type_error(name, RELATION)
    tokens.append(name)
    parts = items(goal.cdr)
    if name in CONNECTIVES:
        if name is NOT and len(parts) != 1:
            raise simple_error("NOT takes one query, found", goal)
        for part in parts:
            _read_goal(part, given, tokens, constants, room - 1)
    else:
        for part in parts:
            kind = part.__class__
            if kind not in DIRECT or (kind is Symbol and part.name[:1] == "?"):
                _read_term(part, given, tokens, constants, room - 1)
            else:
                tokens.append(CONSTANT)
                constants.append(part)
    tokens.append(CLOSE)


def _read_term(term: Value, given: Given, tokens: list[Any], constants: Constants, room: int) -> None:
    if is_variable(term):
        if term in given and term.name != ANYTHING:
            tokens.append(GIVEN)
            constants.append(code_of(given[term]))
        tokens.append(term)
        return
    code = code_of(term)
    if variable_in(code) is None:
        tokens.append(CONSTANT)
        constants.append(code)
    elif not room:
        raise Failure(STACK_EXHAUSTED)
    else:
        tokens.append(OPEN)
        while term.__class__ is Cons:
            _read_term(term.car, given, tokens, constants, room - 1)
            term = term.cdr
        if term is not None:
            tokens.append(LAST)
            _read_term(term, given, tokens, constants, room - 1)
        tokens.append(CLOSE)


def variable_in(code: Code) -> Symbol | None:
    """The first logic variable in what CODE stands for."""
    for token in code if code.__class__ is tuple else (code,):
        if token.__class__ is Symbol and is_variable(token):
            return token
    return None


class Shape(NamedTuple):
    """A query without its constants."""

    goal: Goal
    variables: tuple[Symbol, ...]  # in the order of their first occurrence
    given: dict[Symbol, Constant]  # those that are bound from outside


class _Builder:
    """Makes goals of tokens."""

    def __init__(self, tokens: Tokens) -> None:
        self.tokens = iter(tokens)
        self.constants = 0
        self.variables: dict[Symbol, None] = {}
        self.given: dict[Symbol, Constant] = {}

    def goal(self, token: Any) -> Goal | None:
        """The goal that begins with TOKEN; None at the end of a list of goals."""
        if token is CLOSE:
            return None
        if token is AND or token is OR or token is NOT:
            goals: list[Goal] = []
            while (goal := self.goal(next(self.tokens, CLOSE))) is not None:
                goals.append(goal)
            if token is NOT:
                return Never(goals[0])
            return Both(tuple(goals)) if token is AND else Either(tuple(goals))
        return Atom(token, self.terms()[0])

    def terms(self) -> tuple[tuple[Term, ...], Term | None]:
        """The terms up to the end of a list, and the one behind a dot."""
        found: list[Term] = []
        tail = None
        for token in self.tokens:
            if token is CLOSE:
                break
            if token is LAST:
                tail = self.term(next(self.tokens))
            else:
                found.append(self.term(token))
        return tuple(found), tail

    def term(self, token: Any) -> Term:
        """The term that begins with TOKEN."""
        if token is CONSTANT:
            self.constants += 1
            return Constant(self.constants - 1)
        if token is OPEN:
            return Nested(*self.terms())
        if token is GIVEN:
            self.constants += 1
            token = next(self.tokens)
            self.given.setdefault(token, Constant(self.constants - 1))
        if token.name != ANYTHING:
            self.variables[token] = None
        return token  # type: ignore[no-any-return]


def shape_of(tokens: Tokens) -> Shape:
    """What TOKENS say."""
    builder = _Builder(tokens)
    goal = builder.goal(next(builder.tokens))
    assert goal is not None
    return Shape(goal, tuple(builder.variables), builder.given)


def variables_of(part: Goal | Term | None) -> dict[Symbol, None]:
    """The variables in PART, ?_ left out, in the order of their first occurrence."""
    if part is None or isinstance(part, Constant):
        return {}
    if isinstance(part, Symbol):
        return {} if part.name == ANYTHING else {part: None}
    if isinstance(part, Atom):
        inner: tuple[Any, ...] = part.terms
    elif isinstance(part, Nested):
        inner = (*part.parts, part.tail)
    else:
        inner = (part.goal,) if isinstance(part, Never) else part.goals
    found: dict[Symbol, None] = {}
    for each in inner:
        found.update(variables_of(each))
    return found


def has_anything(term: Term | None) -> bool:
    """Whether ?_ stands in TERM."""
    if isinstance(term, Nested):
        return any(has_anything(part) for part in (*term.parts, term.tail))
    return isinstance(term, Symbol) and term.name == ANYTHING


def form_of(part: Goal | Term | None, constants: Constants) -> Value:
    """PART as it was written."""
    if part is None or isinstance(part, Symbol):
        return part
    if isinstance(part, Constant):
        return value_of(constants[part.number])
    if isinstance(part, Atom):
        return Cons(part.name, _list_of(part.terms, None, constants))
    if isinstance(part, Nested):
        return _list_of(part.parts, part.tail, constants)
    name = NOT if isinstance(part, Never) else AND if isinstance(part, Both) else OR
    return Cons(name, _list_of((part.goal,) if isinstance(part, Never) else part.goals, None, constants))


def _list_of(parts: tuple[Any, ...], tail: Term | None, constants: Constants) -> Value:
    result = form_of(tail, constants)
    for part in reversed(parts):
        result = Cons(form_of(part, constants), result)
    return result


def unbound(variable: Symbol, goal: Value) -> Failure:
    """GOAL needs a value of VARIABLE, and nothing before it gives one."""
    return Failure(UNBOUND, variable, goal)
