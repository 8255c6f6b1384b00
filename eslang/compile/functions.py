"""Special forms that make functions: LAMBDA, FUNCTION, FLET, LABELS, MACROLET."""

from __future__ import annotations

from eslang.base.lists import Cons, items, lisp_list
from eslang.base.printer import prin1
from eslang.base.shown import shown
from eslang.base.symbols import Symbol, Value
from eslang.compile.analyser import LAMBDA, Analyser
from eslang.compile.bindings import is_special, sequential
from eslang.compile.core import (
    FunctionOf,
    KeyParameter,
    Lambda,
    Local,
    LocalFunctions,
    Node,
    Optional,
    Variable,
)
from eslang.compile.core_forms import SPECIAL_NAME, declare_specials, declared, split_body
from eslang.compile.destructuring import macro_lambda
from eslang.compile.exits import named_block
from eslang.compile.lambda_lists import BadLambdaList, LambdaList, Parameter, parse_lambda_list
from eslang.compile.registry import special_form
from eslang.compile.scope import LocalMacro, Scope

SETF = Symbol.intern("SETF", "COMMON-LISP")


def checked_lambda_list(analyser: Analyser, lst: Value, *, destructuring: bool = False) -> LambdaList:
    """The parts of a lambda list; a diagnostic for what is wrong with it."""
    try:
        return parse_lambda_list(lst, destructuring=destructuring)
    except BadLambdaList as mistake:
        named = f": `{shown(mistake.element)}`" if mistake.element is not None else ""
        analyser.fail("malformed-lambda-list", mistake.message + named, analyser.spans.of(lst))


class _Parameters:
    """Binds the parameters of one lambda list, in order, in the function's scope."""

    def __init__(self, analyser: Analyser, scope: Scope) -> None:
        self.analyser = analyser
        self.scope = scope

    def bind(self, symbol: Symbol) -> Variable:
        """The variable of a parameter."""
        return self.analyser.variable(symbol, self.scope)

    def default(self, parameter: Parameter) -> tuple[Variable, Node, Variable | None]:
        """The variable, default and supplied-p variable of an optional or keyword parameter."""
        default = self.analyser.nodes(Cons(parameter.default, None), self.scope)[0]
        variable = self.bind(parameter.name)
        supplied = self.bind(parameter.supplied) if parameter.supplied is not None else None
        return variable, default, supplied


def _check_names(analyser: Analyser, names: list[Symbol]) -> None:
    """Fail if two parameters have the same name."""
    for index, symbol in enumerate(names):
        if symbol in names[:index]:
            analyser.fail("malformed-lambda-list", f"the parameter `{shown(symbol)}` stands here twice")


def _rebound(parts: LambdaList) -> LambdaList:
    """PARTS with other names for all parameters, so that auxiliary ones get theirs, one after the other.

    A special parameter is bound that way before the defaults behind it are computed.
    """
    aux: list[Parameter] = []

    def wait(symbol: Symbol) -> Symbol:
        waiting = Symbol.uninterned(symbol.name)
        aux.append(Parameter(symbol, waiting))
        return waiting

    def wait_or_default(parameter: Parameter) -> Parameter:
        waiting, given = Symbol.uninterned(parameter.name.name), Symbol.uninterned("SUPPLIED")
        aux.append(Parameter(parameter.name, lisp_list(IF, given, waiting, parameter.default)))
        if parameter.supplied is not None:
            aux.append(Parameter(parameter.supplied, given))
        return Parameter(waiting, None, given, parameter.keyword)

    required = [wait(symbol) for symbol in parts.required]
    optional = [wait_or_default(parameter) for parameter in parts.optional]
    rest = wait(parts.rest) if parts.has_rest else None
    keys = [wait_or_default(parameter) for parameter in parts.keys] if parts.keys is not None else None
    return LambdaList(
        required, optional, rest, parts.has_rest, keys, parts.allow_other_keys, [*aux, *parts.aux]
    )


