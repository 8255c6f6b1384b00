"""The functions that answer a query, and those of the rules that it needs.

A query has up to four: two give all answers, as Python has them or as Lisp,
one the first, and one is a generator that gives them one at a time. The rules'
procs are generators, too, but for those that need their own answers: these
fill tables.
"""

from __future__ import annotations

from eslang.base.hints import Any, Callable, Iterable, NamedTuple
from eslang.base.lists import Cons
from eslang.base.symbols import Symbol
from eslang.facts.answers import FIRST, FOLLOW, GENERATES, LAZY, WAYS
from eslang.facts.goals import Constants
from eslang.facts.procs import Clause, Proc, reached_from
from eslang.facts.relations import EMPTY
from eslang.facts.source import (
    TABLE_NAMES,
    TABLE_OPENING,
    Body,
    Scope,
    Sink,
    Source,
    tuple_of,
)
from eslang.facts.steps import Steps
from eslang.facts.tables import Tables
from eslang.facts.terms import DIRECT, value_of
from eslang.facts.views import Accesses, Pace, View
from eslang.facts.walks import Stride, strides

LOOP = "for row in rows if rows.__class__ is tuple else paced(rows):"
SHARED = "EMPTY, DIRECT, value_of, Tables, Cons, new"  # by all queries
FACTORY = f"def make(view, call, paced, left, end, constants, objects, {SHARED}):"


class Question(NamedTuple):
    """A planned query."""

    steps: Steps
    variables: tuple[Symbol, ...]  # what a solution tells, in this order
    given: Scope  # those that are constants
    places: int  # of the constants that change from query to query
    constants: Constants  # these, and behind them those of the rules
    distinct: bool  # whether answers have to be compared, lest one be given twice


class Compiled(NamedTuple):
    """The functions of a query, compiled, and what they read."""

    make: Callable[[View, Any, Pace], Callable[..., Any]]  # a view, call, a pace → the function
    accesses: Accesses
    text: str


def compile_query(question: Question, kind: str) -> Compiled:
    """The function that answers QUESTION: with all answers, the first, or one at a time."""
    source = Source()
    procs = reached_from(question.steps)
    main = _main(source, question, kind, any(map(_is_tabled, procs)))
    for proc in procs:
        _proc(source, proc)
    text = _factory(source, question, procs, main)
    names: dict[str, Any] = {}
    exec(compile(text, "<query>", "exec"), names)
    outer = names["make"]
    fixed = (
        question.constants,
        source.objects,
        EMPTY,
        DIRECT,
        value_of,
        Tables,
        Cons,
        object.__new__,
    )

    def make(view: View, call: Any, pace: Pace) -> Callable[..., Any]:
        return outer(view, call, pace.rows, pace.pauses.left, pace.pauses.end, *fixed)  # type: ignore[no-any-return]

    return Compiled(make, Accesses(source.accesses), text)


def _factory(source: Source, question: Question, procs: list[Proc], main: str) -> str:
    """The text of the function that makes all others: what they share are its variables."""
    lines = [FACTORY]
    if source.accesses:
        names = ", ".join(source.accesses.values())
        lines += [f"    {names}, = view.readers()", "    def use(readers):"]
        lines += [f"        nonlocal {names}", f"        {names}, = readers", "    view.use = use"]
    lines += [f"    o{number} = objects[{number}]" for number in range(len(source.objects))]
    inner = range(question.places, len(question.constants))
    lines += [f"    c{number} = constants[{number}]" for number in inner]
    if any(proc.circle for proc in procs):
        lines += ["    memo = {}", "    tables = Tables(paced)"]
        lines += ["    complete = tables.complete", "    demand = tables.demand"]
    for text in source.functions:
        lines += ["    " + line for line in text.split("\n")]
    lines += [f"    tables.starts[{proc.number}] = p{proc.number}" for proc in procs if _is_tabled(proc)]
    return "\n".join([*lines, f"    return {main}", ""])


def _is_tabled(proc: Proc) -> bool:
    return bool(proc.circle) and not proc.is_linear()


def _main(source: Source, question: Question, kind: str, is_tabling: bool) -> str:
    """The query's own function; its name."""
    way = WAYS[kind]
    constants = tuple(f"c{number}" for number in range(question.places))
    is_sifted = question.distinct and kind != FIRST

    def finish(scope: Scope) -> list[str]:
        told = [each for each in question.variables if each in scope]
        give = way.give({source.object(each): source.value(scope[each]) for each in told})
        if not is_sifted:
            return give
        mark = tuple_of([scope.get(each, "EMPTY") for each in question.variables])
        return [f"mark = {mark}", "if mark not in seen:", "    seen.add(mark)", *_inner(give)]

    names = (*way.carried, *(("seen",) if is_sifted else ()), *constants)
    body = Body(source, Sink(finish, names, way.onward, way.ending), constants)
    body.lines += [*way.begin, *(("seen = set()",) if is_sifted else ())]
    body.emit(question.steps, dict(question.given), 0)
    lines = [*body.lines, *way.end]
    ends = ["if left:", "    end(view)"] if kind != LAZY else []
    ends += ["tables.clear()"] if is_tabling else []  # no garbage in circles
    if ends:
        lines = ["try:", *_inner(lines), "finally:", *_inner(ends)]
    source.add(f"def main({', '.join(constants)}):", lines)
    return "main"


def _inner(lines: Iterable[str]) -> list[str]:
    return ["    " + line for line in lines]


