"""Special forms that bind variables: LET and its kin, and multiple values."""

from __future__ import annotations

from eslang.base.lists import Cons
from eslang.base.shown import shown
from eslang.base.symbols import Keyword, Symbol, Value
from eslang.compile.analyser import Analyser
from eslang.compile.core import (
    Bind,
    Const,
    First,
    Funcall,
    Gather,
    Let,
    Local,
    Node,
    Progv,
    Receive,
    Several,
    Variable,
)
from eslang.compile.core_forms import (
    SPECIAL_NAME,
    declare_specials,
    declared,
    refuse_not_offered,
    split_body,
)
from eslang.compile.registry import special_form
from eslang.compile.scope import SPECIAL, Scope, SymbolMacro


def is_special(analyser: Analyser, symbol: Symbol, specials: set[Symbol]) -> bool:
    """True if binding SYMBOL here is a dynamic binding; a constant cannot be bound."""
    cell = analyser.image.cell(symbol)
    if cell.constant:
        analyser.fail("constant-assignment", f"`{shown(symbol)}` is a constant and cannot be bound")
    refuse_not_offered(analyser, symbol)
    return symbol in specials or cell.special


def binding_parts(analyser: Analyser, binding: Value, what: str) -> tuple[Symbol, Cons]:
    """The name of a LET binding, and a list whose car is its form."""
    if isinstance(binding, Symbol):
        return binding, Cons(None, None)
    if binding.__class__ is not Cons or not isinstance(binding.car, Symbol):
        analyser.fail(
            "malformed-binding",
            f"`{shown(binding)}` is no binding of `{what}`",
            hint="write `(name form)`",
        )
    rest = binding.cdr
    if rest is None:
        return binding.car, Cons(None, None)
    if rest.__class__ is not Cons or rest.cdr is not None:
        analyser.fail(
            "malformed-binding",
            f"the binding of `{shown(binding.car)}` has more than one form",
            analyser.spans.of(binding),
            hint="write `(name form)`",
        )
    return binding.car, rest


def bindings_of(analyser: Analyser, lst: Value, what: str) -> list[tuple[Symbol, Cons]]:
    """The bindings of a LET-like form."""
    result = []
    rest = lst
    while rest.__class__ is Cons:
        result.append(binding_parts(analyser, rest.car, what))
        rest = rest.cdr
    if rest is not None:
        analyser.fail(
            "malformed-binding",
            f"`{shown(rest)}` is no list of bindings",
            hint=f"write `({what} ((name form)) ...)`",
        )
    return result


def given(variable: Variable, value: Node) -> Variable:
    """VARIABLE, which gets VALUE where it is bound, and nothing but what SETQ gives it later."""
    variable.given = [value]
    return variable


def refuse_twice(analyser: Analyser, bindings: list[tuple[Symbol, Cons]]) -> None:
    """Fail if LET binds a variable twice."""
    names: set[Symbol] = set()
    for symbol, holder in bindings:
        if symbol in names:
            analyser.fail(
                "malformed-binding",
                f"`let` binds `{shown(symbol)}` twice",
                analyser.spans.element(holder),
                hint="give one of them another name, or write `let*`",
            )
        names.add(symbol)