def function_node(
    analyser: Analyser,
    name: str,
    lst: Value,
    forms: Value,
    scope: Scope,
    block: Symbol | None = None,
    *,
    named: bool = False,
) -> Lambda:
    """The node of a function with lambda list LST and body FORMS, in a block called BLOCK if `named`."""
    parts = checked_lambda_list(analyser, lst)
    declarations, documentation, forms = split_body(forms, documented=True)
    specials = declared(declarations, SPECIAL_NAME)
    names = parts.names()
    _check_names(analyser, names)
    if any(is_special(analyser, symbol, specials) for symbol in names):
        parts = _rebound(parts)
    procedure = analyser.procedure(name, scope)
    inner = scope.inner(procedure)
    parameters = _Parameters(analyser, inner)
    required = [parameters.bind(symbol) for symbol in parts.required]
    optional = [Optional(*parameters.default(parameter)) for parameter in parts.optional]
    rest = parameters.bind(parts.rest) if parts.has_rest else None
    keys = None
    if parts.keys is not None:
        keys = [KeyParameter(p.keyword, *parameters.default(p)) for p in parts.keys if p.keyword is not None]
    body = _function_body(analyser, parts, declarations, forms, inner, block, named)
    return Lambda(
        analyser.span, procedure, required, optional, rest, keys, parts.allow_other_keys, body, documentation
    )


def _function_body(
    analyser: Analyser,
    parts: LambdaList,
    declarations: list[Cons],
    forms: Value,
    scope: Scope,
    block: Symbol | None,
    named: bool,
) -> Node:
    if parts.aux:
        if named:
            forms = Cons(Cons(BLOCK, Cons(block, forms)), None)
        pairs = [(p.name, Cons(p.default, None)) for p in parts.aux]
        return sequential(analyser, pairs, declarations, forms, scope)
    declare_specials(analyser, declarations, scope)
    return named_block(analyser, block, forms, scope) if named else analyser.body(forms, scope)


BLOCK, IF = (Symbol.intern(name, "COMMON-LISP") for name in ("BLOCK", "IF"))