def _proc(source: Source, proc: Proc) -> None:
    """The function of the rules of PROC."""
    if not proc.circle:
        _plain(source, proc)
    elif proc.is_linear():
        _linear(source, proc)
    else:
        _tabled(source, proc)


def _keys(proc: Proc, letter: str = "k") -> list[str]:
    """The Python variables that hold what is known."""
    return [f"{letter}{place}" for place in proc.positions]


def _row(proc: Proc, clause: Clause, body: Body, scope: Scope, letter: str = "k") -> str:
    """The Python expression for an answer of CLAUSE."""
    return tuple_of(
        [
            f"{letter}{place}" if place in proc.positions else body.expression(term, scope)
            for place, term in enumerate(clause.head.terms)
        ]
    )


def _stored(source: Source, proc: Proc, keep: list[str]) -> list[str]:
    """The lines that take the facts themselves, which come before what is derived; KEEP takes a `row`."""
    access = source.access(proc.relation, proc.positions)
    keys = _keys(proc)
    inner = ["    " + line for line in keep]
    if len(keys) == proc.relation.arity:
        return [f"row = {tuple_of(keys)}", f"if {access}(row):", *inner]
    if not keys:
        return [f"for row in paced({access}()):", *inner]
    return [f"rows = {access}({keys[0] if len(keys) == 1 else tuple_of(keys)}, EMPTY)", LOOP, *inner]


def _clause(
    source: Source, proc: Proc, clause: Clause, base: Sink, save: Callable[[Body, Scope], list[str]]
) -> list[str]:
    """The lines of one rule; SAVE says what becomes of an answer."""
    steps = clause.steps
    body = Body(source, base, ())
    body.sink = base._replace(finish=lambda scope: save(body, scope))
    places = [(clause.head.terms[place], f"k{place}") for place in proc.positions]
    scope, depth = body.unify(places, {}, 0)
    mark = len(body.lines)
    body.emit(steps, scope, depth)
    if len(body.lines) == mark:
        body.line(depth, "pass")
    return body.lines


def _plain(source: Source, proc: Proc) -> None:
    """A generator, for rules that do not need themselves."""
    names = ("seen", *_keys(proc))
    keep = ["seen.add(row)", "yield row"]
    if len(proc.positions) == proc.relation.arity:
        keep = ["yield row", "return"]
    lines = ["seen = set()", *_stored(source, proc, keep)]
    base = Sink(lambda _: [], names, FOLLOW, GENERATES)
    for clause in proc.clauses:

        def save(body: Body, scope: Scope, clause: Clause = clause) -> list[str]:
            row = _row(proc, clause, body, scope)
            return [f"row = {row}", "if row not in seen:", "    seen.add(row)", "    yield row"]

        lines += _clause(source, proc, clause, base, save)
    source.add(f"def p{proc.number}({', '.join(_keys(proc))}):", [*lines, *GENERATES])


def _linear(source: Source, proc: Proc) -> None:
    """A generator that walks from question to question; what it finds answers the first of them."""
    roots = _keys(proc, "b")
    names = ("have", "asked", "agenda", *roots, *_keys(proc))
    keep = ["if row not in have:", "    have[row] = None", "    yield row"]
    rooted = tuple_of(
        [f"b{place}" if place in proc.positions else f"row[{place}]" for place in range(proc.relation.arity)]
    )
    inner = [f"{tuple_of(_keys(proc))} = key"] if proc.positions else []
    inner += _stored(source, proc, [f"row = {rooted}", *keep])
    base = Sink(lambda _: [], names, FOLLOW, GENERATES)
    for stride in strides(proc):

        def save(body: Body, scope: Scope, stride: Stride = stride) -> list[str]:
            lines = []
            if stride.answer is not None:
                told = stride.clause._replace(head=stride.answer)
                lines += [f"row = {_row(proc, told, body, scope, 'b')}", *keep]
            if stride.onward is not None:
                asked = [stride.onward.atom.terms[place] for place in stride.onward.positions]
                lines += [f"key = {tuple_of([body.expression(term, scope) for term in asked])}"]
                lines += ["if key not in asked:", "    asked[key] = None", "    agenda.append(key)"]
            return lines

        inner += _clause(source, proc, stride.clause, base, save)
    lines = [f"root = {tuple_of(roots)}", f"have = memo.get(({proc.number}, root))"]
    lines += ["if have is not None:", "    yield from have", "    return"]
    lines += ["have = {}", "asked = {root: None}", "agenda = [root]", "for key in paced(agenda):"]
    lines += ["    " + line for line in inner]
    lines += [f"memo[{proc.number}, root] = have"]
    source.add(f"def p{proc.number}({', '.join(roots)}):", [*lines, *GENERATES])


def _tabled(source: Source, proc: Proc) -> None:
    """A function that begins to fill a table."""
    keep = ["if row not in have:", "    have[row] = None", "    fresh.append(row)"]
    lines = [*TABLE_OPENING]
    lines += [f"{tuple_of(_keys(proc))} = key"] if proc.positions else []
    lines += _stored(source, proc, keep)
    base = Sink(lambda _: [], (*TABLE_NAMES, *_keys(proc)), ("{}",), circle=proc.circle)
    for clause in proc.clauses:

        def save(body: Body, scope: Scope, clause: Clause = clause) -> list[str]:
            return [f"row = {_row(proc, clause, body, scope)}", *keep]

        lines += _clause(source, proc, clause, base, save)
    source.add(f"def p{proc.number}(t, key, rows):", lines)
