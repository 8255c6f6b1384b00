"""Forms that the naive evaluator knows: jumps, iterations, and the answering of failures."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from eslang.base.lists import Cons, items
from eslang.base.symbols import Keyword, Symbol, Value
from naive.evaluator import CONTROL_ERROR, Clauses, Environment, Jump, Naive, Place, form

ALWAYS = 10**9
THIS_FORM = "this form"

# --- jumps ---------------------------------------------------------------------------


@form("BLOCK")
def block(naive: Naive, env: Environment, name: Value, *forms: Value) -> list[Value]:
    place = Place()
    return naive.land(place, lambda: naive.body(forms, Environment(env, "block", name, place)))


@form("RETURN-FROM")
def return_from(naive: Naive, env: Environment, name: Value, value: Value = None) -> list[Value]:
    given = naive.eval(value, env)
    return naive.leave(env.find("block", name).meaning, given)


@form("RETURN")
def return_(naive: Naive, env: Environment, value: Value = None) -> list[Value]:
    return return_from(naive, env, None, value)


@form("CATCH")
def catch(naive: Naive, env: Environment, tag: Value, *forms: Value) -> list[Value]:
    place = Place(naive.one(tag, env))
    naive.catches.append(place)
    depth = len(naive.catches)

    def run() -> list[Value]:
        try:
            return naive.body(forms, env)
        finally:
            del naive.catches[depth - 1 :]

    return naive.land(place, run)


@form("THROW")
def throw(naive: Naive, env: Environment, tag: Value, value: Value) -> list[Value]:
    wanted, given = naive.one(tag, env), naive.eval(value, env)
    for place in reversed(naive.catches):
        if place.tag is wanted:
            return naive.leave(place, given)
    return naive.signal(CONTROL_ERROR, [])


@form("TAGBODY")
def tagbody(naive: Naive, env: Environment, *statements: Value) -> list[Value]:
    place = Place()
    for number, statement in enumerate(statements):
        if statement.__class__ is not Cons:
            env = Environment(env, "tag", statement, (place, number))
    start = 0
    try:
        while True:
            try:
                naive.body([s for s in statements[start:] if s.__class__ is Cons], env)
                return [None]
            except Jump as jump:
                if jump.target is not place:
                    raise
                start = jump.values[0]
    finally:
        place.live = False


@form("GO")
def go(naive: Naive, env: Environment, tag: Value) -> list[Value]:
    place, number = env.find("tag", tag).meaning
    return naive.leave(place, [number])


@form("UNWIND-PROTECT")
def unwind_protect(naive: Naive, env: Environment, protected: Value, *cleanup: Value) -> list[Value]:
    try:
        return naive.eval(protected, env)
    finally:
        naive.body(cleanup, env)


# --- iterations ----------------------------------------------------------------------


@form("DOTIMES")
def dotimes(naive: Naive, env: Environment, head: Value, *forms: Value) -> list[Value]:
    name, count, *result = items(head)
    place = Place()
    inner = Environment(env, "block", None, place)

    def run() -> list[Value]:
        times = naive.one(count, inner)
        counter = Environment(inner, "variable", name, 0)
        while counter.meaning < times:
            tagbody(naive, counter, *forms)
            counter.meaning += 1
        return naive.body(result, counter)

    return naive.land(place, run)


@form("DOLIST")
def dolist(naive: Naive, env: Environment, head: Value, *forms: Value) -> list[Value]:
    name, lst, *result = items(head)
    place = Place()
    inner = Environment(env, "block", None, place)

    def run() -> list[Value]:
        for element in items(naive.one(lst, inner)):
            tagbody(naive, Environment(inner, "variable", name, element), *forms)
        return naive.body(result, Environment(inner, "variable", name, None))

    return naive.land(place, run)


@form("DO")
def do(naive: Naive, env: Environment, head: Value, ending: Value, *forms: Value) -> list[Value]:
    place = Place()
    outer = Environment(env, "block", None, place)
    parts = [[*items(each), None][:3] if each.__class__ is Cons else [each, None] for each in items(head)]
    steps = [(items(each)[0], items(each)[2]) for each in items(head) if len(items(each)) == 3]

    def run(inner: Environment) -> list[Value]:
        while naive.one(ending.car, inner) is None:
            tagbody(naive, inner, *forms)
            stepped = [(name, naive.one(step, inner)) for name, step in steps]
            for name, value in stepped:
                naive.assign(name, value, inner)
        return naive.body(items(ending.cdr), inner)

    def start() -> list[Value]:
        first = [(part[0], naive.one(part[1], outer)) for part in parts]
        return naive.bind(first, outer, run)

    return naive.land(place, start)


# --- failures ------------------------------------------------------------------------


def with_clauses(naive: Naive, clauses: Clauses, body: Callable[[], list[Value]]) -> list[Value]:
    """The values of BODY, with CLAUSES active; again after each jump to its start."""
    try:
        while True:
            naive.active = clauses
            try:
                return body()
            except Jump as jump:
                if jump.target is not clauses.place:
                    raise
                if jump.values != ["retry"]:
                    return jump.values
    finally:
        clauses.place.live = False
        naive.active = clauses.outer


@form("WITH-RECOVERY-PROCEDURES")
def with_recovery_procedures(naive: Naive, env: Environment, clauses: Value, *forms: Value) -> list[Value]:
    form = Clauses(naive.active, [])
    inner = Environment(env, THIS_FORM, None, form.place)
    for clause in items(clauses):
        (cause, names), rest, limit = parts_of(clause.car), items(clause.cdr), 1
        if rest and rest[0] is Keyword("RETRIES"):
            limit, rest = (ALWAYS if rest[1] is Keyword("INFINITE") else rest[1]), rest[2:]
        form.clauses.append((cause, limit, procedure(naive, names, rest, inner)))
        form.used.append(0)
    return with_clauses(naive, form, lambda: naive.body(forms, env))


def parts_of(head: Value) -> tuple[Value, list[Symbol]]:
    """The cause and the parameters that a recovery clause begins with."""
    return (head.car, items(head.cdr)) if head.__class__ is Cons else (head, [])


def procedure(naive: Naive, names: list[Symbol], forms: list[Value], env: Environment) -> Callable[..., Any]:
    """A recovery procedure: it takes any arguments; what is missing is NIL."""

    def run(*given: Value) -> list[Value]:
        bound = [(name, given[i] if i < len(given) else None) for i, name in enumerate(names)]
        return naive.bind(bound, env, lambda inner: naive.body(forms, inner))

    return run


@form("RETRY")
def retry(naive: Naive, env: Environment) -> list[Value]:
    return naive.leave(env.find(THIS_FORM, None).meaning, ["retry"])


@form("ABORT")
def abort(naive: Naive, env: Environment, result: Value = None) -> list[Value]:
    value = naive.one(result, env)
    return naive.leave(env.find(THIS_FORM, None).meaning, [value])


@form("HANDLER-CASE")
def handler_case(naive: Naive, env: Environment, each: Value, clause: Value) -> list[Value]:
    """Of one clause, for every failure."""
    caught: list[Value] = []
    form = Clauses(
        naive.active, [(Keyword("GENERAL-FAILURE"), ALWAYS, lambda *given: naive.leave(form.place, caught))]
    )
    values = with_clauses(naive, form, lambda: naive.eval(each, env))
    return naive.body(items(clause.cdr.cdr), env) if values is caught else values


@form("WITH-CLEANUP-PROCEDURE")
def with_cleanup_procedure(naive: Naive, env: Environment, cleanup: Value, *forms: Value) -> list[Value]:
    outer = naive.active
    try:
        return naive.body(forms, env)
    except Jump as jump:
        if jump.failed:
            naive.active = outer
            naive.eval(cleanup, env)
        raise