@special_form("(lambda lambda-list &body forms)")
def lambda_(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Give a function with the parameters LAMBDA-LIST and the body FORMS."""
    return function_node(analyser, "lambda", form.cdr.car, form.cdr.cdr, scope)


@special_form("(function name)")
def function(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Give the function called NAME here, or the one that a LAMBDA form makes."""
    name = form.cdr.car
    if name.__class__ is Cons and name.car is LAMBDA:
        return analyser.nodes(form.cdr, scope)[0]
    if name.__class__ is Cons and name.car is NAMED_LAMBDA:
        block = name.cdr.car
        return function_node(
            analyser, prin1(block).lower(), name.cdr.cdr.car, name.cdr.cdr.cdr, scope, block, named=True
        )
    setf = setf_name(name)
    if not isinstance(name, Symbol) and setf is None:
        analyser.fail("bad-operator", f"`{shown(name)}` cannot name a function")
    found = scope.find_function((SETF, setf) if setf is not None else name)
    if isinstance(found, Variable):
        return Local(analyser.span, found)
    symbol = setf or name
    if isinstance(found, LocalMacro) or (
        setf is None
        and not hasattr(analyser.image.cell(symbol), "function")
        and _is_operator(analyser, symbol)
    ):
        analyser.fail("bad-operator", f"`{shown(symbol)}` is no function, but a macro or special form")
    if setf is None:
        analyser.use("function", symbol, None, form, scope)
    return FunctionOf(analyser.span, symbol, setf=setf is not None)


def _is_operator(analyser: Analyser, symbol: Symbol) -> bool:
    """True if SYMBOL names a macro or a special form."""
    return symbol in analyser.image.special_forms or analyser.image.cell(symbol).macro is not None


NAMED_LAMBDA = Symbol.intern("%NAMED-LAMBDA", "COMMON-LISP")


def setf_name(name: Value) -> Symbol | None:
    """The symbol of a function name (setf symbol); None for any other name."""
    if (
        name.__class__ is Cons
        and name.car is SETF
        and name.cdr.__class__ is Cons
        and isinstance(name.cdr.car, Symbol)
    ):
        symbol: Symbol = name.cdr.car
        return symbol
    return None


def _local_definitions(analyser: Analyser, form: Cons) -> list[tuple[Value, Value, Value, Cons]]:
    """The (key, name, lambda list, body) of each definition of FLET, LABELS or MACROLET."""
    result = []
    rest = form.cdr.car
    while rest.__class__ is Cons:
        definition = rest.car
        name = definition.car if definition.__class__ is Cons else None
        setf = setf_name(name)
        if (
            definition.__class__ is not Cons
            or definition.cdr.__class__ is not Cons
            or not (isinstance(name, Symbol) or setf is not None)
        ):
            analyser.fail(
                "malformed-binding",
                f"`{shown(definition)}` defines no function",
                analyser.spans.of(definition) or analyser.spans.element(rest),
                hint="write `(name (parameter...) form...)`",
            )
        result.append(
            ((SETF, setf) if setf is not None else name, setf or name, definition.cdr.car, definition)
        )
        rest = rest.cdr
    return result


def _local_functions(analyser: Analyser, form: Cons, scope: Scope, *, recursive: bool) -> Node:
    inner = scope.inner()
    functions: list[tuple[Variable, Lambda]] = []
    definitions = _local_definitions(analyser, form)
    variables = [analyser.unnamed_variable(name, inner) for _, name, _, _ in definitions]
    bound = {key: variable for (key, _, _, _), variable in zip(definitions, variables, strict=True)}
    if recursive:
        inner.functions.update(bound)
    around = analyser.span
    for (_, name, lst, definition), variable in zip(definitions, variables, strict=True):
        analyser.span = analyser.spans.of(definition) or around
        node = function_node(
            analyser,
            name.name.lower(),
            lst,
            definition.cdr.cdr,
            inner if recursive else scope,
            name,
            named=True,
        )
        functions.append((variable, node))
    analyser.span = around
    inner.functions.update(bound)
    body_scope = inner.inner()
    declarations, _, forms = split_body(form.cdr.cdr)
    declare_specials(analyser, declarations, body_scope)
    return LocalFunctions(analyser.span, functions, analyser.body(forms, body_scope))


@special_form("(flet definitions &body forms)")
def flet(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS with local functions that do not see one another."""
    return _local_functions(analyser, form, scope, recursive=False)


@special_form("(labels definitions &body forms)")
def labels(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS with local functions that see one another."""
    return _local_functions(analyser, form, scope, recursive=True)


@special_form("(macrolet definitions &body forms)")
def macrolet(analyser: Analyser, form: Cons, scope: Scope) -> Node:
    """Run FORMS with the local macros of DEFINITIONS."""
    return analyser.body(*macrolet_scope(analyser, form, scope))


def macrolet_scope(analyser: Analyser, form: Cons, scope: Scope) -> tuple[Value, Scope]:
    """The body of a MACROLET form, and the scope with its macros."""
    inner = scope.inner()
    for key, name, lst, definition in _local_definitions(analyser, form):
        expander = analyser.compile_expander(macro_lambda(analyser, name, lst, definition.cdr.cdr), scope)
        inner.functions[key] = LocalMacro(expander)
    declarations, _, forms = split_body(form.cdr.cdr)
    declare_specials(analyser, declarations, inner)
    return forms, inner


def parameter_names(lst: Value) -> str:
    """A lambda list as it is shown in a signature, without defaults."""
    words = []
    for element in items(lst) if lst.__class__ is Cons else []:
        while element.__class__ is Cons and not isinstance(element.car, Symbol):
            element = element.car
        words.append(prin1(element.car if element.__class__ is Cons else element).lower())
    return " ".join(words)
