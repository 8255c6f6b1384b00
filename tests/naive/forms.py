"""Forms that the naive evaluator knows: order, choice, variables, functions, multiple values."""

from __future__ import annotations

from eslang.base.lists import Cons, from_items, items
from eslang.base.symbols import Symbol, T, Value
from naive.evaluator import FORMS, Environment, Macro, Naive, form

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
def multiple_value_bind(
    naive: Naive, env: Environment, names: Value, each: Value, *forms: Value
) -> list[Value]:
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