@special_form("(let bindings &body forms)")
def let(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS with BINDINGS, all computed before any is bound."""
    declarations, _, forms = split_body(form.cdr.cdr)
    specials = declared(declarations, SPECIAL_NAME)
    inner = scope.inner()
    lexical: list[tuple[Variable, Node]] = []
    dynamic: list[tuple[Symbol, Node]] = []
    bindings = bindings_of(analyser, form.cdr.car, "let")
    refuse_twice(analyser, bindings)
    values = [analyser.nodes(Cons(holder.car, None), scope)[0] for _, holder in bindings]
    any_dynamic = any(is_special(analyser, symbol, specials) for symbol, _ in bindings)
    for (symbol, _), value in zip(bindings, values, strict=True):
        if not is_special(analyser, symbol, specials):
            lexical.append((given(analyser.variable(symbol, inner), value), value))
        elif len(bindings) == 1:
            dynamic.append((symbol, value))
        else:  # computed in its turn, bound after all the others are computed
            waiting = analyser.unnamed_variable(symbol, inner)
            waiting.mentioned = True
            lexical.append((waiting, value))
            dynamic.append((symbol, Local(analyser.span, waiting)))
    for symbol, _ in dynamic:
        inner.variables[symbol] = SPECIAL
    declare_specials(analyser, declarations, inner)
    nesting = scope.procedure.nesting
    scope.procedure.nesting += 2 if any_dynamic else 0
    body = analyser.body(forms, inner)
    scope.procedure.nesting = nesting
    if dynamic:
        body = Bind(analyser.span, dynamic, body)
    return Let(analyser.span, lexical, body) if lexical else body


@special_form("(let* bindings &body forms)")
def let_star(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS with the variables of BINDINGS, each seen by those behind it."""
    declarations, _, forms = split_body(form.cdr.cdr)
    return sequential(analyser, bindings_of(analyser, form.cdr.car, "let*"), declarations, forms, scope)


def sequential(
    analyser: Analyser,
    bindings: list[tuple[Symbol, Cons]],
    declarations: list[Cons],
    forms: Value,
    scope: Scope,
) -> Node:
    """The node of LET*: each binding in the scope of those before it."""
    specials = declared(declarations, SPECIAL_NAME)
    wrappers: list[Let | Bind] = []
    nesting = scope.procedure.nesting
    for symbol, holder in bindings:
        value = analyser.nodes(Cons(holder.car, None), scope)[0]
        scope = scope.inner()
        if is_special(analyser, symbol, specials):
            scope.variables[symbol] = SPECIAL
            scope.procedure.nesting += 2
            wrappers.append(Bind(analyser.span, [(symbol, value)], value))
        else:
            variable = given(analyser.variable(symbol, scope), value)
            wrappers.append(Let(analyser.span, [(variable, value)], value))
    scope = scope.inner()
    declare_specials(analyser, declarations, scope)
    body = analyser.body(forms, scope)
    scope.procedure.nesting = nesting
    for wrapper in reversed(wrappers):
        wrapper.body = body
        if isinstance(wrapper, Let) and isinstance(body, Let):
            wrapper.bindings += body.bindings
            wrapper.body = body.body
        body = wrapper
    return body


@special_form("(symbol-macrolet bindings &body forms)")
def symbol_macrolet(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS, in which each name of BINDINGS stands for its form."""
    inner = scope.inner()
    for symbol, holder in bindings_of(analyser, form.cdr.car, "symbol-macrolet"):
        inner.variables[symbol] = SymbolMacro(holder.car)
    declarations, _, forms = split_body(form.cdr.cdr)
    declare_specials(analyser, declarations, inner)
    return analyser.body(forms, inner)


@special_form("(progv symbols values &body forms)")
def progv(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS with the variables in the list SYMBOLS bound to VALUES."""
    symbols, values = analyser.nodes(Cons(form.cdr.car, Cons(form.cdr.cdr.car, None)), scope)
    scope.procedure.nesting += 2
    body = analyser.body(form.cdr.cdr.cdr, scope)
    scope.procedure.nesting -= 2
    return Progv(analyser.span, symbols, values, body)


@special_form("(values &rest forms)")
def values(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Give the values of all FORMS, as multiple values."""
    nodes = analyser.nodes(form.cdr, scope)
    return Several(analyser.span, nodes)


@special_form("(multiple-value-bind variables values-form &body forms)")
def multiple_value_bind(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS with VARIABLES bound to all the values of VALUES-FORM.

    A variable for which there is no value is NIL.
    """
    source = analyser.nodes(Cons(form.cdr.cdr.car, None), scope)[0]
    declarations, _, forms = split_body(form.cdr.cdr.cdr)
    specials = declared(declarations, SPECIAL_NAME)
    inner = scope.inner()
    variables: list[Variable] = []
    dynamic: list[tuple[Symbol, Node]] = []
    rest = form.cdr.car
    while rest.__class__ is Cons:
        symbol = rest.car
        if not isinstance(symbol, Symbol) or isinstance(symbol, Keyword):
            analyser.fail(
                "malformed-binding", f"`{shown(symbol)}` is no variable", analyser.spans.element(rest)
            )
        if is_special(analyser, symbol, specials):
            waiting = analyser.unnamed_variable(symbol, inner)
            waiting.mentioned = True
            dynamic.append((symbol, Local(analyser.span, waiting)))
            inner.variables[symbol] = SPECIAL
            variables.append(waiting)
        else:
            variables.append(analyser.variable(symbol, inner))
        rest = rest.cdr
    declare_specials(analyser, declarations, inner)
    scope.procedure.nesting += 2 if dynamic else 0
    body = analyser.body(forms, inner)
    scope.procedure.nesting -= 2 if dynamic else 0
    if dynamic:
        body = Bind(analyser.span, dynamic, body)
    return Receive(analyser.span, variables, source, body)


@special_form("(multiple-value-call function &rest forms)")
def multiple_value_call(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Call FUNCTION with all the values of all FORMS as its arguments."""
    function, *nodes = analyser.nodes(form.cdr, scope)
    return Gather(analyser.span, function, nodes)


@special_form("(multiple-value-prog1 first &rest forms)")
def multiple_value_prog1(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Give all the values of FIRST, having run FORMS after it."""
    first, *rest = analyser.nodes(form.cdr, scope)
    return First(analyser.span, first, rest)


@special_form("(funcall function &rest arguments)")
def funcall(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Call FUNCTION, a function or the name of one, with ARGUMENTS.

    Returns: all its values.
    Fails:   :undefined-function, :type-error if FUNCTION is none.
    """
    from eslang.compile.core import Call, FunctionOf, Lambda

    function, *arguments = analyser.nodes(form.cdr, scope)
    if isinstance(function, FunctionOf) and not function.setf:
        return Call(analyser.span, function.symbol, arguments)
    if isinstance(function, Const) and isinstance(function.value, Symbol):
        return Call(analyser.span, function.value, arguments)
    return Funcall(analyser.span, function, arguments, known=isinstance(function, Lambda))
