"""What the naive evaluator knows of the language: special forms, macros, functions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from eslang.base.lists import Cons, from_items, items
from eslang.base.symbols import Keyword, Symbol, T, Value, truth
from naive.evaluator import (
    CONTROL_ERROR,
    ERROR,
    FORMS,
    FUNCTIONS,
    HIGHER,
    Clauses,
    Environment,
    HostError,
    Jump,
    Macro,
    Naive,
    Place,
)

ALWAYS = 10**9
THIS_FORM = "this form"


def form(*names: str) -> Callable[[Any], Any]:
    """Let a function be what the forms called NAMES do."""

    def register(function: Any) -> Any:
        for name in names:
            FORMS[name] = function
        return function

    return register


# --- order and choice ----------------------------------------------------------------

FORMS["QUOTE"] = lambda naive, env, value: [value]
FORMS["PROGN"] = lambda naive, env, *forms: naive.body(forms, env)
FORMS["LOCALLY"] = FORMS["PROGN"]
FORMS["THE"] = lambda naive, env, kind, each: naive.eval(each, env)


@form("IF")
def if_(naive: Naive, env: Environment, test: Value, then: Value, otherwise: Value = None) -> list[Value]:
    return naive.eval(then if naive.one(test, env) is not None else otherwise, env)


@form("WHEN")
def when(naive: Naive, env: Environment, test: Value, *forms: Value) -> list[Value]:
    return naive.body(forms, env) if naive.one(test, env) is not None else [None]


@form("UNLESS")
def unless(naive: Naive, env: Environment, test: Value, *forms: Value) -> list[Value]:
    return naive.body(forms, env) if naive.one(test, env) is None else [None]


@form("COND")
def cond(naive: Naive, env: Environment, *clauses: Value) -> list[Value]:
    for clause in clauses:
        test = naive.one(clause.car, env)
        if test is not None:
            return naive.body(items(clause.cdr), env) if clause.cdr is not None else [test]
    return [None]


@form("CASE")
def case(naive: Naive, env: Environment, key: Value, *clauses: Value) -> list[Value]:
    value = naive.one(key, env)
    for clause in clauses:
        keys = items(clause.car) if clause.car.__class__ is Cons else [clause.car]
        if clause.car is T or any(each is value or each == value for each in keys):
            return naive.body(items(clause.cdr), env)
    return [None]


@form("AND")
def and_(naive: Naive, env: Environment, *forms: Value) -> list[Value]:
    for each in forms[:-1]:
        if naive.one(each, env) is None:
            return [None]
    return naive.eval(forms[-1] if forms else T, env)


@form("OR")
def or_(naive: Naive, env: Environment, *forms: Value) -> list[Value]:
    for each in forms[:-1]:
        value = naive.one(each, env)
        if value is not None:
            return [value]
    return naive.eval(forms[-1] if forms else None, env)


@form("PROG1")
def prog1(naive: Naive, env: Environment, first: Value, *forms: Value) -> list[Value]:
    value = naive.one(first, env)
    naive.body(forms, env)
    return [value]


# --- variables and functions ---------------------------------------------------------


def binding(pair: Value) -> tuple[Symbol, Value]:
    """The name and the form of a binding of LET."""
    return (pair.car, pair.cdr.car) if pair.__class__ is Cons else (pair, None)


@form("LET")
def let(naive: Naive, env: Environment, pairs: Value, *forms: Value) -> list[Value]:
    bound = [(name, naive.one(value, env)) for name, value in map(binding, items(pairs))]
    return naive.bind(bound, env, lambda inner: naive.body(forms, inner))


@form("LET*")
def let_star(naive: Naive, env: Environment, pairs: Value, *forms: Value) -> list[Value]:
    if pairs is None:
        return naive.body(forms, env)
    name, value = binding(pairs.car)
    bound = [(name, naive.one(value, env))]
    return naive.bind(bound, env, lambda inner: let_star(naive, inner, pairs.cdr, *forms))


@form("SETQ")
def setq(naive: Naive, env: Environment, *pairs: Value) -> list[Value]:
    value = None
    for symbol, each in zip(pairs[::2], pairs[1::2], strict=True):
        value = naive.one(each, env)
        naive.assign(symbol, value, env)
    return [value]


@form("PROGV")
def progv(naive: Naive, env: Environment, symbols: Value, values: Value, *forms: Value) -> list[Value]:
    names, given = items(naive.one(symbols, env)), items(naive.one(values, env))
    return naive.bind(list(zip(names, given, strict=True)), env, lambda inner: naive.body(forms, inner))


@form("LAMBDA")
def lambda_(naive: Naive, env: Environment, lst: Value, *forms: Value) -> list[Value]:
    return [naive.lambda_(lst, list(forms), env)]


@form("FUNCTION")
def function(naive: Naive, env: Environment, name: Value) -> list[Value]:
    return [naive.function_of(name, env)]


def in_block(name: Value, forms: Value) -> list[Value]:
    """The body of a function that is a block of its own name."""
    return [Cons(Symbol.intern("BLOCK", "COMMON-LISP"), Cons(name, forms))]


@form("FLET")
def flet(naive: Naive, env: Environment, definitions: Value, *forms: Value) -> list[Value]:
    inner = env
    for each in items(definitions):
        made = naive.lambda_(each.cdr.car, in_block(each.car, each.cdr.cdr), env)
        inner = Environment(inner, "function", each.car, made)
    return naive.body(forms, inner)


@form("LABELS")
def labels(naive: Naive, env: Environment, definitions: Value, *forms: Value) -> list[Value]:
    frames = []
    for each in items(definitions):
        env = Environment(env, "function", each.car, None)
        frames.append((env, each))
    for frame, each in frames:
        frame.meaning = naive.lambda_(each.cdr.car, in_block(each.car, each.cdr.cdr), env)
    return naive.body(forms, env)


@form("MACROLET")
def macrolet(naive: Naive, env: Environment, definitions: Value, *forms: Value) -> list[Value]:
    inner = env
    for each in items(definitions):
        expander = naive.lambda_(each.cdr.car, items(each.cdr.cdr), Environment(None, "", None, None))
        inner = Environment(inner, "function", each.car, Macro(expander))
    return naive.body(forms, inner)


@form("SYMBOL-MACROLET")
def symbol_macrolet(naive: Naive, env: Environment, pairs: Value, *forms: Value) -> list[Value]:
    for name, expansion in map(binding, items(pairs)):
        env = Environment(env, "variable", name, Macro(expansion))
    return naive.body(forms, env)


@form("QUASIQUOTE")
def quasiquote(naive: Naive, env: Environment, template: Value) -> list[Value]:
    """Templates one level deep."""
    if template.__class__ is not Cons:
        return [template]
    if isinstance(template.car, Symbol) and template.car.name == "UNQUOTE":
        return [naive.one(template.cdr.car, env)]
    head, tail = template.car, template.cdr
    if head.__class__ is Cons and isinstance(head.car, Symbol) and head.car.name == "UNQUOTE-SPLICING":
        spliced = items(naive.one(head.cdr.car, env))
        return [from_items(spliced, quasiquote(naive, env, tail)[0])]
    first = quasiquote(naive, env, head)[0]
    return [Cons(first, quasiquote(naive, env, tail)[0])]


# --- multiple values -----------------------------------------------------------------


@form("VALUES")
def values(naive: Naive, env: Environment, *forms: Value) -> list[Value]:
    return [naive.one(each, env) for each in forms]


@form("MULTIPLE-VALUE-LIST")
def multiple_value_list(naive: Naive, env: Environment, each: Value) -> list[Value]:
    return [from_items(naive.eval(each, env))]


@form("MULTIPLE-VALUE-BIND")
def multiple_value_bind(naive: Naive, env: Environment, names: Value, each: Value, *forms: Value) -> list[Value]:
    given = naive.eval(each, env)
    bound = [(name, given[i] if i < len(given) else None) for i, name in enumerate(items(names))]
    return naive.bind(bound, env, lambda inner: naive.body(forms, inner))


@form("MULTIPLE-VALUE-SETQ")
def multiple_value_setq(naive: Naive, env: Environment, names: Value, each: Value) -> list[Value]:
    given = naive.eval(each, env) or [None]
    for i, name in enumerate(items(names)):
        naive.assign(name, given[i] if i < len(given) else None, env)
    return given[:1]


@form("MULTIPLE-VALUE-CALL")
def multiple_value_call(naive: Naive, env: Environment, function: Value, *forms: Value) -> list[Value]:
    called = naive.one(function, env)
    return naive.apply(called, [value for each in forms for value in naive.eval(each, env)])


@form("MULTIPLE-VALUE-PROG1")
def multiple_value_prog1(naive: Naive, env: Environment, first: Value, *forms: Value) -> list[Value]:
    result = naive.eval(first, env)
    naive.body(forms, env)
    return result


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
    form = Clauses(naive.active, [(Keyword("GENERAL-FAILURE"), ALWAYS, lambda *given: naive.leave(form.place, caught))])
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


# --- functions -----------------------------------------------------------------------


def number(value: Value) -> int:
    """VALUE, which must be a number."""
    if value.__class__ is not int:
        raise HostError("TYPE-ERROR")
    return value  # type: ignore[no-any-return]


def part(name: str) -> Callable[[Value], Value]:
    """CAR or CDR."""

    def take(value: Value) -> Value:
        if value is not None and value.__class__ is not Cons:
            raise HostError("TYPE-ERROR")
        return getattr(value, name, None)

    return take


FUNCTIONS.update(
    {
        "+": lambda *given: sum(map(number, given)),
        "-": lambda first, *rest: number(first) - sum(map(number, rest)) if rest else -number(first),
        "*": lambda left, right: number(left) * number(right),
        "1+": lambda value: number(value) + 1,
        "1-": lambda value: number(value) - 1,
        "<": lambda left, right: truth(number(left) < number(right)),
        ">": lambda left, right: truth(number(left) > number(right)),
        "=": lambda left, right: truth(number(left) == number(right)),
        "EQL": lambda left, right: truth(left is right or (left.__class__ is right.__class__ is int and left == right)),
        "NOT": lambda value: truth(value is None),
        "CONS": Cons,
        "CAR": part("car"),
        "CDR": part("cdr"),
        "LIST": lambda *given: from_items(given),
        "REVERSE": lambda lst: from_items(items(lst)[::-1]),
        "LENGTH": lambda lst: len(items(lst)),
        "FUNCTIONP": lambda value: truth(callable(value)),
    }
)


def higher(name: str) -> Callable[[Any], Any]:
    """Let a Python function be the Lisp function NAME, which needs the evaluator or gives several values."""

    def register(function: Any) -> Any:
        HIGHER[name] = function
        return function

    return register


@higher("NOTE")
def note(naive: Naive, value: Value) -> list[Value]:
    naive.trace.append(value)
    return [value]


@higher("FUNCALL")
def funcall(naive: Naive, function: Value, *given: Value) -> list[Value]:
    return naive.apply(function, list(given))


@higher("APPLY")
def apply(naive: Naive, function: Value, *given: Value) -> list[Value]:
    return naive.apply(function, [*given[:-1], *items(given[-1])])


@higher("MAPCAR")
def mapcar(naive: Naive, function: Value, lst: Value) -> list[Value]:
    return [from_items([(naive.apply(function, [each]) or [None])[0] for each in items(lst)])]


@higher("FAIL")
def fail(naive: Naive, cause: Value, *given: Value) -> list[Value]:
    return [naive.signal(cause, list(given), continuable=True)]


@higher("ERROR")
def error(naive: Naive, message: Value) -> list[Value]:
    return [naive.signal(ERROR, [])]


@higher("VALUES-LIST")
def values_list(naive: Naive, lst: Value) -> list[Value]:
    return items(lst)
